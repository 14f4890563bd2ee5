"""Which modules a kernel has: those that every answer may use, and those that its exercise allows.

Whatever is not allowed is not there: no file of it is in a kernel's file system.
"""

import ast
from dataclasses import dataclass
from functools import lru_cache
from importlib import metadata
from pathlib import Path

from packaging.requirements import Requirement
from packaging.utils import canonicalize_name

from imgproc_course.classroom import course
from imgproc_course.classroom.autograder.sandbox import bubblewrap

# The kernel itself, NumPy, and what draws. Pillow, which matplotlib needs, has a stub (inside/PIL): it would
# solve exercises.
BASE = ("numpy", "matplotlib", "ipython", "ipykernel")
STUBBED = "pillow"
_ALWAYS = ("PIL", f"{course.NAME}.classroom", *course.ALWAYS_ALLOWED)


@dataclass(frozen=True)
class ModuleAccess:
    """What a kernel of an exercise has.

    names  top-level modules, and packages of the course as "imgproc_course.imaging"
    bound  (path, where it appears) inside the sandbox, of what the exercise allows beside `base_paths`
    """

    names: tuple
    bound: tuple


@lru_cache(maxsize=64)
def module_access(allowed):
    """The ModuleAccess of an exercise.

    Parameters
    ----------
    allowed : tuple of str, modules that it allows: ("scipy", "imgproc_course.imaging")
    """
    packages = _with_dependencies({name for name in allowed if name.startswith(f"{course.NAME}.")})
    tops = {name.partition(".")[0] for name in allowed} - {course.NAME}
    paths = _paths_of(_distributions_with(tops)) - set(base_paths())
    bound = [(bubblewrap.extra_path(path), f"{bubblewrap.ALLOWED}/{path.name}") for path in paths]
    bound += [bubblewrap.course_package_paths(name.partition(".")[2]) for name in packages]
    names = {path.name.partition(".")[0] for path in (*base_paths(), *paths)} | {*_ALWAYS, *packages, *tops}
    return ModuleAccess(tuple(sorted(names)), tuple(sorted(bound)))


@lru_cache(maxsize=1)
def base_paths():
    """The installed files and folders that every kernel has: a tuple of Path, outside the sandbox."""
    return tuple(sorted(_paths_of(BASE, without=[STUBBED])))


def _paths_of(names, without=()):
    """The top-level paths of distributions and of all that they require."""
    paths, waiting, visited = set(), [canonicalize_name(name) for name in names], set(without)
    while waiting:
        name = waiting.pop()
        if name in visited:
            continue
        visited.add(name)
        try:
            distribution = metadata.distribution(name)
        except metadata.PackageNotFoundError:
            continue
        tops = _top_names(distribution) - {"..", "__pycache__"}
        folder = Path(distribution.locate_file(""))
        paths |= {folder / top for top in tops if (folder / top).exists()}
        waiting += _names_required_by(distribution)
    return paths


def _names_required_by(distribution):
    """The names of the distributions that one requires without any extra.

    Most requirements belong to extras; to parse them all takes half of the time for a sandbox's command line.
    """
    text = distribution.read_text("METADATA")
    if text is None:
        lines = distribution.requires or ()
    else:
        header = text.partition("\n\n")[0].splitlines()
        lines = [line.partition(":")[2] for line in header if line.startswith("Requires-Dist:")]
    requirements = (Requirement(line) for line in lines if " or " in line or "extra ==" not in line)
    return [
        canonicalize_name(requirement.name)
        for requirement in requirements
        if not requirement.marker or requirement.marker.evaluate({"extra": ""})
    ]


def _top_names(distribution):
    """The first parts of the paths of its files.

    Its `files` would be parsed one by one, which takes a quarter of a second for all that kernels have.
    """
    record = distribution.read_text("RECORD")
    if record is None:
        return {file.parts[0] for file in distribution.files or ()}
    return {line.partition(",")[0].partition("/")[0].strip('"') for line in record.splitlines()}


def _distributions_with(tops):
    """The names of the distributions that install top-level modules.

    Like metadata.packages_distributions(), without parsing the metadata of 250 distributions, which takes a
    third of a second.
    """
    prefixes = [f"\n{top}{end}".encode() for top in tops for end in ("/", ".py,", ".cpython", ".abi3")]
    records = [path for folder in bubblewrap.site_folders() for path in folder.glob("*.dist-info/RECORD")]
    installed = [path for path in records if prefixes and _has_line(path, prefixes)]
    return [metadata.PathDistribution(path.parent).metadata["Name"] for path in installed]


def _has_line(path, prefixes):
    text = b"\n" + path.read_bytes()
    return any(prefix in text for prefix in prefixes)


def _with_dependencies(packages):
    """Packages of the course, and the packages of the course that they import."""
    waiting, reached = list(packages), set()
    while waiting:
        package = waiting.pop()
        if package in reached or package in _ALWAYS:
            continue
        reached.add(package)
        for path in (bubblewrap.SOURCE / package.partition(".")[2].replace(".", "/")).rglob("*.py"):
            for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
                if isinstance(node, ast.ImportFrom) and (node.module or "").startswith(f"{course.NAME}."):
                    waiting.append(".".join(node.module.split(".")[:2]))
    return reached
