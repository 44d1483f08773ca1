"""A pyramid on its tip, which oscillates on the one spring that represents its contact."""

import numpy as np

from vv.case import Parameter, Parameters
from vv.scene import Block, Contact, Scene, Wall, polyhedron_inertia

Z = np.array([0.0, 0.0, 1.0])
TIP = np.array([[0, 0, 0], [-1, -1, 2], [1, -1, 2], [1, 1, 2], [-1, 1, 2]], float) / 2  # m
FACES = ((0, 2, 1), (0, 3, 2), (0, 4, 3), (0, 1, 4), (1, 2, 3, 4))
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
    """The frequency of its oscillation [1/s]; raises ValueError if the tip lifts off."""
    w = float(np.sqrt(p["kn"] / p["m"]))
    if not p["v"] * w < p["g"]:
        raise ValueError(
            f"v = {p['v']!r} m/s; from g/w = {p['g'] / w:.6g} m/s on, the tip lifts off"
        )
    return w
