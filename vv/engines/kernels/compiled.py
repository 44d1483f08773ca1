"""Compiles kernels, once per machine: options, and a disk cache named by their sources."""

from __future__ import annotations

import importlib
from collections.abc import Callable
from pathlib import Path
from typing import Any, TypeVar, cast

import numba
from numba.core.registry import cpu_target

from vv.base.closure import import_closure, source_digest
from vv.base.private_folder import cache_root
from vv.engines.kernels.once import once
from vv.engines.kernels.parts import PartCompiler, WholeCompiler

Kernel = TypeVar("Kernel", bound=Callable[..., object])
HERE = Path(__file__).resolve()
SOURCES = HERE.parents[3]  # the folder that holds this package `vv`
ROUNDING: dict[str, Any] = {"error_model": "numpy", "fastmath": {"contract"}}
HIDDEN: dict[str, Any] = {"no_cpython_wrapper": True, "no_cfunc_wrapper": True}
COUNTED: dict[str, Any] = {
    "_nrt": True
}  # numba takes it from the first caller where it is not said
LENT: dict[str, Any] = {"_nrt": False}
ENTRY: dict[str, Any] = {"no_cfunc_wrapper": True, **COUNTED}


def compiled(function: Kernel) -> Kernel:
    """The function compiled for each combination of argument types it meets, and kept on disk.

    An argument that is None is known to the compiler: branches it rules out are not compiled.
    Rounding is that of the source but for `contract`, which lets a product and a sum fuse.
    """
    config: Any = numba.config
    before = config.CACHE_DIR
    source = Path(function.__code__.co_filename)
    folder = cache_folder(source)
    config.CACHE_DIR = str(folder)  # numba reads it once, as it wraps a function
    try:
        kernel: Any = numba.njit(cache=True, pipeline_class=WholeCompiler, **ENTRY, **ROUNDING)(
            function
        )
    finally:
        config.CACHE_DIR = before
    kernel.compile = once(kernel.compile, folder / function.__name__)
    return cast(Kernel, kernel)


def inlined(function: Kernel) -> Kernel:
    """A function for kernels to call: it becomes part of them and has no entry from Python.

    A call would pass each array as seven words, which costs more than most of these compute. It
    may only borrow arrays, as what is `lent`.
    """
    part: Kernel = numba.njit(
        forceinline=True, pipeline_class=PartCompiler, **LENT, **HIDDEN, **ROUNDING
    )(function)
    return part


def lent(function: Kernel) -> Kernel:
    """A function for kernels to call that borrows arrays: it neither makes nor returns any.

    References to arrays are not counted in it, which is most of what compiling it would take. It
    may call no part that returns an array, which nobody would free; numba is told to refuse that.
    """
    part: Kernel = numba.njit(pipeline_class=PartCompiler, **LENT, **HIDDEN, **ROUNDING)(function)
    return part


def called(function: Kernel) -> Kernel:
    """A function for kernels to call that makes arrays, or returns some."""
    part: Kernel = numba.njit(pipeline_class=PartCompiler, **COUNTED, **HIDDEN, **ROUNDING)(
        function
    )
    return part


def inlined_called(function: Kernel) -> Kernel:
    """As `called`, for what is so short that it becomes part of kernels."""
    part: Kernel = numba.njit(
        forceinline=True, pipeline_class=PartCompiler, **COUNTED, **HIDDEN, **ROUNDING
    )(function)
    return part


def shared(function: Kernel) -> Kernel:
    """A function for kernels to call, whose numba.prange is shared out to threads."""
    part: Kernel = numba.njit(parallel=True, **COUNTED, **HIDDEN, **ROUNDING)(function)
    return part


def load() -> None:
    """Load all of numba that the first call of any kernel loads, scipy's BLAS with it."""
    cpu_target.typing_context.refresh()
    cpu_target.target_context.refresh()
    for name in ("numba.core.boxing", "numba.core.runtime.context"):
        importlib.import_module(name)


def cache_folder(source: Path) -> Path:
    """Where the kernels of a file are cached: a folder named by all of an engine it imports.

    numba checks only the file a kernel is in, not those of the functions it calls, and would go
    on using what was compiled before one of these was edited.
    """
    return cache_root("numba") / source_digest(kernel_sources(source, SOURCES))[:16]


def kernel_sources(source: Path, root: Path) -> list[Path]:
    """What the kernels of a file are made of: the file, and all that it imports of an engine.

    root: the folder that holds the package `vv`.
    """
    engines = root / "vv" / "engines"
    compiler = engines / "kernels" / HERE.name
    return [path for path in import_closure([source, compiler], [root]) if engines in path.parents]
