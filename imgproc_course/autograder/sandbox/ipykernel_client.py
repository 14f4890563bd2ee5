"""Jupyter's own kernel, ipykernel, in the same sandbox: slower, and what the forked kernel is held against.

ZMQ goes over ipc, through one folder that both sides see, so that the sandbox needs no network.
"""

import json
import os
import shutil
import tempfile
import time
from pathlib import Path
from queue import Empty

from jupyter_client.kernelspec import KernelSpec, KernelSpecManager
from jupyter_client.manager import KernelManager

from imgproc_course.autograder.sandbox import bubblewrap
from imgproc_course.autograder.sandbox.fork_server_client import LOOK, CellRun, take

_SOCKETS = "/course/kernel"  # the folder as the sandbox sees it


class _OneSpec(KernelSpecManager):
    words = ()

    def get_kernel_spec(self, kernel_name):
        return KernelSpec(argv=list(self.words), display_name="answers", language="python")


class OrdinaryKernel:
    """An ipykernel for the checks of an exercise; `run`, `deliver` and `stop` as `ForkedKernel` has them."""

    def __init__(self, refused, seconds, limits, group, *, confined):
        self._limits, self._seconds, self._group = limits, seconds, group
        self._deadline, self._next_look = None, 0.0
        self._cpu = limits.of_system(seconds)["cpu"] + 2  # its start costs more than a fork
        self._folder = Path(tempfile.mkdtemp(prefix="kernel-"))
        shared = self._folder / "shared"
        shared.mkdir()
        shared.chmod(0o777)
        connection = shared / "kernel.json"
        words = self._words(confined, shared, refused, limits.of_system(seconds) | {"cpu": self._cpu})
        self._manager = KernelManager(
            kernel_name="answers",
            kernel_spec_manager=_OneSpec(),
            transport="ipc",
            connection_file=str(connection),
            ip=str(shared / "ipc"),
        )
        self._manager.kernel_spec_manager.words = words
        with Path(os.devnull).open("w", encoding="utf-8") as null:
            self._group.forget()
            self._manager.start_kernel(
                env=bubblewrap.environment(),
                cwd=str(shared),
                stdout=null,
                stderr=null,
                preexec_fn=self._group.enter,
            )
        self._client = self._manager.client()
        self._client.start_channels()
        try:
            connection.chmod(0o644)
            self._client.wait_for_ready(timeout=60)
            self.run("import numpy as np\n__import__('random').seed(0)\nnp.random.seed(0)")
        except RuntimeError as error:
            self.stop()
            raise bubblewrap.SandboxError(f"ipykernel did not start in the sandbox: {error}") from error
        self._deadline = None

    def _words(self, confined, shared, refused, limits):
        inside = _SOCKETS if confined else str(shared)
        settings = {
            "confined": confined,
            "user": bubblewrap.user() if confined else None,
            "refused": list(refused),
            "hidden": [place for module in refused for place in bubblewrap.places_of(module)],
            "limits": limits,
            "connection": f"{inside}/kernel.json",
            "ip": f"{inside}/ipc",
        }
        words = bubblewrap.command(settings, shared={str(shared): _SOCKETS})
        start = f"import sys; sys.path += {bubblewrap.search_path(confined)!r};"
        start += " from imgproc_course.autograder.sandbox.inside import ipykernel_main; ipykernel_main.main()"
        return [*words, "-c", start, json.dumps(settings)]

    def run(self, code):
        """The messages of one cell, as `CellRun` tells them."""
        run = CellRun()
        if self._deadline is None:
            self._deadline = time.monotonic() + self._limits.deadline(self._seconds)
        name = self._client.execute(code, store_history=False, allow_stdin=False, stop_on_error=False)
        left = self._limits.output
        while not run.ended:
            self._look(run)
            try:
                message = self._client.get_iopub_msg(timeout=0.0 if run.ended else LOOK)
            except Empty:
                self._see_whether_it_is_there(run)
                continue
            except (ValueError, KeyError, TypeError):  # a forged message
                run.ended = "hostile"
                continue
            if message.get("parent_header", {}).get("msg_id") != name:
                continue
            kind, content = message["msg_type"], message["content"]
            left -= len(json.dumps(content, default=str))
            if left < 0:
                run.ended = "output"
            elif kind == "status" and content.get("execution_state") == "idle":
                self._read_reply(run, name)
                break
            elif kind in ("stream", "display_data", "execute_result", "error"):
                take(run, kind, content)
        return run

    def deliver(self, inputs, seconds, refused):
        """Hand over the inputs of the next check, by a cell."""
        text = json.dumps({"calls": inputs, "seconds": seconds, "refused": list(refused)})
        return self.run(
            "from imgproc_course.autograder.sandbox.inside import check_cell as _check_cell\n"
            f"_check_cell.deliver({text!r})\ndel _check_cell"
        )

    def _read_reply(self, run, name):
        """A cell may fail without an error's being shown: a magic that is none."""
        reply = {}
        while reply.get("parent_header", {}).get("msg_id") != name:
            try:
                reply = self._client.get_shell_msg(timeout=1)
            except Empty:
                return
        if reply["content"].get("status") == "error" and not run.error[0]:
            take(run, "idle", {"ename": "", "evalue": ""} | reply["content"])

    def _look(self, run):
        """End the cell whose time or memory is used up, whatever it says meanwhile."""
        if time.monotonic() < self._next_look:
            return
        self._next_look = time.monotonic() + LOOK
        if time.monotonic() > self._deadline:
            run.ended = "time"
        elif self._group.ran_out(self._manager.provisioner.pid):
            run.ended = "memory"

    def _see_whether_it_is_there(self, run):
        if not run.ended and not self._manager.is_alive():
            used = time.monotonic() - self._deadline + self._limits.deadline(self._seconds)
            run.ended = "time" if used > self._cpu - 1 else "crashed"

    def stop(self):
        """End the kernel and all that it started."""
        self._client.stop_channels()
        self._manager.shutdown_kernel(now=True)
        shutil.rmtree(self._folder, ignore_errors=True)
