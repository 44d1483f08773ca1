"""Numbers that bound what the DDA solver does, with their reasons."""

CUTS = 32
"""The largest number of parts of a step; parts that do not converge are kept, and counted."""

SOON = 1e-3
"""A step is not divided where a slide stops within this fraction of it from either end."""

ALONG = 1e-9
"""The sine of an angle below which two directions are one."""

GAIN = 4.0
"""A run has diverged if kinetic and elastic energy exceed this many times all energy put in.

On fixed normals the scheme only loses energy; only newly detected contacts can add to it.
"""

REACH = 0.01
"""The gap up to which contacts are detected, relative to the size of the smallest block."""

STATIC = 1e6
"""kn over the inertia stiffness in the steps that find the penetration under the loads."""

STATIC_STEPS = 4
"""The number of such steps; each reduces the error by a factor of STATIC."""

EASED, EASING = 8, 3.0
"""A third of the steps that release wedges at rest, and kn over the inertia stiffness in them.

Each step leaves a quarter of the error of the springs' forces; a slide of three times the
penetration under the loads rotates friction into its direction.
"""

ROUNDS, HARDER, EVENLY = 8, 4.0, 1e-4
"""The most rounds of such steps, the growth of kn over inertia per round, and a tolerance.

The growth is for narrow wedges, whose springs are softer than kn. The slide is steady if the
displacements in the last two thirds differ by less than the tolerance, relative to the whole.
"""

GOES_ON = 0.25
"""A block slides if it covers more than this part of its displacement in the last third."""

UNLIKE = 1e-9
"""Sine of the smallest angle between the normals of walls that count as two sides of a wedge."""

FLOAT = 1e3
"""A block that moves farther than this times all loads over kn is not supported."""

OPEN_CLOSE = 12
"""The number of open-close iterations before Newton's iteration; most steps need fewer."""

LEAST = 1e-3
"""The smallest fraction of a Newton increment, and the required relative decrease per fraction."""

MOST = 40
"""The number of iterations of formulations that are not limited to the published six."""

COULOMB = 1e-9
"""The allowed excess of friction over mu N, relative to the largest force, if it is converged."""

MOMENTUM = 1e-8
"""The allowed residual of a block's equations of motion, relative to the largest force."""

GRIP = 1e30
"""The coefficient of friction while the penetration at the start is found: nothing slides."""

SERIES = 12
"""Terms of an exponential series: exact to rounding for up to 0.1 rad per step."""

TURNS = 12
"""Iterations for the gyroscopic torque: exact to rounding for up to 0.1 rad per step."""

RADIUS = 0.5
"""The spectral radius of generalised alpha at infinite frequency."""

MULTIPLIERS = 40
"""The most times that multipliers take over the springs' forces in a step; most need four."""

HELD = 1e-10
"""The force that springs may still carry beside multipliers, relative to the largest force."""

FIRM = 10.0
"""Stiffness of springs over the inertia of a contact: a pass then leaves about a tenth."""

SLOW = 0.1
"""If a pass leaves more than this part of the springs' forces, springs become ten times stiffer."""

STUCK = 0.9
"""If a pass leaves more than this part, the springs' forces may be due to rounding of gaps.

Where gaps of corners differ by rounding, what a pass leaves falls as the inverse of their number,
and the forces of a narrow wedge converge meanwhile.
"""

PATIENT = 12
"""The passes after which friction may be left that still rotates where hardly anything slips.

Until then springs become stiffer, since gaps within rounding say nothing about friction.
"""

EIGHTHS = 8
"""Steps in which friction grows to mu N where a pass converges from no other start."""
