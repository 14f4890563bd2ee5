"""Modules that an exercise does not allow: which an answer uses, and how their imports fail."""

import ast

import pytest

from imgproc_course.classroom.exercises.cell_syntax import ANSWER_MARK, bound_names
from imgproc_course.classroom.exercises.dependencies import find_refused, tree_as_graded


def refused(source, allowed=(), others="", given=(), namespace=None):
    source = f"{others}\n{ANSWER_MARK}\n{source}" if others else source
    return find_refused(source, "f", allowed, set(given), namespace or {})


def test_modules_that_are_not_allowed_are_seen_however_they_are_named():
    sources = {
        "import PIL\ndef f(a):\n    return PIL.new(a)\n": "PIL",
        "import PIL.Image as i\ndef f(a):\n    return i.new(a)\n": "PIL",
        "from cv2 import add\ndef f(a):\n    return add(a, a)\n": "cv2",
        "def f(a):\n    import cv2\n": "cv2",
        "def f(a):\n    from skimage import filters\n": "skimage",
        "def f(a):\n    def inner():\n        import cv2\n    return inner()\n": "cv2",
        "def f(a):\n    from imgproc_course import imaging\n": "imgproc_course.imaging",
        "def f(a):\n    return cv2.add(a, a)\n": "cv2",
        "import cv2\nFLAG = cv2.IMREAD_COLOR\ndef f(a):\n    return FLAG\n": "cv2",
        "import cv2\ng = cv2.add\nf = lambda a: g(a, a)\n": "cv2",
    }
    for source, module in sources.items():
        assert list(refused(source)) == [module], source
        assert refused(source, (module,)) == {}, source
    others = "from PIL.Image import new"
    assert refused("def f(a):\n    return new(a)\n", others=others) == {"PIL": "new"}
    others = "import cv2\ndef g(a):\n    return cv2.add(a, a)"
    assert refused("def f(a):\n    return g(a)\n", others=others) == {"cv2": "cv2"}


def test_numpy_the_standard_library_and_what_shows_something_need_no_permission():
    source = (
        "import json, math, numpy as np\nfrom IPython.display import display\n"
        "import matplotlib.pyplot as plt\nfrom imgproc_course.display import show\n"
        "from tqdm.notebook import tqdm\n"
        "def f(a):\n    import xml.dom.minidom\n    return json, math, np, display, plt, show, tqdm(a)\n"
    )
    assert refused(source) == {}


def test_an_import_that_may_fail_and_a_name_that_is_not_used_count_for_nothing():
    source = (
        "import cv2\ndef f(a):\n    try:\n        import skimage\n    except ImportError:\n        return a\n"
    )
    assert refused(source) == {}


def test_a_value_of_another_cell_is_no_use_of_a_module():
    """In grading it is missing, and the answer fails for that."""
    assert refused("def f(a):\n    return FLAG\n", others="import cv2\nFLAG = cv2.IMREAD_COLOR") == {}


def test_a_name_that_only_begins_like_an_allowed_one_is_not_allowed():
    assert list(refused("def f(a):\n    import jsonschema, skimage\n", ("json", "ski"))) == ["jsonschema"]


def test_what_is_given_needs_no_permission_and_a_value_of_such_a_name_is_no_module():
    assert refused("def f(a):\n    return cv2.add(a, a)\n", given={"cv2"}) == {}
    assert refused("def f(a):\n    return cv2 + a\n", namespace={"cv2": 3}) == {}
    assert refused("def f(a):\n    return cv2.add(a)\n", namespace={"cv2": ast}) == {"cv2": "cv2"}


@pytest.mark.parametrize(
    ("source", "after"),
    [
        ("import numpy as np\nx = 1", "import numpy as np\nx = 1"),
        ("import cv2\nx = 1", "pass\nx = 1"),
        ("def f():\n    import cv2", "def f():\n    import cv2"),  # an answer that comes so far is refused
        (
            "try:\n    import cv2\nexcept ImportError:\n    pass",
            "try:\n    raise ModuleNotFoundError('write this exercise without cv2', name='cv2')\n"
            "except ImportError:\n    pass",
        ),
    ],
)
def test_modules_that_are_not_allowed_cannot_be_imported(source, after):
    assert ast.unparse(tree_as_graded(source, ())[0]) == after


def test_what_python_cannot_read_has_no_tree():
    assert tree_as_graded("def (", ()) == (None, {})


def test_bound_names():
    source = (
        "import a.b, c as d\nx, (y, *z) = 1, (2, 3)\ndef g(h): i = 1\nclass J: k = 2\nfor m in []: n = 1\n"
        "o = [p for p in x]\n"
    )
    assert bound_names(source) == {"a", "d", "x", "y", "z", "g", "J", "m", "n", "o"}
    assert bound_names("def (") == set()
