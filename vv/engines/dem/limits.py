"""When a run counts as diverged, in terms of all the energy that was ever put into it."""

GAIN = 4.0
"""The springs and m v- v+/2 may hold this many times the energy put in: twice its speed.

A stable leapfrog conserves that sum; only a contact that closes or opens within a step adds to
it, by at most kn (v dt)^2/8 each time (vv.engines.dem.leapfrog).
"""

BLOW_UP = 1e6
"""m v+^2/2 may be this many times the energy put in.

Near the largest stable step 2/w it is 1/(1 - (w dt/2)^2) of it in a stable run; in an unstable
one it grows without end although m v- v+/2 and the springs still add up.
"""
