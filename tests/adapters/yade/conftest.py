"""The program inside YADE, with modules that touch nothing in YADE's place."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import pytest

from adapters.yade.inside import PARTS
from tests.support.adapters.fake_modules import driver_with
from tests.support.adapters.inside_yade import INSIDE, OMEGA, UTILS
from tests.support.adapters.still_yade import modules


@pytest.fixture
def driver() -> Iterator[Any]:
    OMEGA.reset()
    UTILS.interactions.clear()
    parts = [f"{INSIDE}.{part}" for part in PARTS[:-1]]
    yield from driver_with(f"{INSIDE}.driver", modules(OMEGA, UTILS), parts)
