"""Stubs for two modules of nbval, loaded before it: to import them takes a part of an nbval process's start.

`nbval.kernel` imports jupyter_client; `nbval_plugin` sets its own kernel in that one's place.
`nbval.cover` imports coverage, which nbval calls only if pytest-cov is active.
"""

import sys
import types


def _stub(module, *names):
    sys.modules[module] = types.ModuleType(module)
    vars(sys.modules[module]).update(dict.fromkeys(names))


_stub("nbval.kernel", "RunningKernel", "CURRENT_ENV_KERNEL_NAME")
_stub("nbval.cover", "setup_coverage", "teardown_coverage")
