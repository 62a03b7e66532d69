"""A kernel that Python calls is compiled as one program with all the kernels it calls.

numba optimises every function by itself, with all that it calls, and turns it into machine code,
though most are never called but by others: what lies deep is compiled again at every level. And
where programs share functions, the one loaded first runs with the others', so that the last bits
depend on the order, and on what was compiled and what was kept. Here functions are optimised once,
in the program they end up in, and programs share nothing.
"""

from __future__ import annotations

import gc
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

from llvmlite.binding import Linkage
from numba.core import typed_passes
from numba.core import untyped_passes as passes
from numba.core.codegen import JITCodeLibrary
from numba.core.compiler import CompilerBase, DefaultPassBuilder
from numba.core.compiler_machinery import PassManager
from numba.core.environment import lookup_environment
from numba.core.registry import CPUDispatcher
from numba.core.types import Array, NestedArray, Record, unliteral
from numba.extending import lower_cast


class _Part(JITCodeLibrary):
    """Code of a function, for programs to link."""

    def _optimize_final_module(self) -> None:
        """Leave it to the program."""

    def _finalize_final_module(self) -> None:
        self._finalize_dynamic_globals()
        self._finalized = True


class _Program(JITCodeLibrary):
    """Code of a function with all that it calls."""

    def _optimize_final_module(self) -> None:
        """Hide the parts, which others would else take for theirs, and optimise the whole."""
        for function in self._final_module.functions:
            if function.linkage == Linkage.linkonce_odr and not function.is_declaration:
                function.linkage = Linkage.private
        super()._optimize_final_module()

    def _finalize_specific(self) -> None:
        """Also give the parts the constants that numba keeps for them, as it does on loading."""
        super()._finalize_specific()
        for variable in self._final_module.global_variables:
            constants = lookup_environment(variable.name)
            if constants is not None:
                self.codegen.set_env(variable.name, constants)


# What numba does for Python that kernels are not written in: closures, `with`, unrolled tuples,
# arguments that may be None, loops it would run on several cores. It takes a tenth of the time.
_NEEDLESS = {
    passes.WithLifting,
    passes.InlineClosureLikes,
    passes.DeadBranchPrune,
    passes.RewriteDynamicRaises,
    passes.MakeFunctionToJitFunction,
    passes.InlineInlinables,
    passes.FindLiterallyCalls,
    passes.LiteralUnroll,
    passes.LiteralPropagationSubPipelinePass,
    typed_passes.InlineOverloads,
    typed_passes.DumpParforDiagnostics,
}


class _KernelCompiler(CompilerBase):
    def define_pipelines(self) -> Any:
        usual = DefaultPassBuilder.define_nopython_pipeline(self.state)
        pipeline = PassManager("kernel")
        pipeline.passes = [one for one in usual.passes if one[0] not in _NEEDLESS]
        pipeline.finalize()
        return [pipeline]


class _PartCompiler(_KernelCompiler):
    def define_pipelines(self) -> Any:
        state = self.state
        state.flags.no_compile = state.flags.no_cpython_wrapper = True
        state.library = _Part(state.targetctx.codegen(), state.func_id.func_qualname)
        return super().define_pipelines()


class _ProgramCompiler(_KernelCompiler):
    def define_pipelines(self) -> Any:
        state = self.state
        state.library = _Program(state.targetctx.codegen(), state.func_id.func_qualname)
        state.library.enable_object_caching()
        return super().define_pipelines()


class Program(CPUDispatcher):
    """What Python calls; its machine code is kept."""

    def __init__(self, function: Any, options: dict[str, Any]) -> None:
        super().__init__(function, targetoptions=options, pipeline_class=_ProgramCompiler)
        self.enable_caching()

    def compile(self, signature: Any) -> Any:
        with _without_collection(), _with_short_names():
            return super().compile(signature)


class Kernel(CPUDispatcher):
    """What other kernels call; Python calls its `program`."""

    def __init__(self, function: Any, options: dict[str, Any]) -> None:
        options = options | {"no_cfunc_wrapper": True}
        super().__init__(function, targetoptions=options, pipeline_class=_PartCompiler)
        self.program = Program(function, options)

    def __call__(self, *args: Any) -> Any:
        return self.program(*args)

    def get_call_template(self, args: Any, kws: Any) -> Any:
        """Constants and known lengths need no code of their own: the optimiser sees them."""
        plain = {name: _plain(kind) for name, kind in kws.items()}
        return super().get_call_template(tuple(map(_plain, args)), plain)

    def add_overload(self, result: Any) -> None:
        """Let kernels find the code; they know it by a key, for it has no address."""
        key = object()
        self.targetctx.insert_user_function(key, result.fndesc, [result.library])
        self.overloads[result.signature.args] = result._replace(entry_point=key)


def _plain(kind: Any) -> Any:
    """What an argument is apart from its value and its length."""
    if isinstance(kind, NestedArray):
        return Array(kind.dtype, kind.ndim, "C")
    return unliteral(kind)


@lower_cast(NestedArray, Array)
def _forget_length(context: Any, builder: Any, known: Any, plain: Any, value: Any) -> Any:
    return value


@contextmanager
def _without_collection() -> Iterator[None]:
    """Let no garbage be collected: it takes a tenth of the time, and finds next to nothing."""
    collecting = gc.isenabled()
    gc.disable()
    try:
        yield
    finally:
        if collecting:
            gc.enable()


@contextmanager
def _with_short_names() -> Iterator[None]:
    """Let records be told by name.

    numba describes the arguments of a function at every pass over it, in case someone listens:
    records within records field by field, which takes another tenth of the time.
    """
    kind: Any = Record
    describe = kind.__repr__
    kind.__repr__ = lambda record: record.name
    try:
        yield
    finally:
        kind.__repr__ = describe
