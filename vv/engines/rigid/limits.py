"""The numerical limits of the rigid solver, with the reason for each."""

SMALL = 8
"""Largest number of blocks for which steps are divided at landings and ends of slip.

With more blocks there would be such an event in every step.
"""

FINE, ROUNDED = 2e-11, 1e-13
"""Residual of contact asked of small scenes: the larger of the first times the velocity that the
weight of a block gains in a step, and the second times the speeds in a step. Summed over the steps,
the first is this part of the effect of the weights; the second is rounding. Where
friction gives less than a tenth of weight, a part of CLOSE times that takes the first's place."""

FINEST, COARSE, CONVERGED = 3e-13, 1.9e-6, 4.6e-6
"""Over the speed of a scene: the largest residual asked of small scenes, where a larger one would
spoil the observed order; that asked of other scenes; and one above which blocks held by friction
creep and a run is not valid."""

LONG = 1e4
"""Number of steps of free acceleration whose velocity is the scale of residuals in small scenes
under a weak field.

The velocity of a fall by a block's own size decreases with the root of the field, that gained in a
run in proportion to the field: only the latter is a valid scale for all fields.
"""

CRAWLS = 2.5e-6
"""Upper bound on the residual asked of large scenes, over the speed of a fall by the size of the
smallest block.

However fast a wall is shaken, creep must be small in comparison with the size of its blocks.
"""

FEWEST, MOST, SMALL_MOST = 20, 20_000, 1000
"""Least and largest number of sweeps; small scenes have no least number.

With the least number, a wall at rest converges from step to step to less than the residual asked of
one step. After the largest number a step is accepted as it is, with its residual reported. Of
3000 steps of facades that are shaken apart, one needed nearly as many.
"""

UNHINTED, ENOUGH = 1e-5, 2000
"""Factor on the residual asked in the first step of large scenes, which starts without impulses of
a step before; and the number of sweeps after which the usual residual is enough there.

Later steps of a scene at rest start from the impulses of this one: with the usual residual it took
a hundred steps to settle. A wall that slides at once would need more than 10 000 sweeps.
"""

BORNE, SETTLES, STIFFEST = 1e-9, 10, 1e5
"""Over the weights of all blocks: what the reaction of the base may lack if they start at rest.

Residuals of contacts add up over blocks that stand on each other, at most all, so that a contact is
asked for this part of the velocity that weight gains in a step, over the number of blocks. Then the
most Newton rounds for it, and the stiffness of contacts over inertia beyond which rounding of
velocities grows to impulses above what is asked.
"""

CARRIED, STEADIED = 600, 200
"""Number of sweeps with momentum, and then with conjugate gradients, before the methods alternate.

Of 22 steps of a facade that falls apart, momentum alone left 14 above the residual asked after
3000 sweeps; alternation left 2 after 10 000. A sweep with conjugate gradients takes twice as long.
"""

STUCK, SWEPT, LEAPT = 2400, 7200, 24_000
"""Number of sweeps of a large scene after which Newton steps are tried; the number of sweeps with
leaps after which Newton rounds take their place; and that after which the solution is started again
without leaps.

Walls of 200 blocks that slide take up to 7200 sweeps in some steps of most of them. Of twenty steps
that took longer, 0.5 to 20 s with Newton steps alone, eighteen are solved within 0.6 to 4 s by
sweeps and Newton rounds in turn: wherever these end, sweeps begin anew. A wall shaken at 1.09 g had
steps that took more than 20 000 with leaps, and only 1600 when started again without.

A facade of 216 blocks that is shaken apart reaches these limits in up to 4 of 100 steps. A Newton
step costs as much as some thousand sweeps; sweeps alone left one such step in forty above the
residual asked.
"""

FAR = 10.0
"""Ratio of the residual to that asked above which sweeps that are stuck restart from zero impulses.

Where blocks are wedged, friction allows several solutions, and sweeps diverge from some of them:
from impulses very close to one of these, the residual grew by 1.8 % in each sweep. The step of a
sliding wall of 205 blocks that was near such a solution had a residual of 7e-5 m/s after 20 000
sweeps and Newton steps; from zero impulses it converges to another solution in 980 sweeps.
"""

STALLED = 60
"""Sweeps of a small scene or a chain after which Newton steps are tried, and again as often."""

CHAIN = 3
"""Largest distance in the ordering between blocks in contact for which blocks form a chain.

Sweeps transmit a force by one block each, so that a chain of n blocks needs n^2 sweeps to carry a
load. A Newton step costs about as much as ten sweeps in a chain, and as a hundred in a wall of ten
courses.
"""

ADDED = 100
"""What divides the tolerance of a chain, unless it has fewer blocks: then their number does.

The arch that falls is off by half as much as where the whole tolerance is allowed, at no cost. In
stacks of several hundred the parts of more blocks would be lost in rounding.
"""

POLISHED, SHINED = 1e-4, 0.1
"""Factors on the residual asked of Newton steps: in a chain, where residuals add up; and in a small
scene, where a block that is just held on a slope creeps at the residual velocity.

A stack of 100 to 400 blocks creeps a tenth as far as with 1e-3, in as many steps; with 1e-5 one of
200 and more tumbles about in what rounding leaves, and creeps up to a hundred times as far.
"""

OUTER, INNER = 20, 12
"""Largest numbers of Newton rounds, after each of which impulses are updated, and of iterations for
the velocities in each round."""

BLURRED = 2.0**-50
"""Residual over the velocity that the largest impulse of a contact gives it: below, the residual is
rounding, that of a sum of a few such velocities. In a groove of 1e-6 rad impulses of such a
residual may be wrong by 1e-3.
"""

STIFF, SOFT = 1e3, 10.0
"""Stiffness of contacts over inertia in the first Newton round, and in that of a large scene where
sweeps are stuck; it grows tenfold with each round. In large scenes many slips change in a round:
over 18 steps, the soft start met the residual, or found that it could not be reduced, with two
thirds as many Newton steps."""

WEDGED, REFINED, GRAINS = 1e3, 12, 2.0**-49
"""The velocity by one impulse alone, over that by all together, above which blocks are wedged, and
their velocities are refined until they change by rounding only; most rounds of that; and this
rounding, over the largest velocity. The residual asked leaves an error of this ratio times itself.
"""

TRIED, LONGEST, SEARCHED, HALVINGS = 80, 500, 30, 6
"""Newton steps after which no round begins where sweeps of a large scene are stuck, and in a step
that nothing else solved; most Newton steps of such a round; and most halvings of a step. On stiff
contacts whole steps went back and forth in most rounds.
"""

SOFTEST, FIRMEST, PAUSE = 1e-3, 1e4, 2
"""Stiffness of contacts over inertia below which Newton rounds are given up, and above which it
does not grow; and the number of rounds after the first failure before it grows again."""

PUSHES = 30
"""Sweeps that remove penetration from positions; what remains is removed in the next step."""

TOUCHING, LOOSELY = 1e-11, 1e-5
"""Over the size of the smallest block: gaps and penetrations that count as zero, in small scenes
and in others.

A face on a face has so many corners that their gaps can contradict each other. Without this
tolerance, rounding or the residual of a step would shift the load from corner to corner for ever.
"""

SPLITS = 16
"""Most parts of a step; slip that stops more often within a step chatters."""

BEGINS, ENDS = 6, 34
"""Most trials that enclose the begin or the end of a slip.

A slip begins with zero acceleration: an error of 1/64 of a step in time causes an error of only
the square of that in velocity. Where slip reverses, friction changes its sign at once: 2**-28 of a
step resolves this for a base that shakes at 20 Hz with a thousand times the friction limit.
"""

NEARLY = 1e-5
"""Over the velocity gained from all forces in a step: slower slip has not begun, or has ended where
the step was divided."""

GRIP = 0.5
"""Part of the friction limit below which a sticking contact does not slip before the step ends."""

GLIMPSE = 0.02
"""Length of a trial, over the step, that shows whether slip begins at once: its mean force is close
to the present one."""

CLOSE = 4e-9
"""Accuracy, over the step, of the end of a slip in the general model."""

CUTS = 1e-9
"""Shortest part of a step: slip that ends within it has ended at once."""

LOOKS = 40
"""Most iterations that find a landing where shaking curves the path; otherwise two are enough."""

BRIEF = 0.1
"""Shortest time, over the step, over which impulses are averaged to predict those of the next step.
The mean force over a much shorter time may be 1e4 times too large, and rounding of the prediction
would be lost from the momentum."""

STILL = 1e-11
"""Over the velocity that friction gives in a step: slower slip has no direction.

A slip that friction stops keeps this velocity to the end of its step, so that it is small beside
what friction gives, however slippery the ground, and what a slope leaves of that. Nor has slip
below ten times the residual of its step.
"""

BENDS = 6
"""Iterations in which the mean direction of friction follows the slip, in small scenes."""

SLOWLY, CLOSELY, GENTLY = 0.1, 5e-3, 1e6
"""Limits below which a contact that closes or jams needs no impact: the first is on its velocity,
over the velocity that it gains in a step; the second on its gap, over the distance gained from all
forces; the third on its velocity, over the residual. The closing is then noticed at the end of the
step, too late by a velocity in proportion to the step, which is of second order.

A contact that jams is compared with the velocity gained from all forces. So is one that closes, at
first. But the edge of a slender block falls a thousand times more slowly than weight would have it:
its landing, which the steps resolve, was noticed at their end and cost 1e-3 of its energy.
"""

LANDINGS, LANDED, SHORTLY = 8, 1e-8, 0.1
"""Most iterations that find a landing; its accuracy, over the step; and the part of a step after
which gaps that seem closed at its start are computed again.
"""

APART = -1e30
"""Factor on `slack` for trials in which no new contact may act, whatever its gap."""

HITS = 1e-4
"""Over the largest displacement in a step: gaps up to this take part in an impact."""

IMPACT_TIME = 1e-9
"""Duration of an impact over the step: velocities change in it and positions do not."""

PARTS = 512
"""Most parts of a step of a point mass, divided where slip ends and where it turns sharply."""

HALVINGS, VEERED, AGREE, MOSTLY = 24, 0.01, 7.0, 0.02
"""Most halvings of a step of a point mass, made where the squared sine of the angle by which slip
turns exceeds the second number. The velocities after one step and after two halves must agree to a
part of the velocity that friction gains in a step: the third number times the squared ratio of the
step to the time in which the forces change, and at most the fourth. So the method is of second
order, and steps in which slip is not about to stop are not divided."""

LOITERS, BRISK = VEERED**-0.5, 0.06
"""Over the velocity that friction gives in a step: slower slip that turns (VEERED) takes half a
step in the general model; and the part of a step that is halved no further. Slip of L times that
velocity is turned by friction by 1/L in a step at most, and L is such that this is the angle of
VEERED. Parts of 1/32 follow slip that slows down to 1e-3 m/s at 1e-3 s.
"""
