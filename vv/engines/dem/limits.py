"""The limits beyond which a run counts as diverged, relative to all energy put into it."""

GAIN = 4.0
"""The limit of m v- v+/2 and springs, relative to the energy put in: 4 doubles all speeds.

A stable leapfrog conserves that sum; only a contact that closes or opens within a step adds to it,
by at most kn (v dt)^2/8 each time (vv.engines.dem.leapfrog).
"""

BLOW_UP = 1e6
"""The limit of m v+^2/2, relative to the energy put in.

Near the largest stable step 2/w, the ratio is 1/(1 - (w dt/2)^2) in a stable run. In an unstable
run it grows without limit, although m v- v+/2 and the springs still conserve their sum.
"""
