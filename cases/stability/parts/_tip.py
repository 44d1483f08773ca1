"""A pyramid on its tip, which oscillates on the one spring that represents its contact."""

import numpy as np

from vv.case import Parameter, Parameters
from vv.scene import Block, Contact, Scene, Wall, polyhedron_inertia

Z = np.array([0.0, 0.0, 1.0])
TIP = np.array([[0, 0, 0], [-1, -1, 2], [1, -1, 2], [1, 1, 2], [-1, 1, 2]], float) / 2  # m
FACES = ((0, 2, 1), (0, 3, 2), (0, 4, 3), (0, 1, 4), (1, 2, 3, 4))
DEEPEST = 0.01  # m: contact laws do not hold at larger overlaps
USUAL, LEAST = 5e-4, 1e-9  # m: amplitude at the defaults, and one that rounding changes by 1e-7
PARAMETERS = (
    Parameter("m", 1000.0, "kg", "mass"),
    Parameter("kn", 1e7, "N/m", "penalty stiffness at the tip"),
    Parameter("g", 9.81, "m/s2", "gravity, which keeps the contact closed"),
    Parameter("v", 0.05, "m/s", "velocity at the start, upwards"),
)


def scene(p: Parameters) -> Scene:
    """The pyramid, which stays upright: one point of contact, pressed by its weight."""
    _, inertia = polyhedron_inertia(TIP, FACES, p["m"] / (1 / 3))
    block = Block(
        "block", TIP, FACES, p["m"], inertia,
        velocity=p["v"] * Z,
        free=np.array([False, False, True]),
        free_spin=np.zeros(3, bool),
    )  # fmt: skip
    return Scene((Wall(np.zeros(3), Z), block), Contact(np.inf), gravity=-p["g"] * Z)


def frequency(p: Parameters) -> float:
    """The frequency of its oscillation [1/s].

    Raises ValueError if the pyramid does not oscillate, lifts off or sinks deeply.
    """
    w, speed = float(np.sqrt(p["kn"] / p["m"])), abs(p["v"])
    if not speed > 0.0:
        raise ValueError(f"v = {p['v']!r} m/s; it must not be 0, or nothing oscillates")
    if not speed * w < p["g"]:
        raise ValueError(
            f"v = {p['v']!r} m/s; from g/w = {p['g'] / w:.6g} m/s on, the tip lifts off"
        )
    if not (deepest := p["g"] / w**2 + speed / w) < DEEPEST:
        raise ValueError(
            f"kn = {p['kn']!r} N/m; the tip sinks by {deepest:.4g} m; it must be less than "
            f"{DEEPEST:g} m, a hundredth of the pyramid's height"
        )
    return w


def rounded(p: Parameters) -> float:
    """By what factor rounding matters more than at the defaults.

    Places of 1 m are rounded, and roots are fitted to the amplitude v/w. Raises ValueError where
    amplitudes are so small that rounding hides them.
    """
    amplitude = abs(p["v"]) / frequency(p)
    if not amplitude > LEAST:
        raise ValueError(
            f"v = {p['v']!r} m/s; an amplitude of {amplitude:.3g} m is lost as places are rounded; "
            f"more than {LEAST:g} m are needed"
        )
    return max(1.0, USUAL / amplitude)
