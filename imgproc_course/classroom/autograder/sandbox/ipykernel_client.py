"""Jupyter's own kernel, ipykernel, in the same sandbox: slower; the forked kernel is tested against it.

ZMQ uses ipc, through one folder that both sides see, so the sandbox needs no network.
"""

import json
import os
import shutil
import signal
import tempfile
import time
from pathlib import Path
from queue import Empty

from jupyter_client.kernelspec import KernelSpec, KernelSpecManager
from jupyter_client.manager import KernelManager

from imgproc_course.classroom.autograder.sandbox import bubblewrap
from imgproc_course.classroom.autograder.sandbox.allowed_modules import module_access
from imgproc_course.classroom.autograder.sandbox.cell_run import LOOK_SECONDS, CellRun
from imgproc_course.classroom.exercises.cell_syntax import parts_of

_OWN_THREADS = 16  # of ipykernel itself, at most; they count as processes
_SOCKETS = "/course/kernel"  # the shared folder as the sandbox sees it

_START_SECONDS = 2  # of processor time, more than a fork needs
_KILLED = (-signal.SIGKILL, 128 + signal.SIGKILL)  # of the process, or of the one in bubblewrap


class _SingleSpecManager(KernelSpecManager):
    command = ()

    def get_kernel_spec(self, kernel_name):
        return KernelSpec(argv=list(self.command), display_name="answers", language="python")


class IPykernelClient:
    """An ipykernel for the checks of an exercise; its methods are those of `ForkedKernel`."""

    was_prepared = False

    def __init__(self, allowed, seconds, limits, group, *, confined):
        self._limits, self._seconds, self._group = limits, seconds, group
        self._deadline, self._next_look = None, 0.0
        self._cpu_limit = limits.for_system(seconds)["cpu"] + _START_SECONDS
        self._folder = Path(tempfile.mkdtemp(prefix="kernel-"))
        shared = self._folder / "shared"
        shared.mkdir()
        shared.chmod(0o777)
        processes = limits.processes + _OWN_THREADS
        system_limits = limits.for_system(seconds) | {"cpu": self._cpu_limit, "processes": processes}
        self._start(shared, self._command(confined, shared, allowed, system_limits))
        self._deadline = None

    def _start(self, shared, command):
        connection_file = shared / "kernel.json"
        self._manager = KernelManager(
            kernel_name="answers",
            kernel_spec_manager=_SingleSpecManager(),
            transport="ipc",
            connection_file=str(connection_file),
            ip=str(shared / "ipc"),
        )
        self._manager.kernel_spec_manager.command = command
        with Path(os.devnull).open("w", encoding="utf-8") as null:
            self._group.reset()
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
            connection_file.chmod(0o644)
            self._client.wait_for_ready(timeout=60)
            self.run("import numpy as np\n__import__('random').seed(0)\nnp.random.seed(0)")
        except RuntimeError as error:
            self.stop()
            raise bubblewrap.SandboxError(f"ipykernel did not start in the sandbox: {error}") from error

    def _command(self, confined, shared, allowed, system_limits):
        shared_inside = _SOCKETS if confined else str(shared)
        settings = {
            "confined": confined,
            "user": bubblewrap.kernel_user() if confined else None,
            "names": module_access(tuple(allowed)).names,
            "bound": module_access(tuple(allowed)).bound,
            "limits": system_limits,
            "connection": f"{shared_inside}/kernel.json",
            "ip": f"{shared_inside}/ipc",
        }
        code = f"import sys; sys.path += {bubblewrap.search_path(confined)!r};"
        code += " from imgproc_course.classroom.autograder.sandbox.inside import ipykernel_main;"
        code += " ipykernel_main.main()"
        command = bubblewrap.sandbox_command(confined, shared={str(shared): _SOCKETS})
        return [*command, "-c", code, json.dumps(settings)]

    def run(self, code):
        """Run one cell; returns its CellRun."""
        run = CellRun()
        if self._deadline is None:
            self._deadline = time.monotonic() + self._limits.deadline(self._seconds)
        message_id = self._client.execute(code, store_history=False, allow_stdin=False, stop_on_error=False)
        bytes_left = self._limits.output
        while not run.ended:
            self._check_limits(run)
            try:
                message = self._client.get_iopub_msg(timeout=0.0 if run.ended else LOOK_SECONDS)
            except Empty:
                self._check_process(run)
                continue
            except (ValueError, KeyError, TypeError):  # a forged message
                run.ended = "hostile"
                continue
            if message.get("parent_header", {}).get("msg_id") != message_id:
                continue
            kind, content = message["msg_type"], message["content"]
            bytes_left -= len(json.dumps(content, default=str))
            if bytes_left < 0:
                run.ended = "output"
            elif kind == "status" and content.get("execution_state") == "idle":
                self._read_reply(run, message_id)
                break
            elif kind in ("stream", "display_data", "execute_result", "error"):
                run.add(kind, content)
        return run

    def run_statements(self, sources):
        """Run cells as `ForkedKernel.run_statements` does: each statement is a cell here."""
        whole = CellRun()
        for part in (part for source in sources for part in parts_of(source)):
            run = self.run(part)
            whole.ended, whole.error = run.ended, whole.error if whole.error[0] else run.error
            if run.ended:
                break
        return whole

    def run_check(self, code, inputs, seconds):
        """Run a check cell; a cell before it delivers its inputs."""
        text = json.dumps({"calls": inputs, "seconds": seconds})
        run = self.run(
            "from imgproc_course.classroom.autograder.sandbox.inside import check_cell as _check_cell\n"
            f"_check_cell.deliver({text!r})\ndel _check_cell"
        )
        return run if run.ended else self.run(code)

    def _read_reply(self, run, message_id):
        """Read the error from the reply: a cell can fail without showing it (an unknown magic)."""
        reply = {}
        while reply.get("parent_header", {}).get("msg_id") != message_id:
            try:
                reply = self._client.get_shell_msg(timeout=1)
            except Empty:
                return
        if reply["content"].get("status") == "error" and not run.error[0]:
            run.add("idle", {"ename": "", "evalue": ""} | reply["content"])

    def _check_limits(self, run):
        """End the cell if its time or memory is used up, whatever it sends."""
        if time.monotonic() < self._next_look:
            return
        self._next_look = time.monotonic() + LOOK_SECONDS
        if time.monotonic() > self._deadline:
            run.ended = "time"
        elif self._group.ran_out_of_memory(self._manager.provisioner.pid):
            run.ended = "memory"

    def _check_process(self, run):
        """End the cell if the kernel's process has ended."""
        if not run.ended and not self._manager.is_alive():
            seconds_used = time.monotonic() - self._deadline + self._limits.deadline(self._seconds)
            # Its start has used a part of the processor time after which the system kills it.
            was_killed = self._manager.provisioner.process.poll() in _KILLED
            is_late = seconds_used > self._cpu_limit - _START_SECONDS - 0.9
            run.ended = "time" if was_killed and is_late else "crashed"

    def stop(self):
        """End the kernel and all that it started."""
        self._client.stop_channels()
        self._manager.shutdown_kernel(now=True)
        shutil.rmtree(self._folder, ignore_errors=True)
