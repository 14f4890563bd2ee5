"""A kernel has the modules that its exercise allows, and no other, by whatever road."""

import ast
import sys
from importlib import metadata
from pathlib import Path
from textwrap import dedent

import pytest
from packaging.requirements import Requirement
from packaging.utils import canonicalize_name

from imgproc_course.classroom.autograder.sandbox import bubblewrap
from imgproc_course.classroom.autograder.sandbox.allowed_modules import (
    _names_required_by,
    base_paths,
    module_access,
)
from imgproc_course.classroom.autograder.sandbox.bubblewrap import SOURCE, Limits
from imgproc_course.classroom.autograder.sandbox.kernel_factory import KernelFactory
from imgproc_course.classroom.course import PACKAGES

pytestmark = [pytest.mark.sandbox, pytest.mark.xdist_group("sandbox")]
DOUBLES = "def double(pixels):\n    return np.minimum(pixels.astype(int) * 2, LIMIT).astype(np.uint8)\n"
# Modules that solve an exercise of the course, or hold the functions that do.
SOLVERS = {"cv2", "scipy", "skimage", "PIL", "imageio", "tifffile", "networkx", "rosbags", "sensor_msgs"}
# What a learner tries: an import system without our finder, and a process of its own.
SEARCH = """
import importlib.machinery, subprocess, sys
found = [name for name in {names!r} if importlib.machinery.PathFinder.find_spec(name)]
code = "import importlib.util as u, sys; sys.path += {places!r};"
code += " print([name for name in {names!r} if u.find_spec(name)])"
child = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True)
print([found, eval(child.stdout), [name for name in {names!r} if name in sys.modules]])
"""
PLACES = ["/course/site-packages", "/course/allowed", "/course/extra/site-0", "/course/extra/site-1"]


@pytest.fixture(scope="module")
def kernel_factory():
    with KernelFactory("fast") as factory:
        yield factory


def run(kernel_factory, allowed, code):
    kernel = kernel_factory.start(allowed, 60)
    result = kernel.run(code)
    kernel.stop()
    assert not result.error[0], result.error
    return result.printed


def test_of_all_that_is_installed_a_kernel_finds_only_what_every_answer_may_use(kernel_factory):
    everything = {name.replace("-", "_") for name in metadata.packages_distributions() if name.isidentifier()}
    assert everything > SOLVERS
    for_all = {path.name.partition(".")[0] for path in base_paths()}
    assert not for_all & SOLVERS and {"numpy", "matplotlib", "IPython"} <= for_all
    names = sorted(everything - for_all - {"PIL", "imgproc_course"})
    printed = run(kernel_factory, (), SEARCH.format(names=names, places=PLACES))
    assert ast.literal_eval(printed) == [[], [], []]


def test_what_every_installed_distribution_requires_is_read_right():
    for distribution in metadata.distributions():
        requirements = map(Requirement, distribution.requires or ())
        names = [
            canonicalize_name(requirement.name)
            for requirement in requirements
            if not requirement.marker or requirement.marker.evaluate({"extra": ""})
        ]
        assert sorted(_names_required_by(distribution)) == sorted(names)


def test_the_sandboxs_pillow_computes_nothing(kernel_factory):
    code = "import PIL, os\nprint(sorted(n for n in os.listdir(PIL.__path__[0]) if n.endswith('.py')))"
    assert run(kernel_factory, (), code) == "['Image.py', 'PngImagePlugin.py', '__init__.py']\n"


def test_of_the_systems_commands_a_kernel_can_run_only_a_few(kernel_factory):
    """Whatever the search path is: no other file of a folder for commands is there."""
    code = """
    import os, subprocess
    folders = {*os.defpath.split(":"), *os.environ["PATH"].split(":"), "/sbin", "/usr/sbin", "/usr/local/bin"}
    folders |= {"/usr/local/sbin", "/usr/games", "/usr/local/games", "/usr/libexec"}
    names = {name for folder in folders if os.path.isdir(folder) for name in os.listdir(folder)}
    shell = subprocess.run("echo $((6 * 7)); ls / | wc -l", shell=True, capture_output=True, text=True)
    print(sorted(names), shell.stdout.split()[0], shell.returncode, shell.stderr)
    """
    names, answer = run(kernel_factory, (), dedent(code)).split("] ")
    python = Path(sys.executable).resolve()  # it may be the system's own
    own = {python.name} if python.is_relative_to("/usr") else set()
    assert {*ast.literal_eval(f"{names}]")} <= {*bubblewrap._COMMANDS} | own
    assert answer == "42 0 \n"


def test_no_package_of_the_course_is_there_unless_it_is_allowed(kernel_factory):
    code = "import os\nprint([n for n in {} if os.listdir('/course/packages/imgproc_course/' + n)])"
    code = code.format([name for name in PACKAGES if (SOURCE / name).is_dir()])
    assert run(kernel_factory, (), code) == "[]\n"
    assert run(kernel_factory, ("imgproc_course.imaging",), code) == "['imaging']\n"


def test_what_an_exercise_allows_is_there_whole_and_nothing_remains_for_the_next(kernel_factory):
    code = "import scipy.ndimage, cv2, os\nfrom imgproc_course.imaging import to_gray\n"
    code += "print(cv2.add(1, 2)[0], scipy.ndimage.maximum([1, 3]), to_gray(np.ones((1, 1, 3), np.uint8)))\n"
    code += "print(os.listdir('/course/extra'))"
    allowed = ("cv2", "imgproc_course.imaging", "scipy")
    assert run(kernel_factory, allowed, code) == "[3.] 3 [[1]]\n[]\n"
    printed = run(kernel_factory, (), SEARCH.format(names=["cv2", "scipy"], places=PLACES))
    assert ast.literal_eval(printed) == [[], [], []]


def test_a_package_of_the_course_brings_the_packages_that_it_needs():
    names = module_access(("imgproc_course.ros",)).names
    assert {"imgproc_course.ros", "imgproc_course.messages"} <= set(names)
    assert "imgproc_course.imaging" not in names


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
    wanted = ("key.json", "handed_out.json", "checks", "masters", "solutions", "my_lessons")
    ends = (".inputs.json", ".mistakes.json", ".seed", ".ipynb", "answer_key.py", "declaration.py")
    systems = {"proc", "sys", "usr", "python", "lib", "lib64", "bin", "sbin", "etc", "dev"}
    walks = (step for top in set(os.listdir("/")) - systems for step in os.walk("/" + top))
    ours = [(f, name) for f, *names in walks for name in sum(names, []) if "/site-packages" not in f]
    print(len(ours) > 20, [path for path in ours if path[1] in wanted or path[1].endswith(ends)])
    """
    assert run(kernel_factory, (), dedent(code)) == "True []\n"
    assert run(kernel_factory, ("imgproc_course.imaging",), dedent(code)) == "True []\n"
