"""Fixtures for tests of how codes are started and asked."""

from collections.abc import Iterator

import pytest

from vv.codes.reused_program import ReusedProgram


@pytest.fixture
def program() -> Iterator[ReusedProgram]:
    """A program that is ended with the test."""
    made = ReusedProgram()
    yield made
    if made._waiting is not None:
        made.dismiss(made._waiting, whole=True)
