"""Claims about the LIGGGHTS adapter that need no LIGGGHTS: decks, refusals, answers, absence."""

from __future__ import annotations

import dataclasses
import re
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from adapters.liggghts import ADAPTER
from adapters.liggghts.answers import loops, parse
from adapters.liggghts.deck import deck, silent_deck
from adapters.liggghts.translate import space, watched
from adapters.liggghts.walls import triangle
from cases.incline import CASE as INCLINE
from cases.responding_block import CASE as RESPONDING
from cases.single_contact import CASE
from tests.sliding_blocks import Frame, incline
from vv.ask import Ask, Displacement, History, Knobs, Model, Run, Status, Velocity
from vv.case import Case
from vv.scene import Contact, Harmonic, Scene, Spheres, Term, Vector, Wall
from vv.soften import acceleration_of
from vv.stand_in import sprung
from vv.transform import about_z, rotated

DT = 1e-3
PLAIN, HALF_STEP, CLUMP, _ = (scheme.name for scheme in ADAPTER.schemes)
UP = Wall(np.zeros(3), np.array([0.0, 1.0, 0.0]))
FREE = np.ones((1, 3), bool)
NUMBER = st.floats(-1e3, 1e3)


def case_ask(variant: str, dt: float = DT) -> Ask:
    return CASE.declare(variant, CASE.defaults(variant)).study.ask(Knobs(dt=dt))


def ball(**changes: Any) -> Spheres:
    """One free sphere of 2 kg and 0.1 m at rest, which touches the plane y = 0 from above."""
    place, still = np.array([[0, 0.1, 0]]), np.zeros((1, 3))
    whole = Spheres(place, still, np.array([0.1]), np.array([2.0]), FREE)
    return dataclasses.replace(whole, **changes)


def ball_ask(*bodies: Spheres | Wall, body: int = 0, dt: float | None = DT, **scene: Any) -> Ask:
    whole = Scene(bodies, Contact(1e6, 1e6, 0.5), **scene)
    return Ask(whole, History(0.1, 0.01), (Displacement(body), Velocity(body)), Knobs(dt=dt))


def words(text: str, *start: str) -> list[list[str]]:
    """The rest of the commands that begin so, split into words."""
    split = [line.split() for line in text.splitlines()]
    return [line[len(start) :] for line in split if tuple(line[: len(start)]) == start]


@given(st.tuples(NUMBER, NUMBER, NUMBER), st.floats(1e-3, 1e3), st.floats(1e-6, 1e9))
def test_a_deck_holds_the_scene_to_the_last_bit(
    place: tuple[float, ...], radius: float, mass: float
) -> None:
    sphere = ball(position=[place], radius=[radius], mass=[mass], velocity=[place])
    ask = ball_ask(sphere)
    scene = dataclasses.replace(ask.scene, contact=Contact(mass))
    text = deck(dataclasses.replace(ask, scene=scene), PLAIN, "rows.txt")
    assert float(words(text, "fix", "kn")[0][-1]) == mass
    ((created,), (sizes, *_)) = words(text, "create_atoms"), words(text, "set", "atom")
    assert [float(word) for word in created[2:5]] == list(place)
    assert (float(sizes[2]) / 2, float(sizes[4])) == (radius, mass)
    speeds = [dict(zip(w[1::2], w[2::2], strict=True)) for w in words(text, "set", "atom")][1:]
    assert [float(s[f"v{a}"]) for s in speeds for a in "xyz"] == [*place] * any(place)


def test_kn_and_ks_are_the_springs_and_nothing_is_damped() -> None:
    text = deck(case_ask("T3"), PLAIN, "rows.txt")
    told = {line[0]: float(line[-1]) for line in words(text, "fix") if "property/global" in line}
    assert told == {"kn": 5.5e9, "kt": 5.5e9, "gamman": 0, "gammat": 0, "coefficientFriction": 0.1}
    assert text.count("tangential history") == 2
    assert text.count("tangential_damping off") == 2
    assert "history" not in silent_deck(case_ask("T1"), PLAIN)


def test_ids_follow_the_order_of_spheres_and_locks_come_last() -> None:
    fixed_last = deck(case_ask("T1-swapped"), PLAIN, "rows.txt")
    assert words(fixed_last, "group", "shifted") == [["id", "1"]]
    wall_first = deck(case_ask("T4"), PLAIN, "rows.txt")
    assert words(wall_first, "variable", "o0y") == [["equal", "y[1]-(0.0)"]]
    fixes = [line[2] for line in words(wall_first, "fix")]
    assert fixes[-5:] == ["wall/gran", "nve", "viscous", "setforce", "print"]
    assert words(wall_first, "fix", "lock_xz")[0][-3:] == ["0", "NULL", "0"]


def test_a_raised_mass_leaves_the_weight_as_it_was() -> None:
    ask = ball_ask(ball(load=[[3, 0, 0]]), eta=40.0, gravity=np.array([0, -10.0, 0]))
    plain, raised = deck(ask, PLAIN, "rows.txt"), deck(ask, HALF_STEP, "rows.txt")
    assert float(words(plain, "set", "atom", "1")[0][-1]) == 2.0
    assert words(plain, "fix", "weight", "all", "gravity")[0] == [
        "10.0",
        "vector",
        "0.0",
        "-1.0",
        "0.0",
    ]
    assert float(words(raised, "set", "atom", "1")[0][-1]) == 2.0 + 40.0 * DT / 2
    assert not words(raised, "fix", "weight")
    assert words(raised, "fix", "load0", "load0", "addforce") == [["3.0", "-20.0", "0.0"]]
    assert silent_deck(case_ask("T3"), PLAIN) == silent_deck(case_ask("T3"), HALF_STEP)


def test_a_wall_across_an_axis_is_a_plane_and_an_oblique_one_a_mesh_the_deck_writes() -> None:
    quarter = ball_ask(ball(), UP)
    quarter = dataclasses.replace(quarter, scene=rotated(quarter.scene, about_z(np.pi / 2)))
    assert "primitive type 1 xplane" in deck(quarter, PLAIN, "rows.txt")
    ask = case_ask("T3-rotated")
    text = deck(ask, PLAIN, "rows.txt")
    corners = np.array([v.split() for v in re.findall(r'print "vertex (.*?)"', text)], float)
    across = np.cross(corners[1] - corners[0], corners[2] - corners[0])
    normal = ask.scene.walls[0].normal
    assert across / np.linalg.norm(across) == pytest.approx(normal, abs=1e-15)
    assert text.index("endsolid wall") < text.index("mesh/surface file wall0.stl")
    assert words(text, "fix", "load0")  # the load that stands for the lock


@given(st.tuples(NUMBER, NUMBER, NUMBER), st.tuples(NUMBER, NUMBER, NUMBER), st.floats(0.1, 100))
def test_a_triangle_is_larger_than_its_plane_s_cut_with_a_box(
    point: tuple[float, ...], along: tuple[float, ...], reach: float
) -> None:
    normal = np.array(along) + np.array([0, 0, 2e3])
    wall = Wall(np.array(point), normal / np.linalg.norm(normal))
    a, b, c = triangle(wall, np.full(3, -reach), np.full(3, reach))
    ends = reach * np.array(np.meshgrid(*[[-1, 1]] * 3)).reshape(3, 8).T
    for start, end in ((a, b), (b, c), (c, a)):
        assert (np.cross(end - start, ends - start) @ wall.normal > 0).all()
    assert np.abs((np.array([a, b, c]) - point) @ wall.normal).max() < 1e-9


def block_ask(scene: Scene, kn: float | None = 1e9) -> Ask:
    return Ask(scene, History(0.1, 0.01), (Displacement(1),), Knobs(DT, kn))


REFUSED = {
    "body 1 is no sphere": ball_ask(ball(), UP, body=1),
    "dt is not set": ball_ask(ball(), dt=None),
    "longer than the 0.1 s": ball_ask(ball(), dt=0.2),
    "velocity or spin in a locked freedom": ball_ask(ball(spin=[[0, 0, 1]])),
    "no sphere is free": ball_ask(ball(free=~FREE)),
    "turn about some axes only": ball_ask(ball(free_spin=[[True, False, False]])),
    "inertia is not 2/5": ball_ask(ball(free_spin=FREE, inertia=[1.0])),
    "raise the inertia": ball_ask(ball(free_spin=FREE), eta=1.0),
    "lies behind wall 0": ball_ask(UP, ball(position=[[0, -0.01, 0]]), body=1),
    "Knobs.kn is None": block_ask(incline(Frame(20.0), 30.0), None),
    "has 29 groups": ball_ask(*(ball(position=[[i, 0, 0]], load=[[i, 0, 0]]) for i in range(32))),
}


@pytest.mark.parametrize("reason", REFUSED)
def test_what_liggghts_cannot_hold_is_refused(reason: str) -> None:
    assert reason in (ADAPTER.refuses(REFUSED[reason], HALF_STEP) or "not refused")


def test_every_variant_is_run_and_says_all_its_terms() -> None:
    for variant in CASE.variants:
        ask = case_ask(variant.name)
        for scheme in ADAPTER.schemes[:2]:
            assert ADAPTER.refuses(ask, scheme.name) is None
            assert ask.scene.terms() <= ADAPTER.describe(ask, scheme.name).terms <= scheme.terms
    turned = ADAPTER.describe(case_ask("T4-rotated"), HALF_STEP)
    assert turned.unknowns == 3  # LIGGGHTS integrates locked translations too
    assert Term.OBLIQUE_LOCK in turned.terms
    for said in (
        "a dead load along the normal instead of a locked axis",
        "a mesh wall",
        "eta dt/2",
    ):
        assert said in turned.note


@pytest.mark.parametrize("case", [INCLINE, RESPONDING], ids=lambda case: case.name)
def test_every_variant_with_a_block_is_run_as_a_sphere(case: Case) -> None:
    for variant in case.variants:
        study = case.declare(variant.name, case.defaults(variant.name)).study
        ask = study.ask(Knobs(dt=1e-4, kn=1e9))
        assert ask.scene.terms() <= ADAPTER.schemes[0].terms
        assert ADAPTER.refuses(ask, PLAIN) is None
        model = ADAPTER.describe(ask, PLAIN)
        assert ask.scene.terms() <= model.terms
        assert ADAPTER.refuses(ask, CLUMP) is None
        assert "4 spheres of 0.01" in ADAPTER.describe(ask, CLUMP).note
        assert "a sphere of its mass stands for a block" in model.note
        assert "kn = 1e+09, ks = 2.5e+10 N/m" in model.note


def test_a_charge_is_a_step_before_time_starts_that_ends_where_the_sphere_begins() -> None:
    ask = block_ask(incline(Frame(28.0, turn=0.4), 15.0, v0=0.2))
    text, stood = deck(ask, PLAIN, "rows.txt"), sprung(ask)
    assert stood.charged is not None
    (created,) = words(text, "create_atoms")
    (slid,) = (line for line in words(text, "fix", "slid0") if "move" in line)
    way = DT * np.array(slid[3:6], float)
    start = np.array(created[2:5], float)
    assert start + way == pytest.approx(stood.scene.spheres.position[0], abs=1e-15)
    assert -stood.scene.contact.ks * way == pytest.approx(stood.charged[0], rel=1e-12)
    after = text[text.index("unfix slid0") :]
    (speeds,) = words(after, "set", "atom")
    assert np.array(speeds[2::2], float) == pytest.approx(0.2 * Frame(28.0, turn=0.4).dip)
    assert after.index("reset_timestep") < after.index("nve") < after.index("run  ")
    assert "slid" not in deck(case_ask("T3"), PLAIN, "rows.txt")


def test_a_rigid_body_has_the_sphere_s_springs_and_the_rotations_of_the_block() -> None:
    scene = incline(Frame(28.0), 15.0, A=2.0)
    turning = dataclasses.replace(scene.blocks[0], free_spin=np.array([False, True, False]))
    ask = block_ask(dataclasses.replace(scene, bodies=(*scene.walls, turning)))
    text, alone = deck(ask, CLUMP, "rows.txt"), deck(block_ask(scene), PLAIN, "rows.txt")
    for name in ("kn", "kt"):
        springs = [float(words(deck, "fix", name)[0][-1]) for deck in (text, alone)]
        assert springs[0] * 4 == springs[1]
    masses = [float(line[4]) for line in words(text, "set", "atom") if line[1] == "diameter"]
    assert len(masses) == 1 + 4 + 8
    assert sum(masses) == pytest.approx(scene.blocks[0].mass, rel=1e-15)
    fixes = [line[0] for line in words(text, "fix")]
    assert fixes.index("body") > max(fixes.index("weight"), fixes.index("shake0"))
    (freedoms,) = (" ".join(line) for line in words(text, "fix", "body"))
    assert freedoms == "all rigid single force 1 on on on torque 1 off on off"
    assert not [line for line in words(text, "fix") if line[2].startswith("nve")]


def valued(text: str, name: str, step: int) -> float:
    """A variable of a deck at a step."""
    (formula,) = (line[2] for line in words(text, "variable") if line[0] == name)
    known = {"PI": np.pi, "step": step, "sin": np.sin, "cos": np.cos}
    return float(eval(formula, {"__builtins__": {}}, known))


@given(st.floats(0.1, 50.0), st.floats(-3.0, 3.0), st.floats(-3.0, 3.0))
@settings(max_examples=30)
def test_a_mesh_is_where_it_must_be_after_every_step(f: float, phase: float, turn: float) -> None:
    motion = Harmonic(np.array([0.2, 0.0, 0.1]), np.full(3, f), np.full(3, phase), about_z(turn))
    wall = Wall(np.zeros(3), np.array([0.0, 1.0, 0.0]), motion)
    text = deck(ball_ask(wall, ball(), body=1), PLAIN, "rows.txt")
    speeds = [[valued(text, f"wall0_v_{a}", n) for a in "xyz"] for n in range(1, 51)]
    moved = np.sin(2 * np.pi * f * DT * 50 + phase) - np.sin(phase)
    place = DT * np.sum(speeds, axis=0)
    assert place == pytest.approx(moved * (motion.amplitude @ motion.axes), abs=1e-12)


def test_a_body_acceleration_is_a_force_on_the_scene_s_masses() -> None:
    shaking = Harmonic(np.array([5.0, 0.0, 2.0]), np.full(3, 3.0), np.full(3, 0.4), about_z(0.7))
    ask = ball_ask(ball(), shaking=shaking, eta=40.0)
    for scheme in (PLAIN, HALF_STEP):
        text = deck(ask, scheme, "rows.txt")
        force = [valued(text, f"shake0_{a}", 70) for a in "xyz"]
        assert force == pytest.approx(2.0 * acceleration_of(shaking, 70 * DT), rel=1e-12)


MODEL = Model(3, frozenset())


def answer(folder: Path, ask: Ask, rows: Vector) -> Run:
    file = folder / "rows.txt"
    file.write_text("# title\n" + "\n".join(" ".join(map(str, row)) for row in rows))
    return parse(file, ask, MODEL)


def told(ask: Ask) -> Vector:
    """Rows as a sphere that moves with 1 m/s along the second axis of its scene gives them."""
    times = ask.goal.times(ask.knobs.dt)[1:]
    steps = ask.goal.stride(DT) * np.arange(1, len(times) + 1)
    count = np.full(len(times), len(ask.scene.spheres))
    along = ask.scene.axes[1]
    parts = [
        np.outer(times if isinstance(seen, Displacement) else times**0, along)
        for seen, _ in watched(ask)
    ]
    return np.column_stack([steps, count, *parts])


def test_rows_become_a_run_that_begins_at_the_start(tmp_path: Path) -> None:
    ask = ball_ask(ball(velocity=[[0, 1, 0]]))
    run = answer(tmp_path, ask, told(ask))
    assert (run.status, run.steps, run.model) == (Status.RAN, 100, MODEL)
    assert run.values[Displacement(0)] == pytest.approx(np.outer(run.times, [0, 1, 0]))
    assert run.values[Velocity(0)] == pytest.approx(np.outer(run.times**0, [0, 1, 0]))


def test_lost_spheres_and_what_is_not_finite_are_divergence(tmp_path: Path) -> None:
    ask = ball_ask(ball())
    lost, broken = told(ask), told(ask)
    lost[4, 1], broken[6, 3] = 0, np.nan
    assert answer(tmp_path, ask, lost).status is Status.DIVERGED
    assert (
        "0 of 1 spheres are where they may be at t = 0.05 s" in answer(tmp_path, ask, lost).reason
    )
    assert "not finite at t = 0.07 s" in answer(tmp_path, ask, broken).reason


def test_a_dead_load_that_does_not_hold_is_an_error(tmp_path: Path) -> None:
    ask = case_ask("T3-rotated")
    ask = dataclasses.replace(ask, observables=(Velocity(1),))
    assert watched(ask)[1:] == [(Displacement(1), 0)]
    rows = told(ask)
    held = answer(tmp_path, ask, rows)
    assert (held.status, list(held.values)) == (Status.RAN, [Velocity(1)])
    rows[-1, 5:8] += 1e-6 * ask.scene.axes[0]
    assert "along a locked direction" in answer(tmp_path, ask, rows).reason


def test_rows_that_are_missing_short_or_no_numbers_are_errors(tmp_path: Path) -> None:
    ask = ball_ask(ball())
    assert answer(tmp_path, ask, told(ask)[:-1]).status is Status.ERROR
    assert answer(tmp_path, ask, told(ask)[::-1]).status is Status.ERROR
    assert answer(tmp_path, ask, np.zeros((0, 8))).status is Status.ERROR
    (tmp_path / "cut.txt").write_text("10 1 0.1\n20 1")
    for name in ("cut.txt", "nowhere.txt"):
        assert "cannot be read" in parse(tmp_path / name, ask, MODEL).reason


LOG = """
charging shear springs
Loop time of 7e-06 on 1 procs for 1 steps with 1 atoms, finish time today
Outpt time (%) = 3e-06 (48.0)
shear springs are charged
Loop time of 0.005 on 1 procs for 400 steps with 1 atoms, finish time today
Outpt time (%) = 0.0004 (8.0)
Fix history print time (%) = 0.0026 (5.0)
Fix wall0 wall/gran time (%) = 0.001 (2.0)
Loop time of 0.00175 on 1 procs for 400 steps with 1 atoms, finish time today
Outpt time (%) = 2.5e-05 (8.0)
"""


def test_output_is_no_part_of_a_loop_s_time() -> None:
    assert loops(LOG).whole == pytest.approx([0.005, 0.00175])
    assert loops(LOG).solve == pytest.approx([0.002, 0.001725])


def test_the_box_holds_the_longest_free_path() -> None:
    ask = ball_ask(ball(velocity=[[0, 300, 0]]), gravity=np.array([0, 0, -1e3]))
    room = space(ask, PLAIN)
    assert room.high[1] > 0.1 + 30.0
    assert (room.outer[0] < room.low).all()
    assert (room.high < room.outer[1]).all()


def test_an_absent_liggghts_is_said_to_be_absent(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("VV_LIGGGHTS", str(tmp_path / "nowhere"))
    assert not ADAPTER.found().installed
    (run,) = ADAPTER.run([case_ask("T1")], PLAIN, tmp_path, 0.0)
    assert run.status is Status.NOT_INSTALLED
    assert "apt-get install liggghts" in run.reason


def test_an_executable_of_one_s_own_is_found_with_its_library(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    program, library = tmp_path / "bin/lmp", tmp_path / "lib/libliggghts.so.3.7.1"
    for file in (program, library):
        file.parent.mkdir()
        file.touch(0o755)
    monkeypatch.setenv("VV_LIGGGHTS", str(program))
    found = ADAPTER.found()
    assert (found.installed, found.version, found.path) == (True, "3.7.1", str(program))
    assert found.files == (program.resolve(), library.resolve())


def test_numpy_scalars_are_written_as_numbers() -> None:
    knobs = Knobs(np.float64(DT), np.float64(1e9))
    ask = dataclasses.replace(block_ask(incline(Frame(28.0), 15.0, A=2.0)), knobs=knobs)
    for scheme in (PLAIN, CLUMP):
        assert "float64" not in ADAPTER.native(ask, scheme)
