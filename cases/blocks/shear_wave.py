"""A shear wave runs up a column of elastic layers on a shaking base, and back."""

from __future__ import annotations

import functools
import math
from collections.abc import Callable

import numpy as np

from cases._papers import YAGODA_BIRAN_2016
from reference_solutions.blocks import shear_wave
from vv.ask import Displacement, History, Knobs, Method
from vv.case import (
    Case,
    ComponentAlong,
    Exact,
    Ladder,
    Level,
    Parameter,
    Parameters,
    Series,
    Source,
    Tolerance,
    Trial,
    Variant,
)
from vv.scene import (
    Block,
    Contact,
    Elastic,
    Harmonic,
    Scene,
    Vector,
    Wall,
    box_geometry,
    polyhedron_inertia,
)

X, Z = np.array([1.0, 0.0, 0.0]), np.array([0.0, 0.0, 1.0])
IN_PLANE, ACROSS = np.array([True, False, True]), np.array([False, True, False])
REST = np.full(3, -np.pi / 2)  # the phase at which 1 - cos starts at rest
OUTPUTS = 100


def column(p: Parameters, layers: int, unlike: bool = False) -> Scene:
    """A plane column of layers, so wide that they shear and do not bend, on a shaking base.

    They start with the strain of their weight. Friction is so large that no joint slips.
    """
    blocks, thick = [], p["H"] / layers
    for i, layer in enumerate(soil(p, layers, unlike)):
        stretch = 2.0 * layer.G * (1.0 + p["nu"])
        half = np.array([p["width"] / 2, 0.5, thick / 2])
        vertices, faces = box_geometry((i + 0.5) * thick * Z, half, np.eye(3))
        mass, inertia = polyhedron_inertia(vertices, faces, layer.rho)
        elastic = Elastic(stretch, p["nu"], relaxed=True)
        blocks.append(
            Block(
                f"layer {i}", vertices, faces, mass, inertia, np.zeros(3), IN_PLANE, ACROSS,
                elastic=elastic,
            )
        )  # fmt: skip
    motion = Harmonic(p["D"] * X, p["F"] * X, REST)
    base = Wall(np.zeros(3), Z, motion)
    return Scene((base, *blocks), Contact(np.inf, mu=p["mu"]), gravity=-p["g"] * Z)


def soil(p: Parameters, layers: int, unlike: bool = False) -> list[shear_wave.Layer]:
    """The layers from the base up: all equal, or each softer and lighter than the one below."""
    rise = [1.0 - (2.0 * i + 1.0) / layers if unlike else 0.0 for i in range(layers)]
    thick = p["H"] / layers
    return [
        shear_wave.Layer(thick, p["G"] * (1.0 + 0.6 * x), p["rho"] * (1.0 + 0.1 * x)) for x in rise
    ]


def speed(p: Parameters) -> float:
    """The speed of shear waves [m/s]."""
    return math.sqrt(p["G"] / p["rho"])


def _declare(variant: str, p: Parameters) -> Trial:
    layers = int(variant.partition("-")[0])
    goal = History(p["duration"], p["duration"] / OUTPUTS)
    stiffness = LEVELS[variant][Level.QUICK][0].kn
    assert stiffness is not None
    given = _modulus_loss(p, layers, stiffness)
    quantities = tuple(
        quantity
        for name, number in (("middle", (layers + 1) // 2), ("top", layers))
        for quantity in _layer_series(name, number, layers, goal.times(None), given, p)
    )
    seen = tuple(Displacement(number) for number in ((layers + 1) // 2, layers))
    study = Ladder(column(p, layers), goal, seen, LEVELS[variant])
    return Trial(study, quantities)


def _layer_series(
    name: str, number: int, layers: int, times: Vector, given: float, p: Parameters
) -> tuple[Series, ...]:
    """The motion of a layer's centre, against the wave and against the exact answer of layers.

    given: the part of its shear modulus that the column lacks. Errors are relative to the largest
    motion.
    """
    H, c, D, F = p["H"], speed(p), p["D"], p["F"]
    y, place = (number - 0.5) * H / layers, {"number": number, "layers": layers}
    path = functools.partial(shear_wave.displacement, y=y, height=H, c=c, D=D, F=F)
    chain = functools.partial(
        shear_wave.layered_displacement, number=number, layers=layers, height=H, c=c, D=D, F=F
    )
    passed, layered = path(times), chain(times)
    largest = float(np.abs(passed).max())
    strain = 2 * math.pi * F * largest / c
    own = float(np.abs(layered - passed).max()) / largest
    _require_linear_and_thin(p, strain, own)

    def growth(dt: float) -> float:
        """The error that steps cause in the exact answer, over the step [1/s]."""
        steps = math.ceil(times[-1] / dt)
        stepped = shear_wave.stepped_displacement(steps, dt=dt, **place, height=H, c=c, D=D, F=F)
        return float(np.abs(stepped - chain(dt * np.arange(steps + 1))).max()) / largest / dt

    coarse, fine = growth(COARSE), growth(COARSE / 2)
    late = max(coarse, 2 * fine - coarse)
    soft = chain(times, c=c * math.sqrt(1.0 - given))
    yields = float(np.abs(soft - layered).max()) / largest + strain

    def series(name: str, what: str, due: Callable[[Vector], Vector], judge: Exact) -> Series:
        return Series(
            name, f"u_{name}", "m", f"motion of the centre of layer {number} of {layers}{what}",
            ComponentAlong(Displacement(number), X), due, judge, largest,
        )  # fmt: skip

    return (
        series(name, "", path, _bounds(own + yields, late, UNIFORM)),
        series(f"{name} of layers", ", against the exact answer of the layers", chain,
               _bounds(yields, late, OWN)),
    )  # fmt: skip


def _require_linear_and_thin(p: Parameters, strain: float, own: float) -> None:
    """Raise ValueError where layers shear too much, or are too thick for the wave.

    own: what layers that shear uniformly differ from the wave, over its largest motion.
    """
    D, F = p["D"], p["F"]
    if not strain < LARGE:
        raise ValueError(
            f"D = {D!r} m; layers shear by about {strain:.2g}, and only below {LARGE:g} is the "
            "wave equation linear"
        )
    if not own < THICK:
        raise ValueError(
            f"F = {F!r} Hz; layers that shear uniformly differ from the wave "
            f"by {own:.2g}, more than {THICK:g}"
        )


def _bounds(bound: float, late: float, reason: str) -> Exact:
    """late: the error that a step causes in the answer of the layers, over the step [1/s]."""
    tolerance = Tolerance(bound, reason, late=late)
    return Exact({Method.PENALTY: tolerance}, not_judged={Method.LAGGING: SOFTER})


def _modulus_loss(p: Parameters, layers: int, kn: float) -> float:
    """The part of its shear modulus that a column lacks, by springs in joints and by its weight.

    A layer of thickness h shears by h/(G width) under a unit force, and the springs at the two ends
    of a joint by 1/(2 ks), with ks = 25 kn. In layers whose stress turns with them, half of that
    stress changes the modulus; the mean stress of the column is rho g H/2.
    """
    joints = p["G"] * p["width"] * layers / p["H"] / (2.0 * 25.0 * kn)
    return joints / (1.0 + joints) + 0.25 * p["rho"] * p["g"] * p["H"] / p["G"]


OWN = (
    "springs in the joints and the weight change the modulus: the bound is the change that this "
    "causes in the exact answer of layers that shear uniformly, and the shear strain, by which "
    "layers are no longer linear. The error of the step is the change that the step causes in that "
    "answer: over dt it is largest at the longest step or, by extrapolation, in the limit of short "
    "ones"
)
UNIFORM = (
    f"layers that shear uniformly differ from the wave by as much as their exact answer; {OWN}"
)
SOFTER = (
    "formulations of this class may have the shear springs that are usual in DDA, 0.4 kn, which "
    "make this column softer by a tenth"
)
LARGE = 0.05  # shear strain
THICK = 0.08  # of the largest motion: the largest difference between layers and wave
COARSE = 5e-4  # s
SOFT, STIFF = 1e12, 1e13  # N/m
SHORT = (Knobs(COARSE, SOFT), Knobs(COARSE / 2, SOFT))
WHOLE = (Knobs(COARSE, SOFT), Knobs(2e-4, SOFT), Knobs(1e-4, SOFT))
FINE = (Knobs(1e-4, STIFF), Knobs(4e-5, STIFF), Knobs(2e-5, STIFF))
LEVELS: dict[str, dict[Level, tuple[Knobs, ...]]] = {
    "5": dict.fromkeys(Level, SHORT),
    "20": {Level.QUICK: WHOLE[:2], Level.DEFAULT: WHOLE[:2], Level.PAPER: WHOLE},
    "40": dict.fromkeys(Level, FINE),
}
WAVE = "u = sum (-1)^k (f(t - (2kH + y)/c) + f(t - (2(k+1)H - y)/c)), f = D (1 - cos 2 pi F t)"
INERT = frozenset({"nu", "width", "mu", "g"})
CASE = Case(
    name="shear-wave",
    title="A shear wave through layers",
    source=Source(
        *YAGODA_BIRAN_2016,
        "Sec. 3.5, Fig. 9: layers, material and amplitude are not given; all are chosen, also "
        "the width, since narrower columns bend. The paper's base moves for one cycle; here it "
        "goes on, and the wave comes back from the free top and from the base.",
    ),
    parameters=(
        Parameter("H", 20.0, "m", "height of the column"),
        Parameter("rho", 2000.0, "kg/m3", "density"),
        Parameter("G", 2e8, "Pa", "shear modulus"),
        Parameter("nu", 0.25, "", "Poisson's ratio"),
        Parameter("width", 400.0, "m", "width of the layers"),
        Parameter("D", 1e-4, "m", "amplitude of the base"),
        Parameter("F", 5.0, "Hz", "its frequency"),
        Parameter("mu", 1000.0, "", "friction coefficient: no joint slips"),
        Parameter("g", 9.81, "m/s2", "gravity, which compresses the joints"),
        Parameter("duration", 0.3, "s", "time simulated"),
    ),
    variants=(
        Variant("5", "five layers", WAVE, inert=INERT),
        Variant("20", "twenty layers", WAVE, inert=INERT, level=Level.DEFAULT),
        Variant(
            "40", "forty light layers, a longer wave and stiffer joints", WAVE,
            {"F": 2.5, "g": 1.0}, INERT, Level.PAPER,
        ),
    ),
    declare=_declare,
    published={"Fig. 9": "2D-DDA preserves the wave form, once blocks and steps are tuned."},
)  # fmt: skip
