"""Writes the summary of the gate for a pull request, and annotations for GitHub."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path

from vv.base.files import write_output
from vv.base.printable import one_line, printable
from vv.gate.judgement import counted
from vv.output.wording import listed
from vv.records.finding import Bit, Finding, bits, worst_first
from vv.records.manifest import Manifest

ROWS = 15  # the most rows of a table; the report has the rest
WORDS = {
    Bit.ACCURACY: "accuracy or regression",
    Bit.CONSERVATION: "conservation",
    Bit.SPEED: "speed",
    Bit.CRASH: "crash or divergence",
    Bit.TIMEOUT: "timeout",
    Bit.INCOMPLETE: "incomplete",
}


def headline(findings: Sequence[Finding]) -> str:
    """The overall result of the gate in a sentence."""
    wrong = bits(findings)
    if not wrong:
        return "green"
    return f"red ({int(wrong)}): {', '.join(WORDS[bit] for bit in WORDS if bit & wrong)}"


def write_markdown(path: Path, manifest: Manifest, findings: Sequence[Finding]) -> None:
    """Write the summary."""
    write_output(path, summary(manifest, findings).encode())


def summary(manifest: Manifest, findings: Sequence[Finding]) -> str:
    """The summary as Markdown: colour, counts, what is red, what changed, what is worth knowing."""
    where = manifest.provenance
    commit = f"commit `{_cell(where.commit[:9])}`{' with changes' if where.dirty else ''}, "
    lines = [
        f"### Verification: {headline(findings)}",
        "",
        f"{listed(counted(manifest.records))}. {commit if where.commit else ''}{_cell(where.utc)}.",
    ]
    ranked = worst_first(findings)
    moved = [f for f in ranked if f.compares]
    since = [f for f in moved if f.red or f.size]
    others = [f for f in ranked if f not in moved and f.bit]
    lines += _table("Changed since the baseline", since)
    lines += _table("Out of tolerance, stopped or missing", others)
    notices = [f for f in ranked if f not in since and f not in others]
    lines += _list([*_counted_notices(notices), *_asked(since), *_recorded(manifest)])
    return "\n".join(map(one_line, lines)) + "\n"


def _table(title: str, findings: Sequence[Finding]) -> list[str]:
    if not findings:
        return []
    rows = [
        f"| {'**' + f.kind + '**' if f.red else f.kind} | {_cell(f.where)} | {_cell(f.text)} |"
        for f in findings[:ROWS]
    ]
    more = len(findings) - ROWS
    tail = [f"| | | and {more} more: see the report |"] if more > 0 else []
    return ["", f"**{title}** ({len(findings)})", "", "| | where | what |", "|-|-|-|", *rows, *tail]


def _cell(text: str) -> str:
    """A text in which markup, pictures and links are escaped."""
    whole = " ".join(one_line(text).split()).replace("&", "&amp;")
    return whole.replace("|", "\\|").replace("<", "&lt;").replace("[", "\\[")


def _counted_notices(findings: Sequence[Finding]) -> list[str]:
    """The notices, merged if they say the same of one case."""
    piles: dict[tuple[str, str, str], int] = {}
    for f in findings:
        piles[f.case, f.kind, f.text] = piles.get((f.case, f.kind, f.text), 0) + 1
    return [
        f"{case}: {text}" + (f" ({count} times)" if count > 1 else "")
        for (case, _, text), count in piles.items()
    ]


def _asked(findings: Iterable[Finding]) -> list[str]:
    """The commands that accept results which became better."""
    better = sorted({f.case for f in findings if f.improves})
    return [f'{case} became better: `vv accept {case} --reason "..."` keeps it' for case in better]


def _recorded(manifest: Manifest) -> list[str]:
    """Notes on codes that are not installed: their recorded results do not count."""
    ages: dict[tuple[str, str], int] = {}
    for shown in manifest.recorded:
        ages[shown.code, shown.version] = shown.days
    return [
        f"{code} is not installed: the report shows results of {version} recorded {days} days "
        "ago, which do not affect the verdict here"
        for (code, version), days in ages.items()
    ]


def _list(items: Sequence[str]) -> list[str]:
    more = [f"- and {len(items) - ROWS} more"] if len(items) > ROWS else []
    return ["", *(f"- {_cell(item)}" for item in items[:ROWS]), *more] if items else []


def workflow_commands(findings: Iterable[Finding], files: Mapping[str, str]) -> list[str]:
    """Lines that GitHub shows as annotations; it accepts at most ten of each level.

    files: case -> its file, from the root of the repository.
    """
    lines: dict[str, list[str]] = {"error": [], "warning": []}
    for f in worst_first(findings):
        level = "error" if f.red else "warning"
        place = f"file={_escaped(files[f.case], True)}," if f.case in files else ""
        title = _escaped(f"{f.check.value} {f.kind}: {f.where}".strip(), True)
        lines[level].append(f"::{level} {place}title={title}::{_escaped(f.text)}")
    return [line for level in lines.values() for line in level[:10]]


def _escaped(text: str, in_property: bool = False) -> str:
    """Text with the escapes of a workflow command."""
    text = printable(text.replace("\r\n", "\n"))
    pairs = [("%", "%25"), ("\r", "%0D"), ("\n", "%0A")]
    for old, new in [*pairs, *([(":", "%3A"), (",", "%2C")] if in_property else [])]:
        text = text.replace(old, new)
    return text
