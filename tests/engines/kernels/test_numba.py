"""Claims about the private interface of numba by which kernels are compiled."""

import inspect
from typing import Any

import numba
import numpy as np
import pytest
from llvmlite import binding as llvm
from llvmlite import ir
from numba.core import (
    codegen,
    compiler,
    compiler_machinery,
    datamodel,
    event,
    imputils,
    interpreter,
    lowering,
    ssa,
    transforms,
    typed_passes,
    typeinfer,
    types,
    untyped_passes,
)
from numba.core import ir as numba_ir
from numba.core.callconv import CPUCallConv
from numba.core.cpu import CPUContext
from numba.core.rewrites import registry
from numba.core.runtime import nrt
from numba.core.runtime.context import NRTContext

from vv.engines.kernels.bundle_types import DATA
from vv.engines.kernels.compiler.folding import Folding
from vv.engines.kernels.compiler.lean import BUFFER, SHAPE, STRIDES, Lean
from vv.engines.kernels.compiler.manager import without_events
from vv.engines.kernels.compiler.parts import Part, Whole, linked
from vv.engines.kernels.compiler.passes import CachedFlags

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
    (CPUCallConv, ("get_function_type", "decode_arguments", "return_user_exc")),
    (CPUCallConv, ("return_status_propagate", "return_dynamic_user_exc")),
    (lowering.Lower, ("lower_binop", "lower_getitem", "lower_setitem", "_cast_var")),
    (lowering.Lower, ("storevar", "delvar", "alloca_lltype", "_alloca_var", "getvar")),
    (lowering.Lower, ("loadvar", "_find_singly_assigned_variable", "setup_function", "call_conv")),
    (CPUContext, ("get_abi_sizeof", "get_constant_generic", "nrt", "call_conv")),
    (NRTContext, ("get_meminfos", "meminfo_alloc_aligned_unchecked", "meminfo_data")),
    (CPUContext, ("create_cpython_wrapper", "get_python_api", "make_tuple", "mangler")),
    (codegen.CPUCodeLibrary, ("_optimize_final_module",)),
    (typed_passes.PreLowerStripPhis, ("_strip_phi_nodes",)),
    (ssa, ("reconstruct_ssa",)),
    (event, ("_registered", "register", "unregister")),
    (typed_passes, ("NopythonTypeInference", "PreLowerStripPhis", "IRLegalization")),
    (typed_passes, ("BaseNativeLowering", "NoPythonBackend")),
    (untyped_passes, ("FixupArgs", "DeadBranchPrune")),
    (interpreter, ("peep_hole_delete_with_exit", "peep_hole_fuse_dict_add_updates")),
    (interpreter.Interpreter, ("interpret", "post_process")),
    (transforms, ("canonicalize_cfg",)),
    (compiler_machinery.PassManager, ("_runPass",)),
    (registry.rewrite_registry, ("rewrites",)),
    (typeinfer, ("ConstraintNetwork", "new_error_context")),
    (lowering.Lower, ("lower_block", "lower_inst", "lower_assign", "pre_block", "post_block")),
    (numba_ir.Inst, ("_rec_list_vars", "list_vars")),
    (imputils, ("user_function", "impl_ret_borrowed", "impl_ret_new_ref")),
)
runtime: Any = nrt


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


def test_variables_are_those_that_numba_lists() -> None:
    made: Any = numba_ir
    here = made.Loc("file", 1)
    scope = made.Scope(None, here)
    one, two, three = (made.Var(scope, name, here) for name in "abc")
    statement = made.Assign(made.Expr.call(one, [two], {"key": three}, here), two, here)
    listed = [variable.name for variable in statement.list_vars()]
    with without_events():
        assert [variable.name for variable in statement.list_vars()] == listed == [*"abcb"]


def test_a_word_of_a_structure_is_found_where_it_was_put() -> None:
    word = ir.IntType(64)
    pair = ir.LiteralStructType([word, word])
    block = ir.Function(
        ir.Module(), ir.FunctionType(word, [word, word]), "some"
    ).append_basic_block()
    builder, (first, second) = Folding(block), block.function.args
    made = builder.insert_value(ir.Constant(pair, ir.Undefined), first, 0)
    whole = builder.insert_value(made, second, 1)
    assert builder.extract_value(whole, 0) is first
    assert builder.extract_value(whole, [1]) is second
    nest = ir.LiteralStructType([pair, word])
    outer = builder.insert_value(ir.Constant(nest, ir.Undefined), whole, 0)
    assert builder.extract_value(outer, [0, 1]) is second
    changed = builder.insert_value(outer, first, [0, 1])
    assert builder.extract_value(changed, [0, 1]) is first
    assert builder.extract_value(changed, [0, 0]) is first
    assert builder.extract_value(changed, 0) is not whole


def test_flags_that_are_settled_equal_those_they_were_made_of() -> None:
    plain: Any = compiler.Flags()  # type: ignore[no-untyped-call]
    plain.nrt = True
    settled: Any = CachedFlags(plain)
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


IN_MEMORY = """
define i64 @kept(i64 %value) {
    %place = alloca i64
    store i64 %value, i64* %place
    %again = load i64, i64* %place
    ret i64 %again
}
"""


@pytest.mark.parametrize(("kind", "left"), [(Part, False), (Whole, True)])
def test_functions_of_a_whole_are_left_to_the_passes_over_all_of_it(kind: Any, left: bool) -> None:
    library = kind(numba.core.registry.cpu_target.target_context.codegen(), "some")
    module: Any = llvm.parse_assembly(IN_MEMORY)
    library._optimize_functions(module)
    assert ("alloca" in str(module)) is left


def test_a_function_has_a_short_name_in_code_another_for_other_types() -> None:
    name: Any = Lean.mangler
    tuples: Any = types.Tuple
    kinds = [tuples([types.float64, types.int64] * n) for n in (20, 21)]
    short = [name(None, "pull", (kind,), uid=1) for kind in kinds]
    assert max(map(len, short)) < 40
    assert len({*short, name(None, "push", kinds[:1], uid=1), name(None, "pull", kinds[:1])}) == 4
