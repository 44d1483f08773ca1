"""The error of an answer that is not what the protocol asks for, and how it quotes texts."""

SHOWN = 60  # characters of a text that is quoted


class BadAnswerError(ValueError):
    """What a program wrote is not what the protocol asks for; the message says where."""


def short(text: str) -> str:
    """A text as an error quotes it: its beginning, if it is long."""
    return text if len(text) <= SHOWN else f"{text[:SHOWN]}..."
