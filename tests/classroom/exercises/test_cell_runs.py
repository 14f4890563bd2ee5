"""A function that is older than the learner's cell: recorded by hand, and in real kernels."""

import os

import pytest
from jupyter_client.manager import KernelManager
from nbclassroom.exercises.names_read import CellRuns

RIGHT = "def count_pixels(frame):\n    return frame.shape[0] * frame.shape[1]"
OTHER = "def count_channels(frame):\n    return frame.shape[2]"


def function_of(source, name="count_pixels"):
    namespace = {}
    exec(source, namespace)
    return namespace[name]


def why_older(*cells, error=None, cell_id=""):
    """What is said after some runs of cells, the last of which ended with an error."""
    runs = CellRuns()
    for source in cells:
        run = runs.start(source, cell_id)
    if error is not None:
        run.fail(error)
    return runs.why_older("start-count", "count_pixels", function_of(RIGHT))


def test_a_cell_that_ran_leaves_no_older_function():
    assert why_older(RIGHT) == why_older() == why_older("x = 1") == ""


def test_another_cell_may_define_another_function():
    assert why_older(RIGHT, OTHER) == ""
    assert why_older(RIGHT, RIGHT.replace("count_pixels", "count_pixel"), cell_id="answer-other") == ""


def test_a_lambda_or_an_emptied_cell_in_the_answer_cell():
    assert why_older("count_pixels = lambda frame: frame.size // 3", cell_id="answer-start-count") == ""
    assert "Your cell defines no function" in why_older("frame.size // 3", cell_id="answer-start-count")


def test_a_cell_that_python_cannot_read_is_older_even_with_the_same_function():
    error = SyntaxError("expected ':'", ("cell", 7, 1, ""))
    text = why_older(RIGHT, f"{RIGHT}\nif x", error=error)
    assert "Python cannot read it: SyntaxError, expected ':', in line 7." in text
    assert "Python still has the older count_pixels()" in text and "Repair the cell, run it" in text


def test_an_error_before_the_function_gets_its_advice():
    text = why_older(
        f"import sklearn\n{OTHER}\n{RIGHT[:-1]}", error=ModuleNotFoundError("No module named 'sklearn'")
    )
    assert (
        "ModuleNotFoundError: No module named 'sklearn'. No library with the name sklearn is installed"
        in text
    )


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


def run(kernel, source):
    """What a cell prints; errors are shown by the kernel and end the cell."""
    printed = []

    def collect(message):
        if message["msg_type"] == "stream":
            printed.append(message["content"]["text"])

    kernel.execute_interactive(
        source, timeout=60, output_hook=collect, allow_stdin=False, stop_on_error=False
    )
    return "".join(printed)


@pytest.fixture
def checked(kernel):
    """Runs a right answer, then another cell, and gives what check prints after it."""
    run(kernel, "import numpy as np\nimport imgproc_course.exercises")
    run(kernel, RIGHT)

    def check_after(source):
        run(kernel, source)
        return run(kernel, CHECK_CELL)

    return check_after


def test_in_a_kernel_a_syntax_error_leaves_an_older_function(checked):
    text = checked(RIGHT.replace(":\n", "\n"))
    assert text.startswith("start-count: this is an older function.\nThe last run of your cell failed.")
    assert "SyntaxError, expected ':', in line 1." in text and "checks pass" not in text


def test_in_a_kernel_an_error_above_the_function_leaves_an_older_one(checked):
    text = checked("import nothing_of_this_name\n" + RIGHT.replace("0", "1"))
    assert "this is an older function" in text and "nothing_of_this_name" in text


def run_cell(kernel, source, cell_id):
    """Run a cell as JupyterLab does, with the id of the cell."""
    content = {"code": source, "silent": False, "store_history": True, "stop_on_error": False}
    message = kernel.session.msg("execute_request", content, metadata={"cellId": cell_id})
    kernel.shell_channel.send(message)
    while kernel.get_shell_msg(timeout=60)["parent_header"].get("msg_id") != message["header"]["msg_id"]:
        pass


def test_in_a_kernel_the_answer_cell_is_known_by_its_id(kernel, checked):
    run_cell(kernel, RIGHT, "answer-start-count")
    run_cell(kernel, RIGHT.replace("count_pixels", "how_many"), "answer-start-count")
    text = run(kernel, CHECK_CELL)
    assert (
        "Your cell defines how_many(), and this exercise needs a function with the name count_pixels()"
        in text
    )
    run_cell(kernel, RIGHT, "answer-start-count")
    run_cell(kernel, RIGHT.replace("count_pixels", "count_pixel"), "answer-another-exercise")
    assert "both checks pass" in run(kernel, CHECK_CELL)


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
