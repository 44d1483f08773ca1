"""Estimates which share of all mechanical mutants survives, from a sample of each part.

`python -m bench.mutation.all_parts` reads the figures that the last samples of `engine_mutants`,
`framework_mutants` (of the framework and, by `--part references`, of the reference solutions) and
`case_mutants` have left in .vv/, and weights each by the number of mutants of its part.
"""

import json
from collections.abc import Iterable, Iterator
from pathlib import Path
from typing import Any, NamedTuple

from bench.evidence import conclude
from bench.mutation import case_mutants
from bench.mutation.framework_sites import EVERY, PARTS, uniform
from bench.mutation.mutants import ROOT, all_places

NORMAL = 1.96  # standard deviations of 95 %


class Sample(NamedTuple):
    """A sample of a part: the mutants in the part, those drawn, those that survived."""

    part: int
    drawn: int
    left: int


def share(samples: Iterable[Sample]) -> tuple[float, float, float]:
    """The surviving share of all mutants, and its interval of confidence of 95 %.

    The interval adds the variances of the parts, each with two survivors and two others more than
    were counted, so that a sample without survivors is not taken for certain (Agresti and Coull
    1998).
    """
    every = [*samples]
    total = sum(one.part for one in every)
    rate = sum(one.part / total * one.left / one.drawn for one in every)
    centre = variance = 0.0
    for one in every:
        weight, shrunk = one.part / total, (one.left + 2) / (one.drawn + 4)
        centre += weight * shrunk
        variance += weight**2 * shrunk * (1 - shrunk) / (one.drawn + 4)
    half = NORMAL * variance**0.5
    return rate, max(centre - half, 0.0), min(centre + half, 1.0)


def sizes() -> Iterator[tuple[str, int]]:
    """The name of each bench's figures, and the number of mutants of its part."""
    engines = (path.relative_to(ROOT).as_posix() for path in (ROOT / "vv/engines").rglob("*.py"))
    yield "engine_mutants", sum(1 for _ in all_places(engines))
    yield "case_mutants", len(case_mutants.drawn("*", EVERY, 0))
    for part in PARTS:
        yield f"{part}_mutants", len(uniform("*", EVERY, 0, part))


def told(name: str) -> dict[str, Any]:
    """The figures that a bench left."""
    found: dict[str, Any] = json.loads(Path(f".vv/bench-{name}.json").read_text())["figures"]
    return found


def main() -> None:
    """Read, weight and judge."""
    figures = {name: (size, told(name)) for name, size in sizes()}
    samples = [Sample(size, one["mutants"], len(one["not seen"])) for size, one in figures.values()]
    rate, low, high = share(samples)
    parts = {name: {"of": size, **one} for name, (size, one) in figures.items()}
    conclude(
        "all_parts",
        {"rate": rate, "at 95 %": [low, high], "parts": parts},
        {"5 % at most": rate <= 0.05},
    )


if __name__ == "__main__":
    main()
