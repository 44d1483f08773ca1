"""Claims about the fluid around spheres."""

import numpy as np
import pytest

from vv.ask import Ask, Displacement, History, Knobs
from vv.engines import dem
from vv.engines.dem.refusals import refuses
from vv.engines.dem.solve import solve
from vv.scene import Contact, Fluid, Scene, Spheres, Term


def sinking(eta: float = 0.0, along: tuple[float, float, float] = (0.0, 0.0, -1.0)) -> Ask:
    """A sphere thrown through a fluid."""
    sphere = Spheres(
        np.zeros((1, 3)), 0.3 * np.array([along]), np.array([5e-5]), np.array([1e-9]),
        free=np.ones((1, 3), bool),
    )  # fmt: skip
    scene = Scene((sphere,), Contact(1.0), eta=eta, fluid=Fluid(1.2, 1.8e-5))
    return Ask(scene, History(0.1, 0.1), (Displacement(0),), Knobs(dt=1e-3))


@pytest.mark.parametrize("given", [(0.0, 1.0), (1.0, -1.0), (1.0, float("inf"))])
def test_a_fluid_has_a_density_and_a_viscosity(given: tuple[float, float]) -> None:
    with pytest.raises(ValueError, match="must be positive and finite"):
        Fluid(*given)


def test_a_scene_with_a_fluid_and_spheres_has_its_term() -> None:
    assert Term.FLUID in sinking().scene.terms()


def test_a_fluid_drags_alike_in_all_directions_and_keeps_the_books() -> None:
    """What m v- v+/2 at t = 0 is off, (dt/s)^2/4 with s = m/(3 pi mu d) and its Re, is the rest."""
    down = solve(sinking(), dem.CENTRED)
    aslant = solve(sinking(along=(0.6, 0.0, 0.8)), dem.CENTRED)
    way = [float(np.linalg.norm(run.values[Displacement(0)][-1])) for run in (down, aslant)]
    assert way[0] == pytest.approx(way[1], rel=1e-12)
    assert down.ledger is not None
    assert down.ledger.unaccounted < 2e-4 * down.ledger.peak
    assert down.ledger.terms["drag dissipation"] > 0.3 * down.ledger.peak


def test_a_fluid_beside_linear_drag_is_refused() -> None:
    assert "drag of a fluid" in (refuses(sinking(eta=1e-9)) or "")
