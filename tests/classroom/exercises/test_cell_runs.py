"""A function that is older than the learner's cell: recorded by hand, and in real kernels."""

import os

import pytest
from jupyter_client.manager import KernelManager
from nbclassroom.exercises.names_read import CellRuns

RIGHT = "def count_pixels(frame):\n    return frame.shape[0] * frame.shape[1]"
OTHER = "def count_channels(frame):\n    return frame.shape[2]"


NODE = "class Doubler(Node):\n    pass"


def why_gone(*cells, error=None, line=0, cell_id="mine", name="count_pixels"):
    """What is said of a name after some runs of a cell, the last of which may have ended with an error."""
    runs = CellRuns()
    for source in cells:
        runs.start(source, cell_id)
    if error is not None:
        runs.fail(error, line)
    return runs.why_gone(name)


def test_a_cell_that_ran_leaves_nothing_that_is_older():
    assert why_gone(RIGHT) == why_gone("x = 1") == why_gone(RIGHT, f"x = 1\n{RIGHT}") == ""
    assert why_gone(RIGHT, "x = 1", cell_id="") == ""  # two cells, perhaps
    assert why_gone(OTHER, "count_pixels = lambda frame: frame.size // 3") == ""


def test_a_cell_that_makes_another_name():
    assert why_gone(RIGHT, OTHER) == "now makes count_channels"
    assert why_gone(RIGHT, "count_pixels(frame)") == "now makes nothing that has a name"
    assert why_gone(NODE, NODE.replace("Doubler", "Doublr"), name="Doubler") == "now makes Doublr"


def test_a_cell_that_python_cannot_read_is_older_even_with_the_same_function():
    error = SyntaxError("expected ':'", ("cell", 7, 1, ""))
    assert why_gone(RIGHT, f"{RIGHT}\nif x", error=error) == (
        "failed when it ran last (SyntaxError: expected ':', line 7)"
    )
    error = SyntaxError("invalid character '\u201c' (U+201C)", ("cell", 1, 1, "\u201c"))
    assert "no character of Python: chats, word processors" in why_gone(RIGHT, "\u201c", error=error)


def test_what_stands_above_the_line_that_failed_is_there():
    error = ModuleNotFoundError("No module named 'sklearn'")
    cell = f"import sklearn\n{RIGHT}"
    text = why_gone(RIGHT, cell, error=error, line=1)
    assert "(ModuleNotFoundError: No module named 'sklearn'). No library with the name sklearn" in text
    assert why_gone(RIGHT, f"{RIGHT}\n1 / 0", error=ZeroDivisionError("division by zero"), line=3) == ""


CHECK_CELL = (
    "from imgproc_course.exercises import check\nresult = check('start-count', count_pixels)\nprint(result)"
)


@pytest.fixture(scope="module")
def kernel():
    manager = KernelManager(kernel_name="python3")
    manager.start_kernel(env=os.environ | {"PYTHONDONTWRITEBYTECODE": "1"})
    client = manager.client()
    client.start_channels()
    client.wait_for_ready(timeout=60)
    yield client
    client.stop_channels()
    manager.shutdown_kernel(now=True)


def run(kernel, source, cell_id=None, deleted=()):
    """What a cell prints, run as in JupyterLab; errors are shown by the kernel and end the cell."""
    metadata = {"cellId": cell_id or source, "deletedCells": list(deleted)}
    content = {"code": source, "silent": False, "store_history": True, "stop_on_error": False}
    message = kernel.session.msg("execute_request", content, metadata=metadata)
    kernel.shell_channel.send(message)
    printed = []
    while True:
        reply = kernel.get_iopub_msg(timeout=60)
        if reply["parent_header"].get("msg_id") == message["header"]["msg_id"]:
            printed += [reply["content"]["text"]] if reply["msg_type"] == "stream" else []
            if reply["content"].get("execution_state") == "idle":
                return "".join(printed)


@pytest.fixture
def checked(kernel):
    """Runs a right answer, then another cell, and gives what check prints after it."""
    run(kernel, "import numpy as np\nimport imgproc_course.exercises")
    run(kernel, RIGHT, "mine")

    def check_after(source):
        run(kernel, source, "mine")
        return run(kernel, CHECK_CELL)

    return check_after


def test_in_a_kernel_a_syntax_error_leaves_an_older_function(checked):
    text = checked(RIGHT.replace(":\n", "\n"))
    assert text.startswith("start-count: this is an older function.\ncount_pixels() is older than the page:")
    assert "(SyntaxError: expected ':', line 1)" in text and "checks pass" not in text


def test_in_a_kernel_an_error_above_the_function_leaves_an_older_one(checked):
    text = checked("import nothing_of_this_name\n" + RIGHT.replace("0", "1"))
    assert "this is an older function" in text and "nothing_of_this_name" in text


def test_in_a_kernel_an_error_below_the_function_leaves_none(checked):
    assert "both checks pass" in checked(f"{RIGHT}\n\ncount_pixels(no_frame)")


def test_in_a_kernel_the_cell_may_make_another_name_or_be_deleted(kernel, checked):
    assert "its cell now makes how_many." in checked(RIGHT.replace("count_pixels", "how_many"))
    assert "both checks pass" in checked(RIGHT)
    run(kernel, "x = 1", deleted=["mine"])
    assert "count_pixels() is older than the page: its cell was deleted." in run(kernel, CHECK_CELL)
    assert "both checks pass" in checked(RIGHT)  # the deletion was undone


def test_in_a_kernel_a_cell_that_checks_its_own_function(checked):
    checked(RIGHT.replace(":\n", "\n"))
    assert "both checks pass" in checked(f"{RIGHT}\n{CHECK_CELL}")


def test_in_a_kernel_a_pasted_program_is_named_before_it_runs_and_in_the_check(kernel):
    run(kernel, "import numpy as np\nimport imgproc_course.exercises")
    cell = f"{RIGHT}\ndef main():\n    print('it runs')\n\nmain()"
    line = f"Line {cell.count(chr(10)) + 1}, main(), belongs to a program that runs by itself"
    printed = run(kernel, cell)
    assert line in printed and "interrupt the kernel" in printed.split("it runs")[0]
    text = run(kernel, CHECK_CELL)
    assert "both checks pass" in text and line in text
