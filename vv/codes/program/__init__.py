"""Programs of strangers as codes: a TOML file declares one, JSON and CSV files speak with it."""

from vv.codes.program.adapter import Program, load

__all__ = ["Program", "load"]
