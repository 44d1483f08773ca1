"""numba's lowering, which types arithmetic and elements of arrays once, not at every mention."""

from __future__ import annotations

from typing import Any

from numba.core import cgutils, lowering, typed_passes
from numba.core.compiler_machinery import register_pass

from vv.engines.kernels.lean import element, names_element, set_element
from vv.engines.kernels.passes import ARITHMETIC, SCALARS

BASE: Any = lowering.Lower
CODE: Any = cgutils


class Lower(BASE):  # type: ignore[misc]
    """Writes the code of a function."""

    known: dict[Any, Any] = {}  # signatures of arithmetic, which are the same for ever  # noqa: RUF012

    def lower_binop(self, resty: Any, expr: Any, op: Any) -> Any:
        """One operation on two values."""
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
        """An element, or a view."""
        if not names_element(*signature.args):
            return super().lower_getitem(resty, expr, value, index, signature)
        values = [self._cast_var(v, k) for v, k in zip((value, index), signature.args, strict=True)]
        made = element(self.context, signature, self.builder, values)
        return self.context.cast(self.builder, made, signature.return_type, resty)

    def lower_setitem(self, target_var: Any, index_var: Any, value_var: Any, signature: Any) -> Any:
        """Set an element, or several."""
        if not (names_element(*signature.args[:2]) and isinstance(signature.args[2], SCALARS)):
            return super().lower_setitem(target_var, index_var, value_var, signature)
        given = zip((target_var, index_var, value_var), signature.args, strict=True)
        values = [self._cast_var(variable, kind) for variable, kind in given]
        return set_element(self.context, signature, self.builder, values)

    def storevar(self, value: Any, name: str, argidx: Any = None) -> None:
        """Set a variable; what it was needs to be freed only where references are counted."""
        if name in self._singly_assigned_vars or self.is_counted(name):
            super().storevar(value, name, argidx)
        else:
            self._alloca_var(name, self.typeof(name))
            self.builder.store(value, self.getvar(name))

    def delvar(self, name: str) -> None:
        """Forget a variable."""
        if self.is_counted(name):
            super().delvar(name)
        elif name not in self._blk_local_varmap:
            self._singly_assigned_vars.discard(name)
            self._alloca_var(name, self.typeof(name))

    def is_counted(self, name: str) -> bool:
        """Whether references to what a variable holds are counted."""
        if not self.context.enable_nrt:
            return False
        return bool(self.context.data_model_manager[self.typeof(name)].contains_nrt_meminfo())

    def alloca_lltype(self, name: str, lltype: Any, datamodel: Any = None) -> Any:
        """Room for a variable; nothing is noted for a debugger."""
        return CODE.alloca_once(self.builder, lltype, name=name)


NATIVE: Any = typed_passes.BaseNativeLowering


@register_pass(mutates_CFG=True, analysis_only=False)  # type: ignore[no-untyped-call]
class Write(NATIVE):  # type: ignore[misc]
    """Write the code of a function."""

    _name = "write"

    @property
    def lowering_class(self) -> Any:
        """What writes it."""
        return Lower
