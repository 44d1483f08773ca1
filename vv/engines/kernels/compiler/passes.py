"""The passes by which numba compiles functions of kernels: its own, except those not needed here.

Functions of kernels contain no closures, array comprehensions, `with` statements, exceptions with
values known only at run time, or loops over tuples of several types.
"""

from __future__ import annotations

import operator
from typing import Any

from numba.core import (
    compiler,
    interpreter,
    ssa,
    transforms,
    typed_passes,
    types,
    untyped_passes,
)
from numba.core.compiler_machinery import FunctionPass, register_pass
from numba.core.errors import NumbaTypeError
from numba.core.rewrites import registry

from vv.engines.kernels.compiler.manager import Passes

SCALARS = (types.Integer, types.Float, types.Boolean, types.IntegerLiteral, types.BooleanLiteral)
ARITHMETIC = frozenset(
    {operator.add, operator.sub, operator.mul, operator.truediv, operator.neg,
     operator.iadd, operator.isub, operator.imul, operator.itruediv,
     operator.lt, operator.le, operator.gt, operator.ge, operator.eq, operator.ne}
)  # fmt: skip


SSA: Any = ssa
LOOPS: Any = transforms
READER: Any = interpreter.Interpreter
NEEDLESS = frozenset({"peep_hole_delete_with_exit", "peep_hole_fuse_dict_add_updates"})
REWRITES: Any = registry.rewrite_registry.rewrites["before-inference"]


class CachedFlags(compiler.Flags):
    """Compiler flags whose values are computed once: numba compares them hundreds of times."""

    def __init__(self, copy_from: Any = None) -> None:
        super().__init__(copy_from)  # type: ignore[no-untyped-call]
        self._seen: Any = None

    def values(self) -> Any:
        """All flags and their values."""
        now = tuple(self._values.items())
        if self._seen is None or self._seen[0] != now:
            self._seen = now, super().values()  # type: ignore[no-untyped-call]
        return self._seen[1]

    def __eq__(self, other: object) -> bool:
        if isinstance(other, CachedFlags) and self._values == other._values:
            return True
        return bool(super().__eq__(other))  # type: ignore[no-untyped-call]

    __hash__ = compiler.Flags.__hash__


class CachingContext:
    """numba's typing context with a cache for the types of calls and of array elements."""

    def __init__(self, context: Any, known: dict[Any, Any]) -> None:
        self._context, self._known = context, known

    def __getattr__(self, name: str) -> Any:
        return getattr(self._context, name)

    def resolve_function_type(self, function: Any, args: Any, keywords: Any) -> Any:
        """The signature of a call."""
        if keywords or not is_cacheable(function, args):
            return self._context.resolve_function_type(function, args, keywords)
        if isinstance(function, types.Dispatcher):  # one copy for all constants
            args = tuple(map(types.unliteral, args))
        key = (function, *args)
        if key not in self._known:
            self._known[key] = self._context.resolve_function_type(function, args, keywords)
        return self._known[key]

    def resolve_getitem(self, target: Any, index: Any) -> Any:
        """The signature of reading an element."""
        return self._resolved("resolve_getitem", (target, index))

    def resolve_setitem(self, target: Any, index: Any, value: Any) -> Any:
        """The signature of setting an element."""
        return self._resolved("resolve_setitem", (target, index, value))

    def _resolved(self, how: str, args: Any) -> Any:
        key = (how, *args)
        if key not in self._known:
            self._known[key] = getattr(self._context, how)(*args)
        return self._known[key]


def is_cacheable(function: Any, args: Any) -> bool:
    """Whether a call is one of a part, arithmetic of numbers, or reads an array element."""
    if isinstance(function, types.Dispatcher):
        return True
    if not isinstance(function, types.Function):
        return False
    if all(isinstance(arg, SCALARS) for arg in args):
        return True
    return function.typing_key is operator.getitem and isinstance(args[0], types.Array)


KNOWN: dict[Any, Any] = {}


class Reader(READER):  # type: ignore[misc]
    """Reads the bytecode of a function that contains no `with` statement and no dict."""

    def post_process(self, peepholes: Any, func_ir: Any) -> Any:
        """Apply the peephole rewrites that are needed here."""
        wanted = [one for one in peepholes if one.__name__ not in NEEDLESS]
        return super().post_process(wanted, func_ir)


@register_pass(mutates_CFG=True, analysis_only=False)  # type: ignore[no-untyped-call]
class Read(FunctionPass):
    """The pass that reads the bytecode of a function."""

    _name = "read"

    def __init__(self) -> None:
        FunctionPass.__init__(self)  # type: ignore[no-untyped-call]

    def run_pass(self, state: Any) -> bool:
        state.func_ir = made = Reader(state.func_id).interpret(state.bc)
        if made.is_generator:
            raise NumbaTypeError(f"{state.func_id.func_qualname} is a generator")
        made.blocks = LOOPS.canonicalize_cfg(made.blocks)
        made.generator_info = None
        return True


@register_pass(mutates_CFG=True, analysis_only=False)  # type: ignore[no-untyped-call]
class Constants(FunctionPass):
    """The pass that finds constants in indices and arithmetic (numba's GenericRewrites)."""

    _name = "constants"

    def __init__(self) -> None:
        FunctionPass.__init__(self)  # type: ignore[no-untyped-call]

    def run_pass(self, state: Any) -> bool:
        blocks = state.func_ir.blocks
        for kind in REWRITES:
            one = kind(state)
            for label in [*blocks]:
                while one.match(state.func_ir, blocks[label], None, None):
                    blocks[label] = one.apply()
        return True


@register_pass(mutates_CFG=True, analysis_only=False)  # type: ignore[no-untyped-call]
class Types(FunctionPass):
    """The pass that infers types; a function that counts no references may receive none."""

    _name = "types"

    def __init__(self) -> None:
        FunctionPass.__init__(self)  # type: ignore[no-untyped-call]

    def run_pass(self, state: Any) -> bool:
        context = state.typingctx
        state.typingctx = CachingContext(context, KNOWN)
        try:
            inference: Any = typed_passes.NopythonTypeInference()  # type: ignore[no-untyped-call]
            inference.run_pass(state)
        finally:
            state.typingctx = context
        if not state.flags.nrt:
            refuse_returned_arrays(state)
        return True


def refuse_returned_arrays(state: Any) -> None:
    """Raise NumbaTypeError if a function that counts no references is returned an array."""
    for call, signature in state.calltypes.items():
        gift = getattr(signature, "return_type", None)
        if getattr(call, "op", None) != "call" or gift is None:
            continue
        called = state.typemap[call.func.name]
        model = state.targetctx.data_model_manager[gift]
        if isinstance(called, types.Dispatcher) and model.contains_nrt_meminfo():
            raise NumbaTypeError(
                f"{state.func_id.func_qualname} only borrows arrays, but {called} returns one: "
                "nothing would free it"
            )


@register_pass(mutates_CFG=True, analysis_only=False)  # type: ignore[no-untyped-call]
class Single(FunctionPass):
    """The pass that gives each variable one assignment (numba's ReconstructSSA, shortened)."""

    _name = "single"

    def __init__(self) -> None:
        FunctionPass.__init__(self)  # type: ignore[no-untyped-call]

    def run_pass(self, state: Any) -> bool:
        state.func_ir = SSA.reconstruct_ssa(state.func_ir)
        state.func_ir._definitions = SSA.ir_utils.build_definitions(state.func_ir.blocks)
        return True


@register_pass(mutates_CFG=True, analysis_only=False)  # type: ignore[no-untyped-call]
class Joined(typed_passes.PreLowerStripPhis):
    """The pass that merges these variables again where branches join (numba's, shortened)."""

    _name = "joined"

    def run_pass(self, state: Any) -> bool:
        state.func_ir = self._strip_phi_nodes(state.func_ir)  # type: ignore[no-untyped-call]
        state.func_ir._definitions = SSA.ir_utils.build_definitions(state.func_ir.blocks)
        return True


def front_end(name: str) -> Any:
    """The passes before the generation of code."""
    manager = Passes(name)
    for made in (
        Read,
        untyped_passes.FixupArgs,
        untyped_passes.DeadBranchPrune,
        Constants,
        Single,
        Types,
        Joined,
        typed_passes.IRLegalization,
    ):
        manager.add_pass(made, made.__name__)
    return manager
