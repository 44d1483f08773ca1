"""Reads result.json, which result.schema.json describes: what a program says of its run."""

from __future__ import annotations

import json
import math
import sys
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from vv.ask import Ledger, Status
from vv.base.files import read_whole
from vv.base.hints import name_hint
from vv.codes.program.bad_answer import BadAnswerError, short
from vv.codes.program.declared import words_of
from vv.scene import Form, Loss, Term

RESULT = "result.json"
LONGEST = 1000  # characters of a reason or note, which tables and reports quote
STATUSES = {s.value: s for s in (Status.RAN, Status.REFUSED, Status.DIVERGED, Status.ERROR)}


@dataclass(frozen=True)
class Result:
    """What result.json says, each entry with the meaning that result.schema.json gives it."""

    status: Status = Status.RAN
    reason: str = ""
    solve_cpu: float | None = None
    steps: int | None = None
    unknowns: int | None = None
    terms: frozenset[Term] | None = None
    note: str = ""
    energies: Ledger | None = None


def read_result(file: Path) -> Result:
    """What result.json says; without one, that the program ran. Raises BadAnswerError."""
    if not file.is_file():
        return Result()
    try:
        data = json.loads(read_whole(file).decode(errors="replace"))
    except OSError as error:
        raise BadAnswerError(f"{RESULT}: {error.strerror}") from error
    except (ValueError, RecursionError) as error:
        raise BadAnswerError(f"{RESULT}: {short(str(error))}") from error
    if not isinstance(data, dict):
        raise BadAnswerError(f"{RESULT} holds {short(repr(data))}; it must be an object")
    for name in data.keys() - READERS.keys():
        hint = name_hint(name, READERS)
        raise BadAnswerError(f"{RESULT}: there is no entry {short(repr(name))}{hint}")
    return Result(**{name: READERS[name](Value(name, one)) for name, one in data.items()})


@dataclass(frozen=True)
class Value:
    """A value of result.json and the name by which messages call it."""

    name: str
    value: Any

    def refuse(self, rule: str) -> BadAnswerError:
        """The error that names the entry, its value and the rule."""
        return BadAnswerError(f"{RESULT}: {self.name} = {short(repr(self.value))}; {rule}")

    def text(self) -> str:
        """A text, whose beginning is enough where it has no end."""
        if not isinstance(self.value, str):
            raise self.refuse("it must be a text")
        return self.value if len(self.value) <= LONGEST else f"{self.value[:LONGEST]}..."

    def number(self) -> float:
        """A finite number."""
        if not _is_number(self.value):
            raise self.refuse("it must be a finite number")
        return float(self.value)

    def size(self) -> float:
        """A finite number that is not negative."""
        if not (_is_number(self.value) and self.value >= 0):
            raise self.refuse("it must be a finite number, zero or more")
        return float(self.value)

    def count(self) -> int:
        """A whole number that is not negative."""
        if not (type(self.value) is int and 0 <= self.value < 1 << 53):
            raise self.refuse("it must be a whole number, zero or more")
        return int(self.value)

    def members(self) -> Mapping[str, Value]:
        """The entries of an object."""
        if not isinstance(self.value, dict):
            raise self.refuse("it must be an object")
        return {key: Value(f"{self.name}.{key}", one) for key, one in self.value.items()}


def _is_number(value: object) -> bool:
    """Whether a value is a finite number that a float can hold; true and false are none."""
    if type(value) is int:
        return abs(value) <= sys.float_info.max
    return type(value) is float and math.isfinite(value)


def _status(given: Value) -> Status:
    if not isinstance(given.value, str) or given.value not in STATUSES:
        raise given.refuse(f"it must be one of {', '.join(STATUSES)}")
    return STATUSES[given.value]


def _terms(given: Value) -> frozenset[Term]:
    known = words_of(Term)
    if not isinstance(given.value, list):
        raise given.refuse("it must be a list of texts")
    for number, word in enumerate(given.value):
        if not isinstance(word, str) or word not in known:
            one = Value(f"{given.name}[{number}]", word)
            raise one.refuse(f"unknown{name_hint(str(word), known)}")
    return frozenset(known[word] for word in given.value)


def _ledger(given: Value) -> Ledger:
    """A balance: forms of energy at the end, the largest remainder, the largest energy, a bound."""
    parts = given.members()
    if not {"forms", "unaccounted", "peak"} <= parts.keys() <= {*ENERGIES}:
        raise given.refuse(f"its entries are {', '.join(ENERGIES)}; only bound may be left out")
    names = {word: one.value for kind in (Form, Loss) for word, one in words_of(kind).items()}
    forms = {names.get(key, key): one.number() for key, one in parts["forms"].members().items()}
    bound = parts["bound"].size() if "bound" in parts else None
    return Ledger(forms, parts["unaccounted"].size(), parts["peak"].size(), bound)


ENERGIES = ("forms", "unaccounted", "peak", "bound")
READERS: Mapping[str, Any] = {
    "status": _status,
    "reason": Value.text,
    "solve_cpu": Value.size,
    "steps": Value.count,
    "unknowns": Value.count,
    "terms": _terms,
    "note": Value.text,
    "energies": _ledger,
}
