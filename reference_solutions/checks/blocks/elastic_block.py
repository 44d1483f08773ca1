"""A box of uniform strain from the energies of its points, by integration: the second route.

For the box on its base, velocities and energies are summed over Gauss points, and a Lagrange
multiplier keeps the lower face on the base. For the spinning box the deformation gradient F is
integrated through finite rotations, rho int X X^T dV F'' = -V dW/dF, with the energy W of Saint
Venant and Kirchhoff. Parameters are those of `reference_solutions.blocks.elastic_block`, whose code
is not used here.
"""

import itertools

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
Sides = tuple[float, float, float]
GAUSS = np.array(list(itertools.product((-1.0, 1.0), repeat=3))) / np.sqrt(3.0)  # weight V/8 each
UP = np.array([0.0, 0.0, 1.0])
FINE = {"method": "DOP853", "rtol": 1e-12}


def energy(e: Array, young: float, poisson: float) -> float:
    """The strain energy density [J/m3] for normal strains e (3,), by Lame's constants."""
    shear = young / (2.0 * (1.0 + poisson))
    bulk = young * poisson / ((1.0 + poisson) * (1.0 - 2.0 * poisson))
    return float(0.5 * bulk * e.sum() ** 2 + shear * e @ e)


def standing(
    t: Array, *, sides: Sides, rho: float, young: float, poisson: float, g: float,
    along: tuple[int, ...] = (0, 1, 2),
) -> Array:  # fmt: skip
    """The strains (k, 3); if the box may strain along z only, the other strains minimise W."""
    from scipy.integrate import solve_ivp

    places = GAUSS * np.array(sides) / 2.0
    unit = np.eye(4)[[i + 1 for i in along]]
    fields = np.concatenate([np.eye(4)[:1], unit])  # displacement of the centroid, and strains

    def moved(q: Array, at: Array) -> Array:
        return np.asarray(at * q[1:] + q[0] * UP)

    speeds = np.array([[moved(field, at) for at in places] for field in fields])
    mass = rho / 8.0 * np.einsum("apc,bpc->ab", speeds, speeds)
    weight = -rho * g / 8.0 * speeds[:, :, 2].sum(axis=1)
    foot = np.array([moved(field, np.array([0.0, 0.0, -sides[2] / 2.0]))[2] for field in fields])
    n = len(fields)
    if len(along) == 1:
        poisson = 0.0  # the lateral stress is zero, and W is that of a bar
    held = [[_mixed(a[1:], b[1:], young, poisson) for b in fields] for a in fields]
    whole = np.block([[mass, foot[:, None]], [foot[None], np.zeros((1, 1))]])

    def rate(_: float, y: Array) -> Array:
        pull = np.append(weight - np.array(held) @ y[:n], 0.0)
        return np.concatenate([y[n:], np.linalg.solve(whole, pull)[:n]])

    size = rho * abs(g) * sides[2] / young
    end = solve_ivp(rate, (0.0, t[-1]), np.zeros(2 * n), t_eval=t, atol=1e-12 * size, **FINE)
    return np.asarray((fields.T @ end.y[:n])[1:].T)


def _mixed(a: Array, b: Array, young: float, poisson: float) -> float:
    """The mixed derivative d2W/da db, from W of the sum and of each strain."""
    parts = [energy(e, young, poisson) for e in (a + b, a, b)]
    return parts[0] - parts[1] - parts[2]


def spinning(
    t: Array, *, sides: Sides, rho: float, young: float, poisson: float, spin: float
) -> Array:
    """The Green strains (k, 3) along the axes of the box."""
    from scipy.integrate import solve_ivp

    second = rho / 8.0 * np.einsum("pi,pj->ij", *[GAUSS * np.array(sides) / 2.0] * 2)
    shear = young / (2.0 * (1.0 + poisson))
    bulk = young * poisson / ((1.0 + poisson) * (1.0 - 2.0 * poisson))

    def green(f: Array) -> Array:
        return np.asarray(0.5 * (f.T @ f - np.eye(3)))

    def rate(_: float, y: Array) -> Array:
        f, e = y[:9].reshape(3, 3), green(y[:9].reshape(3, 3))
        stress = bulk * np.trace(e) * np.eye(3) + 2.0 * shear * e
        return np.concatenate([y[9:], -(f @ stress @ np.linalg.inv(second)).ravel()])

    turning = spin * np.array([[0.0, -1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 0.0]])
    begin = np.concatenate([np.eye(3).ravel(), turning.ravel()])
    end = solve_ivp(rate, (0.0, t[-1]), begin, t_eval=t, atol=1e-14, **FINE)
    return np.array([np.diag(green(y[:9].reshape(3, 3))) for y in end.y.T])
