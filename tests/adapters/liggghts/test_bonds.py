"""Claims about bonds in LIGGGHTS, for which contacts stand in that overlap from the start."""

from __future__ import annotations

import dataclasses
from pathlib import Path

import numpy as np
import pytest

from adapters.liggghts import ADAPTER
from adapters.liggghts.overlaps import OVERLAP, overlapped
from tests.scenes.spheres.bonded_scenes import CORNERS, EDGES, KN, KS, D, elements, tied, unit
from tests.support.installed import only_with
from vv.ask import Ask, Displacement, History, Knobs, Status
from vv.case import Grid, Level
from vv.codes import known_beforehand, unsupported
from vv.engines import dem
from vv.plan.project import find
from vv.scene import Bonds, Scene, Spheres, Term, initial_normal_forces

SCHEME = "pre-overlapped"
live = only_with(ADAPTER)


def pulled(force: float = 0.1, bonds: Bonds | None = None) -> Scene:
    base = np.array([[1, 1, 1], [1, 1, 0], [1, 1, 0], [1, 1, 0]], bool)
    load = np.outer([1, 0, 0, 0], [0, 0, force])
    return unit(elements(free=base, load=load), bonds, eta=2.0)


def ask(scene: Scene) -> Ask:
    seen = tuple(Displacement(i) for i in range(len(scene.spheres)))
    return Ask(scene, History(2e-6, 2e-7), seen, Knobs(dt=1e-8))


def refusal(scene: Scene) -> str:
    return ADAPTER.refuses(ask(scene), SCHEME) or ""


def test_spheres_overlap_alike_and_dead_loads_hold_them() -> None:
    made, own = overlapped(pulled()), pulled().spheres.load
    force = initial_normal_forces(made)
    assert np.abs(force).max() > 1.0  # N
    assert np.abs(force + made.spheres.load - own).max() < 1e-9
    i, j = EDGES.T
    apart = np.linalg.norm(made.spheres.position[j] - made.spheres.position[i], axis=1)
    assert 2 * made.spheres.radius[0] - apart == pytest.approx(OVERLAP * D, rel=1e-6)
    assert (made.contact.kn, made.contact.ks) == (KN, KS)


def test_it_is_labelled_with_its_overlap() -> None:
    assert f"overlap by {OVERLAP:g}" in ADAPTER.describe(ask(pulled()), SCHEME).note
    assert f"overlap by {OVERLAP:g}" in ADAPTER.native(ask(pulled()), SCHEME)
    assert OVERLAP <= 2e-4


def test_what_contacts_cannot_be_is_refused() -> None:
    scheme = next(s for s in ADAPTER.schemes if s.name == SCHEME)
    lacking = {Term.BREAKAGE, Term.ROTATION, Term.SPHERE_CONTACT, Term.CARRIED}
    assert lacking <= unsupported(scheme, frozenset(Term))
    assert "represent bonds up to 5e-08 m" in refusal(pulled(10.0))
    assert "a bond has a force at t = 0" in refusal(pulled(bonds=tied(length=0.9999 * D)))
    assert "bonds differ in ks" in refusal(pulled(bonds=tied(ks=KS * np.linspace(0, 1, 6))))
    assert "as close as bonded ones" in refusal(pulled(bonds=tied(pairs=EDGES[:5])))
    loose = Spheres(CORNERS[:1], np.zeros((1, 3)), np.ones(1), np.ones(1), np.ones((1, 3), bool))
    assert "no bonds" in refusal(dataclasses.replace(unit(), bodies=(loose,), bonds=None))
    assert refusal(pulled()) == ""


@live
def test_it_says_in_its_own_words_why_bonds_do_not_break() -> None:
    frail = ask(pulled(bonds=tied(tension=1.0, shear=1.0)))
    for scheme in ADAPTER.schemes:
        run = known_beforehand(ADAPTER, scheme, frail, ADAPTER.found())
        assert run is not None
        assert ("bonds that break (" in run.reason) is (Term.BOND in scheme.terms), scheme.name


def test_words_on_a_term_that_a_scheme_has_are_refused() -> None:
    with pytest.raises(ValueError, match=r"'default' has Term\.BOND"):
        dataclasses.replace(ADAPTER.schemes[0], why_not={Term.BOND: "it has"})


@live
def test_it_moves_as_bonds_do_but_for_the_overlap_s_part(tmp_path: Path) -> None:
    """Without drag, which LIGGGHTS takes half a step late."""
    scene = dataclasses.replace(pulled(), eta=0.0)
    (run,) = ADAPTER.run([ask(scene)], SCHEME, tmp_path, 0.0)
    assert run.status is Status.RAN, run.reason
    truth = dem.solve_default(ask(scene))
    for what, values in run.values.items():
        size = np.abs(truth.values[what]).max()
        assert np.abs(values - truth.values[what]).max() < 5e-4 * size, what


@live
def test_bonds_without_shear_springs_are_harmonic_bonds(tmp_path: Path) -> None:
    """Of unlike springs and lengths, far from small motions."""
    bonds = tied(ks=0.0, kn=KN * np.linspace(0.5, 1.5, 6), length=D * np.linspace(0.99, 1.01, 6))
    thrown = elements(velocity=np.random.default_rng(1).normal(size=(4, 3)) * 20.0)
    one, other = ask(unit(thrown, bonds)), ask(pulled(bonds=tied(ks=0.0)))
    assert ADAPTER.refuses(one, "default") is None
    runs = ADAPTER.run([one, other, one], "default", tmp_path, 0.0)
    for asked, run in zip((one, other, one), runs, strict=True):
        assert run.status is Status.RAN, run.reason
        truth = dem.solve_default(asked)
        for what, values in run.values.items():
            size = np.abs(truth.values[what]).max()
            allowed = 1e-9 if asked is one else 2e-2  # drag is half a step late
            assert np.abs(values - truth.values[what]).max() < allowed * size, what


def test_harmonic_bonds_take_no_contacts_beside() -> None:
    beside = ask(unit(bonds=tied(pairs=EDGES[:5], ks=0.0)))
    assert "contacts beside bonds" in (ADAPTER.refuses(beside, "default") or "")
    sheared = ADAPTER.schemes[0].terms
    assert Term.BOND in sheared
    assert Term.BOND_SHEAR not in sheared


@live
def test_bonds_that_fly_apart_at_too_long_a_step_diverge_which_is_no_error(tmp_path: Path) -> None:
    """LIGGGHTS stops where it misses a bonded sphere that has left its box."""
    study = find().load_case("stability-map").declare("unit", {}).study
    assert isinstance(study, Grid)
    limit, rungs = study.critical(None), study.rungs[Level.PAPER]
    beyond = min((k for k in rungs if (k.dt or 0.0) > limit), key=lambda k: k.dt or 0.0)
    (run,) = ADAPTER.run([study.ask(beyond)], "default", tmp_path, 0.0)
    assert run.status is Status.DIVERGED
    assert "Bond atoms" in run.reason
    assert "left the box" in run.reason
