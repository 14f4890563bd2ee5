"""The points that `check` gives in a real kernel, in which the cells of a notebook run as in JupyterLab."""

import json
import os
import re
import sys
from ast import literal_eval
from pathlib import Path

from jupyter_client.manager import KernelManager

CALL = "__import__('kernel_points').points_here({functions!r})"
NEW = "__import__('kernel_points').begin_anew()"


class NotebookKernel:
    """One kernel for many notebooks.

    Parameters
    ----------
    checks : Path of the folder of checks files
    """

    def __init__(self, checks):
        paths = [str(Path(__file__).parent), *filter(None, [os.environ.get("PYTHONPATH")])]
        variables = {"NBCLASSROOM_CHECKS": str(checks), "PYTHONPATH": os.pathsep.join(paths)}
        self._manager = KernelManager(kernel_name="python3")
        self._manager.start_kernel(env=os.environ | variables)
        self._client = self._manager.client()
        self._client.start_channels()
        self._client.wait_for_ready(timeout=120)

    def close(self):
        """End the kernel."""
        self._client.stop_channels()
        self._manager.shutdown_kernel(now=True)

    def points(self, cells, functions):
        """({exercise id: [points, text] of its check, run where the notebook has it}, whether a cell failed).

        Parameters
        ----------
        cells : list of the notebook's cells; what is no code is not run
        functions : {exercise id: name of its function}
        """
        self._evaluate(NEW)
        found, has_failed = {}, False
        for cell in cells:
            source = cell.get("source") if isinstance(cell, dict) else None
            if not isinstance(source, str) or cell.get("cell_type") != "code":
                continue
            reply = self._execute(source, cell.get("id"), about=cell.get("metadata"))
            has_failed |= reply["status"] != "ok"
            checked = {id: name for id, name in functions.items() if f'check("{id}"' in source}
            found |= self._evaluate(CALL.format(functions=checked)) if checked else {}
        return found, has_failed

    def _evaluate(self, expression):
        content = self._execute("", None, {"value": expression})["user_expressions"]["value"]
        assert content["status"] == "ok", content
        return json.loads(literal_eval(content["data"]["text/plain"]))

    def _execute(self, source, cell_id, expressions=None, about=None):
        content = {"code": source.encode("utf-8", "replace").decode(), "silent": False}
        content |= {"user_expressions": expressions or {}, "store_history": False, "stop_on_error": False}
        metadata = dict(about) if isinstance(about, dict) else {}  # JupyterLab sends those of the cell
        metadata |= {"cellId": cell_id} if isinstance(cell_id, str) else {}
        message = self._client.session.msg("execute_request", content, metadata=metadata)
        self._client.shell_channel.send(message)
        while True:
            reply = self._client.get_shell_msg(timeout=120)
            if reply["parent_header"].get("msg_id") == message["header"]["msg_id"]:
                return reply["content"]


# ---------------------------------------------------------------- inside the kernel


def begin_anew():
    """A kernel as after its start: only the lesson's import of the exercises has run."""
    from nbclassroom.exercises.names_read import RUNS

    shell = sys.modules["IPython"].get_ipython()
    shell.reset(new_session=False)
    RUNS.__init__()
    return "null"


def points_here(functions):
    """{exercise id: [points, text] of `check`}, as JSON; without functions that no cell has defined."""
    from imgproc_course.exercises import check

    names = sys.modules["IPython"].get_ipython().user_ns
    texts = {id: repr(check(id, names[name])) for id, name in functions.items() if callable(names.get(name))}
    found = {id: re.search(r"Points here: (\d+) of", text) for id, text in texts.items()}
    return json.dumps({id: [int(match[1]) if match else 0, texts[id]] for id, match in found.items()})
