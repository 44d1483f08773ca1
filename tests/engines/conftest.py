"""What tests of engines share: kernels that run as Python, without being compiled."""

from collections.abc import Iterator
from typing import Any

import numpy as np
import pytest

from vv.engines.kernels.compiled import Deferred


def _as_written(kernel: Any, *arguments: object) -> object:
    return kernel.__wrapped__(*arguments)


@pytest.fixture(scope="module")
def in_python() -> Iterator[None]:
    """Let kernels run as the Python that they are written in, which needs no compiler.

    Divisions by zero give infinity, as they do in compiled kernels, if one number is of numpy.
    """
    with pytest.MonkeyPatch.context() as patch, np.errstate(all="ignore"):
        patch.setattr(Deferred, "__call__", _as_written)
        yield
