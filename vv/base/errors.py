"""The error whose message is shown to the user without a traceback."""


class UsageError(ValueError):
    """The user asked for something invalid; the message names the thing, the value and the rule."""
