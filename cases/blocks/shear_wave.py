"""A shear wave runs up a column of elastic layers that shake on their base, and back."""

from __future__ import annotations

import functools
import math

import numpy as np

from cases._papers import YAGODA_BIRAN_2016
from reference_solutions.blocks import shear_wave
from vv.ask import Displacement, History, Knobs, Method
from vv.case import (
    Case,
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
REST = np.full(3, -np.pi / 2)  # the phase at which 1 - cos stands still
OUTPUTS = 100


def column(p: Parameters, layers: int) -> Scene:
    """Layers in the plane, so wide that they shear and do not bend, on a base that shakes along.

    They begin as their weight has strained them. Friction never ends: no joint slips.
    """
    thick, stretch = p["H"] / layers, 2.0 * p["G"] * (1.0 + p["nu"])
    blocks = []
    for i in range(layers):
        half = np.array([p["width"] / 2, 0.5, thick / 2])
        vertices, faces = box_geometry((i + 0.5) * thick * Z, half, np.eye(3))
        mass, inertia = polyhedron_inertia(vertices, faces, p["rho"])
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


def speed(p: Parameters) -> float:
    """That of shear waves [m/s]."""
    return math.sqrt(p["G"] / p["rho"])


def _declare(variant: str, p: Parameters) -> Trial:
    layers = int(variant.partition("-")[0])
    angle = 2.0 * math.pi * p["F"] * p["H"] / (layers * speed(p))
    if not angle < 1.0:
        raise ValueError(
            f"F = {p['F']!r} Hz: a layer is {angle:.3g} rad of a wave; it must be below 1"
        )
    goal = History(p["duration"], p["duration"] / OUTPUTS)
    quantities = tuple(
        _at(name, number, layers, angle, goal.times(None), p)
        for name, number in (("middle", (layers + 1) // 2), ("top", layers))
    )
    seen = tuple(Displacement(number) for number in ((layers + 1) // 2, layers))
    study = Ladder(column(p, layers), goal, seen, LEVELS[variant])
    return Trial(study, quantities)


def _at(name: str, number: int, layers: int, angle: float, times: Vector, p: Parameters) -> Series:
    """The motion of a layer's centre; errors are relative to the largest of it."""
    path = functools.partial(
        shear_wave.displacement,
        y=(number - 0.5) * p["H"] / layers, height=p["H"], c=speed(p), D=p["D"], F=p["F"],
    )  # fmt: skip
    late = 2.0 * math.pi * p["F"] * p["duration"]
    bound = Tolerance(
        min(0.1, 0.1 * angle + 2.0 * math.pi * p["F"] * COARSE * late / 4.0),
        "a layer of h shears uniformly, which is a tenth of w h/c off; the step damps by w dt/4",
        dt=COARSE, order=1, floor=min(0.1, 0.1 * angle),
    )  # fmt: skip
    return Series(
        name, f"u_{name}", "m", f"motion of the centre of layer {number} of {layers}",
        lambda run: np.asarray(run.values[Displacement(number)] @ X), path,
        Exact({Method.PENALTY: bound}, not_judged={Method.LAGGING: SOFTER}),
        lambda: float(np.abs(path(times)).max()),
    )  # fmt: skip


SOFTER = (
    "formulations of this class may have the shear springs that are usual in DDA, 0.4 kn, which "
    "make this column softer by a tenth"
)
COARSE = 5e-4  # s
SOFT, STIFF = 1e12, 1e13  # N/m
SHORT = (Knobs(COARSE, SOFT), Knobs(COARSE / 2, SOFT))
WHOLE = (Knobs(COARSE, SOFT), Knobs(2e-4, SOFT), Knobs(1e-4, SOFT))
FINE = (Knobs(1e-4, STIFF), Knobs(5e-5, STIFF), Knobs(2.5e-5, STIFF))
LEVELS: dict[str, dict[Level, tuple[Knobs, ...]]] = {
    "5": dict.fromkeys(Level, SHORT),
    "20": dict.fromkeys(Level, WHOLE),
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
        Parameter("g", 9.81, "m/s2", "gravity, which presses the joints"),
        Parameter("duration", 0.3, "s", "time simulated"),
    ),
    variants=(
        Variant("5", "five layers", WAVE, inert=INERT),
        Variant("20", "twenty layers", WAVE, inert=INERT, level=Level.DEFAULT),
        Variant("40", "forty layers, stiffer joints", WAVE, inert=INERT, level=Level.PAPER),
    ),
    declare=_declare,
    published={"Fig. 9": "2D-DDA keeps the wave form, once blocks and steps are tuned."},
)  # fmt: skip
