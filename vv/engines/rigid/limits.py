"""Numbers that bound what the rigid solver does, with their reasons."""

SMALL = 8
"""Blocks up to which steps are cut at landings and where slip ends: beyond, there always is one."""

FINE, ROUNDED = 2e-11, 1e-13
"""Of the weight of a block, times the step, and of the speeds in a step: residuals asked of small
scenes, the larger counts. Summed over the steps the first is this part of what weights do; less
than the second is rounding."""

FINEST, COARSE, CONVERGED = 3e-13, 1.9e-6, 4.6e-6
"""Of a scene's speed: the largest residual asked of small scenes, where more would flatten the
order, and of others; and one above which friction creeps and a run is not to be believed."""

LONG = 1e4
"""Steps in which a weak field makes the speed that residuals of small scenes are parts of.

What it makes of its blocks as they fall by their own size is less by the root of the field; what
it makes within a run, by the field.
"""

CRAWLS = 2.5e-6
"""Of the speed of a fall over the smallest block: no larger residual is asked of large scenes.

However fast a wall is shaken, what it creeps by is seen beside the blocks of which it is built.
"""

FEWEST, MOST, SMALL_MOST = 20, 20_000, 1000
"""Sweeps made at least, and at most; in small scenes there is no least.

The least lets a wall at rest converge from step to step beyond the residual asked of one step.
A step is taken as it is after the most; its residual says so. Of 3000 steps of facades shaken apart
one needed nearly as many.
"""

UNHINTED, ENOUGH = 1e-5, 2000
"""Of the residual asked: in the first step of large scenes, whose impulses no step before hints at.

What stands goes on from there: left at the residual of any step, it settled for a hundred steps. A
wall that slides at once would take more than 10 000 sweeps; after enough of them the residual of
any step will do.
"""

CARRIED, STEADIED = 600, 200
"""Sweeps with momentum, and then with conjugate gradients, before the others have a turn.

Of 22 steps of a facade that falls apart, momentum alone left 14 above their residual after 3000
sweeps, and in turns 2 after 10 000. A sweep of conjugate gradients takes twice as long.
"""

STUCK, LEAPT = 2400, 7200
"""Sweeps of a large scene after which Newton steps are tried; with leaps, after which they end.

Walls of 200 blocks that slide take up to 10 000 sweeps with leaps in some steps. One shaken at
1.09 g had steps that needed more than 20 000, and 1600 more when they were begun again without.

A facade of 216 blocks that is shaken apart comes here in 2 to 4 of 100 steps. Newton steps cost as
much as some thousand sweeps, and sweeps alone had left one such step in forty above its residual.
"""

FAR = 10.0
"""Of the residual asked: where more is left after so many sweeps, they begin anew from no impulses.

Where blocks wedge, friction allows several answers, and of some of them sweeps keep away: from the
impulses of a hair's breadth beside, what was missing grew by 1.8 % in each. The step of a sliding
wall of 205 blocks that was near such an answer had 7e-5 m/s left after 20 000 sweeps, with Newton
steps among them; from no impulses it takes 980 sweeps to another one.
"""

STALLED = 60
"""Sweeps of a small scene or a chain after which Newton steps are tried, and again as often."""

CHAIN = 3
"""Places by which blocks that touch are apart at most where they hang together in a chain.

Sweeps pass a force on by a block each, so that a chain of n takes n squared of them to bear it; a
Newton step there costs about as much as ten sweeps, and in a wall of ten courses a hundred.
"""

POLISHED, SHINED = 1e-3, 0.1
"""Of the residual asked: how far Newton steps go in a chain, where what is left adds up; and in a
small scene, where a block just held on a slope creeps by what is left."""

OUTER, INNER = 20, 12
"""Newton's rounds: of impulses that follow, and of velocities within each."""

STIFF, SOFT = 1e3, 10.0
"""How much stiffer than inertia contacts are in the first round, and where sweeps of a large scene
are stuck; ten times as much in the next. There many slips change within a round, and of 18 steps
the soft one met the residual, or found that it gains no more, in two thirds of the Newton steps."""

PUSHES = 30
"""Sweeps that move blocks out of one another; what is left is moved in the next step."""

TOUCHING, LOOSELY = 1e-11, 1e-5
"""Of the smallest block's size: gaps and penetrations that are none, in small scenes and others.

A face on a face has corners enough for their gaps to contradict one another. Such rounding, or
what a residual leaves behind in a step, would shift the load from corner to corner for ever.
"""

SPLITS = 16
"""Parts a step is cut into at most; slip that stops more often than that within a step chatters."""

BEGINS, ENDS = 6, 34
"""Trials by which the begin or the end of a slip is enclosed.

A slip begins with no acceleration: missed by 1/64 of a step, its velocity is off by the square
of that. Where it turns about, friction changes sign at once: 2**-28 of a step shows where a base
shakes at 20 Hz with a thousand times what friction can do.
"""

NEARLY = 1e-5
"""Of what drives a scene: a slip slower than this acceleration makes it in a step has not begun, or
has ended where a cut was made."""

GRIP = 0.5
"""Of what friction can hold: a contact that holds less does not slip before the step's end."""

GLIMPSE = 0.02
"""Part of a step that shows whether slip begins at once: its mean force is the one of now."""

CLOSE = 4e-9
"""Part of a step within which the general model encloses the end of a slip."""

CUTS = 1e-9
"""Part of a step that is no step: slip that ends as it begins is taken to have ended."""

LOOKS = 40
"""Trials by which a landing is found where drives bend the way to it; without, two are enough."""

BRIEF = 0.1
"""Part of a step: an impulse that acted for less is no force to guess the next one from. As a force
times the step it may be 1e4 times too large, and rounding of that would be lost from momentum."""

STILL = 1e-9
"""Of what drives a scene: a slip slower than this acceleration makes it in a step has no
direction."""

BENDS = 6
"""Rounds by which, in small scenes, the mean direction of friction follows the slip it decides."""

SLOWLY, CLOSELY, GENTLY = 0.1, 5e-3, 1e6
"""Of what drives a scene, times the step: a contact that closes, or jams, at less needs no blow. It
is found where the step ends, too late by so much times the step, which is of second order. Nor does
one whose gap is less of what the drive makes of the step, or that is slower than so many residuals.
"""

LANDINGS, LANDED, SHORTLY = 8, 1e-8, 0.1
"""Trials by which a landing is found, the part of a step that it may be missed by, and the part of
one after which gaps are looked at anew that seem closed as it begins.
"""

APART = -1e30
"""Of the slack: from there on gaps count that must not close in a trial."""

HITS = 1e-4
"""Of the way that anything goes in a step: a gap that takes part in a blow."""

BLOW = 1e-9
"""Part of a step that a blow takes, in which velocities change and positions do not."""

PARTS = 512
"""Parts a step of a point mass is cut into at most, where slip ends, and where it turns sharply."""

HALVINGS, VEERED, AGREE, MOSTLY = 24, 0.01, 7.0, 0.02
"""Halvings of a step of a point mass in which the square of the sine of the angle that slip turns
by is more than the second. Its halves must agree to the third, times the square of the step over
the time in which drives turn about, and to the last, of what friction makes of a step: so the whole
is of second order, and steps in which slip is not about to stop are left whole."""
