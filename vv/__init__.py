"""vv: verification and validation of contact mechanics codes.

May import: cli.
"""

__version__ = "0.1.0"
