"""The doctor: looks at everything that the lessons use, and names the remedy of what is not well.

`doctor()` in a notebook, `imgproc-course doctor` in a terminal.
"""

import contextlib

from imgproc_course.doctor import graph, pictures, software
from imgproc_course.doctor.report import Finding, Report

CHECKS = (
    ("Python", software.look_at_python),
    ("the kernel", software.look_at_kernel),
    ("packages", software.look_at_packages),
    ("OpenCV", software.look_at_opencv),
    ("the recording", pictures.look_at_recording),
    ("the disk", pictures.look_at_disk),
    ("ROS 2", graph.look_at_ros),
    ("the network", graph.look_at_network),
    ("topics, for some seconds", pictures.look_at_topics),
)


def doctor():
    """Looks at everything that the lessons use. Takes about five seconds, and says what it is looking at.

    Returns
    -------
    Report
    """
    findings = []
    with _progress() as tell:
        for what, look in CHECKS:
            tell(what)
            findings += look()
    return Report(findings)


@contextlib.contextmanager
def _progress():
    """Yields a function that tells what is looked at; nothing of it stays on the page."""
    if software.in_notebook():
        from IPython.display import clear_output

        def tell(what):
            clear_output(wait=True)
            print(f"The doctor looks at {what} ...")

        yield tell
        clear_output()
    else:
        from rich.console import Console

        console = Console(stderr=True)
        with console.status("") as status:
            yield lambda what: status.update(f"The doctor looks at {what} ...")


__all__ = ["Finding", "Report", "doctor"]
