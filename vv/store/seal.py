"""Seals stored content with a digest of its name and content, so that damage is noticed.

The name is part of the digest: a file that was copied or renamed to another place counts as damaged
there. A seal is no signature: it detects accidents, not forgery, and therefore a store must contain
data only.
"""

from __future__ import annotations

import hashlib

SIZE = 32  # hexadecimal digits of a seal
BEFORE, BETWEEN, AFTER = '{"seal": "', '", "kept": ', "}\n"
START = len(BEFORE) + SIZE + len(BETWEEN)


class BrokenSealError(ValueError):
    """The content differs from what was stored under this name."""


def seal_of(name: str, content: bytes) -> str:
    """The seal of content under a name, SIZE hexadecimal digits."""
    person = hashlib.blake2b(name.encode("utf-8", "surrogateescape"), digest_size=16).digest()
    return hashlib.blake2b(content, digest_size=SIZE // 2, key=person).hexdigest()


def sealed_text(name: str, text: str) -> str:
    """A text in JSON with its seal, which is JSON too."""
    return f"{BEFORE}{seal_of(name, text.encode())}{BETWEEN}{text}{AFTER}"


def opened_text(name: str, whole: str) -> str:
    """The text that was sealed; raises BrokenSealError."""
    if not whole.startswith(BEFORE):
        raise BrokenSealError("it has no seal: it is of an older form, or damaged")
    text = whole[START : -len(AFTER)]
    if whole != sealed_text(name, text):
        raise BrokenSealError("it is not what was stored: the digest differs")
    return text


def sealed_bytes(name: str, content: bytes) -> bytes:
    """The content with its seal appended, where readers of zip files do not look."""
    return content + seal_of(name, content).encode()


def opened_bytes(name: str, whole: bytes) -> bytes:
    """The content that was sealed; raises BrokenSealError."""
    content = whole[:-SIZE]
    if whole[-SIZE:] != seal_of(name, content).encode():
        raise BrokenSealError("it is not what was stored: the digest differs")
    return content
