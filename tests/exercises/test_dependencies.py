"""What an answer uses from outside its own cell."""

import linecache

from imgproc_course.exercises.dependencies import Dependencies, bound_names, find_dependencies


def function_in_cell(source, *, others="", name="f", file="<cell 1>"):
    """A function as a notebook holds it: its own cell, and one shared namespace."""
    namespace = {}
    exec(compile(others, "<another cell>", "exec"), namespace)
    linecache.cache[file] = (len(source), None, source.splitlines(keepends=True), file)
    exec(compile(source, file, "exec"), namespace)
    return namespace[name]


def test_a_function_that_needs_nothing_has_no_dependencies():
    function = function_in_cell("import numpy as np\nK = 3\ndef f(a):\n    return np.sum(a) + K + len(a)\n")
    assert find_dependencies(function, ("cv2",), set()) == Dependencies()


def test_names_of_another_cell_are_foreign_and_given_ones_are_not():
    function = function_in_cell(
        "def f(a):\n    return helper(a) + K\n", others="K = 3\ndef helper(a): return a\n"
    )
    assert find_dependencies(function, (), {"K"}).foreign == ("helper",)


def test_a_helper_in_the_same_cell_is_followed():
    function = function_in_cell("def g(a):\n    return K\ndef f(a):\n    return g(a)\n", others="K = 3")
    assert find_dependencies(function, (), set()).foreign == ("K",)


def test_refused_modules_are_seen_however_they_are_named():
    refused = ("json", "imgproc_course.imaging", "xml")
    sources = {
        "import json\ndef f(a):\n    return json.dumps(a)\n": "json",
        "import json as j\ndef f(a):\n    return j.dumps(a)\n": "json",
        "from json import dumps\ndef f(a):\n    return dumps(a)\n": "json",
        "def f(a):\n    import json\n": "json",
        "def f(a):\n    from xml.dom import minidom\n": "xml",
        "def f(a):\n    def inner():\n        import json\n    return inner()\n": "json",
        "def f(a):\n    from imgproc_course import imaging\n": "imgproc_course.imaging",
    }
    for source, module in sources.items():
        assert find_dependencies(function_in_cell(source), refused, set()).refused == (module,), source
    other_cell = function_in_cell("def f(a):\n    return dumps(a)\n", others="from json import dumps")
    assert find_dependencies(other_cell, refused, set()) == Dependencies(refused=("json",))


def test_a_name_that_only_begins_like_a_refused_one_is_free():
    function = function_in_cell("def f(a):\n    import jsonschema\n")
    assert find_dependencies(function, ("json",), set()).refused == ()


def test_where_a_name_of_another_cell_comes_from():
    others = (
        "import math\nimport xml.dom.minidom as dom\nfrom imgproc_course.imaging import psnr\n"
        "K = 3\ndef helper(a): return a\n"
    )
    function = function_in_cell(
        "def f(a):\n    return math.pi, dom.parse, psnr(a, a), K, helper(a)\n", others=others
    )
    assert find_dependencies(function, (), set()).origins == {
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
    refused = find_dependencies(function, ("imgproc_course.imaging",), set())
    assert refused.names == {"imgproc_course.imaging": "psnr"}


def test_bound_names():
    source = (
        "import a.b, c as d\nx, (y, *z) = 1, (2, 3)\ndef g(h): i = 1\nclass J: k = 2\nfor m in []: n = 1\n"
    )
    assert bound_names(source) == {"a", "d", "x", "y", "z", "g", "J", "m", "n"}
    assert bound_names("def (") == set()
