"""Claims that every code solves small scenes of unlike spheres as scipy does from the contact law.

The scenes tell apart what single contacts cannot: one sphere from another, one wall from another,
a second touch from a first. The reference shares no code with any engine.
"""

from __future__ import annotations

import dataclasses
import functools
import itertools
import os
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np
import pytest
from scipy.integrate import solve_ivp

import adapters.dem
import adapters.liggghts
import adapters.yade
from vv.adapter import Adapter
from vv.ask import Ask, Displacement, History, Knobs, Run, Status
from vv.scene import Contact, Scene, Spheres, Vector, Wall

STICKING = Contact(kn=2e4, ks=1.2e4, mu=1e6)
"""Whatever touches sticks until it opens, when its shear force is lost."""


class Touch(NamedTuple):
    """A sphere i, and the sphere j (None: the wall) that may push it."""

    i: int
    j: int | None
    wall: Wall | None


def touches(scene: Scene) -> list[Touch]:
    n = range(len(scene.spheres))
    walls = [Touch(i, None, wall) for wall in scene.walls for i in n]
    return walls + [Touch(i, j, None) for i, j in itertools.combinations(n, 2)]


class Law:
    """m u'' = m g + F + contacts - eta u', I w' = torques, each along the free directions.

    y = (u, v, w, shear force of every contact), all flat. A shear force grows by -ks times the
    velocity of the spheres' surfaces against each other, half the overlap in, and turns with
    the normal and with the mean spin of the two about it.
    """

    def __init__(self, scene: Scene) -> None:
        self.scene, self.touches = scene, touches(scene)
        s, axes = scene.spheres, scene.axes
        self.n = len(s)
        self.hold = np.einsum("ka,nk,kb->nab", axes, s.free, axes) / s.mass[:, None, None]
        self.hold_spin = np.einsum("ka,nk,kb->nab", axes, s.free_spin, axes)
        self.hold_spin /= s.inertia[:, None, None]

    def parts(self, y: Vector) -> list[Vector]:
        n = 3 * self.n
        return [part.reshape(-1, 3) for part in np.split(y, [n, 2 * n, 3 * n])]

    def facing(self, touch: Touch, u: Vector) -> tuple[float, Vector, float]:
        """The gap, the unit normal towards sphere i, and the distance over which it turns."""
        s = self.scene.spheres
        place = s.position[touch.i] + u[touch.i]
        if touch.wall is not None:
            n = touch.wall.normal
            return float((place - touch.wall.point) @ n - s.radius[touch.i]), n, np.inf
        offset = place - s.position[touch.j] - u[touch.j]
        length = float(np.linalg.norm(offset))
        return length - float(s.radius[touch.i] + s.radius[touch.j]), offset / length, length

    def gap(self, touch: Touch, time: float, y: Vector) -> float:
        return self.facing(touch, self.parts(y)[0])[0]

    def rate(self, closed: Iterable[int], time: float, y: Vector) -> Vector:
        """dy/dt while these contacts are closed and the others open."""
        scene, s = self.scene, self.scene.spheres
        u, v, w, shear = self.parts(y)
        push = s.mass[:, None] * scene.gravity + s.load - scene.eta * v
        turn, sheared = np.zeros_like(w), np.zeros_like(shear)
        for k in closed:
            i, j, _ = self.touches[k]
            gap, n, length = self.facing(self.touches[k], u)
            arm = s.radius + gap / 2
            slide, rolled, spin = v[i], arm[i] * w[i], w[i] / 2
            if j is not None:
                slide, rolled, spin = slide - v[j], rolled + arm[j] * w[j], spin + w[j] / 2
            across = slide - (slide @ n) * n
            sheared[k] = -scene.contact.ks * (across - np.cross(rolled, n))
            sheared[k] += (spin @ n) * np.cross(n, shear[k]) - (shear[k] @ across) / length * n
            force = -scene.contact.kn * gap * n + shear[k]
            for body, sign in ((i, 1.0), (j, -1.0)):
                if body is not None:
                    push[body] += sign * force
                    turn[body] += arm[body] * np.cross(force, n)
        rates = np.einsum("nab,nb->na", self.hold, push), self.hold_spin @ turn[..., None]
        return np.concatenate([v.ravel(), rates[0].ravel(), rates[1].ravel(), sheared.ravel()])


def reference(scene: Scene, times: Vector, kept: float = 0.0) -> Vector:
    """Displacements (times, n, 3) [m] at times from 0, by scipy from event to event.

    kept: the part of its shear force with which a contact that opened closes again.
    """
    law, s = Law(scene), scene.spheres
    shear = np.zeros((len(law.touches), 3))
    y = np.concatenate([0 * s.position, s.velocity, s.spin, shear]).ravel()
    shut = np.array([law.gap(touch, 0.0, y) < 0 for touch in law.touches], bool)
    t, found = 0.0, [y[: 3 * law.n]]
    while t < times[-1]:
        ends: list[Any] = [functools.partial(law.gap, touch) for touch in law.touches]
        for k, end in enumerate(ends):
            end.terminal, end.direction = True, 1.0 if shut[k] else -1.0
        part = solve_ivp(
            functools.partial(law.rate, np.flatnonzero(shut).tolist()), (t, times[-1]), y, "DOP853",
            events=ends, rtol=1e-9, atol=1e-12, max_step=times[-1] / 30, dense_output=True,
        )  # fmt: skip
        found += [part.sol(time)[: 3 * law.n] for time in times if t < time <= part.t[-1]]
        t, y = float(part.t[-1]), part.y[:, -1].copy()
        for k in (k for k, when in enumerate(part.t_events) if len(when)):
            shut[k] = not shut[k]
            y[9 * law.n + 3 * k :][:3] *= kept
    return np.array(found).reshape(len(times), law.n, 3)


def spheres(position: Sequence[Sequence[float] | Vector], **given: Any) -> Spheres:
    """Unlike spheres, at rest and free to move unless given otherwise."""
    n = len(position)
    data = {
        "velocity": np.zeros((n, 3)),
        "radius": np.array([0.3, 0.2, 0.25])[:n],
        "mass": np.array([1.0, 3.0, 2.0])[:n],
        "free": np.ones((n, 3), bool),
    }
    return Spheres(np.array(position), **{**data, **given})


def facing(*normal: float, at: Sequence[float]) -> Wall:
    n = np.array(normal)
    return Wall(np.array(at), n / np.linalg.norm(n))


def falling() -> Scene:
    """Three that touch nothing; the first and the last carry the same load."""
    load = np.array([[4.0, 0.0, 7.0], [-9.0, 2.0, 0.0], [4.0, 0.0, 7.0]])
    group = spheres([[0, 0, 0], [2, 1, 0], [-1, 3, 2]], load=load)
    return Scene((group,), STICKING, eta=2.0, gravity=np.array([1.0, -9.81, 3.0]))


def landing() -> Scene:
    """Two dropped into a corner, which meet each wall at a time of their own."""
    walls = facing(0, 1, 0, at=(0.7, -0.2, 5.0)), facing(0, 0, 1, at=(-3.0, 0.9, 0.1))
    group = spheres([[0, 0.13, 0.42], [2, 0.01, 0.34]])
    gravity = np.array([12.0, -20.0, -25.0])
    return Scene((walls[0], group, walls[1]), STICKING, 4.0, gravity)


def bouncing(on: str, speed: float = 0.5) -> Scene:
    """A ball that falls twice, on a sphere or on a wall, where it holds on as it touches.

    On a sphere and on an oblique wall it turns; on an aligned wall it moves in a plane.
    """
    n, flat = {
        "sphere": (np.array([0.0, 1.0, 0.0]), np.array([0.8, 0.0, 0.6])),
        "oblique": (
            np.array([1.0, 2.0, 0.0]) / np.sqrt(5),
            np.array([2.0, -1.0, 0.0]) / np.sqrt(5),
        ),
        "aligned": (np.array([0.0, 0.0, 1.0]), np.array([1.0, 0.0, 0.0])),
    }[on]
    turns = on != "aligned"
    foot = np.array([0.4, -0.1, 0.6])
    ball = spheres(
        [foot + 0.301 * n],
        velocity=[speed * flat - 0.6 * n],
        spin=[np.array([1.0, 0.5, -2.0]) * turns],
        free=[np.abs(flat) + np.abs(n) > 0 if on == "aligned" else [True] * 3],
        free_spin=[[turns] * 3],
        load=[-6.0 * n + 2.0 * flat],
    )
    fixed = spheres([foot - 0.3 * n], free=[[False] * 3])
    partner = fixed if on == "sphere" else Wall(foot, n)
    return Scene((partner, ball), STICKING, 0.0 if turns else 0.5, -25.0 * n)


def pressed(side: Sequence[float], first: bool) -> Scene:
    """A ball pushed against a larger fixed one, which lies on the other side of it."""
    n, free = np.array(side), np.abs([side]) > 0
    fixed = spheres([[0, 0, 0]], radius=[0.5], mass=[7.0], free=[[False] * 3])
    ball = spheres([0.81 * n], mass=[2.0], free=free, load=[-30.0 * n])
    bodies = (ball, fixed) if first else (fixed, ball)
    return Scene(bodies, STICKING, eta=3.0, gravity=5.0 * n)


def rolling(inertia: float = 0.4, lock: bool = False) -> Scene:
    """A ball in balance on a floor, 5 % of its radius deep, thrown and turning both ways.

    inertia: in m r2. lock: it cannot turn about x, and so not roll along z.
    """
    m, g, r = 1.0, 20.0, 0.02
    ball = spheres(
        [[0.3, r - m * g / STICKING.kn, -0.2]],
        radius=[r],
        velocity=[[0.5, 0, -0.3]],
        spin=[[0 if lock else 4, 0, 9]],
        inertia=[inertia * m * r**2],
        free_spin=[[not lock, True, True]],
    )
    return Scene((facing(0, 1, 0, at=(5, 0, -4)), ball), STICKING, gravity=np.array([0, -g, 0]))


def rolled(scene: Scene, times: Vector, depth: float) -> Vector:
    """The closed form (times, 1, 3) [m] of `rolling`; slip is seen `depth` overlaps deep.

    With the slip s = v + a w x n of a surface at the arm a, and m v' = q, I w' = -b n x q,
    q' = -ks s: s swings at W^2 = ks (1/m + a b/I), or ks/m where it cannot turn.
    """
    s, g = scene.spheres, scene.gravity
    m, r, ks = s.mass[0], s.radius[0], scene.contact.ks
    overlap = -m * g[1] / scene.contact.kn
    seen, arm, (vx, _, vz), (wx, _, wz) = (
        r - depth * overlap,
        r - overlap / 2,
        s.velocity[0],
        s.spin[0],
    )
    moved = np.zeros((len(times), 1, 3))
    for axis, v, w, turns in ((0, vx, wz, True), (2, vz, -wx, s.free_spin[0, 0])):
        square = ks * (1 / m + turns * seen * arm / s.inertia[0])
        swing = times - np.sin(np.sqrt(square) * times) / np.sqrt(square)
        moved[:, 0, axis] = v * times - ks / m * (v + seen * w) / square * swing
    return moved


@dataclass(frozen=True)
class Known:
    """A scene, how long it runs [s], and how far codes may be off, in parts of the largest.

    within: the in-house code, which sees a contact open within a step and drag at mid-step, and
    the others, which do neither.
    """

    scene: Scene
    duration: float
    within: tuple[float, float]
    dt: float = 5e-5

    def ask(self, scene: Scene) -> Ask:
        """All spheres' displacements, at ten times, in the scene or one that adds bodies to it."""
        goal = History(self.duration, self.duration / 10)
        kinds = [isinstance(g, Spheres) for g in self.scene.bodies for _ in range(len(g))]
        seen = tuple(Displacement(int(body)) for body in np.flatnonzero(kinds))
        return Ask(scene, goal, seen, Knobs(self.dt))


SCENES = {
    "falling": Known(falling(), 0.4, (1e-7, 1e-4), dt=1e-4),
    "landing": Known(landing(), 0.15, (5e-3, 5e-3)),
    "twice on a sphere": Known(bouncing("sphere"), 0.2, (4e-4, 4e-4)),
    "slowly on a sphere": Known(bouncing("sphere", 0.2), 0.1, (1e-3, 2e-3)),
    "twice on a wall": Known(bouncing("oblique"), 0.2, (4e-4, 4e-4)),
    "twice in a plane": Known(bouncing("aligned"), 0.2, (2e-3, 2e-3)),
    "below": Known(pressed([0, -1, 0], first=True), 0.2, (1e-5, 2e-4)),
    "left": Known(pressed([-1, 0, 0], first=False), 0.2, (1e-5, 2e-4)),
    "rolling": Known(rolling(), 0.05, (1e-5, 1e-5)),
    "rolling as given": Known(rolling(0.7), 0.05, (1e-5, 1e-5)),
    "rolling one way": Known(rolling(0.7, lock=True), 0.05, (1e-5, 1e-5)),
}
REFUSED = {("liggghts", "rolling as given"), ("liggghts", "rolling one way")}
CODES: dict[str, Adapter] = {
    "dem": adapters.dem.ADAPTER,
    "dem, general": adapters.dem.ADAPTER,
    "yade": adapters.yade.ADAPTER,
    "liggghts": adapters.liggghts.ADAPTER,
}
FAR = 1e3  # m


def crowded(scene: Scene) -> Scene:
    """The scene with a sphere, a wall and forces that do not matter: all need the same kernel."""
    walls = scene.walls or (facing(0, 0, 1, at=(0, 0, -10 * FAR)),)
    place = FAR * np.sum([wall.normal for wall in walls], axis=0)
    still, turning = np.zeros((1, 3), bool), np.array([[True, False, False]])
    bystander = spheres([place], free=still, free_spin=turning, load=[[1e-100, 0, 0]])
    bodies = (*scene.bodies, bystander, *(() if scene.walls else walls))
    gravity = np.where(scene.gravity.any(), scene.gravity, 1e-100)
    return dataclasses.replace(scene, bodies=bodies, eta=scene.eta or 1e-100, gravity=gravity)


def asked(code: str) -> dict[str, Ask]:
    """What a code is asked, by the scenes' names; dem plainly only where it has a small model."""
    if code == "dem, general":
        return {name: known.ask(crowded(known.scene)) for name, known in SCENES.items()}
    asks = {name: known.ask(known.scene) for name, known in SCENES.items()}
    if code == "dem":
        return {name: ask for name, ask in asks.items() if unknowns(ask) <= 2}
    return {name: ask for name, ask in asks.items() if (code, name) not in REFUSED}


def unknowns(ask: Ask) -> int:
    return adapters.dem.ADAPTER.describe(ask, "default").unknowns


def expected(code: str, name: str, times: Vector) -> Vector:
    """What the law says, as far as the code holds to it.

    YADE sees slip on an aligned wall in the wall's plane, not half an overlap above it. LIGGGHTS
    keeps the shear force of two spheres that part until it next looks for neighbours.
    """
    scene = SCENES[name].scene
    if name.startswith("rolling"):
        return rolled(scene, times, 1.0 if code == "yade" else 0.5)
    kept = (code, name) == ("liggghts", "slowly on a sphere")
    return solved(name, float(kept), tuple(times))


@functools.cache
def solved(name: str, kept: float, times: tuple[float, ...]) -> Vector:
    return reference(SCENES[name].scene, np.array(times), kept)


Runs = Mapping[str, Run]
Answers = Callable[[str], Runs]


@pytest.fixture(scope="module")
def answers(tmp_path_factory: pytest.TempPathFactory) -> Answers:
    """The runs of a code by the scenes' names, all from one call of its adapter."""

    @functools.cache
    def run(code: str) -> Runs:
        here, needed = CODES[code].found(), os.environ.get("VV_REQUIRE", "").split(",")
        if not here.installed and code not in needed:
            pytest.skip(f"{code} is not installed: {here.how_to_install}")
        asks, folder = asked(code), tmp_path_factory.mktemp("scenes")
        runs = CODES[code].run(list(asks.values()), "default", folder, 0.0)
        return dict(zip(asks, runs, strict=True))

    return run


CHOICES = [(code, name) for code in CODES for name in asked(code)]


@pytest.mark.parametrize(("code", "name"), CHOICES)
def test_a_code_does_what_the_law_says(code: str, name: str, answers: Answers) -> None:
    run = answers(code)[name]
    assert run.status is Status.RAN, run.reason
    exact = expected(code, name, run.times)
    error = np.abs(moved(run) - exact).max() / np.abs(exact).max()
    assert error < SCENES[name].within[not code.startswith("dem")]


@pytest.mark.parametrize(("code", "name"), [pair for pair in CHOICES if pair[0].startswith("dem")])
def test_the_ledger_holds_m_g_h_and_f_x(code: str, name: str, answers: Answers) -> None:
    ledger, s = answers(code)[name].ledger, SCENES[name].scene.spheres
    assert ledger is not None
    fallen = s.mass[:, None] * SCENES[name].scene.gravity * moved(answers(code)[name])[-1]
    loaded = s.load * moved(answers(code)[name])[-1]
    for term, work in (("gravity potential", fallen), ("load potential", loaded)):
        assert ledger.terms[term] == pytest.approx(-work.sum(), abs=1e-12 * np.abs(work).sum())


@pytest.mark.parametrize("name", [name for name in SCENES if name.startswith("rolling")])
def test_the_reference_rolls_as_the_closed_form_says(name: str) -> None:
    times = np.linspace(0.0, 0.05, 6)
    scene = SCENES[name].scene
    assert np.abs(reference(scene, times) - rolled(scene, times, 0.5)).max() < 1e-12


@pytest.mark.parametrize(("code", "name"), sorted(REFUSED))
def test_what_a_code_cannot_hold_it_refuses(code: str, name: str) -> None:
    known = SCENES[name]
    assert CODES[code].refuses(known.ask(known.scene), "default") is not None


def moved(run: Run) -> Vector:
    """Displacements (times, spheres, 3) [m]."""
    return np.stack(list(run.values.values()), axis=1)
