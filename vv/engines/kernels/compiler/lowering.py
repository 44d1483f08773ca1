"""numba's lowering, which resolves the types of arithmetic and array elements only once."""

from __future__ import annotations

from collections import defaultdict
from typing import Any

from numba.core import cgutils, lowering, typed_passes
from numba.core import ir as numba_ir
from numba.core.compiler_machinery import register_pass
from numba.core.errors import NumbaError

from vv.engines.kernels.compiler.counting import holds_references
from vv.engines.kernels.compiler.direct import Direct, MayRaiseError, declared
from vv.engines.kernels.compiler.folding import Folding
from vv.engines.kernels.compiler.lean import element, names_element, set_element
from vv.engines.kernels.compiler.passes import ARITHMETIC, SCALARS

BASE: Any = lowering.Lower
CODE: Any = cgutils


class Lower(BASE):  # type: ignore[misc]
    """Generates the code of a function."""

    known: dict[Any, Any] = {}  # signatures of arithmetic, which never change  # noqa: RUF012

    @property
    def call_conv(self) -> Any:
        """The calling convention of the present function."""
        return Direct(self.context) if self.context.direct else self.context.call_conv

    def setup_function(self, fndesc: Any) -> None:
        """Start the code of a function."""
        if self.context.direct:
            self.function = declared(self.context, self.module, fndesc)
            self.entry_block = self.function.append_basic_block("entry")
            self.builder = Folding(self.entry_block)
            self.call_helper = None
        else:
            super().setup_function(fndesc)
            self.builder.__class__ = Folding

    def lower_block(self, block: Any) -> None:
        """Generate the code of all statements of a block."""
        self.pre_block(block)
        try:
            for statement in block.body:
                self.loc = statement.loc
                self.lower_inst(statement)
        except NumbaError as error:
            error.add_context(f"generating the code of {statement} at {self.loc}")
            raise
        self.post_block(block)

    def lower_inst(self, inst: Any) -> None:
        """Generate the code of one statement."""
        if isinstance(inst, numba_ir.Assign):
            name, value = inst.target.name, inst.value
            argument = value.index + 1 if isinstance(value, numba_ir.Arg) else None
            self.storevar(self.lower_assign(self.typeof(name), inst), name, argument)
        elif isinstance(inst, numba_ir.Del):
            self.delvar(inst.value)
        elif self.context.direct and isinstance(inst, numba_ir.Return):
            self.builder.ret(self.loadvar(inst.value.name))
        else:
            super().lower_inst(inst)

    def _find_singly_assigned_variable(self) -> None:
        """Find the variables that need no memory: those set once that hold no counted references.

        A variable with references needs none either, if it is freed in the block that sets it.
        """
        self._blk_local_varmap: dict[str, Any] = {}
        self._singly_assigned_vars = {
            name
            for name, places, ends in lives(self.blocks)
            if len(places) == 1 and (not self.is_counted(name) or ends == set(places))
        }

    def loadvar(self, name: str) -> Any:
        """The code for the value of a variable."""
        if name in self._blk_local_varmap:
            return self._blk_local_varmap[name]
        self._singly_assigned_vars.discard(name)  # its use is generated before its assignment
        return super().loadvar(name)

    def lower_binop(self, resty: Any, expr: Any, op: Any) -> Any:
        """The code of an operation on two values."""
        wanted = self.fndesc.calltypes[expr]
        if op not in ARITHMETIC or not all(isinstance(kind, SCALARS) for kind in wanted.args):
            return super().lower_binop(resty, expr, op)
        function = self.context.typing_context.resolve_value_type(op)
        key = (op, *wanted.args)
        if key not in self.known:
            typing = self.context.typing_context
            self.known[key] = function.get_call_type(typing, wanted.args, {})
        values = [
            self._cast_var(v, k) for v, k in zip((expr.lhs, expr.rhs), wanted.args, strict=True)
        ]
        made = self.context.get_function(function, self.known[key])(self.builder, values)
        return self.context.cast(self.builder, made, wanted.return_type, resty)

    def lower_getitem(self, resty: Any, expr: Any, value: Any, index: Any, signature: Any) -> Any:
        """The code that reads an element, or a view."""
        if not names_element(*signature.args):
            return super().lower_getitem(resty, expr, value, index, signature)
        values = [self._cast_var(v, k) for v, k in zip((value, index), signature.args, strict=True)]
        made = element(self.context, signature, self.builder, values)
        return self.context.cast(self.builder, made, signature.return_type, resty)

    def lower_setitem(self, target_var: Any, index_var: Any, value_var: Any, signature: Any) -> Any:
        """The code that sets an element, or several."""
        if not (names_element(*signature.args[:2]) and isinstance(signature.args[2], SCALARS)):
            return super().lower_setitem(target_var, index_var, value_var, signature)
        given = zip((target_var, index_var, value_var), signature.args, strict=True)
        values = [self._cast_var(variable, kind) for variable, kind in given]
        return set_element(self.context, signature, self.builder, values)

    def storevar(self, value: Any, name: str, argidx: Any = None) -> None:
        """Set a variable; its old value has to be freed only if it holds counted references."""
        if name in self._singly_assigned_vars or self.is_counted(name):
            super().storevar(value, name, argidx)
        else:
            self._alloca_var(name, self.typeof(name))
            self.builder.store(value, self.getvar(name))

    def delvar(self, name: str) -> None:
        """End the life of a variable."""
        if self.is_counted(name):
            super().delvar(name)

    def is_counted(self, name: str) -> bool:
        """Whether a variable holds counted references."""
        context = self.context
        kind = self.fndesc.typemap[name]
        return context.enable_nrt and holds_references(context.data_model_manager, kind)

    def alloca_lltype(self, name: str, lltype: Any, datamodel: Any = None) -> Any:
        """Memory for a variable, without information for a debugger."""
        if self.is_counted(name):
            return CODE.alloca_once(self.builder, lltype, name=name)  # zero: can be freed
        with self.builder.goto_entry_block():
            return self.builder.alloca(lltype, name=name)


def lives(blocks: Any) -> list[tuple[str, list[Any], set[Any]]]:
    """Each variable, the blocks of its assignments, and the blocks in which its life ends."""
    places: dict[str, list[Any]] = defaultdict(list)
    ends: dict[str, set[Any]] = defaultdict(set)
    for label, block in blocks.items():
        for statement in block.body:
            if isinstance(statement, numba_ir.Assign):
                places[statement.target.name].append(label)
            elif isinstance(statement, numba_ir.Del):
                ends[statement.value].add(label)
            elif isinstance(statement, numba_ir.Return):
                ends[statement.value.name].add(label)
    return [(name, places[name], ends[name]) for name in places]


NATIVE: Any = typed_passes.BaseNativeLowering


@register_pass(mutates_CFG=True, analysis_only=False)  # type: ignore[no-untyped-call]
class Write(NATIVE):  # type: ignore[misc]
    """The pass that generates the code of a function."""

    _name = "write"

    @property
    def lowering_class(self) -> Any:
        """The class that generates the code."""
        return Lower

    def run_pass(self, state: Any) -> bool:
        """Generate a function for direct calls, if it is a part and cannot raise."""
        state.targetctx.direct = state.flags.no_compile
        try:
            return bool(super().run_pass(state))
        except MayRaiseError:
            state.targetctx.direct = False
            return bool(super().run_pass(state))
