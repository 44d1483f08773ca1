"""Claims about the first page of the gallery: which case stands in which family, with what."""

from __future__ import annotations

from typing import Any

from tests.support.fabricated import some
from vv.output.gallery.index_page import index


def a_case(name: str, variants: int) -> Any:
    source = some(citation=f"{name} (2001)")
    return some(name=name, title=f"the {name}", variants=("v",) * variants, source=source)


def test_cases_stand_in_their_families_and_schemes_with_their_codes() -> None:
    cases = [a_case("slide", 2), a_case("bounce", 3), a_case("fall", 4)]
    families = {"slide": "motion", "bounce": "impact", "fall": "motion"}
    schemes = [some(name="x", summary="steps"), some(name="y", summary="solves")]
    adapters = [some(name="a", schemes=schemes), some(name="b", schemes=schemes[:1])]
    lines = [line for line in index(cases, families, adapters).splitlines() if line]
    head = ["| case | what it is | variants | source |", "|---|---|---|---|"]
    first = lines.index("## 3 cases with 9 variants")
    assert lines[first + 1 :] == [
        "### impact", *head,
        "| [bounce](cases/bounce.md) | the bounce | 3 | bounce (2001) |",
        "### motion", *head,
        "| [slide](cases/slide.md) | the slide | 2 | slide (2001) |",
        "| [fall](cases/fall.md) | the fall | 4 | fall (2001) |",
        "## 2 codes",
        "| code | scheme | what it is |", "|---|---|---|",
        "| [a](codes/a.md) | `x` | steps |",
        "| [a](codes/a.md) | `y` | solves |",
        "| [b](codes/b.md) | `x` | steps |",
    ]  # fmt: skip
