"""Read the files of a ROS 2 package that a learner wrote as texts, and feed its node.

The answer is a function without arguments that returns {path: text}, paths as "package.xml". setup.py runs
without setuptools. The node's file is run, and its class is fed as `node.feed` says.
"""

import ast
import builtins
import sys
import types
import xml.etree.ElementTree as ET
from unittest import mock

from nbclassroom import course

from ...cell_syntax import names_in, program_lines
from ...running import NodeError
from ..node.feed import feed

# {what a node imports: its rosdep key}
_KEYS = {"cv2": "python3-opencv", "numpy": "python3-numpy"} | {
    name: name for name in course.node_modules() if name != "builtin_interfaces"
}
_PIP_NAMES = {"opencv-python", "opencv-python-headless", "numpy"}
_ELEMENTS = ("name", "version", "description", "maintainer", "license")
_DEPENDENCIES = ("depend", "exec_depend", "build_depend")


def feed_package(function, part, steps):
    """What a file of a package says, or what its node does: a dict, compared with that of the solution.

    `part` is "package.xml", "setup.py", or as `feed` takes it. NodeError: a file is missing or unreadable.
    """
    files = function()
    parts = [part for item in files.items() for part in item] if isinstance(files, dict) else [None]
    if not all(isinstance(part, str) for part in parts):
        raise NodeError('Return a dict of texts, {path: text}, such as {"package.xml": "..."}.')
    if part == "package.xml":
        return _read_manifest(files)
    if part == "setup.py":
        return _read_setup(files)
    return feed(_node_class(files), part, steps)


def _text(files, name):
    if name not in files:
        raise NodeError(f"There is no {name}. The paths are: {', '.join(sorted(files)) or 'none'}.")
    return files[name]


def _parse(files, name):
    try:
        return ast.parse(_text(files, name), name)
    except SyntaxError as error:
        raise NodeError(f"{name}, line {error.lineno}, is not Python: {error.msg.rstrip('?')}.") from None


def _node_file(files):
    """The path of the file that defines a class: the node's."""
    paths = [path for path in files if path.endswith(".py") and path != "setup.py"]
    parts = {path: _parse(files, path).body for path in paths}
    nodes = [path for path in paths if any(isinstance(part, ast.ClassDef) for part in parts[path])]
    if len(nodes) != 1:
        raise NodeError(
            "One file must define the class of the node, such as image_negative/image_negative.py."
        )
    return nodes[0]


def _read_manifest(files):
    try:
        root = ET.fromstring(_text(files, "package.xml").strip())
    except ET.ParseError as error:
        raise NodeError(f"package.xml is not XML: {error}. Is each <tag> closed by a </tag>?") from None
    named = {element.text.strip() for tag in _DEPENDENCIES for element in root.iter(tag) if element.text}
    needed = {_KEYS[name] for name in _imports(_parse(files, _node_file(files))) if name in _KEYS}
    return {
        "name": root.findtext("name", "").strip(),
        "missing elements": " ".join(tag for tag in _ELEMENTS if not root.findtext(tag, "").strip()),
        "build type": root.findtext("export/build_type", "").strip(),
        "names of pip": " ".join(sorted(named & _PIP_NAMES)),
        "missing dependencies": " ".join(sorted(needed - named)),
    }


def _imports(tree):
    """The top names of the modules that a file imports."""
    for part in ast.walk(tree):
        names = [alias.name for alias in part.names] if isinstance(part, ast.Import) else []
        names += [part.module or ""] if isinstance(part, ast.ImportFrom) else []
        yield from (name.partition(".")[0] for name in names)


def _read_setup(files):
    path = _node_file(files)
    given = _arguments_of_setup(files, path.partition("/")[0])
    entry_points = given.get("entry_points")
    lines = entry_points.get("console_scripts") if isinstance(entry_points, dict) else None
    scripts = sorted("".join(str(line).split()) for line in lines or ())
    started = {script.partition("=")[2].partition(":")[0].replace(".", "/") + ".py" for script in scripts}
    return {
        "name": str(given.get("name")),
        "packages": " ".join(map(str, given.get("packages") or ())),
        "executables": ", ".join(scripts),
        "missing paths": " ".join(sorted(started - files.keys())),
        "data files": ", ".join(sorted(_data_files(given.get("data_files") or ()))),
        "main": any(getattr(part, "name", "") == "main" for part in _parse(files, path).body),
    }


def _arguments_of_setup(files, package):
    """What setup.py gives to setup(): it runs with a setuptools that only keeps it."""
    calls: list[dict] = []
    setuptools = types.ModuleType("setuptools")
    vars(setuptools)["setup"] = lambda **given: calls.append(given)
    vars(setuptools)["find_packages"] = lambda *_arguments, **_options: [package]
    code = compile(_parse(files, "setup.py"), "setup.py", "exec")
    with mock.patch.dict(sys.modules, {"setuptools": setuptools}):
        exec(code, {"__name__": "setup"})
    if len(calls) != 1:
        raise NodeError("setup.py must call setup(...) once.")
    return calls[0]


def _data_files(entries):
    for entry in entries:
        folder, files = entry if isinstance(entry, list | tuple) and len(entry) == 2 else (None, None)
        if isinstance(folder, str) and isinstance(files, list | tuple) and not folder.endswith("/launch"):
            yield from (f"{file} to {folder}" for file in files)


def _node_class(files):
    """The class that the node's file defines."""
    path = _node_file(files)
    unknown = set(_imports(_parse(files, path))) - {*_KEYS, course.package, *sys.stdlib_module_names}
    if unknown:
        raise NodeError(f"{path} imports {min(unknown)}, which this exercise does not need.")
    for line, code in program_lines(files[path], is_main=False)[:1]:
        raise NodeError(f"{path}, line {line}: {code} runs when the file is imported: delete this line.")
    name = path.removesuffix(".py").replace("/", ".")
    names = {"__name__": name}
    code = compile(files[path], path, "exec")
    exec(code, names)
    for unknown in sorted(names_in(code).reads - names.keys() - vars(builtins).keys())[:1]:
        raise NodeError(f"{path} reads {unknown}, and nothing in this file has that name.")
    return next(kind for kind in names.values() if isinstance(kind, type) and kind.__module__ == name)
