"""Claims about four bonded elements at finite strain: they follow the path, and deviations show."""

import numpy as np
import pytest

from reference_solutions.bonds import tetrahedral_unit
from vv.ask import Method, Run
from vv.case import Exact, Parameters, Scalar, Trial, evaluated, judge_for_method
from vv.engines import dem
from vv.plan.project import find

CASE = find().load_case("tetrahedral-path")
UNIT = find().load_case("tetrahedral-unit")
BAR = 1e-6
FIGURES = {-1e-3: (-5.02589e-4, 6.08120e-4), -5e-3: (-2.520506e-3, 3.042308e-3)}


def trial(variant: str, **changed: float) -> tuple[Trial, Parameters]:
    p = {**CASE.defaults(variant), **changed}
    return CASE.declare(variant, p), p


def solved(of: Trial) -> Run:
    rungs = next(iter(of.study.rungs.values()))
    return dem.solve_default(of.study.ask(rungs[0]))


def judged(q: Scalar) -> bool:
    return isinstance(judge_for_method(q.judge, Method.SECOND_ORDER), Exact)


def errors(of: Trial, run: Run) -> dict[str, float]:
    """The relative errors of all quantities that are judged."""
    return {
        q.name: abs(q.observe(run) - evaluated(q.reference)) / evaluated(q.scale)
        for q in of.quantities
        if isinstance(q, Scalar) and q.reference is not None and judged(q)
    }


@pytest.mark.parametrize("gamma", [0.0, 5 / 29, 1.0])
@pytest.mark.parametrize("way", ["out", "in"])
def test_a_slow_load_keeps_to_the_equilibrium_path_up_to_half_a_percent(
    way: str, gamma: float
) -> None:
    of, _ = trial(way, gamma=gamma)
    seen = errors(of, solved(of))
    assert len(seen) == 8
    assert max(seen.values()) < BAR


def test_secants_are_off_the_small_strain_formulas_by_what_is_known_of_them() -> None:
    of, _ = trial("in")
    run = solved(of)
    beside = {q.name: q for q in of.quantities if isinstance(q, Scalar)}
    for strain, (E, nu) in FIGURES.items():
        assert beside[f"E({strain:g})-small"].observe(run) == pytest.approx(E, abs=1e-8)
        assert beside[f"nu({strain:g})-small"].observe(run) / 0.16 == pytest.approx(nu, abs=1e-8)


def test_the_rate_of_loading_is_no_part_of_the_answer() -> None:
    of, p = trial("out")
    slower, _ = trial("out", rate=p["rate"] / 2)
    assert max(errors(slower, solved(slower)).values()) < BAR
    exact = [q.reference for q in of.quantities if isinstance(q, Scalar)]
    assert exact == [q.reference for q in slower.quantities if isinstance(q, Scalar)]


def test_the_other_shear_spring_in_use_is_told_apart() -> None:
    p = CASE.defaults("out")
    springs = tetrahedral_unit.incremental, tetrahedral_unit.total
    kn, ks = p["kn"], p["gamma"] * p["kn"]
    first, second = (
        tetrahedral_unit.equilibrium(p["strain"], kn=kn, ks=ks, d=p["d"], spring=spring)
        for spring in springs
    )
    assert abs(first.modulus / second.modulus - 1) > 100 * BAR


def test_a_load_put_on_at_once_leaves_the_path_by_no_more_than_a_tenth_of_the_strain() -> None:
    for variant in ("pulled", "pulled-more", "pressed-more"):
        p = UNIT.defaults(variant)
        of = UNIT.declare(variant, p)
        largest = max(errors(of, solved(of)).values())
        assert 1e-3 * abs(p["strain"]) < largest < 0.1 * abs(p["strain"])


@pytest.mark.parametrize("gamma", [0.0, 0.5, 1.0])
def test_nu_grows_with_the_strain_where_it_is_zero_too(gamma: float) -> None:
    nu = np.array([
        tetrahedral_unit.equilibrium(strain, kn=1e7, ks=gamma * 1e7, d=1e-3).poisson
        for strain in (1e-5, -1e-5)
    ])  # fmt: skip
    assert (nu[0] - nu[1]) / 2e-5 == pytest.approx(tetrahedral_unit.poisson_slope(gamma), abs=1e-6)
