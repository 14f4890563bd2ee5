"""Cells behave as in JupyterLab, in both kernels."""

import ast
from pathlib import Path

import pytest
from jupyter_kernel import JupyterFactory
from master_answers import sample_answers

from imgproc_course.classroom.authoring.masters import find_masters
from imgproc_course.classroom.autograder.sandbox.bubblewrap import Limits
from imgproc_course.classroom.autograder.sandbox.kernel_factory import KernelFactory
from imgproc_course.classroom.exercises import read_exercises

pytestmark = pytest.mark.sandbox
MASTERS = Path(__file__).parents[3] / "notebooks" / "masters"


@pytest.fixture(scope="module", params=[KernelFactory, JupyterFactory])
def kernel(request):
    with request.param() as kernel_factory:
        kernel = kernel_factory.start((), 60)
        yield kernel
        kernel.stop()


# Each cell imports and defines what it reads: two workers may share these cells out in any way.
ASYNC_FUNCTION = "import asyncio\nasync def g():\n    await asyncio.sleep(0.001)\n    return 5\n"
CELLS = [
    ("print('a'); print('b')", "a\nb\n", ("", "")),
    ("print(np.arange(3))", "[0 1 2]\n", ("", "")),
    ("In [1]: x = 4\n\nIn [2]: print(x)", "4\n", ("", "")),
    ("1 / 0", "", ("ZeroDivisionError", "division by zero")),
    ("raise KeyError('k')", "", ("KeyError", "'k'")),
    ("def f(:\n    pass", "", ("SyntaxError", None)),
    ("%notamagic", None, ("UsageError", "Line magic function `%notamagic` not found.")),
    ("%time x = 3\nx", None, ("", "")),
    ("%%bash\necho from bash", "from bash\n", ("", "")),
    ("kept = !echo out\nprint(kept)", "['out']\n", ("", "")),
    (ASYNC_FUNCTION, "", ("", "")),
    (f"{ASYNC_FUNCTION}print(await g())", "5\n", ("", "")),
    (
        # Closed, else Python warns some cells later that it was never awaited.
        "import asyncio\nlate = asyncio.sleep(0)\ntry:\n    asyncio.run(late)\nfinally:\n    late.close()",
        "",
        ("RuntimeError", "asyncio.run() cannot be called from a running event loop"),
    ),
    ("from IPython.display import HTML, display\ndisplay(HTML('<b>x</b>'))\n'last'", "", ("", "")),
    ("x = 3\nx?", None, ("", "")),
    ("import matplotlib.pyplot as plt\nplt.plot([1, 2]);\nplt.show()", None, ("", "")),
    ("print(get_ipython().__class__.__mro__[1].__name__)", "InteractiveShell\n", ("", "")),
    ("print(__name__)", "__main__\n", ("", "")),
    ("import cv2\nfrom imgproc_course.imaging import to_gray\nprint('imported')", "imported\n", ("", "")),
    ("import cv2\ncv2.add(1, 2)", "", ("RefusedModule", "write this exercise without cv2")),
    (
        "from imgproc_course.imaging import to_gray\nto_gray(np.ones((2, 2, 3)))",
        "",
        ("RefusedModule", "write this exercise without imgproc_course.imaging"),
    ),
    ("try:\n    import scipy\nexcept ImportError:\n    print('without')", "without\n", ("", "")),
    ("from imgproc_course.display import show\nshow(np.ones((2, 2)), text=('a', 'b'))", "", ("", "")),
    (
        "%matplotlib inline\nimport matplotlib.pyplot as plt\nplt.imshow(np.ones((2, 2)))\nplt.show()",
        None,
        ("", ""),
    ),
    ("from imgproc_course.exercises import check\ncheck('x', print)", "", ("", "")),
    ("from imgproc_course.exercises import hint, solution\nhint('x'), solution('x')", None, ("", "")),
    ("import random\nprint(random.random())", "0.8444218515250481\n", ("", "")),
    ("print(np.random.rand())", "0.5488135039273248\n", ("", "")),
]


@pytest.mark.parametrize(
    ("code", "printed", "error"), CELLS, ids=[cell[0].splitlines()[-1] for cell in CELLS]
)
def test_a_cell_does_what_it_does_in_jupyterlab(kernel, code, printed, error):
    run = kernel.run(code)
    assert run.ended == ""
    assert run.error[0] == error[0]
    assert error[1] is None or run.error[1] == error[1]
    assert printed is None or run.printed.replace("\r\n", "\n") == printed


def test_an_exception_is_sent_without_a_traceback_that_nobody_reads():
    with KernelFactory() as kernel_factory:
        kernel = kernel_factory.start((), 10)
        code = "import sys\nprint([name for name in ('stack_data', 'executing') if name in sys.modules])"
        assert kernel.run("def f(:").error[0] == "SyntaxError"
        assert kernel.run("def f():\n    f()\nf()").error[0] == "RecursionError"
        assert kernel.run(code).printed == "[]\n"
        kernel.stop()


def test_input_is_refused_with_an_explanation(kernel):
    run = kernel.run("input('name?')")
    assert run.error[0] in ("RuntimeError", "StdinNotImplementedError")
    assert "input" in run.error[1]


def test_python_hashes_are_the_same_in_every_kernel():
    hashes = []
    for kind in (KernelFactory, KernelFactory, JupyterFactory):
        with kind() as kernel_factory:
            kernel = kernel_factory.start((), 30)
            hashes.append(kernel.run("print(hash('course'))").printed)
            kernel.stop()
    assert hashes[0] == hashes[1] == hashes[2] != ""


def test_a_kernel_gets_no_more_time_than_its_limit():
    with KernelFactory(limits=Limits(grace=0.0, wall_factor=1, wall_grace=1)) as kernel_factory:
        kernel = kernel_factory.start((), 1)
        assert kernel.run("while True: pass").ended == "time"
        assert kernel.run("1").ended != ""
        kernel.stop()
        after = kernel_factory.start((), 1)
        assert after.run("print(1)").printed == "1\n"
        after.stop()


TRICKY = [
    "",
    "\n\n",
    "x = 1",
    "# a comment alone",
    "   # indented\n   x = 1",
    "%time x = 1",
    "x = %time 1",
    "%%time\nx = 1",
    "files = !ls\nprint(files)",
    "!ls\n!pwd",
    "print?",
    "?print",
    "a.b??\nc",
    "/f 1",
    ",f a b",
    ";f a b",
    "ls",
    "exit",
    ">>> x = 1\n>>> y",
    "In [1]: x = 1\n\nIn [2]: y = 2",
    "x = (1\n  % 2\n  / 3)",
    "x = 5 \\\n% 3",
    "text = '''\n%time\n!ls\n? x\n'''",
    "def f():\n    ...\n...\nx",
    "f'{x!r}' + f'{x?}'",
    "def f(:",
    "if x:\n%time y",
    "await g()",
    "'\\d'",
    "x\0y",
    "(" * 300 + ")" * 300,
    "\tx",
    "x = 1\r\ny = 2\r\n",
    " \n\nx = 1",
]


def test_ipython_leaves_plain_python_as_it_is():
    from IPython.core.inputtransformer2 import TransformerManager

    from imgproc_course.classroom.autograder.sandbox.inside.shell import plain_statements

    cells = [*TRICKY, *(cell[0] for cell in CELLS)]
    for master in find_masters(MASTERS):
        for exercise in read_exercises(master):
            cells += [*exercise.given, *sample_answers(exercise).values()]
    plain = [cell for cell in cells if plain_statements(cell)]
    assert len(plain) > 150
    for cell in plain:
        transformed = ast.parse(TransformerManager().transform_cell(cell))
        assert ast.dump(transformed, include_attributes=True) == _dump(plain_statements(cell)), cell
    assert [cell for cell in TRICKY if plain_statements(cell)] == [
        "x = 1",
        "ls",
        "exit",
        "x = (1\n  % 2\n  / 3)",
        "x = 5 \\\n% 3",
        "text = '''\n%time\n!ls\n? x\n'''",
        "def f():\n    ...\n...\nx",
        "x = 1\r\ny = 2\r\n",
    ]


def _dump(statements):
    return ast.dump(ast.Module(statements, []), include_attributes=True)
