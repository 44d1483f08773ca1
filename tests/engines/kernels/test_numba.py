"""What of numba's private interface kernels are compiled by, and what that promises."""

import inspect
from typing import Any, NamedTuple

import numba
import numpy as np
import pytest
from numba.core import (
    codegen,
    compiler,
    datamodel,
    event,
    imputils,
    lowering,
    ssa,
    typed_passes,
    types,
    untyped_passes,
)
from numba.core.callconv import CPUCallConv
from numba.core.cpu import CPUContext
from numba.core.errors import TypingError
from numba.core.runtime import nrt

from vv.engines.kernels.arrays import nil_numbers
from vv.engines.kernels.bundle_types import DATA
from vv.engines.kernels.bundles import bundle
from vv.engines.kernels.compiled import called, compiled, lent
from vv.engines.kernels.lean import BUFFER, SHAPE, STRIDES
from vv.engines.kernels.parts import Part, linked
from vv.engines.kernels.passes import Settled
from vv.scene import Vector

CHANGED = (
    f"numba {numba.__version__} is not the numba that vv/engines/kernels is written for: "
    "compare the modules named here with its sources, then raise its bound in pyproject.toml"
)
MEMBERS: tuple[tuple[Any, tuple[str, ...]], ...] = (
    (
        codegen.JITCodeLibrary,
        ("_optimize_functions", "_get_module_for_linking", "_ensure_finalized", "add_ir_module"),
    ),
    (compiler.CompilerBase, ("_compile_core", "define_pipelines")),
    (compiler.Flags, ("values", "copy", "options")),
    (CPUContext, ("get_function", "insert_user_function", "unpack_value", "pack_value", "cast")),
    (CPUCallConv, ("get_return_type", "_get_arg_packer")),
    (lowering.Lower, ("lower_binop", "lower_getitem", "lower_setitem", "_cast_var")),
    (lowering.Lower, ("storevar", "delvar", "alloca_lltype", "_alloca_var", "getvar")),
    (CPUContext, ("get_abi_sizeof",)),
    (typed_passes.PreLowerStripPhis, ("_strip_phi_nodes",)),
    (ssa, ("reconstruct_ssa",)),
    (event, ("_registered", "register", "unregister")),
    (typed_passes, ("NopythonTypeInference", "PreLowerStripPhis", "IRLegalization")),
    (typed_passes, ("AnnotateTypes", "BaseNativeLowering", "NoPythonBackend")),
    (untyped_passes, ("TranslateByteCode", "FixupArgs", "IRProcessing", "DeadBranchPrune")),
    (untyped_passes, ("GenericRewrites",)),
    (imputils, ("user_function", "impl_ret_borrowed", "impl_ret_new_ref")),
)
runtime: Any = nrt


@bundle
class Held(NamedTuple):
    """numbers: (n,)."""

    numbers: Vector


@lent
def last(held: Held) -> float:
    """The last of the numbers."""
    return float(held.numbers[-1])


@compiled
def last_of_many(held: Held, rounds: int) -> float:
    """The last of the numbers, read so often."""
    total = 0.0
    for _ in range(rounds):
        total += last(held)
    return total


@lent
def given(n: int) -> float:
    """What is lent arrays must not be given one."""
    return float(nil_numbers(n)[0])


@compiled
def asks(n: int) -> float:
    """Calls what is given an array."""
    return given(n)


@called
def doubtful(number: int) -> int:
    """May raise."""
    if number > 2:
        raise ValueError("too many")
    return number


@compiled
def told(number: int) -> int:
    """Calls what may raise."""
    return doubtful(number)


@compiled
def looped(table: Vector, first: int, end: int) -> float:
    """Elements from both ends, over ranges of all kinds."""
    total = 0.0
    for i in range(end):
        for j in range(first, end):
            total += table[i, j] + 10.0 * table[-1 - i, -1]
    for i in range(end - 1, -1, -1):
        table[i, 0] = len(table)
    return total


@pytest.mark.parametrize(("owner", "names"), MEMBERS, ids=lambda value: str(value)[:40])
def test_numba_still_has_what_kernels_are_compiled_by(owner: Any, names: tuple[str, ...]) -> None:
    missing = [name for name in names if not hasattr(owner, name)]
    assert not missing, f"{owner} has no {missing}: {CHANGED}"


def test_numba_makes_compilers_and_libraries_as_before() -> None:
    made = list(inspect.signature(compiler.CompilerBase.__init__).parameters)
    wanted = ["self", "typingctx", "targetctx", "library", "args", "return_type", "flags", "locals"]
    assert made == wanted, CHANGED
    library = numba.core.registry.cpu_target.target_context.codegen().create_library("some")
    for name in ("_final_module", "_linking_libraries", "_shared_module", "_finalized"):
        assert hasattr(library, name), CHANGED


def test_an_array_has_its_words_where_kernels_read_them() -> None:
    manager: Any = datamodel.default_manager  # type: ignore[attr-defined]
    fields = manager[types.float64[:, ::1]]._fields
    assert [fields[k] for k in (BUFFER, SHAPE, STRIDES)] == ["data", "shape", "strides"], CHANGED


def test_what_a_meminfo_holds_is_at_its_fourth_word() -> None:
    whole = np.arange(3.0)
    runtime.rtsys.initialize(numba.core.registry.cpu_target.target_context)
    memory = runtime.rtsys.meminfo_new(whole.ctypes.data, whole)
    assert DATA == 3
    assert memory.data == whole.ctypes.data, CHANGED


def test_a_lent_part_reads_a_bundle_and_leaves_its_references_alone() -> None:
    numbers = np.array([1.0, 2.5])
    last_of_many(Held(numbers), 1)
    runtime._nrt.memsys_enable_stats()
    before = runtime.rtsys.get_allocation_stats()
    assert last_of_many(Held(numbers), 4) == 10.0
    after = runtime.rtsys.get_allocation_stats()
    assert after.mi_alloc - before.mi_alloc == after.mi_free - before.mi_free


def test_a_lent_part_that_is_given_an_array_is_refused() -> None:
    with pytest.raises(TypingError, match="nobody would free it"):
        asks(2)


def test_what_a_part_raises_reaches_python() -> None:
    assert told(2) == 2
    with pytest.raises(ValueError, match="too many"):
        told(3)


def test_elements_and_ranges_are_those_of_python() -> None:
    for table in (np.arange(9.0).reshape(3, 3), np.arange(18.0).reshape(3, 6)[:, ::2]):
        wanted = looped.py_func(table.copy(), 1, 3)  # type: ignore[attr-defined]
        assert looped(table, 1, 3) == wanted
        assert list(table[:, 0]) == [3.0, 3.0, 3.0]


def test_flags_that_are_settled_equal_those_they_were_made_of() -> None:
    plain: Any = compiler.Flags()  # type: ignore[no-untyped-call]
    plain.nrt = True
    settled: Any = Settled(plain)
    assert settled == plain
    assert plain == settled
    assert hash(settled) == hash(plain)
    settled.nrt = False
    assert settled != plain


def test_each_part_is_linked_once() -> None:
    made = numba.core.registry.cpu_target.target_context.codegen()
    make: Any = Part
    one, two = make(made, "one"), make(made, "two")
    one._linking_libraries, two._linking_libraries = [two], [one]
    assert linked([one, two]) == [one, two]
