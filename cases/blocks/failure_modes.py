"""How blocks on a slope begin to move: the chart of stability, sliding and toppling."""

from __future__ import annotations

import math

import numpy as np

from cases._papers import YAGODA_BIRAN_2016
from cases.blocks.parts._failure_chart import (
    HALF,
    SEVERAL,
    STEEPEST,
    TURNS,
    UNDER_GRAVITY,
    Point,
    borders_of,
    is_clear,
    law_at,
    tested_points,
)
from reference_solutions.blocks import first_motion
from reference_solutions.blocks.first_motion import Mode, acceleration
from vv.ask import Displacement, History, Knobs, Method, Run
from vv.case import (
    LARGEST_TOLERANCE,
    Case,
    Check,
    Count,
    Exact,
    Ladder,
    Level,
    Parameter,
    Parameters,
    Scalar,
    Sign,
    Source,
    Tolerance,
    Trial,
    Variant,
)
from vv.scene import Block, Contact, Scene, Vector, Wall, box_geometry, polyhedron_inertia

DENSITY = 2500.0  # kg/m3; does not enter the answer
BRIEF = 0.02 * math.sqrt(9.81)  # duration over sqrt(R/g): blocks turn by less than 0.01 rad
OUTPUTS = 10
STEPS = ((20, 1e10), (40, 1e10), (40, 1e11), (80, 1e11))  # in the duration, and kn [N/m]
SHORT = (400, 1e10)  # at which explicit codes are stable
FREE = np.ones(3, bool)
IN_PLANE, ACROSS = np.array([True, False, True]), np.array([False, True, False])


def _axes(alpha: float) -> Vector:
    """Rows: down the slope, along its strike, out of it."""
    a = math.radians(alpha)
    dip, normal = (
        np.array([math.cos(a), 0.0, -math.sin(a)]),
        np.array([math.sin(a), 0.0, math.cos(a)]),
    )
    return np.array([dip, np.cross(normal, dip), normal])


def _scene(variant: str, p: Parameters, points: list[Point]) -> Scene:
    """Blocks side by side along the strike of one slope, each with its horizontal load."""
    axes, blocks, place = _axes(p["alpha"]), [], 0.0
    free = (IN_PLANE, ACROSS) if variant.startswith("2d") else (FREE, FREE)
    for number, (psi, delta) in enumerate(points):
        d = math.radians(delta)
        half = p["R"] * np.array([math.sin(d), HALF, math.cos(d)])
        vertices, faces = box_geometry(half[2] * axes[2] + place * axes[1], half, axes)
        mass, inertia = polyhedron_inertia(vertices, faces, DENSITY)
        push = mass * p["g"] * math.tan(math.radians(psi - p["alpha"]))
        load = np.array([push, 0.0, 0.0])
        block = Block(
            f"block {number}", vertices, faces, mass, inertia, np.zeros(3), *free, load=load
        )
        blocks.append(block)
        place += 2.0 * p["R"]
    wall = Wall(np.zeros(3), axes[2])
    law = Contact(np.inf, mu=math.tan(math.radians(p["phi"])))
    return Scene((wall, *blocks), law, gravity=np.array([0.0, 0.0, -p["g"]]), axes=axes)


def _declare(variant: str, p: Parameters) -> Trial:
    if not 1.0 <= p["phi"] <= 85.0:
        raise ValueError(f"phi = {p['phi']!r} degrees; it must be between 1 and 85")
    if not 0.0 < p["alpha"] <= STEEPEST:
        raise ValueError(
            f"alpha = {p['alpha']!r} degrees; it must be above 0 and at most {STEEPEST}"
        )
    points = tested_points(variant, p)
    duration = BRIEF * math.sqrt(p["R"] / p["g"])
    goal = History(duration, duration / OUTPUTS)
    seen = tuple(Displacement(1 + number) for number in range(len(points)))
    short = variant.endswith("short")
    rungs = tuple(
        Knobs(duration / n, kn * _stiffening(p)) for n, kn in ((SHORT,) if short else STEPS)
    )
    levels = {Level.QUICK: rungs[:2], Level.DEFAULT: rungs[:3], Level.PAPER: rungs}
    study = Ladder(_scene(variant, p, points), goal, seen, levels)
    modes = tuple(_mode(number, point, p) for number, point in enumerate(points))
    asked = {mode.name: point for mode, point in zip(modes, points, strict=True)}
    chart = borders_of(p["phi"], asked)
    return Trial(study, (_worst(points, p, short), _agreeing(points, p), *modes), regions=chart)


def _stiffening(p: Parameters) -> float:
    """The factor on stiffness by which springs respond equally fast at any size and gravity."""
    return p["R"] ** 2 * p["g"] / 9.81


def _moved(p: Parameters, number: int, point: Point, run: Run) -> Vector:
    """Displacement (2,) of a block's centre at the end over g' T^2/2: down the slope, out of it."""
    moved = run.values[Displacement(1 + number)][-1] @ _axes(p["alpha"]).T
    pull = p["g"] / math.cos(math.radians(point[0] - p["alpha"]))
    return np.asarray(moved[[0, 2]] / (0.5 * pull * run.times[-1] ** 2))


def _nearest(moved: Vector, law: dict[str, float]) -> Mode:
    """The mode whose displacement is nearest to that of the block."""
    return min(Mode, key=lambda mode: float(np.linalg.norm(moved - acceleration(mode, **law))))


def _error(p: Parameters, number: int, point: Point, run: Run) -> float:
    """The distance of a block from its exact place, over g' T^2/2."""
    law = law_at(p, point)
    due = acceleration(first_motion.mode(**law), **law)
    return float(np.linalg.norm(_moved(p, number, point, run) - due))


def _worst(points: list[Point], p: Parameters, short: bool) -> Scalar:
    return Scalar(
        "worst", "max|e|", "", "largest distance of a block from its exact place, over g' T^2/2",
        lambda run: max(_error(p, *each, run) for each in enumerate(points)), 0.0, 1.0,
        _places(p, short),
    )  # fmt: skip


def _agreeing(points: list[Point], p: Parameters) -> Count:
    """The number of points that agree with the chart, which is the figure that the paper gives."""
    return Count(
        "agree", "n", "number of points at which the block moves as the chart says",
        lambda run: sum(
            _observed_mode(p, *each, run) is _charted_mode(p, each[1]) for each in enumerate(points)
        ),
        len(points), Exact(ALL, not_judged=BORDERS),
    )  # fmt: skip


def _mode(number: int, point: Point, p: Parameters) -> Count:
    """The mode of a block: 0 stays, 1 slides, 2 topples, 3 slides and topples."""
    psi, delta = point
    judge = Exact(ALL, not_judged=CLEAR if is_clear(p["phi"], psi, delta) else BORDERS)
    return Count(
        f"psi={psi:.4g} delta={delta:.4g}", "mode", "how the block moves: 0 stays, 1 slides, 2 "
        "topples, 3 slides and topples",
        lambda run: int(_observed_mode(p, number, point, run)), int(_charted_mode(p, point)), judge,
    )  # fmt: skip


def _observed_mode(p: Parameters, number: int, point: Point, run: Run) -> Mode:
    return _nearest(_moved(p, number, point, run), law_at(p, point))


def _charted_mode(p: Parameters, point: Point) -> Mode:
    return first_motion.mode(**law_at(p, point))


def _places(p: Parameters, short: bool) -> Exact:
    turns = (
        "the exact answer is that of the first instant. After it the block turns by up to 0.01 "
        "rad, and its weight relative to its base"
    )
    springs = "springs need a time to build up their force, which is shorter the stiffer they are"
    swings = "; short steps do not damp the oscillation that this leaves"
    bounds = {
        Method.SECOND_ORDER: Tolerance(
            TURNS, turns, slack="it does not turn where it only slides, or falls in one piece"
        ),
        Method.FIRST_ORDER: Tolerance(
            6e-2,
            "the motion starts half a step late, an error of dt/T, a twentieth at the longest "
            f"step; {turns}",
            dt=BRIEF * math.sqrt(p["R"] / p["g"]) / STEPS[0][0],
            order=1,
            floor=TURNS,
            slack="a scheme whose forces act from the first step on starts in time",
        ),
        Method.PENALTY: Tolerance(
            LARGEST_TOLERANCE if short else 6e-2,
            springs + swings * short,
            kn=1e10 * _stiffening(p),
            softness=0.5,
            slack="springs that start charged with the weight bear it from the first step on",
        ),
    }
    return Exact(bounds, not_judged={Method.LAGGING: LATE})


LATE = (
    "friction of the previous iteration lets blocks slip that should not. Modes are wrong beside "
    "borders, and with large friction elsewhere too; errors do not fall with step or stiffness"
)
SAME = Tolerance(
    1e-9, "the mode is either that of the chart, or wrong", slack="a mode has no error"
)
ALL = dict.fromkeys((Method.SECOND_ORDER, Method.FIRST_ORDER, Method.PENALTY), SAME)
BESIDE = "half a degree from a border the modes differ by less than the error of springs"
CLEAR, BORDERS = (
    {Method.LAGGING: LATE},
    {Method.LAGGING: LATE, Method.PENALTY: BESIDE},
)
FORMULA = (
    "psi <= phi, delta: stays; phi < psi, phi <= delta: slides; psi > delta: topples for "
    "phi >= phi_c, and slides too for delta < phi < phi_c; tan(phi_c - delta) = tan(psi - delta)/4"
)
INERT = frozenset({"g", "R"})
CASE = Case(
    name="failure-modes",
    title="How a block on a slope begins to move",
    source=Source(
        *YAGODA_BIRAN_2016,
        "Secs. 3.2 and 4.3: 106 of 110 points agree in the plane, 49 of 51 and 89 of 89 in space. "
        "The points are not given: ours lie half a degree from the borders, on both sides, and "
        "evenly over the chart. The paper judges by rules in words; here the displacement of the "
        "centre decides. In space points are left out where Coulomb's law also permits a block to "
        "turn aside as it topples. At friction phi_c and above, a block topples about its lower "
        "edge without sliding.",
    ),
    parameters=(
        Parameter("phi", 20.0, "degrees", "friction angle"),
        Parameter("alpha", 10.0, "degrees", "slope"),
        Parameter("R", 1.0, "m", "half a diagonal of a block", Sign.POSITIVE),
        Parameter("g", 9.81, "m/s2", "gravity", Sign.POSITIVE),
    ),
    variants=(
        *(
            Variant(
                f"{space}-{phi}", f"{SEVERAL} blocks with horizontal loads, phi {phi}", FORMULA,
                {"phi": float(phi)}, INERT | {"alpha"}, Level.QUICK if phi == 40 else Level.DEFAULT,
            )
            for space, several in (("2d", (10, 20, 30, 40, 60)), ("3d", (6, 20, 40, 50)))
            for phi in several
        ),
        *(
            Variant(
                f"gravity-{alpha}", f"{UNDER_GRAVITY} blocks in space without loads", FORMULA,
                {"alpha": float(alpha)}, INERT, Level.DEFAULT,
            )
            for alpha in (14, 32, 50)
        ),
        *(
            Variant(
                f"{like}-short", f"as {like}, at a step at which explicit codes are "
                "stable", FORMULA,
                given, INERT | still, Level.QUICK if like == "2d-20" else Level.DEFAULT,
            )
            for like, given, still in (
                ("2d-20", {"phi": 20.0}, {"alpha"}),
                ("3d-20", {"phi": 20.0}, {"alpha"}),
                ("gravity-32", {"alpha": 32.0}, set[str]()),
            )
        ),
    ),
    declare=_declare,
    # where nearly all blocks stay, rounding errors of their weights exceed what the motion allows
    enforced=frozenset(Check) - {Check.CONSERVATION},
    published={
        "Sec. 3.2.2": "2D-DDA agrees at 106 of 110 points",
        "Sec. 4.3": "3D-DDA agrees at 49 of 51 points under gravity, at 89 of 89 with a level load",
    },
)  # fmt: skip
