"""Errors that are told to the user as they are."""


class UsageError(ValueError):
    """What the user asked for cannot be understood; one line names the thing and the rule."""
