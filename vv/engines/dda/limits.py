"""Numbers that bound what the DDA solver does, with their reasons."""

CUTS = 32
"""Parts a step is cut into at most; what does not converge even then is kept, and counted."""

GAIN = 4.0
"""Motion and springs may hold this many times the energy ever put in: more is divergence.

On fixed normals the scheme only loses energy; only contacts found anew can add to it.
"""

REACH = 0.01
"""Part of the smallest block's size within which a contact is sought before it closes."""

STATIC = 1e6
"""kn over the inertial stiffness in the step that finds the penetration under the loads."""

STATIC_STEPS = 4
"""Such steps taken: each leaves a part 1/STATIC of the error of the one before."""

EASED, EASING = 8, 3.0
"""Steps, three times, in which wedges at rest let go of what friction does not hold, and kn over
the inertial stiffness in them: each leaves a quarter of what springs bear wrongly, and a slide of
three times what loads press turns friction along it."""

ROUNDS, HARDER, EVENLY = 8, 4.0, 1e-4
"""Rounds of such steps at most, by what kn over inertia grows from each to the next, as a narrow
wedge is on softer springs than kn; and the part of the whole way by which the last two thirds
differ where the slide has become steady."""

GOES_ON = 0.25
"""Part of its way that a block goes in the last third of these steps, if it slides: what rests has
come to an end."""

UNLIKE = 1e-9
"""Sine of the angle between normals of walls that press a block from two sides."""

FLOAT = 1e3
"""Times all loads over kn: a block that moves farther under static loads rests on nothing."""

OPEN_CLOSE = 12
"""Open-close iterations before Newton's take over; most steps end in fewer."""

LEAST = 1e-3
"""Part of a step of Newton's that is taken at least, and by which what is left must shrink."""

MOST = 40
"""Open-close iterations of a formulation that does not stop at the published six."""

COULOMB = 1e-9
"""Of the largest force: friction beyond mu N where friction is iterated to convergence."""

MOMENTUM = 1e-8
"""Of the largest force: what a solution may leave of a block's equations of motion."""

GRIP = 1e30
"""Coefficient of friction while contacts are pressed at the start: none of them slides."""

SERIES = 12
"""Terms of an exponential series: rounding, for up to 0.1 rad a step."""

TURNS = 12
"""Rounds in which the gyroscopic torque of a step is found: rounding, for up to 0.1 rad a step."""

RADIUS = 0.5
"""Part of a swing that a step of generalised alpha keeps where it does not resolve the swing."""

MULTIPLIERS = 40
"""Times that multipliers take up the springs' forces before a step is cut; most steps need four."""

HELD = 1e-10
"""Part of the largest contact force that springs may still bear where multipliers bear forces."""

FIRM = 10.0
"""Springs under multipliers over the inertia of a contact: each pass then leaves a tenth or so."""

SLOW = 0.1
"""What a pass of multipliers may leave of the springs' forces before springs are ten times firmer.
"""

STUCK = 0.5
"""What a pass of multipliers leaves of the springs' forces where they are rounding of gaps."""

PATIENT = 12
"""Passes of multipliers before friction that still turns where next to nothing slips is left as it
is: until then springs become firmer, since gaps that are rounding say nothing of it."""
