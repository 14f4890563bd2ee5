"""Modules that an exercise does not allow are refused by their names; no key and no master is there."""

from textwrap import dedent

import pytest
from nbclassroom.autograder.sandbox.bubblewrap import Limits
from nbclassroom.autograder.sandbox.fork_server_client import KernelFactory
from printed import run_printing

pytestmark = pytest.mark.sandbox
DOUBLES = "def double(pixels):\n    return np.minimum(pixels.astype(int) * 2, LIMIT).astype(np.uint8)\n"


@pytest.fixture(scope="module")
def kernel_factory():
    with KernelFactory() as factory:
        yield factory


def run(kernel_factory, allowed, code):
    """(what a new kernel prints, the error)."""
    kernel = kernel_factory.start(allowed, 60)
    result, printed = run_printing(kernel, code)
    kernel.stop()
    return printed, result.error


USES = {
    "cv2": "import cv2\ncv2.add(1, 2)",
    "scipy.ndimage": "import scipy.ndimage as nd\nnd.maximum([1, 3])",
    "PIL": "import matplotlib.pyplot\nfrom PIL import Image\nImage.new('L', (1, 1))",
    "imgproc_course.imaging": "from imgproc_course import imaging\nimaging.to_gray(1)",
    "imgproc_course.imaging.canny": "from imgproc_course.imaging.canny import canny\ncanny(1)",
    "networkx": "import importlib\nimportlib.import_module('networkx').Graph()",
}


@pytest.mark.parametrize("name", USES)
def test_a_module_that_is_not_allowed_is_refused_by_its_name(kernel_factory, name):
    assert run(kernel_factory, (), USES[name]) == (
        "",
        ("RefusedModule", f"write this exercise without {name}"),
    )


def test_what_an_exercise_allows_is_there_and_nothing_remains_for_the_next(kernel_factory):
    code = "import scipy.ndimage, cv2, os\nfrom imgproc_course.imaging import to_gray\n"
    code += "print(cv2.add(1, 2)[0], scipy.ndimage.maximum([1, 3]), to_gray(np.ones((1, 1, 3), np.uint8)))\n"
    allowed = ("cv2", "imgproc_course.imaging", "scipy")
    assert run(kernel_factory, allowed, code) == ("[3.] 3 [[1]]\n", ("", ""))
    assert run(kernel_factory, (), "import cv2\ncv2.add(1, 2)")[1][0] == "RefusedModule"


SHOWS = [
    ("from tqdm import tqdm\nprint([n * n for n in tqdm([1, 2, 3], desc='rows')])", "[1, 4, 9]"),
    ("from tqdm.auto import trange\nprint(list(trange(1, 4, 2)))", "[1, 3]"),
    ("import tqdm\nwith tqdm.tqdm(total=9) as bar:\n    bar.update(3)\nbar.close()\nprint(1)", "1"),
    ("try:\n    from rich.progress import track\nfinally:\n    print(*track(range(2)))", "0 1"),
    ("from rich import print as show\nshow('[red]7[/red]')\nprint('shown')", "shown"),
    ("print(len([__import__(name) for name in ['bs4', 'yaml']]))", "2"),  # not used
    ("import doctest\nfrom PIL import Image\nprint(doctest.testmod().failed)", "0"),
    ("def module():\n    yield __import__('bs4')\nprint(len(list(module())))", "1"),
]


@pytest.mark.parametrize(("code", "printed"), SHOWS)
def test_what_only_shows_something_or_is_not_used_is_allowed_and_silent(kernel_factory, code, printed):
    assert run(kernel_factory, (), code) == (f"{printed}\n", ("", ""))


def test_libraries_find_one_another(kernel_factory):
    code = "import matplotlib.pyplot as plt\nplt.plot([1, 2])\nplt.savefig('a.png')\n"
    code += "import imgproc_course.recording\nprint('found')"
    assert run(kernel_factory, ("imgproc_course.recording",), code) == ("found\n", ("", ""))


ANSWERS = {
    "an unused import": f"import cv2, torch\nfrom skimage import data\nimport scipy.ndimage as nd\n{DOUBLES}",
    "an import inside try, not there": """
        try:
            import cv2
            HAS_CV2 = True
        except ImportError:
            HAS_CV2 = False
        def double(pixels):
            if HAS_CV2:
                return cv2.add(pixels, pixels)
            return np.minimum(pixels.astype(int) * 2, LIMIT).astype(np.uint8)
        """,
    "a fallback inside the function": """
        def double(pixels):
            try:
                from cv2 import add
                return add(pixels, pixels)
            except ImportError:
                return np.minimum(pixels.astype(int) * 2, LIMIT).astype(np.uint8)
        """,
    "figures and displays": """
        %matplotlib inline
        import matplotlib.pyplot as plt
        from IPython.display import display
        from imgproc_course.display import show
        figure, axes = plt.subplots()
        axes.imshow(np.eye(3))
        plt.show()
        display(figure)
        def double(pixels):
            show(pixels, caption="a", alt="b")
            return np.minimum(pixels.astype(int) * 2, LIMIT).astype(np.uint8)
        """,
}


@pytest.mark.parametrize("name", ANSWERS)
def test_what_an_answer_only_names_costs_nothing(grade, name):
    exercise = grade(dedent(ANSWERS[name]), limits=Limits())
    assert [(case.outcome, case.message) for case in exercise.cases] == [("passed", "")] * 2


def test_using_a_module_says_which_one(grade):
    public, hidden = grade("import cv2\ndef double(pixels):\n    return cv2.add(pixels, pixels)\n").cases
    assert (public.outcome, public.message) == ("refused module", "write this exercise without cv2")
    assert hidden.outcome == "refused module"


def test_no_key_no_master_and_no_check_of_a_lesson_is_visible(kernel_factory):
    code = """
    import os
    wanted = ("checks", "masters", "solutions", "my_lessons")
    ends = (".seed", ".ipynb", "answer_key.py", "declaration.py", "lesson.py")
    systems = {"proc", "sys", "usr", "python", "lib", "lib64", "bin", "sbin", "etc", "dev"}
    walks = (step for top in set(os.listdir("/")) - systems for step in os.walk("/" + top))
    ours = [(f, name) for f, *names in walks for name in sum(names, []) if "/course/site" not in f]
    print(len(ours) > 20, [path for path in ours if path[1] in wanted or path[1].endswith(ends)])
    """
    assert run(kernel_factory, (), dedent(code)) == ("True []\n", ("", ""))
