"""Checks everything that the lessons use: `doctor()` in a notebook, `imgproc-course doctor` in a terminal."""

import contextlib

from imgproc_course.extras import naming_extra

with naming_extra():
    import rich.console  # noqa: F401 - the others import it when they show something

    from imgproc_course.doctor import graph, software
    from imgproc_course.doctor.report import Finding, Report

CHECKS = (
    ("Python", software.check_python),
    ("the kernel", software.check_kernel),
    ("packages", software.check_packages),
    ("OpenCV", software.check_opencv),
    ("the recording", software.check_recording),
    ("the room", software.check_room),
    ("the disk", software.check_disk),
    ("ROS 2", graph.check_ros),
    ("the network", graph.check_network),
    ("topics (some seconds)", graph.check_topics),
)


def doctor():
    """Checks everything that the lessons use, in about five seconds; returns the Report."""
    findings = list(software.check_pythonpath())
    if findings:
        return Report(findings)  # the other checks would load packages that are not the course's
    with _progress() as show_progress:
        for subject, run_check in CHECKS:
            show_progress(subject)
            findings += run_check()
    return Report(findings)


@contextlib.contextmanager
def _progress():
    """Yields a function that shows what is being checked; at the end the line disappears."""
    if software.in_notebook():
        from IPython.display import clear_output

        def show_progress(subject):
            clear_output(wait=True)
            print(f"The doctor checks {subject} ...")

        yield show_progress
        clear_output()
    else:
        from rich.console import Console

        console = Console(stderr=True)
        with console.status("") as status:
            yield lambda subject: status.update(f"The doctor checks {subject} ...")


__all__ = ["Finding", "Report", "doctor"]
