"""The end of an error message about a name that is not known."""

from __future__ import annotations

import difflib
from collections.abc import Iterable


def name_hint(name: str, known: Iterable[str]) -> str:
    """Known names that are similar to `name`, else all known names, as the end of a message."""
    names = sorted(set(known))
    by_folded = {n.lower(): n for n in names}
    close = difflib.get_close_matches(name.lower(), by_folded, n=2, cutoff=0.6)
    if close:
        return f"; did you mean {' or '.join(by_folded[c] for c in close)}?"
    return f"; known: {', '.join(names)}" if names else "; there is none"
