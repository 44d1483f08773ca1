"""Registers bundles with numba: their type, and the code that makes them and reads their fields.

They have the memory layout of numba's structref. Its fields can be read only by code that counts
references; fields of a bundle can also be read by functions that are `lent` their arguments.
"""

from __future__ import annotations

import hashlib
from typing import Any, cast

from numba.core import cgutils, imputils, types
from numba.core.datamodel import models
from numba.core.typing.templates import AbstractTemplate, AttributeTemplate, signature
from numba.experimental.jitclass.base import imp_dtor
from numba.extending import (
    NativeValue,
    infer_getattr,
    lower_builtin,
    lower_getattr_generic,
    register_model,
    typeof_impl,
    unbox,
)

DATA = 3  # words of numba's MemInfo before the pointer to its data: refct, dtor, dtor_info


class Bundle(types.StructRef):
    """The numba type of a bundle: the named tuple and the types of its fields."""

    def __init__(self, origin: type, kinds: tuple[Any, ...]) -> None:
        names = origin._fields  # type: ignore[attr-defined]
        super().__init__(list(zip(names, kinds, strict=True)))
        # the name is short since numba writes it into every call that it compiles
        digest = hashlib.sha256(f"{origin.__module__}.{self.name}".encode()).hexdigest()[:12]
        self.name = f"{origin.__name__}.{digest}"
        self.instance_class = origin  # the attribute that numba's own type of a named tuple has

    def get_data_type(self) -> Any:
        """The type of the fields to which it points."""
        return types.StructRefPayload(typename=self.name, fields=self._fields)


register_model(Bundle)(cast(Any, models).StructRefModel)


def register(origin: type, made: type) -> None:
    """Register a named tuple with numba, and the class by which kernels make bundles."""
    typeof_impl.register(origin)(typeof_bundle)
    typeof_impl.register(type(made))(typeof_maker)
    lower_builtin(made, types.VarArg(types.Any))(make)


def typeof_bundle(value: Any, context: Any) -> Bundle:
    """The numba type of a named tuple passed from Python."""
    return Bundle(type(value), tuple(typeof_impl(field, context) for field in value))


def typeof_maker(origin: Any, context: Any) -> Any:
    """The numba type of a named tuple's class, which kernels call to make a bundle."""

    class Make(AbstractTemplate):
        key = origin

        def generic(self, args: Any, keywords: Any) -> Any:
            return signature(Bundle(origin, tuple(map(types.unliteral, args))), *args)

    return types.Function(Make)


def make(context: Any, builder: Any, signature: Any, args: Any) -> Any:
    """The code that makes a bundle of given fields, with a new reference to each."""
    kind, fields = signature.return_type, []
    for value, given, (_, wanted) in zip(args, signature.args, kind._fields, strict=True):
        field = context.cast(builder, value, given, wanted)
        if context.enable_nrt:
            context.nrt.incref(builder, wanted, field)
        fields.append(field)
    return filled(context, builder, kind, fields)


def filled(context: Any, builder: Any, kind: Bundle, fields: list[Any]) -> Any:
    """The code that makes a bundle which takes over the references to its fields."""
    payload = context.get_value_type(kind.get_data_type())
    memory = context.nrt.meminfo_alloc_dtor_unchecked(
        builder,
        context.get_constant(types.uintp, context.get_abi_sizeof(payload)),
        imp_dtor(context, builder.module, kind),
    )
    pointer = builder.bitcast(context.nrt.meminfo_data(builder, memory), payload.as_pointer())
    data = cgutils.create_struct_proxy(kind.get_data_type())(context, builder, ref=pointer)
    for (name, _), field in zip(kind._fields, fields, strict=True):
        setattr(data, name, field)
    reference = context.make_helper(builder, kind)
    reference.meminfo = memory
    return reference._getvalue()


@infer_getattr
class Read(AttributeTemplate):
    """The types of fields of bundles that code reads."""

    key = Bundle

    def generic_resolve(self, kind: Bundle, name: str) -> Any:  # type: ignore[override]
        """The type of a field, or None if there is no field of this name."""
        return kind.field_dict.get(name)


@lower_getattr_generic(Bundle)
def read(context: Any, builder: Any, kind: Bundle, value: Any, name: str) -> Any:
    """The code that reads a field; it counts the new reference in code that counts references."""
    word = context.get_value_type(types.voidptr)
    memory = builder.bitcast(builder.extract_value(value, 0), word.as_pointer())
    data = builder.load(
        builder.gep(memory, [context.get_constant(types.intp, DATA)], inbounds=True)
    )
    payload = context.get_value_type(kind.get_data_type()).as_pointer()
    index = list(kind.field_dict).index(name)
    place = cgutils.gep_inbounds(builder, builder.bitcast(data, payload), 0, index)
    wanted = kind.field_dict[name]
    return imputils.impl_ret_borrowed(context, builder, wanted, builder.load(place))


@unbox(Bundle)
def unbox_bundle(kind: Bundle, value: Any, c: Any) -> Any:
    """The code that makes a bundle of a named tuple passed from Python."""
    fields, wrong = [], cgutils.false_bit
    for name, wanted in kind._fields:
        given = c.pyapi.object_getattr_string(value, name)
        native = c.unbox(wanted, given)
        c.pyapi.decref(given)
        fields.append(native.value)
        wrong = c.builder.or_(wrong, native.is_error)
    return NativeValue(filled(c.context, c.builder, kind, fields), is_error=wrong)
