"""What a source prints in a kernel, which itself sends nothing of it: a check shows it."""

from nbclassroom.autograder.sandbox.inside import MIME

COLLECT = "import io, sys\nsys.stdout = sys.stderr = io.StringIO()"
SHOW = f"from IPython.display import display\ndisplay({{{MIME!r}: sys.stdout.getvalue()}}, raw=True)"


def run_printing(kernel, code, run=None):
    """(the CellRun of a source, what it prints); `run` runs it in place of the kernel's own method."""
    kernel.run(COLLECT)
    cell_run = (run or kernel.run)(code)
    return cell_run, "".join(kernel.run(SHOW).answers)
