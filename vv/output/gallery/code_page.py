"""The page of a code: its schemes, what they claim and support, which cases they run."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass

from vv.codes.adapter import Adapter, Scheme
from vv.output.gallery.case_page import Answers
from vv.output.gallery.markup import cell, code, table
from vv.scene import Term


@dataclass(frozen=True)
class CodePage:
    """What a page is made of. answers: case -> which schemes run its variants, as accepted.

    known: (case, variants, reason) of what the code is known to do otherwise.
    """

    adapter: Adapter
    answers: Mapping[str, Answers]
    known: Sequence[tuple[str, str, str]]

    def text(self) -> str:
        """The page, as Markdown."""
        return "\n".join([*self._head(), *self._schemes(), *self._cases(), *self._known(), ""])

    def _head(self) -> Iterator[str]:
        name = self.adapter.name
        yield from (f"# {name}", "", "```")
        yield f"vv run single-contact --codes {name}"
        yield from (f"vv list --code {name}", "```")

    def _schemes(self) -> Iterator[str]:
        yield from ("", "## Schemes", "")
        rows = [
            (code(s.name), cell(s.summary), _claim(s), ", ".join(s.knobs) or "none")
            for s in self.adapter.schemes
        ]
        yield from table(("scheme", "what it is", "class of method", "knobs"), rows)
        for scheme in self.adapter.schemes:
            lacks = sorted(term.value for term in Term if term not in scheme.terms)
            text = ", ".join(lacks) or "nothing that scenes have"
            yield from ("", f"`{scheme.name}` does not support: {text}.")

    def _cases(self) -> Iterator[str]:
        yield from ("", "## Cases that it runs", "")
        rows = []
        for case, answers in self.answers.items():
            own = {s: a for s, a in answers.items() if s.startswith(f"{self.adapter.name}/")}
            every = {variant for row in answers.values() for variant in row}
            runs = {
                v for row in own.values() for v, answer in row.items() if isinstance(answer, int)
            }
            if runs:
                rows.append((f"[{case}](../cases/{case}.md)", f"{len(runs)} of {len(every)}"))
        yield from table(("case", "variants"), rows)

    def _known(self) -> Iterator[str]:
        if not self.known:
            return
        yield from ("", "## Known disagreements", "")
        yield "What it is known to do otherwise; the gate watches that it stays so."
        yield ""
        for case, variants, reason in self.known:
            yield f"- [{case}](../cases/{case}.md) {cell(variants)}: {cell(reason)}"


def _claim(scheme: Scheme) -> str:
    lowered = [f"{m.value} with {t.value}" for t, m in scheme.lowered.items()]
    return "; ".join([scheme.method.value, *lowered])
