"""Numbers and names as the report writes them."""

from __future__ import annotations

import functools
import hashlib
import math
import re
from collections.abc import Iterable, Mapping
from typing import TypeVar

from markupsafe import Markup, escape

Same = TypeVar("Same")

NONE = "\N{EN DASH}"  # the text for a missing number
SUPERSCRIPTS = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")
SMALL_NUMBER = re.compile(r"\d[\d.]*e-\d+")
PADDED = re.compile(r"(?<=\d)e([+-])0*(\d+)")  # an exponent as programs write it
LONGEST = 80  # characters of an identifier
PLAIN = re.compile(r"[A-Za-z0-9./-]+")


def sci(value: float | None, digits: int = 2) -> str:
    """A number in scientific notation with `digits` after the point, 2.23e-5; – for None."""
    if value is None or not math.isfinite(value):
        return NONE
    if value == 0:
        return "0"
    mantissa, _, exponent = f"{value:.{digits}e}".partition("e")
    return f"{mantissa}e{int(exponent)}"


def short(value: float | None) -> str:
    """A number to three digits: 6.43, 0.113, 1.54e-3; – for None."""
    if value is None or not math.isfinite(value):
        return NONE
    return f"{value:.3g}" if 1e-2 <= abs(value) < 1e3 else sci(value)


def brief(value: float | None) -> str:
    """A number with as few characters as six digits need: 0.4, 5.5e9, 1e-5; – for None."""
    if value is None or not math.isfinite(value):
        return NONE
    if value == 0 or 1e-2 <= abs(value) < 1e5:
        return f"{value:.6g}"
    mantissa, _, exponent = f"{value:.5e}".partition("e")
    return f"{mantissa.rstrip('0').rstrip('.')}e{int(exponent)}"


def ratio(value: float | None) -> str:
    """A ratio to two digits: 1.8, 140, 3e5; – for None."""
    if value is None or not math.isfinite(value):
        return NONE
    return f"{value:.2g}" if value < 10 else f"{value:.0f}" if value < 1e4 else sci(value, 0)


def seconds(value: float | None) -> str:
    """A duration in a suitable unit: 91.6 ms, 2.03 s, 12 min; – for None."""
    if value is None or not math.isfinite(value):
        return NONE
    for below, scale, unit in ((1e-3, 1e6, "µs"), (1.0, 1e3, "ms"), (120.0, 1.0, "s")):
        if abs(value) < below:
            return f"{scale * value:.3g} {unit}"
    return f"{value / 60:.3g} min"


def power(exponent: int) -> str:
    """A power of ten for an axis, as plain text: 10⁻³."""
    return f"10{str(exponent).translate(SUPERSCRIPTS)}"


def sort_key(value: float | None) -> str:
    """A number as tables sort by it; empty for None."""
    return "" if value is None else f"{value:.3g}"


def with_unit(value: str, unit: str) -> str:
    """A number as text with its unit; words have none."""
    return f"{value} {unit}" if value and unit and value[-1].isdigit() else value


def within(content: str) -> Markup:
    """A text escaped for use between tags; quotes stay, so that it is unfit for attributes."""
    return Markup(content.replace("&", "&amp;").replace("<", "&lt;"))


def unbroken(content: str) -> Markup:
    """A text whose numbers are written as in tables: 6.8e-5 for 6.8e-05, 1e9 for 1e+09.

    No line breaks at the hyphen of an exponent.
    """
    plain = PADDED.sub(lambda found: f"e{found[1].replace('+', '')}{found[2]}", content)
    return Markup(SMALL_NUMBER.sub(r'<span class="n">\g<0></span>', str(escape(plain))))


@functools.cache
def slug(*names: str) -> str:
    """An identifier for anchors and file names; different names give different identifiers."""
    return "--".join(map(_plain, names))


def _plain(name: str) -> str:
    """The name itself if it is plain, else its plain characters and a digest."""
    if PLAIN.fullmatch(name) and len(name) <= LONGEST and "--" not in name:
        return name.replace("/", "~")
    kept = re.sub(r"[^A-Za-z0-9]+", "-", name)[:40].strip("-")
    return f"{kept}_{hashlib.sha256(name.encode('utf-8', 'surrogatepass')).hexdigest()[:8]}"


def known_columns(names: Iterable[str], rows: Iterable[Mapping[str, float | None]]) -> list[str]:
    """The names, in order, for which some row has a number; a table omits other columns."""
    known = {name for row in rows for name, value in row.items() if value is not None}
    return [name for name in names if name in known]


def alike(table: Mapping[str, Same]) -> list[tuple[list[str], Same]]:
    """The (names, value) for each distinct value, with all names that have it."""
    found: list[tuple[list[str], Same]] = []
    for name, value in table.items():
        names = next((names for names, known in found if known == value), None)
        if names is None:
            found.append(([name], value))
        else:
            names.append(name)
    return found


def listed(words: list[str]) -> str:
    """Words as a list in a sentence: 'a, b and c'."""
    return " and ".join([", ".join(words[:-1]), words[-1]]) if len(words) > 1 else "".join(words)
