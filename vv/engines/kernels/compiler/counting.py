"""numba's reference counting, limited to values that hold references.

numba extracts every word of an array, and of every bundle of arrays, to find the one that is
counted; this made a fifth of the generated code of kernels.
"""

from __future__ import annotations

from typing import Any

from numba.core.runtime import context

NUMBA: Any = context.NRTContext
HOLDS: dict[Any, bool] = {}  # whether values of a type hold references


def holds_references(manager: Any, kind: Any) -> bool:
    """Whether values of this type hold counted references."""
    if kind not in HOLDS:
        HOLDS[kind] = bool(manager[kind].contains_nrt_meminfo())
    return HOLDS[kind]


class Counting(NUMBA):  # type: ignore[misc]
    """Generates the code that counts references."""

    def get_meminfos(self, builder: Any, ty: Any, val: Any) -> Any:
        """The counted references in a value, each with its type."""
        manager = self._context.data_model_manager
        if not holds_references(manager, ty):
            return []
        model = manager[ty]
        found = [(ty, model.get_nrt_meminfo(builder, val))] if model.has_nrt_meminfo() else []
        for kind, take in model.traverse(builder):
            if holds_references(manager, kind):
                found += self.get_meminfos(builder, kind, take(val))
        return found
