"""The page of a case: drawings, source, variants, formulas, tolerances, schemes."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass

from vv.case import Case
from vv.output.gallery.markup import cell, code, listed_codes, table
from vv.output.wording import scaled
from vv.records.case_facts import CaseFacts, QuantityFacts, VariantFacts

Answers = Mapping[str, Mapping[str, int | str]]  # scheme -> variant -> unknowns, or why not


@dataclass(frozen=True)
class CasePage:
    """The data of a page.

    facts: of the variants that are described in full. drawings: variant -> file of its drawing,
    beside the page. answers: which schemes run it, as accepted with its results. numbers: the file
    of all numbers that its variants declare, beside the page.
    """

    case: Case
    family: str
    facts: CaseFacts
    drawings: Mapping[str, str]
    answers: Answers
    numbers: str

    def text(self) -> str:
        """The page, as Markdown."""
        return "\n".join([*self._head(), *self._variants(), *self._sections(), ""])

    def _head(self) -> Iterator[str]:
        case, source = self.case, self.case.source
        link = f" [doi:{source.doi}](https://doi.org/{source.doi})" if source.doi else ""
        yield from (f"# {case.name}", "", f"{cell(case.title)}. Family `{self.family}`.", "")
        yield f"Source: {cell(source.citation)}.{link}"
        if source.note:
            yield from ("", cell(source.note))
        for where, what in case.published.items():
            yield from ("", f"Published, {cell(where)}: {cell(what)}")

    def _variants(self) -> Iterator[str]:
        yield from ("", f"## {len(self.case.variants)} variants", "")
        rows = [(code(v.name), v.level.value, cell(v.summary)) for v in self.case.variants]
        yield from table(("variant", "from level", "what it is"), rows)
        yield from ("", "Run one of them, or all:", "", "```")
        yield f"vv run {self.case.name}:{self.case.variants[0].name}"
        yield from (f"vv run {self.case.name}", "```", "")
        yield f"[All numbers]({self.numbers}) that the variants declare are on a page of their own."

    def _sections(self) -> Iterator[str]:
        for names in alike(self.facts.variants):
            first = self.facts.variants[names[0]]
            yield from ("", f"## {', '.join(names)}", "")
            shown = next((self.drawings[name] for name in names if name in self.drawings), "")
            if shown:
                yield from (f"![the scene of {names[0]}]({shown})", "")
            yield from ("```", first.formula, "```", "")
            yield from self._parameters(names[0], first)
            yield from ("", f"In the scene: {', '.join(first.terms)}. Unknowns: {first.unknowns}.")
            for quantity in first.quantities:
                yield from _judged(quantity)
            yield from self._schemes(names)

    def _parameters(self, name: str, facts: VariantFacts) -> Iterator[str]:
        values = self.case.defaults(name)
        rows = [
            (
                code(p.name),
                f"{values[p.name]:g} {p.unit}".strip(),
                cell(p.meaning) + (" (inert)" if p.name in facts.inert else ""),
            )
            for p in self.case.parameters
        ]
        if rows:
            yield from table(("parameter", "value", "meaning"), rows)

    def _schemes(self, names: Sequence[str]) -> Iterator[str]:
        """Which schemes run the first of these variants, and why the others do not."""
        given = {s: row[names[0]] for s, row in self.answers.items() if names[0] in row}
        runs = [scheme for scheme, answer in given.items() if isinstance(answer, int)]
        if not given:
            return
        yield from ("", f"Run by: {listed_codes(runs) or 'no scheme'}.")
        reasons: dict[str, list[str]] = {}
        for scheme, answer in given.items():
            if isinstance(answer, str):
                reasons.setdefault(_without(scheme, answer), []).append(scheme)
        if reasons:
            yield from ("", "Not supported:", "")
        for reason, schemes in reasons.items():
            yield f"- {listed_codes(schemes)}: {cell(reason)}"


def _without(scheme: str, reason: str) -> str:
    """A reason without the scheme's name, so that schemes with one reason can be merged."""
    return reason.removeprefix(f"{scheme} does not support: ")


def alike(variants: Mapping[str, VariantFacts]) -> Iterable[list[str]]:
    """Names of the variants that differ only in the scene's position or in parameters."""
    piles: dict[object, list[str]] = {}
    for name, facts in variants.items():
        key = (facts.formula, facts.inert, facts.unknowns, repr(facts.quantities))
        piles.setdefault(key, []).append(name)
    return piles.values()


def _judged(quantity: QuantityFacts) -> Iterator[str]:
    unit = f" [{quantity.unit}]" if quantity.unit else ""
    yield ""
    yield f"**{quantity.name}**{unit}: {cell(quantity.meaning)}."
    if quantity.tolerances is None:
        yield f"{quantity.judge.value.capitalize()}: {cell(quantity.reason or '')}."
        return
    rows = []
    for method, one in quantity.tolerances.items():
        rows.append((method, scaled(one), cell(one.reason)))
    shown = sorted((quantity.shown or {}).items())
    rows += [(method, "shown only", cell(why)) for method, why in shown]
    yield f"Error: {cell(quantity.norm or '')}."
    yield from ("", *table(("class of method", "tolerance", "why"), rows))
