"""Compiles kernels once per machine, with a disk cache that is named by their sources.

numba is loaded when a kernel is first called, so that files with kernels can be imported without
it.
"""

from __future__ import annotations

import functools
import importlib
from collections.abc import Callable
from pathlib import Path
from typing import Any, TypeVar, cast

from vv.base.closure import import_closure, source_digest
from vv.base.private_folder import cache_root
from vv.engines.kernels.bundles import register_all
from vv.engines.kernels.once import once

Kernel = TypeVar("Kernel", bound=Callable[..., object])
HERE = Path(__file__).resolve()
SOURCES = HERE.parents[3]  # the folder that holds this package `vv`
ROUNDING: dict[str, Any] = {"error_model": "numpy", "fastmath": {"contract"}}
HIDDEN: dict[str, Any] = {"no_cpython_wrapper": True, "no_cfunc_wrapper": True}
COUNTED: dict[str, Any] = {"_nrt": True}  # if not given, numba takes it from the first caller
LENT: dict[str, Any] = {"_nrt": False}
ENTRY: dict[str, Any] = {"no_cfunc_wrapper": True, **COUNTED}


class Deferred:
    """A function that numba wraps when it is first called, or used in code that it compiles."""

    def __init__(self, function: Callable[..., object], wrap: Callable[[Any], Any]) -> None:
        functools.update_wrapper(self, function)
        self._function, self._wrap = function, wrap
        self.entries: dict[bytes, Callable[..., object]] = {}  # those that `entry` returned

    @functools.cached_property
    def dispatcher(self) -> Any:
        """The function as wrapped by numba."""
        check_that_numba_compiles()
        register_all()
        return self._wrap(self._function)

    def __call__(self, *args: object) -> object:
        return self.dispatcher(*args)

    def __getattr__(self, name: str) -> Any:
        return getattr(self.dispatcher, name)  # numba looks up its type in this way


def check_that_numba_compiles() -> None:
    """Raise a `RuntimeError` where the environment forbids numba to compile."""
    import numba

    if cast(Any, numba.config).DISABLE_JIT:
        raise RuntimeError("NUMBA_DISABLE_JIT is set, but kernels run compiled only; unset it")


def compiled(function: Kernel) -> Kernel:
    """The function, compiled for each combination of argument types and cached on disk.

    An argument that is None is known to the compiler: branches that it excludes are not compiled.
    Rounding is that of the source except for `contract`, by which a product and a sum may be fused.
    """
    return cast(Kernel, Deferred(function, whole))


def compiled_to_branch(function: Kernel) -> Kernel:
    """The same as `compiled`, for a kernel with many branches and short loops.

    Its loops are not unrolled, which would take a tenth of the time of compiling. They are
    vectorised: without that, sweeps over the contacts of many blocks take twice as long.
    """
    return cast(Kernel, Deferred(function, functools.partial(whole, compiler="BranchingCompiler")))


def compiled_to_join(function: Kernel) -> Kernel:
    """The same as `compiled`, for a kernel with lines that do the same to neighbours in memory.

    Such lines are vectorised too, whereas numba vectorises loops alone.
    """
    return cast(Kernel, Deferred(function, functools.partial(whole, compiler="JoiningCompiler")))


def inlined(function: Kernel) -> Kernel:
    """A function that is inlined into kernels and cannot be called from Python.

    A call would pass each array as seven words, which costs more than most of these functions
    compute. It may only borrow arrays, like a function that is `lent` them.
    """
    return part(function, forceinline=True, **LENT)


def lent(function: Kernel) -> Kernel:
    """A function for kernels that borrows arrays: it neither makes nor returns any.

    References to arrays are not counted in it, which saves most of the time of compiling it. It
    must not call a function that returns an array, since nothing would free that; compiling such a
    call fails.
    """
    return part(function, **LENT)


def called(function: Kernel) -> Kernel:
    """A function for kernels that makes or returns arrays."""
    return part(function, **COUNTED)


def inlined_called(function: Kernel) -> Kernel:
    """The same as `called`, for a function so short that it is inlined."""
    return part(function, forceinline=True, **COUNTED)


def part(function: Kernel, **options: Any) -> Kernel:
    """A function for kernels, compiled with these options of numba."""

    def wrap(function: Kernel) -> Any:
        import numba

        from vv.engines.kernels.compiler.parts import PartCompiler

        return numba.njit(pipeline_class=PartCompiler, **options, **HIDDEN, **ROUNDING)(function)

    return cast(Kernel, Deferred(function, wrap))


def shared(function: Kernel) -> Kernel:
    """A function for kernels, whose loops over numba.prange are distributed over threads."""

    def wrap(function: Kernel) -> Any:
        import numba

        function.__globals__["numba"] = numba  # the function uses it
        return numba.njit(parallel=True, **COUNTED, **HIDDEN, **ROUNDING)(function)

    return cast(Kernel, Deferred(function, wrap))


def whole(function: Kernel, compiler: str = "WholeCompiler") -> Any:
    """The function as wrapped by numba, to be called from Python; compiler: a class in `parts`."""
    import numba

    from vv.engines.kernels.compiler import parts

    config: Any = numba.config
    before = config.CACHE_DIR
    folder = cache_folder(Path(function.__code__.co_filename))
    config.CACHE_DIR = str(folder)  # numba reads it once, when it wraps a function
    try:
        made_by = getattr(parts, compiler)
        kernel: Any = numba.njit(cache=True, pipeline_class=made_by, **ENTRY, **ROUNDING)(function)
    finally:
        config.CACHE_DIR = before
    kernel.compile = once(kernel.compile, folder / function.__name__)
    return kernel


def entry(kernel: Kernel, arguments: tuple[Any, ...]) -> Kernel:
    """The machine code of a kernel for the types of these arguments, compiled if necessary.

    It may only be called with arguments of these types and does not check them: the check would
    take longer than a hundred steps of a small scene. Code is looked up by numba's own key of
    argument types: to build the types themselves takes hundreds of times as long.
    """
    from numba import _dispatcher

    known = cast(Deferred, kernel)
    key = _dispatcher.compute_fingerprint(arguments)
    if key not in known.entries:
        dispatcher = known.dispatcher
        kinds = tuple(map(dispatcher.typeof_pyval, arguments))
        if kinds not in dispatcher.overloads:
            dispatcher.compile(kinds)
        known.entries[key] = dispatcher.overloads[kinds].entry_point
    return cast(Kernel, known.entries[key])


def load() -> None:
    """Load all modules of numba that the first call of any kernel needs, and scipy's BLAS."""
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
    """The cache folder of the kernels of a file, named by the digest of all sources they use.

    numba checks only the file of a kernel and not those of the functions that it calls, so that it
    would use outdated machine code after one of these has been edited. Nor does it check whether
    arguments still have the memory layout that the machine code reads.
    """
    from vv.engines.kernels.compiler.layout import is_known

    root = cache_root("numba" if is_known() else "numba-own-entry")
    return root / source_digest(kernel_sources(source, SOURCES))[:16]


def kernel_sources(source: Path, root: Path) -> list[Path]:
    """The sources of the kernels of a file: the file, and all files of engines that it imports.

    root: the folder that holds the package `vv`.
    """
    engines = root / "vv" / "engines"
    compiler = engines / "kernels" / HERE.name
    return [path for path in import_closure([source, compiler], [root]) if engines in path.parents]
