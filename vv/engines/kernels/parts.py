"""Compiles functions that kernels call to no machine code of their own, but within kernels alone.

numba optimises each function, with all that it calls, and makes machine code of it, and does so
again for those that call it; most of that work is for code that nobody runs. A `Part` is
only linked; a `Whole`, which can be called from Python, links each of its parts once.
"""

from __future__ import annotations

import gc
from collections.abc import Iterator
from typing import Any

from numba.core import codegen, compiler, typed_passes
from numba.core.compiler_machinery import LoweringPass, register_pass
from numba.core.environment import lookup_environment

ENVIRONMENT = "_ZN08NumbaEnv"  # how numba begins the names of what functions refer to at run time


class Part(codegen.JITCodeLibrary):
    """A function to be linked, and what it calls."""

    def _optimize_functions(self, ll_module: Any) -> None:
        ll_module.data_layout = self._codegen._data_layout
        passes, builder = self._codegen._function_pass_manager()
        for function in ll_module.functions:
            if not function.is_declaration:
                passes.run(function, builder)

    def finalize(self) -> None:
        """Let kernels link it more than once."""
        for function in self._final_module.functions:
            if not function.is_declaration and function.linkage.name == "external":
                function.linkage = "linkonce_odr"
        self._finalized = True

    def _get_module_for_linking(self) -> Any:
        """With all that it calls, for what is no `Whole`."""
        self._ensure_finalized()
        if self._shared_module is None:
            self._shared_module = self._final_module.clone()
            for library in linked(self._linking_libraries, set()):
                self._shared_module.link_in(module_of(library), preserve=True)
        return self._shared_module


class Whole(codegen.JITCodeLibrary):
    """A function that becomes machine code, together with all its parts."""

    def finalize(self) -> None:
        """Link each part once, then do what numba does."""
        for library in linked(self._linking_libraries, set()):
            self._reload_init.update(library._reload_init)
            self._final_module.link_in(module_of(library), preserve=True)
        self._linking_libraries = []
        super().finalize()


def linked(libraries: list[Any], seen: set[Any]) -> Iterator[Any]:
    """Libraries, and those that parts among them link, each once."""
    for library in libraries:
        if library not in seen:
            seen.add(library)
            yield library
            if isinstance(library, Part):
                yield from linked(library._linking_libraries, seen)


def module_of(library: Any) -> Any:
    """The code of a part alone, or of any other library with all that it calls."""
    if not isinstance(library, Part):
        return library._get_module_for_linking()
    library._ensure_finalized()
    return library._final_module


@register_pass(mutates_CFG=True, analysis_only=False)
class HandOver(LoweringPass):
    """Make a part known to those that call it."""

    _name = "hand_over"

    def __init__(self) -> None:
        LoweringPass.__init__(self)

    def run_pass(self, state: Any) -> bool:
        # numba knows a function by a builtin, which runs its machine code; any of its own will do
        lowered, key = state["cr"], [state.library].append
        state.targetctx.insert_user_function(key, lowered.fndesc, [state.library])
        state["cr"] = lowered._replace(cfunc=key)
        return True


@register_pass(mutates_CFG=True, analysis_only=False)
class Refer(LoweringPass):
    """Set what the parts of a whole refer to at run time."""

    _name = "refer"

    def __init__(self) -> None:
        LoweringPass.__init__(self)

    def run_pass(self, state: Any) -> bool:
        for variable in state.library._final_module.global_variables:
            if variable.name.startswith(ENVIRONMENT):
                found = lookup_environment(variable.name)
                if found is not None:
                    state.library.codegen.set_env(variable.name, found)
        return True


class PartCompiler(compiler.CompilerBase):
    """numba's pipeline, but for its end."""

    def define_pipelines(self) -> list[Any]:
        """As numba wants them."""
        state = self.state
        state.library = Part(state.targetctx.codegen(), state.func_id.func_qualname)
        state.flags.no_compile = True
        pipeline = compiler.DefaultPassBuilder.define_nopython_pipeline(state)
        pipeline.add_pass_after(HandOver, typed_passes.NativeLowering)
        pipeline.finalize()
        return [pipeline]


class WholeCompiler(compiler.CompilerBase):
    """numba's pipeline, but for the library."""

    def define_pipelines(self) -> list[Any]:
        """As numba wants them."""
        state = self.state
        state.library = Whole(state.targetctx.codegen(), state.func_id.func_qualname)
        state.library.enable_object_caching()
        pipeline = compiler.DefaultPassBuilder.define_nopython_pipeline(state)
        pipeline.add_pass_after(Refer, typed_passes.NativeLowering)
        pipeline.finalize()
        return [pipeline]

    def _compile_core(self) -> Any:
        """Compile without looking for garbage, of which there is little among very much else."""
        collects = gc.isenabled()
        gc.disable()
        try:
            return super()._compile_core()
        finally:
            if collects:
                gc.enable()
