"""Generates the code for elements of arrays and for `range`, a third as long as numba's.

Most code of kernels reads elements in loops. For these numba generates copies of whole arrays in
memory and iterators with a state, which LLVM then has to remove.
"""

from __future__ import annotations

import functools
import hashlib
import operator
from collections.abc import Callable
from typing import Any

from llvmlite import ir
from numba.core import cgutils as numba_code
from numba.core import types
from numba.core.cpu import CPUContext

from vv.engines.kernels.compiler.counting import Counting
from vv.engines.kernels.compiler.direct import CONVENTION, Outward
from vv.engines.kernels.compiler.entry import add_entry, is_plain
from vv.engines.kernels.compiler.folding import together

CODE: Any = numba_code
TUPLE: Any = types.BaseTuple
NUMBA: Any = CPUContext
BUFFER, SHAPE, STRIDES = 4, 5, 6  # the positions of these words in an array
RANGES = (types.range_state32_type, types.range_state64_type)
COUNTS = (types.range_iter32_type, types.range_iter64_type)
NUMBERS = (types.Float, types.Integer, types.Boolean)


class Lean(CPUContext):
    """numba's code generator, except for the code that this module generates.

    direct: whether the present function is called directly.
    """

    direct = False

    @property
    def call_conv(self) -> Any:
        """The calling convention of numba's own functions."""
        return Outward(self) if self.direct else CONVENTION(self)

    def get_function(self, function: Any, signature: Any, _firstcall: bool = True) -> Any:
        """The generator of the code of a call."""
        ours = generator_of(function, signature)
        if ours is None:
            return NUMBA.get_function(self, function, signature, _firstcall)
        return functools.partial(ours, self, signature)

    def mangler(self, name: Any, types: Any, *, abi_tags: Any = (), uid: Any = None) -> str:
        """The name of a function in LLVM, as a digest; numba's names spell out all types."""
        told = ", ".join(map(str, (name, *types, *abi_tags, uid)))
        short = f"f{hashlib.sha256(told.encode()).hexdigest()[:24]}"
        return f"_ZN{len(short)}{short}E"

    @property
    def nrt(self) -> Any:
        """The generator of the code that counts references."""
        return Counting(self, self.enable_nrt)

    def get_constant_generic(self, builder: Any, ty: Any, val: Any) -> Any:
        """A constant; a function of a kernel needs none, since its type identifies it in calls."""
        if isinstance(ty, types.Dispatcher):
            return NUMBA.get_dummy_value(self)
        return NUMBA.get_constant_generic(self, builder, ty, val)

    def create_cpython_wrapper(
        self, library: Any, fndesc: Any, env: Any, call_helper: Any, release_gil: bool = False
    ) -> None:
        """Add the entry for calls from Python to a library."""
        if is_plain(fndesc):
            add_entry(self, library, fndesc)
        else:
            NUMBA.create_cpython_wrapper(self, library, fndesc, env, call_helper, release_gil)

    def get_abi_sizeof(self, ty: Any) -> int:
        """The size of an LLVM type in bytes, which is asked for once."""
        return sizeof(str(ty), lambda: NUMBA.get_abi_sizeof(self, ty))


SIZES: dict[str, int] = {}  # of LLVM types in bytes, by name


def sizeof(name: str, look: Callable[[], int]) -> int:
    """The size in bytes of the type of this name; look: finds it at first."""
    if name not in SIZES:
        SIZES[name] = look()
    return SIZES[name]


def generator_of(function: Any, signature: Any) -> Any:
    """The function of this module that generates the code of a call, or None."""
    args = signature.args
    if function == "getiter" and args[0] in RANGES:
        return range_iterator
    if function == "iternext" and args[0] in COUNTS:
        return next_in_range
    if isinstance(function, types.Function):
        for key, fits, ours in CALLS:
            if function.typing_key is key and fits(signature):
                return ours
    return None


def names_element(array: Any, index: Any) -> bool:
    """Whether an index selects a single number of an array."""
    if not (isinstance(array, types.Array) and array.layout in "CA" and array.aligned):
        return False
    kinds = index.types if isinstance(index, TUPLE) else (index,)
    return (
        isinstance(array.dtype, NUMBERS)
        and len(kinds) == array.ndim
        and all(isinstance(kind, types.Integer) for kind in kinds)
    )


def place_of(context: Any, builder: Any, kinds: Any, array: Any, index: Any) -> Any:
    """The code for the address of an element; negative indices count from the end."""
    many = kinds[1].types if isinstance(kinds[1], TUPLE) else (kinds[1],)
    given = CODE.unpack_tuple(builder, index) if isinstance(kinds[1], TUPLE) else [index]
    at: Any = None
    for axis, (kind, value) in enumerate(zip(many, given, strict=True)):
        here = context.cast(builder, value, kind, types.intp)
        if kind.signed and not (isinstance(kind, types.Literal) and kind.literal_value >= 0):
            size = builder.extract_value(array, [SHAPE, axis])
            negative = builder.icmp_signed("<", here, here.type(0))
            here = builder.select(negative, builder.add(size, here), here)
        if kinds[0].layout == "A":
            here = builder.mul(here, builder.extract_value(array, [STRIDES, axis]))
        elif at is not None:
            at = builder.mul(at, builder.extract_value(array, [SHAPE, axis]))
        at = here if at is None else builder.add(at, here)
    data = builder.extract_value(array, BUFFER)
    if kinds[0].layout == "A":
        return CODE.pointer_add(builder, data, at)
    return builder.gep(data, [at])


def element(context: Any, signature: Any, builder: Any, args: Any, loc: Any = None) -> Any:
    """The code for array[index]."""
    place = place_of(context, builder, signature.args, *args)
    return context.unpack_value(builder, signature.args[0].dtype, place)


def set_element(context: Any, signature: Any, builder: Any, args: Any, loc: Any = None) -> None:
    """The code for array[index] = value."""
    kind = signature.args[0].dtype
    value = context.cast(builder, args[2], signature.args[2], kind)
    place = place_of(context, builder, signature.args, *args[:2])
    context.pack_value(builder, kind, value, place)


def length(context: Any, signature: Any, builder: Any, args: Any, loc: Any = None) -> Any:
    """The code for len(array)."""
    return builder.extract_value(args[0], [SHAPE, 0])


def make_range(context: Any, signature: Any, builder: Any, args: Any, loc: Any = None) -> Any:
    """The code for range(last) or range(first, last)."""
    word = args[0].type
    first = word(0) if len(args) == 1 else args[0]
    kind = context.get_value_type(signature.return_type)
    return together(builder, kind, first, args[-1], word(1))


def range_iterator(context: Any, signature: Any, builder: Any, args: Any, loc: Any = None) -> Any:
    """The code for the iterator of a range; its counter starts a step before the first number."""
    last = args[0]
    if not (isinstance(last, ir.instructions.InsertValue) and steps_by_one(last)):
        made = NUMBA.get_function(context, "getiter", signature)(builder, args)
        now, step = (builder.extract_value(made, place) for place in (0, 2))
        builder.store(builder.sub(builder.load(now), step), now)
        return made
    first, end = (builder.extract_value(last, place) for place in (0, 1))
    with builder.goto_entry_block():
        now, left = builder.alloca(first.type), builder.alloca(first.type)
    builder.store(builder.sub(first, first.type(1)), now)
    some = builder.icmp_signed(">", end, first)
    builder.store(builder.select(some, builder.sub(end, first), first.type(0)), left)
    return together(
        builder, context.get_value_type(signature.return_type), now, end, first.type(1), left
    )


def steps_by_one(made: Any) -> bool:
    """Whether the last word that was inserted into a range, its step, is one."""
    step = made.operands[1]
    return list(made.indices) == [2] and isinstance(step, ir.Constant) and step.constant == 1


def next_in_range(context: Any, signature: Any, builder: Any, args: Any, loc: Any = None) -> Any:
    """The code for the next number of a range, and for whether there is one.

    The stored counter is the number itself: LLVM can then prove that it is not negative if the
    first is not, and that the elements which it indexes are contiguous.
    """
    now, step, left = (builder.extract_value(args[0], place) for place in (0, 2, 3))
    count, value = builder.load(left), builder.add(builder.load(now), step, flags=["nsw"])
    there = builder.icmp_signed(">", count, count.type(0))
    builder.store(builder.sub(count, count.type(1), flags=["nsw"]), left)
    builder.store(value, now)
    return together(builder, context.get_value_type(signature.return_type), value, there)


CALLS: tuple[Any, ...] = (
    (range, lambda s: len(s.args) < 3 and s.return_type in RANGES, make_range),
    (len, lambda s: isinstance(s.args[0], types.Array) and s.args[0].ndim, length),
    (operator.getitem, lambda s: names_element(*s.args), element),
    (
        operator.setitem,
        lambda s: names_element(*s.args[:2]) and isinstance(s.args[2], NUMBERS),
        set_element,
    ),
)
