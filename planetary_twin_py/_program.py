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
from numba.core.codegen import JITCodeLibrary
from numba.core.compiler import Compiler
from numba.core.environment import lookup_environment
from numba.core.registry import CPUDispatcher
from numba.core.types import unliteral


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


class _PartCompiler(Compiler):
    def define_pipelines(self) -> Any:
        state = self.state
        state.flags.no_compile = state.flags.no_cpython_wrapper = True
        state.library = _Part(state.targetctx.codegen(), state.func_id.func_qualname)
        return super().define_pipelines()


class _ProgramCompiler(Compiler):
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
        with _without_collection():  # takes a tenth of the time, and finds next to nothing
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
        """A constant argument needs no code of its own: the program's optimiser finds it."""
        plain = {name: unliteral(kind) for name, kind in kws.items()}
        return super().get_call_template(tuple(map(unliteral, args)), plain)

    def add_overload(self, result: Any) -> None:
        """Let kernels find the code; they know it by a key, for it has no address."""
        key = object()
        self.targetctx.insert_user_function(key, result.fndesc, [result.library])
        self.overloads[result.signature.args] = result._replace(entry_point=key)


@contextmanager
def _without_collection() -> Iterator[None]:
    """Let no garbage be collected."""
    collecting = gc.isenabled()
    gc.disable()
    try:
        yield
    finally:
        if collecting:
            gc.enable()
