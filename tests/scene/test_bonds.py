"""Claims about bonds as part of a scene: they check themselves, and no code passes them over."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

from tests.scenes.spheres.bonded_scenes import CORNERS, EDGES, KN, KS, D, elements, tied, unit
from vv.ask import Ask, Displacement, History, Knobs, Status
from vv.base.digest import digest
from vv.codes import known_beforehand, python_script, source, unsupported
from vv.plan.project import find
from vv.scene import (
    Bonds,
    Contact,
    Scene,
    Spheres,
    Term,
    Wall,
    rotated,
    rotation_about_z,
    why_locks_need_more_than_loads,
    with_bodies_reversed,
)

BONDED = {Term.BOND, Term.BOND_SHEAR, Term.BREAKAGE}
FLOOR = Wall(np.zeros(3), np.array([0.0, 0.0, 1.0]))


def bonded_terms(scene: Scene) -> set[Term]:
    return set(scene.terms() & BONDED)


def test_terms_follow_from_the_bonds() -> None:
    assert bonded_terms(unit()) == {Term.BOND, Term.BOND_SHEAR}
    assert bonded_terms(unit(bonds=tied(ks=0.0))) == {Term.BOND}
    assert bonded_terms(unit(bonds=tied(tension=8.0))) == BONDED
    assert bonded_terms(unit(bonds=tied(shear=18.0))) == BONDED
    assert not bonded_terms(Scene((elements(),), Contact(KN)))


def test_spheres_bonded_for_good_never_touch() -> None:
    assert Term.SPHERE_CONTACT not in unit().terms()
    assert Term.SPHERE_CONTACT in unit(bonds=tied(tension=8.0)).terms()
    assert Term.SPHERE_CONTACT in unit(bonds=tied(pairs=EDGES[:5])).terms()


def test_one_value_stands_for_all_bonds() -> None:
    bonds = tied(tension=8.0)
    assert len(bonds) == 6
    assert all(getattr(bonds, name).shape == (6,) for name in ("length", "kn", "ks", "tension"))
    assert np.isinf(bonds.shear).all()
    assert bonds.breakable.all()
    with pytest.raises(ValueError, match="read-only"):
        bonds.kn[0] = 1.0


def test_pairs_are_body_numbers_and_bonded_are_spheres() -> None:
    bonds = tied(pairs=EDGES + 1)
    scene = Scene((FLOOR, elements()), Contact(KN), bonds=bonds)
    assert (scene.bonded_pairs == EDGES).all()
    parted = Scene(
        (elements(CORNERS[:1]), FLOOR, elements(CORNERS[1:])),
        Contact(KN),
        bonds=tied(pairs=np.where(EDGES > 0, EDGES + 1, 0)),
    )
    assert (parted.bonded_pairs == EDGES).all()
    assert Scene((elements(),), Contact(KN)).bonded_pairs.shape == (0, 2)


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (lambda: tied(kn=0.0), r"Bonds.kn\[0\] = 0.0 N/m; it must be positive"),
        (lambda: tied(ks=-1.0), r"Bonds.ks\[0\] = -1.0 N/m; it must be zero or more"),
        (lambda: tied(kn=np.inf), r"Bonds.kn\[0\] = inf N/m; values must be finite"),
        (lambda: tied(kn=np.ones(5)), "broadcast"),
        (lambda: tied(length=-D), r"Bonds.length\[0\] = -0.001 m; it must be positive"),
        (lambda: tied(tension=np.nan), r"Bonds.tension\[0\] = nan N; it must be positive"),
        (lambda: tied(shear=0.0), r"Bonds.shear\[0\] = 0.0 N; it must be positive"),
        (lambda: tied(pairs=EDGES * 1.0), "float64; it must be .* whole body numbers"),
        (lambda: tied(pairs=EDGES[:0]), "Bonds.pairs is empty"),
        (lambda: tied(pairs=EDGES - 1), r"Bonds.pairs\[0\] = \[-1, 0\]; body numbers start at 0"),
        (lambda: tied(pairs=[[0, 1], [2, 2]]), r"Bonds.pairs\[1\] = \[2, 2\]; a bond joins two"),
        (lambda: tied(pairs=[[0, 1], [1, 0]]), r"Bonds.pairs\[0\] = \[0, 1\] is listed twice"),
        (lambda: unit(bonds=tied(pairs=EDGES + 1)), r"Bonds.pairs\[2\] = \[1, 4\]; bonds join"),
        (
            lambda: Scene((FLOOR, elements()), Contact(KN), bonds=tied()),
            r"Bonds.pairs\[0\] = \[0, 1\]; bonds join spheres",
        ),
        (
            lambda: unit(elements(np.zeros((4, 3)))),
            r"Bonds.pairs\[0\] = \[0, 1\] have one centre",
        ),
        (
            lambda: unit(bonds=tied(tension=8.0, kn=2 * KN)),
            r"Bonds.kn\[0\] = 93587662.2158 N/m, and 46793831.1079 N/m once it is broken",
        ),
        (lambda: unit(bonds=tied(shear=8.0, ks=KN)), r"Bonds.ks\[0\]"),
        (lambda: unit(bonds=tied(shear=8.0, length=2 * D)), r"Bonds.length\[0\] = 0.002 m"),
        (lambda: unit(bonds=tied(shear=8.0), contact=Contact(np.inf)), r"Bonds.kn\[0\]"),
    ],
)
def test_what_no_bond_can_be_is_refused_by_name(make: Callable[[], object], message: str) -> None:
    with pytest.raises(ValueError, match=message):
        make()


def test_an_unbreakable_bond_has_springs_of_its_own() -> None:
    assert Term.BOND in unit(bonds=tied(kn=2 * KN, length=1.1 * D)).terms()


@pytest.mark.parametrize(
    "other",
    [tied(kn=2 * KN), tied(ks=0.0), tied(length=1.1 * D), tied(tension=8.0), tied(shear=8.0)],
)
def test_every_part_of_a_bond_is_in_the_digest(other: Bonds) -> None:
    assert unit(bonds=other).digest() != unit().digest()
    assert unit().digest() == unit().digest()
    assert unit().digest() != Scene((elements(),), Contact(KN, KS, 0.3964)).digest()


def test_turned_and_renumbered_scenes_keep_their_bonds() -> None:
    scene = unit(bonds=tied(pairs=EDGES[:2], kn=[KN, 2 * KN]))
    lengths = [
        _lengths(s)
        for s in (scene, rotated(scene, rotation_about_z(0.3)), with_bodies_reversed(scene))
    ]
    assert np.ptp(lengths, axis=0).max() < 1e-14 * D
    assert with_bodies_reversed(scene).bonds.pairs.tolist() == [[3, 2], [3, 1]]  # type: ignore[union-attr]
    assert with_bodies_reversed(with_bodies_reversed(scene)).digest() == scene.digest()


def _lengths(scene: Scene) -> list[float]:
    i, j = scene.bonded_pairs.T
    x = scene.spheres.position
    return [float(a) for a in np.linalg.norm(x[j] - x[i], axis=1)]


def test_no_dead_load_stands_for_an_oblique_lock_of_a_bonded_body() -> None:
    free = np.array([[True, True, False]] * 4)
    tilted = rotated(
        unit(elements(free=free)), np.array([[0.6, 0, 0.8], [0, 1, 0], [-0.8, 0, 0.6]])
    )
    assert "pull varies" in (why_locks_need_more_than_loads(tilted) or "")
    assert why_locks_need_more_than_loads(unit()) is None


@pytest.mark.parametrize("tension", [np.inf, np.array([8.0, np.inf, 8.0, 8.0, 8.0, 8.0])])
def test_bonds_are_written_into_scripts_bit_for_bit(tension: object) -> None:
    ask = Ask(unit(bonds=tied(tension=tension)), History(1e-6, 1e-8), (Displacement(0),))
    names = {kind.__name__: kind for kind in (Ask, Bonds, Contact, Displacement, History, Scene)}
    assert digest(eval(source(ask), {**names, "Spheres": Spheres, "np": np})) == digest(ask)
    assert "from vv.scene import Bonds" in python_script(ask, "vv.engines.dem", "solve_default")


def test_a_scheme_that_does_not_declare_bonds_refuses_them() -> None:
    project = find(Path(__file__))
    scene = unit(bonds=tied(tension=8.0))
    ask = Ask(scene, History(1e-6, 1e-8), (Displacement(0),), Knobs(dt=1e-8))
    for name in project.adapter_names():
        adapter = project.load_adapter(name)
        for scheme in adapter.schemes:
            missing = unsupported(scheme, scene.terms()) & BONDED
            if missing:
                run = known_beforehand(adapter, scheme, ask, adapter.found())
                assert run is not None
                assert run.status is Status.REFUSED
                assert all(term.value in run.reason for term in missing)


def test_links_of_a_chain_are_scenes_too() -> None:
    x = D * np.outer(np.arange(5), [1.0, 0.0, 0.0])
    pairs = np.stack([np.arange(4), np.arange(1, 5)], axis=1)
    scene = Scene((elements(x),), Contact(KN), bonds=tied(pairs=pairs, ks=0.0))
    assert scene.unknowns() == 15
    assert Term.SPHERE_CONTACT in scene.terms()
