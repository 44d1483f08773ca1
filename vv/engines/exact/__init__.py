"""Exact engine: solves small scenes with constant contact normals exactly, event by event.

May import: base, scene, ask, standins, engines.kernels.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, Protocol

from vv.ask import Ask, Displacement, Ledger, Model, Run, Status
from vv.engines.exact.bonds import assemble_bonded, assemble_linearised
from vv.engines.exact.flow import SystemFlow, follow
from vv.engines.exact.ledger import ledger
from vv.engines.exact.line.flow import LineFlow
from vv.engines.exact.line.model import line_of
from vv.engines.exact.modelled import BONDS, RIGID, TERMS
from vv.engines.exact.path import Path
from vv.engines.exact.reachability import RefusedError
from vv.engines.exact.slide.flow import SliderFlow, lift_off
from vv.engines.exact.slide.ledger import slide_ledger
from vv.engines.exact.slide.path import Slide
from vv.engines.exact.slide.system import (
    Slider,
    TurningSlider,
    assemble_slider,
    describe_slider,
)
from vv.engines.exact.steps.flow import Steps
from vv.engines.exact.stopped import StoppedError
from vv.engines.exact.system import System, assemble, describe
from vv.engines.exact.turn.flow import TurningFlow
from vv.engines.exact.turn.ledger import turn_ledger
from vv.engines.exact.turn.path import Turn
from vv.scene import Scene
from vv.standins.penalty_springs import as_spheres

__all__ = [
    "BONDS",
    "RIGID",
    "TERMS",
    "Path",
    "Prepare",
    "RefusedError",
    "Slide",
    "Slider",
    "Steps",
    "StoppedError",
    "System",
    "Turn",
    "TurningSlider",
    "answer",
    "assemble",
    "assemble_bonded",
    "assemble_slider",
    "duration",
    "follow",
    "model",
    "move",
    "prepare",
    "prepare_linearised",
    "prepare_steps",
    "ready",
    "refusal",
    "solve",
    "solve_linearised",
    "solve_second_order",
    "steps_refused",
]

Problem = System | Slider | TurningSlider
Motion = Path | Slide | Turn
Prepare = Callable[[Ask], Problem]


class Flow(Protocol):
    """Computes a motion from event to event."""

    def warm(self) -> None:
        """Load or compile the kernel."""

    def follow(self) -> Any:
        """Run the kernel, which is what is timed.

        Raises StoppedError if the motion stops early, RefusedError if it takes too many steps.
        """

    def path(self, outcome: Any, /) -> Motion:
        """The motion, made from the outcome of `follow`."""


def prepare(ask: Ask) -> Problem:
    """The equations of an ask with bonds, spring contact or rigid contact; raises RefusedError."""
    problem: Problem
    if ask.scene.bonds is not None:
        problem = assemble_bonded(ask.scene)
    else:
        problem = _slider_held_on_wall(ask) if ask.scene.contact.rigid else assemble(ask.scene)
    _check_observed(ask)
    return problem


def prepare_linearised(ask: Ask) -> Problem:
    """The equations of an ask with bonds, to first order in displacements; raises RefusedError."""
    problem = assemble_linearised(ask.scene)
    _check_observed(ask)
    return problem


def prepare_steps(ask: Ask) -> Steps:
    """An ask about one body on a rigid wall, ready for steps of its dt; raises RefusedError."""
    if ask.knobs.dt is None:
        raise RefusedError("Knobs.dt is None; steps need a length")
    if not ask.scene.contact.rigid:
        raise RefusedError(
            f"Contact.kn = {ask.scene.contact.kn!r} N/m; steps are for rigid contact"
        )
    slider = _slider_held_on_wall(ask)
    if isinstance(slider, Slider):
        raise RefusedError("the slip keeps its line; `default` solves it exactly")
    _check_observed(ask)
    return Steps(ask, slider, describe_slider(ask.scene, slider))


def steps_refused(ask: Ask) -> str | None:
    """Why an ask cannot be solved in steps, or None if it can."""
    try:
        prepare_steps(ask)
    except RefusedError as reason:
        return str(reason)
    return None


def refusal(ask: Ask, prepare: Prepare = prepare) -> str | None:
    """Why the engine cannot solve an ask exactly, or None if it can."""
    try:
        prepare(ask)
    except RefusedError as reason:
        return str(reason)
    return None


def ready(problem: Problem, duration: float) -> Flow:
    """The flow that computes the motion over a duration [s], as often as it is asked to."""
    if isinstance(problem, TurningSlider):
        return TurningFlow(problem, duration)
    if isinstance(problem, Slider):
        return SliderFlow(problem, duration)
    line = line_of(problem)
    return SystemFlow(problem, duration) if line is None else LineFlow(problem, line, duration)


def move(problem: Problem, duration: float) -> Motion:
    """The exact motion over a duration [s]; raises as `Flow.follow`."""
    flow = ready(problem, duration)
    return flow.path(flow.follow())


def model(scene: Scene, problem: Problem) -> Model:
    """The model built for a scene: its unknowns, terms and a note."""
    if isinstance(problem, System):
        return describe(scene, problem)
    return describe_slider(scene, problem)


def solve(ask: Ask, prepare: Prepare = prepare) -> Run:
    """The run of an ask, without its cost: refused, diverged, or exact to rounding errors."""
    try:
        problem = prepare(ask)
        try:
            path = move(problem, duration(ask))
        except StoppedError as reason:
            return Run(Status.DIVERGED, str(reason), model=model(ask.scene, problem))
    except RefusedError as reason:
        return Run(Status.REFUSED, str(reason))
    return answer(ask, path)


def solve_linearised(ask: Ask) -> Run:
    """The run of an ask about bonds, exact to first order in the displacements."""
    return solve(ask, prepare_linearised)


def solve_second_order(ask: Ask) -> Run:
    """The run of an ask in steps of second order, without its cost; may be refused."""
    try:
        steps = prepare_steps(ask)
    except RefusedError as reason:
        return Run(Status.REFUSED, str(reason))
    return steps.run(steps.solve())


def duration(ask: Ask) -> float:
    """The last output time of an ask [s]."""
    return float(ask.goal.times(ask.knobs.dt)[-1])


def answer(ask: Ask, path: Motion) -> Run:
    """The run of an ask, with its observables and ledger taken from an exact motion."""
    times = ask.goal.times(ask.knobs.dt)
    values = {}
    for observable in ask.observables:
        displacement, velocity = path.of(_index(ask.scene, observable.body), times)
        is_displacement = isinstance(observable, Displacement)
        values[observable] = displacement if is_displacement else velocity
    return Run(
        Status.RAN,
        times=times,
        values=values,
        steps=len(path),
        model=model(ask.scene, path.system if isinstance(path, Path) else path.slider),
        ledger=_ledger(path),
    )


def _ledger(path: Motion) -> Ledger:
    if isinstance(path, Turn):
        return turn_ledger(path)
    return slide_ledger(path) if isinstance(path, Slide) else ledger(path)


def _slider_held_on_wall(ask: Ask) -> Slider | TurningSlider:
    """The slider of a scene; raises RefusedError if its body leaves the wall before the end."""
    slider = assemble_slider(ask.scene)
    end = lift_off(slider, duration(ask))
    wall, body = slider.names
    if end is not None:
        raise RefusedError(
            f"body {body} lifts off body {wall} at t = {end:.6g} s; flight is not followed"
            if end > 0
            else f"body {body} is not pressed on body {wall} at t = 0"
        )
    return slider


def _check_observed(ask: Ask) -> None:
    for observable in ask.observables:
        _index(ask.scene, observable.body)


def _index(scene: Scene, body: int) -> int:
    """The sphere index of a body; raises RefusedError if the body is no sphere or block."""
    try:
        return (as_spheres(scene) if scene.contact.rigid else scene).sphere_index(body)
    except ValueError as reason:
        raise RefusedError(str(reason)) from None
