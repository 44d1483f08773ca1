"""The one place where records are written as JSON and read again.

A record becomes an object with a member per field, in their order; enums become their names in
small letters, with hyphens. Reading checks each field, and names what is damaged.
"""

from vv.records.codec.damaged import MISSING, DamagedError
from vv.records.codec.json_text import dump, parse, render
from vv.records.codec.reading import members, read
from vv.records.codec.writing import Json, names, to_data, word

__all__ = [
    "MISSING",
    "DamagedError",
    "Json",
    "dump",
    "members",
    "names",
    "parse",
    "read",
    "render",
    "to_data",
    "word",
]
