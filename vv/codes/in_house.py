"""What there is to find of a code that is part of vv and compiled by numba."""

from __future__ import annotations

import importlib.util

import vv
from vv.codes.adapter import Found


def part_of_vv() -> Found:
    """Whether it can be compiled here; numba is brought into memory for all its workers at once."""
    if importlib.util.find_spec("numba") is None:
        return Found(False, how_to_install="pip install numba")
    return Found(True, vv.__version__, load=_load_compiler)


def _load_compiler() -> None:
    from vv.engines.kernels import compiled

    compiled.load()
