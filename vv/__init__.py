"""vv: verification and validation of contact mechanics codes."""

__version__ = "0.1.0"
