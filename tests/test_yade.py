"""Claims about the YADE adapter that need no YADE: input, refusals, answers, absence."""

from __future__ import annotations

import ast
import dataclasses
import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from adapters.yade import ADAPTER
from adapters.yade.answers import parse
from adapters.yade.translate import plan, put, wall_body
from cases.incline import CASE as INCLINE
from cases.responding_block import CASE as RESPONDING
from cases.single_contact import CASE
from tests.sliding_blocks import Frame, incline, responding
from vv.ask import Ask, Displacement, History, Knobs, Model, Status, Velocity
from vv.case import Case
from vv.scene import Contact, Harmonic, Scene, Spheres, Term, Wall
from vv.stand_in import sprung
from vv.transform import about_z, rotated

DT = 1e-3
PLAIN, HALF_STEP, CLUMP, POLYHEDRA = (scheme.name for scheme in ADAPTER.schemes)
UP = Wall(np.zeros(3), np.array([0.0, 1.0, 0.0]))


def case_ask(variant: str, dt: float = DT) -> Ask:
    return CASE.declare(variant, CASE.defaults(variant)).study.ask(Knobs(dt=dt))


def ball(**changes: Any) -> Spheres:
    """One free sphere of 2 kg and 0.1 m, resting at the origin."""
    still = Spheres(np.zeros((1, 3)), np.zeros((1, 3)), np.array([0.1]), np.array([2.0]), FREE)
    return dataclasses.replace(still, **changes)


FREE = np.ones((1, 3), bool)


def ball_ask(*bodies: Spheres | Wall, body: int = 0, **scene: Any) -> Ask:
    whole = Scene(bodies, Contact(1e6, 1e6, 0.5), **scene)
    return Ask(whole, History(0.1, 0.01), (Displacement(body),), Knobs(dt=DT))


def sphere_of(ask: Ask, scheme: str = PLAIN) -> dict[str, Any]:
    """What YADE is told of the last sphere."""
    spheres = [body for body in plan(ask, scheme)["bodies"] if body["kind"] == "sphere"]
    return dict(spheres[-1])


def test_velocities_start_half_a_step_early() -> None:
    ask = case_ask("T2")
    spheres, eta = ask.scene.spheres, ask.scene.eta
    v0, m = spheres.velocity[1, 1], spheres.mass[1]
    assert sphere_of(ask)["velocity"][1] == pytest.approx(v0 * (1 + eta / m * DT / 2), rel=1e-15)


@pytest.mark.parametrize("scheme", [PLAIN, HALF_STEP])
def test_a_push_gives_a_touching_sphere_the_speed_it_would_have_after_a_step(scheme: str) -> None:
    ask = case_ask("T4")
    eta, m, v0 = ask.scene.eta, ask.scene.spheres.mass[0], ask.scene.spheres.velocity[0, 1]
    told = sphere_of(ask, scheme)
    early = v0 + eta * v0 / m * DT / 2
    assert told["velocity"] == [0.0, 0.0, 0.0]
    after = early - eta * early / told["mass"] * DT
    assert told["push"][1] / told["mass"] * DT == pytest.approx(after, rel=1e-14)


def test_without_friction_or_overlap_nothing_is_pushed() -> None:
    assert sphere_of(case_ask("T1"))["push"] == [0.0, 0.0, 0.0]
    apart = ball_ask(UP, ball(position=[[0, 0.2, 0]], velocity=[[1, 0, 0]]))
    assert sphere_of(apart)["push"] == [0.0, 0.0, 0.0]


def test_spin_of_a_touching_sphere_becomes_a_twist() -> None:
    spinning = ball(position=[[0, 0.09, 0]], spin=[[0, 0, 3]], free_spin=FREE)
    told = sphere_of(ball_ask(UP, spinning))
    assert told["spin"] == [0.0, 0.0, 0.0]
    assert told["twist"][2] * DT / told["inertia"] == pytest.approx(3.0, rel=1e-15)


def test_only_half_step_mass_changes_the_mass_and_then_not_the_weight() -> None:
    ask = ball_ask(ball(), gravity=np.array([0.0, -9.81, 0.0]), eta=3.0)
    plain, half = plan(ask, PLAIN), plan(ask, HALF_STEP)
    assert (plain["bodies"][0]["mass"], plain["gravity"][1]) == (2.0, -9.81)
    assert half["bodies"][0]["mass"] == 2.0 + 3.0 * DT / 2
    assert half["gravity"] == [0.0, 0.0, 0.0]
    assert half["bodies"][0]["force"][1] == -9.81 * 2.0


def test_schemes_agree_on_a_scene_without_drag() -> None:
    assert plan(case_ask("T3"), PLAIN) == plan(case_ask("T3"), HALF_STEP)


def test_locks_become_blocked_freedoms() -> None:
    told = sphere_of(ball_ask(ball(free=[[True, False, True]], free_spin=[[False, True, False]])))
    assert told["blocked"] == "yXZ"


def test_bodies_keep_the_order_of_the_scene() -> None:
    kinds = [body["kind"] for body in plan(case_ask("T3-swapped"), PLAIN)["bodies"]]
    assert kinds == ["sphere", "wall"]


def test_the_frame_given_reaches_yade() -> None:
    bodies = plan(case_ask("T3-rotated"), PLAIN)["bodies"]
    scene = case_ask("T3-rotated").scene
    assert bodies[0]["kind"] == "facet"
    assert bodies[0]["normal"] == scene.walls[0].normal.tolist()
    assert bodies[1]["initial"] == scene.spheres.velocity[0].tolist()
    assert bodies[1]["blocked"] == "zXYZ"


@given(st.floats(0.01, 3.1), st.floats(0.01, 3.1))
def test_a_facet_lies_in_the_plane_of_its_wall_about_its_point(tilt: float, turn: float) -> None:
    normal = np.array([np.sin(tilt) * np.cos(turn), np.sin(tilt) * np.sin(turn), np.cos(tilt)])
    corners = np.array(wall_body(Wall(np.array([1.0, 2.0, 3.0]), normal), 10.0)["corners"])
    assert np.abs(corners @ normal).max() < 1e-14
    assert np.abs(corners.sum(axis=0)).max() < 1e-14
    assert np.linalg.norm(corners, axis=1) == pytest.approx([10.0] * 3)


@pytest.mark.parametrize("scheme", [PLAIN, HALF_STEP])
def test_a_file_carries_every_number_exactly(scheme: str) -> None:
    told = plan(case_ask("T4-rotated"), scheme)
    assert json.loads(json.dumps(told)) == told


def test_contacts_expected_at_the_start_are_counted() -> None:
    assert plan(case_ask("T1"), PLAIN)["contacts"] == 0
    assert plan(case_ask("T3"), PLAIN)["contacts"] == 1
    assert plan(ball_ask(ball(), ball(position=[[0, 0.15, 0]])), PLAIN)["contacts"] == 1
    held = ball(free=~FREE)
    assert plan(ball_ask(held, ball(position=[[0, 0.15, 0]], free=~FREE)), PLAIN)["contacts"] == 0


def test_every_variant_is_run() -> None:
    for variant in CASE.variants:
        ask = case_ask(variant.name)
        assert ask.scene.terms() <= ADAPTER.schemes[0].terms
        assert ADAPTER.refuses(ask, PLAIN) is None


def block_ask(scene: Scene, kn: float | None = 1e9) -> Ask:
    return Ask(scene, History(0.1, 0.01), (Displacement(1),), Knobs(DT, kn))


@pytest.mark.parametrize("case", [INCLINE, RESPONDING], ids=lambda case: case.name)
def test_every_variant_with_a_block_is_run_as_a_sphere_and_no_freedom_more(case: Case) -> None:
    for variant in case.variants:
        study = case.declare(variant.name, case.defaults(variant.name)).study
        ask = study.ask(Knobs(dt=1e-4, kn=1e9))
        assert ask.scene.terms() <= ADAPTER.schemes[0].terms
        assert ADAPTER.refuses(ask, PLAIN) is None
        model = ADAPTER.describe(ask, PLAIN)
        assert model.unknowns == ask.scene.unknowns()
        assert ask.scene.terms() <= model.terms
        assert ADAPTER.refuses(ask, CLUMP) is None
        assert "4 spheres of 0.01" in ADAPTER.describe(ask, CLUMP).note
        assert "a sphere of its mass stands for a block" in model.note
        assert "kn = 1e+09, ks = 2.5e+10 N/m" in model.note


def test_a_clump_has_the_sphere_s_springs_and_the_rotations_of_the_block() -> None:
    scene = incline(Frame(28.0), 15.0)
    turning = dataclasses.replace(scene.blocks[0], free_spin=np.array([False, True, False]))
    for block, blocked in ((scene.blocks[0], "XYZ"), (turning, "XZ")):
        ask = block_ask(dataclasses.replace(scene, bodies=(*scene.walls, block)))
        assert ADAPTER.refuses(ask, CLUMP) is None
        told, alone = plan(ask, CLUMP), plan(block_ask(scene), PLAIN)
        assert (4 * told["kn"], 4 * told["ks"]) == (alone["kn"], alone["ks"])
        forces = np.array(told["charged"][0]["forces"])
        assert forces.sum(axis=0) == pytest.approx(alone["charged"][0]["forces"][0])
        clump, sphere = told["bodies"][1], alone["bodies"][1]
        assert clump["blocked"] == blocked
        assert [clump[name] for name in ("mass", "push", "force")] == [
            sphere[name] for name in ("mass", "push", "force")
        ]
        assert ADAPTER.describe(ask, CLUMP).unknowns == 6 - len(blocked)


@given(st.floats(0.0, 40.0), st.floats(0.0, 6.3), st.floats(10.0, 40.0))
def test_a_polyhedron_lies_level_and_is_charged_by_its_first_step(
    alpha: float, turn: float, phi: float
) -> None:
    ask = block_ask(incline(Frame(alpha, turn), phi, A=2.0, v0=0.1))
    flat, frame = put(ask, POLYHEDRA)
    told, alone = plan(flat, POLYHEDRA), plan(flat, PLAIN)
    (wall, made), (_, sphere) = told["bodies"], alone["bodies"]
    assert (wall["kind"], wall["normal"]) == ("wall", [0.0, 0.0, 1.0])
    assert frame @ frame.T == pytest.approx(np.eye(3), abs=1e-12)
    assert flat.scene.gravity @ frame == pytest.approx(ask.scene.gravity, abs=1e-12)
    slid = np.array(made["velocity"]) * DT
    assert -told["ks"] * slid == pytest.approx(alone["charged"][0]["forces"][0], abs=1e-9)
    after = np.array(made["velocity"]) + np.array(made["push"]) / made["mass"] * DT
    assert after == pytest.approx(np.array(sphere["push"]) / sphere["mass"] * DT, abs=1e-12)
    assert told["kn"] * 1.0 * 0.6 == pytest.approx(alone["kn"], rel=1e-9)  # its face: 1 m by 0.6 m
    corners = np.array(made["vertices"]) + made["position"]
    assert corners[:, 2].min() * told["kn"] * 0.6 == pytest.approx(
        -2500.0 * 0.48 * 9.81 * np.cos(np.radians(alpha)), rel=1e-5
    )


def test_the_limits_of_polyhedra_are_refusals() -> None:
    scene = incline(Frame(20.0), 30.0)
    block = scene.blocks[0]
    long = dataclasses.replace(block_ask(scene), goal=History(100.0, 1.0))
    assert "steps of polyhedra" in (ADAPTER.refuses(long, POLYHEDRA) or "")
    turning = dataclasses.replace(block, free_spin=np.ones(3, bool))
    low = scene.walls[0].normal
    flat = block.vertices - np.outer(0.95 * (block.vertices @ low), low)
    changes = {
        "would start to rock": turning,
        "thinner than 0.1": dataclasses.replace(block, vertices=flat),
    }
    for words, changed in changes.items():
        ask = block_ask(dataclasses.replace(scene, bodies=(*scene.walls, changed)))
        assert words in (ADAPTER.refuses(ask, POLYHEDRA) or ""), words
    assert ADAPTER.refuses(block_ask(scene), POLYHEDRA) is None


def test_drag_is_all_that_half_step_masses_are_about() -> None:
    terms = ADAPTER.schemes[1].terms
    assert {Term.SHAKING, Term.BASE_MOTION} <= terms
    assert not {Term.BLOCK, Term.RIGID_CONTACT} & terms


def test_a_contact_starts_with_the_friction_of_rigid_contact() -> None:
    ask = block_ask(incline(Frame(28.0, turn=0.4), 15.0))
    told, stood = plan(ask, PLAIN), sprung(ask)
    assert stood.charged is not None
    assert told["charged"] == [{"wall": 0, "body": 1, "forces": stood.charged.tolist()}]
    assert (told["kn"], told["ks"]) == (1e9, stood.scene.contact.ks)
    sphere = told["bodies"][1]
    pull = np.array(ask.scene.gravity) + stood.charged[0] / sphere["mass"]
    down = Frame(28.0, turn=0.4).dip
    early = np.array(sphere["push"]) @ down / sphere["mass"] * DT
    assert early == pytest.approx(-(pull @ down) * DT / 2, rel=1e-12)
    assert plan(case_ask("T3"), PLAIN)["charged"] == []


@given(st.floats(0.1, 50.0), st.floats(-3.0, 3.0), st.floats(-3.0, 3.0))
def test_a_driven_wall_is_where_it_must_be_after_every_step(
    f: float, phase: float, turn: float
) -> None:
    motion = Harmonic(np.array([0.2, 0.0, 0.1]), np.full(3, f), np.full(3, phase), about_z(turn))
    wall = Wall(np.zeros(3), np.array([0.0, 0.0, 1.0]), motion)
    above = ball(position=[[0, 0, 0.5]])
    told = plan(ball_ask(wall, above, body=1), PLAIN)["bodies"][0]["motion"]
    steps, place = np.arange(50), np.zeros(3)
    for sine in told:  # YADE: v = -A w sin(wt + fi) for a whole step
        rate = 2 * np.pi * sine["f"]
        place = (
            place - np.array(sine["A"]) * rate * DT * np.sin(rate * DT * steps + sine["fi"]).sum()
        )
    rate = 2 * np.pi * f
    moved = np.sin(rate * DT * 50 + phase) - np.sin(phase)
    assert place == pytest.approx(moved * (motion.amplitude @ motion.axes), abs=1e-12)


def test_a_body_acceleration_is_told_in_the_frame() -> None:
    told = plan(block_ask(incline(Frame(20.0, turn=0.4), 30.0, A=5.0)), PLAIN)
    (sine,) = told["shaking"]
    assert sine["A"] == pytest.approx(5.0 * Frame(0.0, turn=0.4).level)
    assert (sine["f"], sine["fi"]) == (1.0, 0.0)
    assert told["bodies"][1]["shaken"] == told["bodies"][1]["mass"]


def test_a_shaken_sphere_starts_half_a_step_of_its_acceleration_early() -> None:
    shaking = Harmonic(np.array([4.0, 0.0, 0.0]), np.full(3, 2.0), np.full(3, 0.5))
    told = sphere_of(ball_ask(ball(), shaking=shaking))
    assert told["velocity"] == pytest.approx([-4.0 * np.sin(0.5) * DT / 2, 0.0, 0.0])


def refusal(*bodies: Spheres | Wall, **more: Any) -> str:
    return ADAPTER.refuses(ball_ask(*bodies, **more), PLAIN) or ""


def test_what_yade_would_get_wrong_is_refused_with_the_reason() -> None:
    carried = ball(velocity=[[1, 0, 0]], free=[[False, True, True]])
    turned = rotated(ball_ask(carried).scene, about_z(0.3))
    reason = ADAPTER.refuses(dataclasses.replace(ball_ask(carried), scene=turned), PLAIN)
    assert "locks are oblique" in (reason or "")
    assert "locked freedom" in refusal(ball(spin=[[1, 0, 0]]))
    assert "behind wall 0" in refusal(UP, ball(position=[[0, -0.01, 0]]), body=1)
    partly = ball(free_spin=[[True, False, False]])
    turned = rotated(ball_ask(partly).scene, about_z(0.3))
    reason = ADAPTER.refuses(dataclasses.replace(ball_ask(partly), scene=turned), PLAIN)
    assert "turned frame" in (reason or "")
    assert "body 0 is no sphere" in refusal(UP, ball(position=[[0, 1, 0]]))


def test_blocks_that_no_sphere_stands_for_are_refused_with_the_reason() -> None:
    scene = responding(0.2, 2.0, 0.6, turn=0.3)
    assert "Knobs.kn is None" in (ADAPTER.refuses(block_ask(scene, None), PLAIN) or "")
    turning = dataclasses.replace(scene.blocks[0], free_spin=np.ones(3, bool))
    loose = dataclasses.replace(scene, bodies=(*scene.walls, turning))
    assert "may turn" in (ADAPTER.refuses(block_ask(loose), PLAIN) or "")


def test_a_lock_across_the_frame_along_which_the_base_shakes_is_refused() -> None:
    scene = responding(0.2, 2.0, 0.6, turn=0.3)  # the base swings along 0.3 rad
    held = dataclasses.replace(scene.blocks[0], free=np.array([True, False, True]))
    for turn, refused in ((0.3, False), (0.7, True)):
        axes = Frame(0.0, turn).axes
        locked = dataclasses.replace(scene, bodies=(*scene.walls, held), axes=axes)
        reason = ADAPTER.refuses(block_ask(locked), PLAIN)
        assert ("a dead load" in (reason or "")) is refused


def test_a_model_states_its_unknowns_and_how_locks_are_kept() -> None:
    straight = ADAPTER.describe(case_ask("T3"), PLAIN)
    oblique = ADAPTER.describe(case_ask("T3-rotated"), PLAIN)
    assert (straight.unknowns, oblique.unknowns) == (1, 2)
    assert "a dead load along the normal instead of a locked axis" in oblique.note
    assert oblique.terms - straight.terms == {Term.OBLIQUE_LOCK, Term.LOAD}


def test_an_exported_script_is_the_driver_with_the_ask_filled_in() -> None:
    ask = case_ask("T4-rotated")
    tree = ast.parse(ADAPTER.native(ask, HALF_STEP))
    written = next(n for n in tree.body if isinstance(n, ast.AnnAssign))
    assert written.value is not None
    assert ast.literal_eval(written.value) == plan(ask, HALF_STEP)


def test_where_yade_is_absent_it_is_said_how_to_get_it(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("VV_YADE", str(tmp_path))
    found = ADAPTER.found()
    assert not found.installed
    assert "apt-get install yade" in found.how_to_install
    runs = list(ADAPTER.run([case_ask("T1")] * 2, PLAIN, tmp_path, 0.0))
    assert [run.status for run in runs] == [Status.NOT_INSTALLED] * 2


def test_the_version_is_read_from_the_package(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    package = tmp_path / "py" / "yade"
    package.mkdir(parents=True)
    (package / "wrapper.so").touch()
    (package / "config.py").write_text("prefix='/usr'\nversion='1.2b'\n")
    monkeypatch.setenv("VV_YADE", str(package.parent))
    monkeypatch.setattr("adapters.yade.installed.PYTHON", package / "config.py")
    assert ADAPTER.found().version == "1.2b"
    assert package / "wrapper.so" in ADAPTER.found().files


FACTS = {
    "status": "ran", "reason": "", "steps": 100, "unknowns": 3, "ready": 12.5, "setup": 0.1,
    "solve_cpu": 0.2, "solve_wall": 0.3, "output": 0.4, "repeats": 5, "spread": 0.6,
}  # fmt: skip
MODEL = Model(0, frozenset(), "as described")
FRAME = np.eye(3)


def answered(folder: Path, values: Any, **changes: Any) -> Path:
    path = folder / "ask-0.json"
    np.save(f"{path}.npy", values)
    Path(f"{path}.answer").write_text(json.dumps({**FACTS, **changes}))
    return path


def test_an_answer_becomes_a_run(tmp_path: Path) -> None:
    ask = ball_ask(ball())
    values = np.arange(33.0).reshape(1, 11, 3)
    run = parse(answered(tmp_path, values), ask, FRAME, MODEL, started=11.0)
    assert run is not None
    assert run.status is Status.RAN
    assert (run.values[Displacement(0)] == values[0]).all()
    assert run.times == pytest.approx(0.01 * np.arange(11))
    assert (run.cost.startup, run.cost.solve_cpu, run.cost.repeats) == (1.5, 0.2, 5)
    assert run.model == Model(3, frozenset(), "as described")


def test_only_the_first_answer_of_a_program_carries_its_start(tmp_path: Path) -> None:
    path = answered(tmp_path, np.zeros((1, 11, 3)), ready=0.0)
    run = parse(path, ball_ask(ball()), FRAME, MODEL, started=11.0)
    assert run is not None
    assert run.cost.startup == 0.0


def test_a_quantity_missing_from_an_answer_is_an_error(tmp_path: Path) -> None:
    ask = dataclasses.replace(ball_ask(ball()), observables=(Displacement(0), Velocity(0)))
    run = parse(answered(tmp_path, np.zeros((1, 11, 3))), ask, FRAME, MODEL, started=0.0)
    assert run is not None
    assert run.status is Status.ERROR
    assert "(2, 11, 3) was asked for" in run.reason


def test_a_sphere_that_drifts_where_it_was_locked_is_an_error(tmp_path: Path) -> None:
    ask = case_ask("T3-rotated", dt=0.1)
    along, across = ask.scene.axes[1], ask.scene.axes[0]
    moved = np.array([[0.0, 0.0, 0.0], 0.1 * along, 0.2 * along, 0.3 * along, 0.4 * along])
    kept = parse(answered(tmp_path, moved[None] + 1e-13 * across), ask, FRAME, MODEL, started=0.0)
    lost = parse(answered(tmp_path, moved[None] + 1e-9 * across), ask, FRAME, MODEL, started=0.0)
    assert kept is not None
    assert lost is not None
    assert kept.status is Status.RAN
    assert (lost.status, "dead load stands for the lock" in lost.reason) == (Status.ERROR, True)


def test_a_sphere_under_a_dead_load_is_watched_though_nobody_asked() -> None:
    ask = dataclasses.replace(case_ask("T3-rotated"), observables=(Velocity(1),))
    assert plan(ask, PLAIN)["observe"] == [["velocity", 1], ["displacement", 1]]
    assert plan(case_ask("T3"), PLAIN)["observe"] == [["displacement", 1]]


def test_a_failure_keeps_its_status_and_reason(tmp_path: Path) -> None:
    path = answered(tmp_path, np.zeros(0), status="diverged", reason="not finite at t = 1 s")
    run = parse(path, ball_ask(ball()), FRAME, MODEL, started=0.0)
    assert run is not None
    assert (run.status, run.reason) == (Status.DIVERGED, "not finite at t = 1 s")


def test_values_without_their_facts_are_no_answer_yet(tmp_path: Path) -> None:
    path = answered(tmp_path, np.zeros((1, 11, 3)))
    Path(f"{path}.answer").unlink()
    assert parse(path, ball_ask(ball()), FRAME, MODEL, started=0.0) is None


def test_numpy_scalars_are_written_as_numbers() -> None:
    knobs = Knobs(np.float64(DT), np.float64(1e9))
    ask = dataclasses.replace(block_ask(incline(Frame(28.0), 15.0, A=2.0)), knobs=knobs)
    for scheme in (PLAIN, CLUMP, POLYHEDRA):
        assert "float64" not in ADAPTER.native(ask, scheme)
