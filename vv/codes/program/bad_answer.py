"""The error of an answer that violates the protocol, and how it quotes texts."""

SHOWN = 60  # characters of a text that is quoted


class BadAnswerError(ValueError):
    """The output of a program violates the protocol; the message says where."""


def short(text: str) -> str:
    """A text as an error quotes it: its beginning, if it is long."""
    return text if len(text) <= SHOWN else f"{text[:SHOWN]}..."
