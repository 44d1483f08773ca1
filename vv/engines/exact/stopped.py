"""What is raised where a motion cannot be followed further."""


class StoppedError(Exception):
    """The motion cannot be followed further; the message is the reason."""
