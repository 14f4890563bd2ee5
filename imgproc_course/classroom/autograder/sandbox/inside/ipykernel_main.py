"""Start Jupyter's own kernel, confined like the forked ones."""

import json
import sys
from pathlib import Path

from imgproc_course.classroom.autograder.sandbox.inside import check_cell, confine, refusal


def main():
    confine.leave_session_keyring()
    settings = json.loads(sys.argv[1])
    connection_file = Path(settings["connection"])
    if settings["confined"]:
        connection = json.loads(connection_file.read_text(encoding="utf-8"))
        confine.protect_devices()
        confine.confine(settings["bound"], settings["limits"], settings["user"])
        connection_file = Path("/tmp/kernel.json")
        connection_file.write_text(json.dumps(connection | {"ip": settings["ip"]}), encoding="utf-8")
    else:
        confine.die_with_parent()
        confine.set_limits(settings["limits"] | {"processes": 4096})
    check_cell.refuse_input()
    refusal.allow_modules(settings["names"])
    from ipykernel.kernelapp import IPKernelApp

    IPKernelApp.launch_instance(["-f", str(connection_file), "--HistoryManager.enabled=False"])
