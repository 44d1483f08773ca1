"""Compiles kernels, once per machine: options, and a disk cache named by their sources.

numba is loaded where a kernel is first called, so that a file may hold kernels beside what scenes
are described by.
"""

from __future__ import annotations

import functools
import importlib
from collections.abc import Callable
from pathlib import Path
from typing import Any, TypeVar, cast

from vv.base.closure import import_closure, source_digest
from vv.base.private_folder import cache_root
from vv.engines.kernels.bundles import introduce
from vv.engines.kernels.once import once

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


class Deferred:
    """A function that numba wraps when it is first called, or met by what numba compiles."""

    def __init__(self, function: Callable[..., object], wrap: Callable[[Any], Any]) -> None:
        functools.update_wrapper(self, function)
        self._function, self._wrap = function, wrap

    @functools.cached_property
    def dispatcher(self) -> Any:
        """What numba makes of the function."""
        introduce()
        return self._wrap(self._function)

    def __call__(self, *args: object) -> object:
        return self.dispatcher(*args)

    def __getattr__(self, name: str) -> Any:
        return getattr(self.dispatcher, name)  # numba asks for its type in this way


def compiled(function: Kernel) -> Kernel:
    """The function compiled for each combination of argument types it meets, and kept on disk.

    An argument that is None is known to the compiler: branches it rules out are not compiled.
    Rounding is that of the source but for `contract`, which lets a product and a sum fuse.
    """
    return cast(Kernel, Deferred(function, whole))


def compiled_to_branch(function: Kernel) -> Kernel:
    """As `compiled`, for a kernel that decides more than it computes, whose loops are short.

    They are not unrolled, which would be a tenth of what compiling takes. They are made of vectors,
    without which sweeps over the contacts of many blocks take twice as long.
    """
    return cast(Kernel, Deferred(function, functools.partial(whole, branches=True)))


def inlined(function: Kernel) -> Kernel:
    """A function for kernels to call: it becomes part of them and has no entry from Python.

    A call would pass each array as seven words, which costs more than most of these compute. It
    may only borrow arrays, as what is `lent`.
    """
    return part(function, forceinline=True, **LENT)


def lent(function: Kernel) -> Kernel:
    """A function for kernels to call that borrows arrays: it neither makes nor returns any.

    References to arrays are not counted in it, which is most of what compiling it would take. It
    may call no part that returns an array, which nobody would free; numba is told to refuse that.
    """
    return part(function, **LENT)


def called(function: Kernel) -> Kernel:
    """A function for kernels to call that makes arrays, or returns some."""
    return part(function, **COUNTED)


def inlined_called(function: Kernel) -> Kernel:
    """As `called`, for what is so short that it becomes part of kernels."""
    return part(function, forceinline=True, **COUNTED)


def part(function: Kernel, **options: Any) -> Kernel:
    """A function for kernels to call, compiled by these options of numba's."""

    def wrap(function: Kernel) -> Any:
        import numba

        from vv.engines.kernels.compiler.parts import PartCompiler

        return numba.njit(pipeline_class=PartCompiler, **options, **HIDDEN, **ROUNDING)(function)

    return cast(Kernel, Deferred(function, wrap))


def shared(function: Kernel) -> Kernel:
    """A function for kernels to call, whose numba.prange is shared out to threads."""

    def wrap(function: Kernel) -> Any:
        import numba

        function.__globals__["numba"] = numba  # which it names, and which is loaded only now
        return numba.njit(parallel=True, **COUNTED, **HIDDEN, **ROUNDING)(function)

    return cast(Kernel, Deferred(function, wrap))


def whole(function: Kernel, branches: bool = False) -> Any:
    """What numba makes of a function that is called from Python; branches: its loops are short."""
    import numba

    from vv.engines.kernels.compiler.parts import BranchingCompiler, WholeCompiler

    config: Any = numba.config
    before = config.CACHE_DIR
    folder = cache_folder(Path(function.__code__.co_filename))
    config.CACHE_DIR = str(folder)  # numba reads it once, as it wraps a function
    try:
        compiler = BranchingCompiler if branches else WholeCompiler
        kernel: Any = numba.njit(cache=True, pipeline_class=compiler, **ENTRY, **ROUNDING)(function)
    finally:
        config.CACHE_DIR = before
    kernel.compile = once(kernel.compile, folder / function.__name__)
    return kernel


def entry(kernel: Kernel, arguments: tuple[Any, ...]) -> Kernel:
    """The machine code of a kernel for the types of these arguments; compiled if it is not yet.

    It may be given arguments of these types only, and does not look at them again, which would take
    longer than a hundred steps of a small scene.
    """
    dispatcher = cast(Deferred, kernel).dispatcher
    kinds = tuple(map(dispatcher.typeof_pyval, arguments))
    if kinds not in dispatcher.overloads:
        dispatcher.compile(kinds)
    return cast(Kernel, dispatcher.overloads[kinds].entry_point)


def load() -> None:
    """Load all of numba that the first call of any kernel loads, scipy's BLAS with it."""
    from numba.core.registry import cpu_target

    cpu_target.typing_context.refresh()
    cpu_target.target_context.refresh()
    for name in (
        "vv.engines.kernels.compiler.parts",
        "numba.core.boxing",
        "numba.core.runtime.context",
    ):
        importlib.import_module(name)


def cache_folder(source: Path) -> Path:
    """Where the kernels of a file are cached: a folder named by all of an engine it imports.

    numba checks only the file a kernel is in, not those of the functions it calls, and would go
    on using what was compiled before one of these was edited. Nor does it see whether arguments
    still lie in memory where what is cached reads them.
    """
    from vv.engines.kernels.compiler.layout import is_known

    root = cache_root("numba" if is_known() else "numba-own-entry")
    return root / source_digest(kernel_sources(source, SOURCES))[:16]


def kernel_sources(source: Path, root: Path) -> list[Path]:
    """What the kernels of a file are made of: the file, and all that it imports of an engine.

    root: the folder that holds the package `vv`.
    """
    engines = root / "vv" / "engines"
    compiler = engines / "kernels" / HERE.name
    return [path for path in import_closure([source, compiler], [root]) if engines in path.parents]
