"""Claims about `dem/published`: it is the scheme of the paper, in its equations and errors."""

from __future__ import annotations

import numpy as np
import pytest

from cases.contact.single_contact import CASE
from tests.scenes.spheres.dem_contacts import PLAIN, STEPS, displacement, error
from tests.support.adapters.small_asks import case_ask as asked
from vv.ask import History
from vv.engines import dem
from vv.scene import Vector

PUBLISHED = {"T1": 2.228e-5, "T2": 1.325e-2, "T3": 6.751e-5, "T4": 2.070e-2}
ORDERS = {"T1": (2, 0.25), "T2": (1, 0.02), "T3": (2, 0.25), "T4": (1, 0.02)}


def transcribed(test: str, dt: float) -> Vector:
    """Li 2018, Eqs. 4-12, line by line for one coordinate; v^(-1/2) = v_0, |F_s| limited."""
    p = CASE.defaults(test)
    m = 2 * 3**0.5 * p["rho"] * p["r"] ** 2
    eta = p["eta"] if test in ("T2", "T4") else 0.0
    normal = test in ("T1", "T2")
    v = p["v_a"] if normal else p["v_b"]
    wall = CASE.declare(test, p).study.scene.walls
    Fmax = 0.0 if normal else p["mu"] * p["kn"] * (p["r"] + float(wall[0].point[0]))  # Eq. 7
    P = Fs = 0.0
    path = [P]
    for step in range(History(0.4, 1e-3).steps(dt)):
        if normal:
            Fc = p["kn"] * max(-P, 0.0)  # Eq. 4
        else:
            Fs -= p["ks"] * v * dt if step else 0.0  # Eqs. 5, 6
            Fc = Fs = min(max(Fs, -Fmax), Fmax)  # Eq. 8
        a = (Fc - eta * v) / m  # Eqs. 9, 10
        v += a * dt  # Eq. 11
        P += v * dt  # Eq. 12
        path.append(P)
    return np.array(path)


@pytest.mark.parametrize("test", PLAIN)
def test_published_shows_the_errors_and_orders_of_the_paper_s_scheme(test: str) -> None:
    errors = [error(test, dem.solve_published(asked(test, dt))) for dt in STEPS]
    assert errors[STEPS.index(1e-3)] == pytest.approx(PUBLISHED[test], rel=0.01)
    order, within = ORDERS[test]
    assert np.polyfit(np.log(STEPS), np.log(errors), 1)[0] == pytest.approx(order, abs=within)


@pytest.mark.parametrize("test", PLAIN)
@pytest.mark.parametrize("dt", STEPS)
def test_published_is_the_paper_s_equations_line_by_line(test: str, dt: float) -> None:
    ask = asked(test, dt)
    y = displacement(test, dem.solve_published(ask))
    path = transcribed(test, dt)[:: ask.goal.stride(dt)]
    assert np.abs(y - path).max() <= 1e-12 * np.abs(path).max()
