"""The entry by which Python calls kernels: arguments have known types and are only borrowed.

numba's own entry checks each argument and counts references to it, which takes as long as ten steps
of a small scene, and it generates several blocks of code for each. Here the caller holds the
references and has checked the types (`vv.engines.kernels.compiled.entry`). If the memory layout of
objects is not the expected one (`layout.py`), kernels use numba's own entry.
"""

from __future__ import annotations

import functools
from typing import Any

from llvmlite import ir
from numba.core import cgutils, types

from vv.engines.kernels.bundle_types import Bundle, filled
from vv.engines.kernels.compiler import layout
from vv.engines.kernels.compiler.folding import Folding, together

CODE: Any = cgutils
TUPLE: Any = types.BaseTuple
WORD = ir.IntType(64)
BYTES: Any = ir.IntType(8).as_pointer()


def is_plain(described: Any) -> bool:
    """Whether a function can have this entry: it returns an integer and has no default arguments.

    The memory layout of arguments must also be known.
    """
    if not layout.is_known():
        return False
    given = not any(isinstance(kind, types.Omitted) for kind in described.argtypes)
    return given and isinstance(described.restype, types.Integer)


def add_entry(context: Any, library: Any, described: Any) -> None:
    """Add the entry to a library, in place of numba's own."""
    module, kinds = context.create_module("wrapper"), described.argtypes
    python = context.get_argument_type(types.pyobject)
    kind = ir.FunctionType(python, [python] * 3)  # module, arguments, keyword names
    outer = ir.Function(module, kind, described.llvm_cpython_wrapper_name)
    builder = Folding(outer.append_basic_block("entry"))
    api, found = context.get_python_api(builder), outer.args[1]
    refuse_unless(builder, api, api.tuple_size(found), len(kinds))
    given = Given(context, builder, api)
    args = given.items(kinds, found)
    with CODE.if_unlikely(builder, given.wrong):
        given.free()
        builder.ret(api.get_null_object())
    call = context.call_conv
    wanted = call.get_function_type(described.restype, kinds)
    inner = ir.Function(module, wanted, described.llvm_func_name)
    status, value = call.call_function(
        builder, inner, described.restype, kinds, args, attrs=("noinline",)
    )
    given.free()
    with builder.if_then(status.is_ok, likely=True):
        builder.ret(api.from_native_return(described.restype, value, None))
    call.raise_error(builder, api, status)
    builder.ret(api.get_null_object())
    library.add_ir_module(module)


def refuse_unless(builder: Any, api: Any, found: Any, wanted: int) -> None:
    """Generate the code that raises TypeError for a wrong number of arguments."""
    with CODE.if_unlikely(builder, builder.icmp_signed("!=", found, found.type(wanted))):
        api.err_set_string("PyExc_TypeError", f"this kernel takes {wanted} arguments")
        builder.ret(api.get_null_object())


def word(builder: Any, base: Any, offset: int, kind: Any) -> Any:
    """The value of a type at an offset [bytes] from a pointer."""
    place = builder.gep(builder.bitcast(base, BYTES), [WORD(offset)])
    return builder.load(builder.bitcast(place, kind.as_pointer()))


class Given:
    """Generates the code that reads values from Python objects.

    wrong: whether a number could not be read; bundles: the bundles made, as pairs with their types.
    """

    def __init__(self, context: Any, builder: Any, api: Any) -> None:
        self.context, self.builder, self.api = context, builder, api
        self.wrong: Any = CODE.false_bit
        self.bundles: list[tuple[Any, Any]] = []

    def value(self, kind: Any, found: Any) -> Any:
        """The value of an object of a given numba type."""
        if isinstance(kind, types.Array):
            return self.array(kind, found)
        if isinstance(kind, TUPLE):
            return self.context.make_tuple(self.builder, kind, self.items(kind, found))
        if isinstance(kind, Bundle):
            before = len(self.bundles)
            fields = self.items([wanted for _, wanted in kind._fields], found)
            made = filled(self.context, self.builder, kind, fields)
            del self.bundles[before:]  # those among its fields, which are freed with it
            self.bundles.append((kind, made))
            return made
        native = self.api.to_native_value(kind, found)
        self.wrong = self.builder.or_(self.wrong, native.is_error)
        return native.value

    def items(self, kinds: Any, whole: Any) -> list[Any]:
        """The values of the items of a tuple."""
        places = (
            word(self.builder, whole, layout.ITEMS + 8 * k, whole.type) for k in range(len(kinds))
        )
        return [self.value(kind, place) for kind, place in zip(kinds, places, strict=True)]

    def array(self, kind: Any, found: Any) -> Any:
        """An array without a counted reference."""
        context, builder = self.context, self.builder
        shape, strides = (
            self.along(kind.ndim, found, first) for first in (layout.SHAPE, layout.STRIDES)
        )
        item, whole = context.get_data_type(kind.dtype), context.get_value_type(kind)
        data = word(builder, found, layout.DATA, item.as_pointer())
        owners = (ir.Constant(owner, None) for owner in whole.elements[:2])
        many, size = functools.reduce(builder.mul, shape), WORD(context.get_abi_sizeof(item))
        axes = (together(builder, ir.ArrayType(WORD, kind.ndim), *n) for n in (shape, strides))
        return together(builder, whole, *owners, many, size, data, *axes)

    def free(self) -> None:
        """Generate the code that frees the bundles."""
        for kind, made in self.bundles:
            self.context.nrt.decref(self.builder, kind, made)

    def along(self, axes: int, found: Any, offset: int) -> list[Any]:
        """The numbers, one for each axis, to which the pointer at an offset points."""
        first = word(self.builder, found, offset, WORD.as_pointer())
        return [word(self.builder, first, 8 * axis, WORD) for axis in range(axes)]
