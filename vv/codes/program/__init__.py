"""Programs as codes: a TOML file declares one, which reads JSON and writes CSV files."""

from vv.codes.program.adapter import Program, load

__all__ = ["Program", "load"]
