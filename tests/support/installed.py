"""Skips tests of a code that is not installed, unless VV_REQUIRE names it: then they fail."""

from __future__ import annotations

import os

import pytest

from vv.codes import Adapter


def only_with(adapter: Adapter) -> pytest.MarkDecorator:
    """The mark of a test, or of a module of them, that runs a code."""
    return pytest.mark.skipif(excused(adapter), reason=_reason(adapter))


def require(adapter: Adapter) -> None:
    """Skip the test or the fixture that calls it."""
    if excused(adapter):
        pytest.skip(_reason(adapter))


def excused(adapter: Adapter) -> bool:
    """Whether a code is not installed and need not be."""
    required = adapter.name in os.environ.get("VV_REQUIRE", "").split(",")
    return not (adapter.found().installed or required)


def _reason(adapter: Adapter) -> str:
    return f"{adapter.name} is not installed: {adapter.found().how_to_install}"
