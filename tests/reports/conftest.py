"""Fixtures: a store for each test of the report, and a manifest with all outcomes of a job."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.support.fabricated import manifest_of_all
from vv.records.manifest import Manifest
from vv.store.store import Store


@pytest.fixture
def store(tmp_path: Path) -> Store:
    return Store(tmp_path / ".vv")


@pytest.fixture
def manifest(store: Store) -> Manifest:
    return manifest_of_all(store)
