"""Writes an ask as ask.json, which ask.schema.json describes: the input of any program."""

from __future__ import annotations

import dataclasses
import json
import math
from collections.abc import Iterable
from typing import Any

import numpy as np

from vv.ask import Ask, Observable
from vv.scene import Block, Bonds, Contact, Form, Harmonic, Pulse, Scene, Spheres, Wall

FORMAT = "vv ask 1"
DIRECTIONS = "xyz"
WIDTH = 100  # columns, beyond which an object is broken into lines
Json = dict[str, Any]


def text(ask: Ask, scheme: str, knobs: Iterable[str]) -> str:
    """The text of ask.json for a scheme with these knobs."""
    return _lines(data(ask, scheme, knobs)) + "\n"


def data(ask: Ask, scheme: str, knobs: Iterable[str]) -> Json:
    """An ask as plain data in SI units, numbers that are infinite as None."""
    dt, goal = ask.knobs.dt, ask.goal
    terms = sorted(term.name.lower().replace("_", "-") for term in ask.scene.terms())
    return {
        "format": FORMAT,
        "scheme": scheme,
        "scene": _scene(ask.scene),
        "terms": terms,
        "knobs": {name: getattr(ask.knobs, name) for name in sorted(knobs)},
        "duration": goal.duration,
        "interval": goal.interval,
        "steps": None if dt is None else goal.steps(dt),
        "stride": None if dt is None else goal.stride(dt),
        "times": goal.times(dt).tolist(),
        "observables": [
            {"kind": kind(what), "body": what.body, "columns": columns(what)}
            for what in ask.observables
        ],
        "energies": [
            {"form": form.name.lower().replace("_", "-"), "column": energy_column(form)}
            for form in ask.energies
        ],
        "columns": ["t", *all_columns(ask)],
    }


def kind(what: Observable) -> str:
    """The word for the kind of an observable."""
    return type(what).__name__.lower()


def columns(what: Observable) -> list[str]:
    """The names of an observable's three columns in series.csv, such as velocity_1_x."""
    return [f"{kind(what)}_{what.body}_{axis}" for axis in DIRECTIONS]


def energy_column(form: Form) -> str:
    """The name of the column of a form of energy in series.csv."""
    return f"energy_{form.name.lower()}"


def all_columns(ask: Ask) -> list[str]:
    """The columns of series.csv that an ask wants beside t."""
    seen = [column for what in ask.observables for column in columns(what)]
    return [*seen, *map(energy_column, ask.energies)]


def _scene(scene: Scene) -> Json:
    return {
        "contact": _contact(scene.contact),
        "drag": scene.eta,
        "gravity": scene.gravity.tolist(),
        "axes": scene.axes.tolist(),
        "shaking": _shaking(scene),
        "spheres": _spheres(scene),
        "walls": [_wall(body, scene) for body in scene.body_numbers(Wall)],
        "blocks": [
            _block(body, block)
            for body, block in zip(scene.body_numbers(Block), scene.blocks, strict=True)
        ],
        "bonds": _bonds(scene.bonds),
        **({} if scene.fluid is None else {"fluid": dataclasses.asdict(scene.fluid)}),
    }


def _shaking(scene: Scene) -> Json | None:
    """The sines, and when they end if they do."""
    sines = _harmonic(scene.wave)
    ends = {"until": scene.shaking.until} if isinstance(scene.shaking, Pulse) else {}
    return None if sines is None else {**sines, **ends}


def _contact(law: Contact) -> Json:
    springs = {"kn": _finite(law.kn), "ks": law.ks, "mu": law.mu, "eta_n": law.eta_n}
    return springs if law.hertz is None else {**springs, "hertz": dataclasses.asdict(law.hertz)}


def _spheres(scene: Scene) -> Json:
    group = scene.spheres
    return {
        "body": scene.body_numbers(Spheres),
        **{
            name: getattr(group, name).tolist()
            for name in ("position", "velocity", "spin", "load", "radius", "mass", "inertia")
        },
        "free": group.free.astype(int).tolist(),
        "free_spin": group.free_spin.astype(int).tolist(),
    }


def _wall(body: int, scene: Scene) -> Json:
    wall = scene.walls[scene.body_numbers(Wall).index(body)]
    return {
        "body": body,
        "point": wall.point.tolist(),
        "normal": wall.normal.tolist(),
        "motion": _harmonic(wall.motion),
    }


def _block(body: int, block: Block) -> Json:
    law = block.elastic
    return {
        "body": body,
        "name": block.name,
        "vertices": block.vertices.tolist(),
        "faces": [list(face) for face in block.faces],
        "centroid": block.centroid().tolist(),
        "mass": float(block.mass),
        "inertia": block.inertia.tolist(),
        "velocity": block.velocity.tolist(),
        "spin": block.spin.tolist(),
        "load": block.load.tolist(),
        "free": block.free.astype(int).tolist(),
        "free_spin": block.free_spin.astype(int).tolist(),
        "elastic": None if law is None else dataclasses.asdict(law),
    }


def _harmonic(motion: Harmonic | None) -> Json | None:
    if motion is None:
        return None
    names = ("amplitude", "frequency", "phase", "axes")
    return {name: getattr(motion, name).tolist() for name in names}


def _bonds(bonds: Bonds | None) -> Json | None:
    if bonds is None:
        return None
    names = ("length", "kn", "ks", "tension", "shear")
    rows = {name: [*map(_finite, getattr(bonds, name).tolist())] for name in names}
    return {"pairs": np.asarray(bonds.pairs).tolist(), **rows}


def _finite(value: float) -> float | None:
    """The value, or None for one that is infinite, which JSON cannot say."""
    return float(value) if math.isfinite(value) else None


def _lines(value: Any, margin: str = "") -> str:
    """JSON with the entries of objects that are long on lines of their own."""
    line = json.dumps(value, allow_nan=False)
    if not isinstance(value, dict) or len(margin) + len(line) <= WIDTH:
        return line
    inner = (f'{margin}  "{key}": {_lines(one, margin + "  ")}' for key, one in value.items())
    return "{\n" + ",\n".join(inner) + f"\n{margin}}}"
