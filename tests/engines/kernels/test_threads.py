"""Claims about threads of kernels: they spin while they wait, unless the user chose otherwise."""

from __future__ import annotations

import os

import numba
import pytest

from vv.engines.kernels.threads import SPINS, on_threads


@pytest.mark.parametrize(("chosen", "due"), [(None, SPINS), ("7", "7"), ("0", "0")])
def test_threads_start_with_the_spins_that_were_chosen_and_leave_the_choice(
    chosen: str | None, due: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The number of threads is set for the call and then as before."""
    seen: list[object] = []

    def running() -> int:
        seen.append(os.environ.get("GOMP_SPINCOUNT"))
        return 5

    monkeypatch.setattr(numba, "get_num_threads", running)
    monkeypatch.setattr(numba, "set_num_threads", seen.append)
    monkeypatch.setenv("GOMP_SPINCOUNT", chosen or "")
    if chosen is None:
        monkeypatch.delenv("GOMP_SPINCOUNT")
    assert on_threads(3, lambda *given: sum(given), (1, 2)) == 3
    assert seen == [due, 3, 5]
    assert os.environ.get("GOMP_SPINCOUNT") == chosen
