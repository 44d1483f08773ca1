"""Compiles functions that kernels call within the kernels only, without machine code of their own.

numba optimises each function together with all its callees and generates machine code, and repeats
this for each caller, although most of that code never runs. A `Part` is only linked into others; a
`Whole`, which can be called from Python, links each of its parts once.
"""

from __future__ import annotations

import gc
from typing import Any

from llvmlite import binding as llvm
from numba.core import codegen, compiler, typed_passes
from numba.core.compiler_machinery import LoweringPass, register_pass
from numba.core.environment import lookup_environment

from vv.engines.kernels.compiler.direct import call_that_raises, direct_call
from vv.engines.kernels.compiler.lean import Lean
from vv.engines.kernels.compiler.lowering import Write
from vv.engines.kernels.compiler.manager import without_events
from vv.engines.kernels.compiler.passes import CachedFlags, front_end

ENVIRONMENT = "_ZN08NumbaEnv"  # how numba begins the names of what functions refer to at run time


class Part(codegen.JITCodeLibrary):
    """A library with a function to be linked, and its callees."""

    def _optimize_functions(self, ll_module: Any) -> None:
        ll_module.data_layout = self._codegen._data_layout
        passes, builder = self._codegen._function_pass_manager()
        for function in ll_module.functions:
            if not function.is_declaration:
                passes.run(function, builder)

    def finalize(self) -> None:
        """Allow kernels to link it more than once."""
        for function in self._final_module.functions:
            if not function.is_declaration and function.linkage.name == "external":
                function.linkage = "linkonce_odr"
        self._finalized = True

    def _get_module_for_linking(self) -> Any:
        """The module with all callees, for a caller that is no `Whole`."""
        self._ensure_finalized()
        if self._shared_module is None:
            self._shared_module = self._final_module.clone()
            for library in linked(self._linking_libraries):
                self._shared_module.link_in(module_of(library), preserve=True)
        return self._shared_module


class Whole(codegen.JITCodeLibrary):
    """A library with a function that becomes machine code, together with all its parts."""

    def _optimize_functions(self, ll_module: Any) -> None:
        """Leave it to the passes over the whole, which numba has here once more."""
        ll_module.data_layout = self._codegen._data_layout

    def finalize(self) -> None:
        """Link each part once, then proceed as numba does."""
        for library in linked(self._linking_libraries):
            self._reload_init.update(library._reload_init)
            self._final_module.link_in(module_of(library), preserve=True)
        self._linking_libraries = []
        super().finalize()


class Tuned(Whole):
    """A whole with other optimisations than those of numba."""

    unrolls, joins = True, False  # loops; equal operations on neighbours in memory

    def _optimize_final_module(self) -> None:
        ours = self._codegen
        first, told = ours._module_pass_manager(loop_vectorize=False, opt=0, cost="cheap")
        first.run(self._final_module, told)
        tuned = llvm.create_pipeline_tuning_options(speed_level=3)
        tuned.loop_unrolling, tuned.slp_vectorization = self.unrolls, self.joins
        told = llvm.create_pass_builder(ours._tm, tuned)
        passes = told.getModulePassManager()
        passes.add_refprune_pass()
        passes.run(self._final_module, told)


class Branching(Tuned):
    """A whole with short loops, which are not unrolled."""

    unrolls = False


class Joining(Tuned):
    """A whole in which equal operations on neighbours in memory are vectorised."""

    joins = True


def linked(libraries: list[Any]) -> list[Any]:
    """Libraries and the callees of parts among them, each once and after all its callers.

    A function that nobody needs as it is linked is left out, for good.
    """
    found: dict[Any, None] = {}
    entered = set()

    def enter(library: Any) -> None:
        if library not in entered:
            entered.add(library)
            for called in library._linking_libraries if isinstance(library, Part) else ():
                enter(called)
            found[library] = None

    for library in libraries:
        enter(library)
    return [*reversed(found)]


def module_of(library: Any) -> Any:
    """The module of a part alone, or of any other library with all its callees."""
    if not isinstance(library, Part):
        return library._get_module_for_linking()
    library._ensure_finalized()
    return library._final_module


def pipeline(name: str, last: type) -> Any:
    """All passes of a compilation; `last` is the pass after the generation of code."""
    manager = front_end(name)
    manager.add_pass(Write, Write.__name__)
    manager.add_pass(last, last.__name__)
    manager.add_pass(typed_passes.NoPythonBackend, "backend")
    manager.finalize()
    return manager


@register_pass(mutates_CFG=True, analysis_only=False)
class HandOver(LoweringPass):
    """The pass that makes a part known to its callers."""

    _name = "hand_over"

    def __init__(self) -> None:
        LoweringPass.__init__(self)

    def run_pass(self, state: Any) -> bool:
        # numba identifies a function by the builtin that runs it; any unique builtin will do
        lowered, key = state["cr"], [state.library].append
        write = direct_call if state.targetctx.direct else call_that_raises
        call = write(lowered.fndesc, state.library)
        state.targetctx._defns[key].append(call, call.signature)
        state["cr"] = lowered._replace(cfunc=key)
        return True


@register_pass(mutates_CFG=True, analysis_only=False)
class Refer(LoweringPass):
    """The pass that sets the objects to which the parts of a whole refer at run time."""

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


class OwnCompiler(compiler.CompilerBase):
    """numba's compiler with flags that are compared quickly."""

    def __init__(
        self, typing: Any, target: Any, library: Any, args: Any, kind: Any, flags: Any, local: Any
    ) -> None:
        super().__init__(typing, target, library, args, kind, CachedFlags(flags), local)
        self.state.targetctx.__class__ = Lean  # a copy for these flags, which is used nowhere else


class PartCompiler(OwnCompiler):
    """Compiles a part."""

    def define_pipelines(self) -> list[Any]:
        """The pipelines of passes; the name is numba's."""
        state = self.state
        state.library = Part(state.targetctx.codegen(), state.func_id.func_qualname)
        state.flags.no_compile = True
        return [pipeline("part", HandOver)]


class WholeCompiler(OwnCompiler):
    """Compiles a whole."""

    library: type[Whole] = Whole

    def define_pipelines(self) -> list[Any]:
        """The pipelines of passes; the name is numba's."""
        state = self.state
        state.library = self.library(state.targetctx.codegen(), state.func_id.func_qualname)
        state.library.enable_object_caching()
        return [pipeline("whole", Refer)]

    def _compile_core(self) -> Any:
        """Compile without garbage collection, which would find little among very many objects."""
        collects = gc.isenabled()
        gc.disable()
        try:
            with without_events():
                return super()._compile_core()
        finally:
            if collects:
                gc.enable()


class BranchingCompiler(WholeCompiler):
    """Compiles a whole with short loops."""

    library = Branching


class JoiningCompiler(WholeCompiler):
    """Compiles a whole in which equal operations on neighbours in memory are vectorised."""

    library = Joining
