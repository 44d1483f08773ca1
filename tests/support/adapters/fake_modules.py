"""Installs substitutes for the modules of a missing code, so that its driver can be loaded."""

from __future__ import annotations

import importlib
import sys
from collections.abc import Iterator, Mapping, Sequence
from types import ModuleType
from typing import Any


def driver_with(name: str, modules: Mapping[str, Any], parts: Sequence[str] = ()) -> Iterator[Any]:
    """A driver, loaded with these modules beside it and forgotten with them afterwards.

    parts: what it is made of besides, which imports these modules too.
    """
    own = (name, *parts)
    before = {one: sys.modules.get(one) for one in (*own, *modules)}
    for one in own:
        sys.modules.pop(one, None)
    for one, content in modules.items():
        made = ModuleType(one)
        vars(made).update(content)
        sys.modules[one] = made
    try:
        yield importlib.import_module(name)
    finally:
        for one, module in before.items():
            sys.modules.pop(one, None)
            if module is not None:
                sys.modules[one] = module
