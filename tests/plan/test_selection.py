"""Patterns that select cases and codes; one that is no name is refused before anything is read."""

import time

import pytest

from tests import ROOT
from vv.base.errors import UsageError
from vv.plan import selection
from vv.plan.project import Project

STARS = "*" * 100_000


def test_a_pattern_that_is_too_long_is_refused_at_once_for_cases_and_codes() -> None:
    began = time.process_time()
    with pytest.raises(UsageError, match=r"100000 characters, '\*{20}\.\.\.'; at most 200 are"):
        selection.select(Project(ROOT), [STARS])
    with pytest.raises(UsageError, match="100000 characters"):
        selection.named_adapters(Project(ROOT), [STARS])
    assert time.process_time() - began < 1.0  # fnmatch alone takes some 15 s


def test_the_longest_pattern_is_read() -> None:
    found = selection.select(Project(ROOT), ["single-contact:T1" + "*" * 183])
    assert "T1" in {variant for _, variant in found}
