"""Start Jupyter's own kernel, shut in like the forked ones."""

import json
import sys
from pathlib import Path

from imgproc_course.autograder.sandbox.inside import check_cell, confine


def main():
    settings = json.loads(sys.argv[1])
    connection = Path(settings["connection"])
    if settings["confined"]:
        told = json.loads(connection.read_text(encoding="utf-8"))
        confine.confine(settings["hidden"], settings["limits"], settings["user"])
        connection = Path("/tmp/kernel.json")
        connection.write_text(json.dumps(told | {"ip": settings["ip"]}), encoding="utf-8")
    else:
        confine.die_with_parent()
        confine.set_limits(settings["limits"] | {"processes": 4096})
    check_cell.surround(settings["refused"])
    from ipykernel.kernelapp import IPKernelApp

    IPKernelApp.launch_instance(["-f", str(connection), "--HistoryManager.enabled=False"])
