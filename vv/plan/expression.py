"""Parses expressions such as `T3 and not (rotated or yade)` that select jobs by name."""

from __future__ import annotations

import re
from collections.abc import Callable

from vv.base.errors import UsageError

Matches = Callable[[str], bool]
TOKEN = re.compile(r"[()]|[^\s()]+")
LONGEST = 1000  # characters; each bracket is a level of calls
OPERATORS = ("and", "or", "not", "(", ")")


def matcher(text: str) -> Matches:
    """A test of names by an expression; a word matches names that contain it, in any case.

    Raises UsageError for an expression that cannot be read.
    """
    if len(text) > LONGEST:
        raise UsageError(f"-k: {len(text)} characters; at most {LONGEST} are taken")
    reader = _Reader(text)
    found = reader.either()
    if reader.next:
        raise reader.unreadable()
    return found


class _Reader:
    """Reads an expression from left to right; `next` is the token to come, '' at the end."""

    def __init__(self, text: str) -> None:
        self.text = text
        self.tokens = iter(TOKEN.findall(text))
        self.next = ""
        self.advance()

    def advance(self) -> None:
        self.next = next(self.tokens, "")

    def either(self) -> Matches:
        """Parts joined by `or`."""
        parts = [self.both()]
        while self.next == "or":
            self.advance()
            parts.append(self.both())
        return parts[0] if len(parts) == 1 else lambda name: any(part(name) for part in parts)

    def both(self) -> Matches:
        """Parts joined by `and`."""
        parts = [self.one()]
        while self.next == "and":
            self.advance()
            parts.append(self.one())
        return parts[0] if len(parts) == 1 else lambda name: all(part(name) for part in parts)

    def one(self) -> Matches:
        """A word, an expression in brackets, or the negation of either."""
        token = self.next
        self.advance()
        if token == "not":
            inner = self.one()
            return lambda name: not inner(name)
        if token == "(":
            inner = self.either()
            if self.next != ")":
                raise self.unreadable()
            self.advance()
            return inner
        if not token or token in OPERATORS:
            raise self.unreadable(token)
        word = token.lower()
        return lambda name: word in name.lower()

    def unreadable(self, token: str | None = None) -> UsageError:
        """The error for a token that is not allowed at its place."""
        at = f"'{self.next if token is None else token}'" if (token or self.next) else "end"
        rule = "an example: T3 and not (rotated or yade)"
        return UsageError(f"-k '{self.text}': unexpected {at}; {rule}")
