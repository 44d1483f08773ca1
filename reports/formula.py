"""Typesets the formulas that cases write as plain text: mathematics as MathML.

A case states its formula once, as people type it, so that terminal and page show the same. Words
stay words between the formulas, where lines may break.
"""

from __future__ import annotations

import re
from collections.abc import Iterator

from markupsafe import Markup, escape

LATIN = """
    alpha beta gamma delta eps zeta eta theta kappa lam mu nu xi pi rho sigma tau phi chi psi omega
"""
GREEK = dict(zip(LATIN.split(), "αβγδεζηθκλμνξπρστφχψω", strict=True))
FUNCTIONS = {"sin", "cos", "tan", "asin", "acos", "atan", "exp", "max", "min", "ceil", "ln", "dn"}
FUNCTIONS |= {"sign", "sum", "Im"}
SHORT_WORDS = {"in", "is", "at", "of", "by", "as", "to", "it", "or", "so", "no", "if", "up", "on"}
MINUS, PRIME = "\N{MINUS SIGN}", "\N{PRIME}"
SIGNS = {"<=": "≤", ">=": "≥", "-+": "∓", "+-": "±", "-": MINUS, "'": PRIME, "''": "″", "*": "·"}
OPENING = {"(": ")", "{": "}", "[": "]"}
TOKEN = re.compile(
    r"(?P<space>\s+)|(?P<number>\d+(?:\.\d+)?)|(?P<name>[^\W\d_]+\d*)|(?P<prime>'+)"
    r"|(?P<sign><=|>=|-\+(?=[\s(])|\+-(?=[\s(])|.)"
)
CONTENT = re.compile(r"[\w=+<>]")  # a text without any of these is no formula
STOP = re.compile(r"; |: | \| ")  # stands between formulas
WORD = re.compile(r"(?:[^\W\d_]{3,}|[a-z]{2})(?:'s|(?<=s)'(?=\s))?(?![\w'(^{])")


def typeset(formula: str) -> Markup:
    """A formula as MathML with its words between."""
    parts = (escape(text) if is_prose else _math(text) for is_prose, text in _runs(formula))
    return Markup("").join(parts)


def _runs(formula: str) -> Iterator[tuple[bool, str]]:
    """(whether it is prose, text): words and what stands between formulas, and the formulas."""
    at = start = 0
    while at < len(formula):
        inside = formula[max(0, at - 1) : at].isalnum()
        word = None if inside else WORD.match(formula, at)
        found = word if word and _is_word(word[0]) else STOP.match(formula, at)
        if found:
            yield from _trimmed(formula[start:at])
            yield True, found[0]
            at = start = found.end()
        else:
            at += 1
    yield from _trimmed(formula[start:])


def _trimmed(text: str) -> Iterator[tuple[bool, str]]:
    """A formula, with the surrounding blanks and full stop as prose."""
    inner = text.strip().rstrip(",.;")
    before = text[: len(text) - len(text.lstrip())]
    yield True, before
    if text.strip():
        yield not CONTENT.search(inner), inner
        yield True, text[len(before) + len(inner) :]


def _is_word(text: str) -> bool:
    bare = text.removesuffix("'").removesuffix("'s")
    if bare in GREEK or bare in FUNCTIONS or bare == "sqrt":
        return False
    return bare in SHORT_WORDS if len(bare) < 3 else True


def _math(text: str) -> Markup:
    tokens = [(found.lastgroup or "", found[0]) for found in TOKEN.finditer(text)]
    row, _ = _row(tokens, 0, "")
    return Markup("<math>{}</math>").format(Markup("").join(row))


def _row(tokens: list[tuple[str, str]], at: int, end: str) -> tuple[list[Markup], int]:
    """The elements up to a closing sign, and the place behind it."""
    row: list[Markup] = []
    while at < len(tokens):
        kind, text = tokens[at]
        if text == end:
            return row, at + 1
        if kind == "space":
            between = row and at + 1 < len(tokens) and tokens[at + 1][0] in ("name", "number")
            if between and tokens[at - 1][0] != "sign":
                row.append(Markup('<mspace width=".2em"/>'))
            at += 1
            continue
        base, at = _atom(tokens, at)
        scripted, at = _scripted(base, tokens, at)
        row.append(scripted)
    return row, at


def _atom(tokens: list[tuple[str, str]], at: int) -> tuple[Markup, int]:
    """One element: a number, a name, a root, or a sign; brackets are signs of their own."""
    kind, text = tokens[at]
    if kind == "number":
        return Markup("<mn>{}</mn>").format(text), at + 1
    if text.startswith("sqrt") and text[4:].isdigit():
        return Markup("<msqrt><mn>{}</mn></msqrt>").format(text[4:]), at + 1
    if text == "sqrt" and tokens[at + 1 : at + 2] == [("sign", "(")]:
        inner, behind = _row(tokens, at + 2, ")")
        return Markup("<msqrt>{}</msqrt>").format(Markup("").join(inner)), behind
    if text in FUNCTIONS:
        return Markup('<mo lspace="0" rspace=".16em">{}</mo>').format(text), at + 1
    if kind == "name":
        stem = text.rstrip("0123456789")
        name = Markup("<mi>{}</mi>").format(GREEK.get(stem, stem))
        if text != stem:
            name = Markup("<msub>{}<mn>{}</mn></msub>").format(name, text[len(stem) :])
        return name, at + 1
    return Markup("<mo>{}</mo>").format(SIGNS.get(text, text)), at + 1


def _scripted(base: Markup, tokens: list[tuple[str, str]], at: int) -> tuple[Markup, int]:
    """An element with what stands below it and above it."""
    below = above = Markup("")
    while at < len(tokens):
        kind, text = tokens[at]
        if text == "_" and not below and at + 1 < len(tokens):
            below, at = _script(tokens, at + 1)
        elif text == "^" and at + 1 < len(tokens):
            base = Markup("<msup>{}{}</msup>").format(base, above) if above else base
            above, at = _script(tokens, at + 1)
        elif kind == "prime" and not above:
            above, at = Markup("<mo>{}</mo>").format(SIGNS.get(text, text)), at + 1
        else:
            break
    if below and above:
        return Markup("<msubsup>{}{}{}</msubsup>").format(base, below, above), at
    if below:
        return Markup("<msub>{}{}</msub>").format(base, below), at
    return (Markup("<msup>{}{}</msup>").format(base, above) if above else base), at


def _script(tokens: list[tuple[str, str]], at: int) -> tuple[Markup, int]:
    """What follows a '_' or '^': all between brackets, or one element, with its sign."""
    text = tokens[at][1]
    if text in OPENING:
        row, at = _row(tokens, at + 1, OPENING[text])
        return Markup("<mrow>{}</mrow>").format(Markup("").join(row)), at
    if text in "+-" and at + 1 < len(tokens) and tokens[at + 1][0] == "number":
        inner, behind = _atom(tokens, at + 1)
        return Markup("<mrow><mo>{}</mo>{}</mrow>").format(SIGNS.get(text, text), inner), behind
    return _atom(tokens, at)
