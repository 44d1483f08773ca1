"""The exception for a motion that cannot be computed to its end."""


class StoppedError(Exception):
    """The motion cannot be computed further; the message is the reason."""
