"""Jupyter's own kernel, with the methods of `ForkedKernel`: ours must run cells as it does."""

import json
import sys

from jupyter_client.manager import start_new_kernel
from nbclassroom.autograder.sandbox import bubblewrap
from nbclassroom.autograder.sandbox.cell_run import CellRun

INSIDE = "nbclassroom.autograder.sandbox.inside"
BEGIN = f"""
import sys as _sys
from {INSIDE} import check_cell as _check_cell, package_stub, refusal as _refusal
_sys.modules |= {{{{"imgproc_course.display": package_stub, "imgproc_course.exercises": package_stub}}}}
__import__("builtins").input = _check_cell.refuse_input
_refusal.allow_modules({{allowed!r}})
import numpy as np
__import__("random").seed(0), np.random.seed(0)
"""


class JupyterKernel:
    """An ipykernel for the checks of an exercise."""

    def __init__(self, allowed):
        environment = bubblewrap.environment(confined=False) | {
            "PATH": "/usr/bin:/bin",
            "JUPYTER_PATH": f"{sys.prefix}/share",
        }
        self._manager, self._client = start_new_kernel(env=environment)
        self.run(BEGIN.format(allowed=allowed))

    def run(self, code):
        run = CellRun()

        def add(message):
            kind = message["msg_type"]
            if kind in ("stream", "display_data", "execute_result", "error"):
                run.add(kind, message["content"])

        try:
            options = {"store_history": False, "allow_stdin": False, "stop_on_error": False, "timeout": 60}
            reply = self._client.execute_interactive(code, output_hook=add, **options)["content"]
        except RuntimeError:
            run.ended = "crashed"
        else:
            run.add("idle", {"ename": "", "evalue": ""} | reply)
        return run

    def run_check(self, code, inputs, seconds):
        case = {"calls": inputs, "seconds": seconds}
        run = self.run(
            f"import json\nfrom {INSIDE} import check_cell as _check_cell\n"
            f"_check_cell.deliver(json.loads({json.dumps(case)!r}))"
        )
        return run if run.ended else self.run(code)

    def stop(self):
        self._client.stop_channels()
        self._manager.shutdown_kernel(now=True)


class JupyterFactory:
    """Starts them as `KernelFactory` does, without one that waits."""

    def __enter__(self):
        return self

    def __exit__(self, *_error):
        pass

    def start(self, allowed, seconds, *, alone=False):
        return JupyterKernel(allowed)


class JupyterKernels(JupyterFactory):
    """A new kernel for each check, which has run a page's cells as Run All does; see `PageKernels`."""

    def __init__(self, page):
        self._page = page

    def open_check(self, exercise, seconds, *, alone=False):
        kernel, last = JupyterKernel(exercise.allowed), self._page["checks"][exercise.id][0]
        runs = [kernel.run(cell["source"]) for cell in self._page["cells"][:last]]
        errors = [run.error for run in runs if run.error[0]]
        return kernel, CellRun(ended=runs[-1].ended, error=errors[0] if errors else ("", ""))
