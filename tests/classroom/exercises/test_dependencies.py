"""What an answer uses from outside its own cell."""

import linecache

from imgproc_course.classroom.exercises.dependencies import Dependencies, bound_names, find_dependencies


def function_in_cell(source, *, others="", name="f", file="<cell 1>"):
    """A function as a notebook holds it: its own cell, and one shared namespace."""
    namespace = {}
    exec(compile(others, "<another cell>", "exec"), namespace)
    linecache.cache[file] = (len(source), None, source.splitlines(keepends=True), file)
    exec(compile(source, file, "exec"), namespace)
    return namespace[name]


def test_a_function_that_needs_nothing_has_no_dependencies():
    function = function_in_cell("import numpy as np\nK = 3\ndef f(a):\n    return np.sum(a) + K + len(a)\n")
    assert find_dependencies(function, (), set()) == Dependencies()


def test_names_of_another_cell_are_foreign_and_given_ones_are_not():
    function = function_in_cell(
        "def f(a):\n    return helper(a) + K\n", others="K = 3\ndef helper(a): return a\n"
    )
    assert find_dependencies(function, (), {"K"}).foreign == ("helper",)


def test_a_helper_in_the_same_cell_is_followed():
    function = function_in_cell("def g(a):\n    return K\ndef f(a):\n    return g(a)\n", others="K = 3")
    assert find_dependencies(function, (), set()).foreign == ("K",)


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
    }
    for source, module in sources.items():
        assert find_dependencies(function_in_cell(source), (), set()).refused == (module,), source
        assert find_dependencies(function_in_cell(source), (module,), set()).refused == (), source
    other_cell = function_in_cell("def f(a):\n    return new(a)\n", others="from PIL.Image import new")
    assert find_dependencies(other_cell, (), set()) == Dependencies(refused=("PIL",))


def test_numpy_the_standard_library_and_what_shows_something_need_no_permission():
    function = function_in_cell(
        "import json, math, numpy as np\nfrom IPython.display import display\n"
        "import matplotlib.pyplot as plt\nfrom imgproc_course.display import show\n"
        "def f(a):\n    import xml.dom.minidom\n    return json, math, np, display, plt, show\n"
    )
    assert find_dependencies(function, (), set()) == Dependencies()


def test_an_import_that_may_fail_and_a_name_that_is_not_used_count_for_nothing():
    function = function_in_cell(
        "import cv2\ndef f(a):\n    try:\n        import skimage\n    except ImportError:\n        return a\n"
    )
    assert find_dependencies(function, (), set()) == Dependencies()


def test_a_name_that_only_begins_like_an_allowed_one_is_not_allowed():
    function = function_in_cell("def f(a):\n    import jsonschema, skimage\n")
    assert find_dependencies(function, ("json", "ski"), set()).refused == ("jsonschema", "skimage")


def test_what_is_given_needs_no_permission():
    function = function_in_cell("def f(a):\n    return cv2.add(a, a)\n", others="import cv2")
    assert find_dependencies(function, (), {"cv2"}) == Dependencies()


def test_where_a_name_of_another_cell_comes_from():
    others = (
        "import math\nimport xml.dom.minidom as dom\nfrom imgproc_course.imaging import psnr\n"
        "K = 3\ndef helper(a): return a\n"
    )
    function = function_in_cell(
        "def f(a):\n    return math.pi, dom.parse, psnr(a, a), K, helper(a)\n", others=others
    )
    assert find_dependencies(function, ("imgproc_course.imaging",), set()).origins == {
        "math": "import math",
        "dom": "import xml.dom.minidom as dom",
        "psnr": "from imgproc_course.imaging import psnr",
        "K": "value",
        "helper": "function",
    }


def test_the_name_by_which_a_refused_module_is_used():
    function = function_in_cell(
        "def f(a):\n    return psnr(a, a)\n", others="from imgproc_course.imaging import psnr"
    )
    refused = find_dependencies(function, (), set())
    assert refused.names == {"imgproc_course.imaging": "psnr"}


def test_bound_names():
    source = (
        "import a.b, c as d\nx, (y, *z) = 1, (2, 3)\ndef g(h): i = 1\nclass J: k = 2\nfor m in []: n = 1\n"
    )
    assert bound_names(source) == {"a", "d", "x", "y", "z", "g", "J", "m", "n"}
    assert bound_names("def (") == set()
