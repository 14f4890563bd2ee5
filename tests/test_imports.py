"""The rules of the project: which package imports which, and what no file may contain."""

import ast
import re
import subprocess
from graphlib import TopologicalSorter
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[1]
PACKAGE = ROOT / "imgproc_course"

# Each package, and exactly those of our packages that its modules import. The design allows no other import,
# and an arrow that is no longer used must be removed.
ARROWS = {
    "messages": set(),
    "imaging": set(),
    "geometry": set(),
    "recording": {"messages"},
    "simulation": {"geometry"},
    "ros": {"messages", "recording", "simulation"},
    "display": {"messages", "ros"},
    "exercises": {"classroom"},
    "classroom": set(),
}
# The same inside the classroom; its modules import nothing else of the course.
CLASSROOM_ARROWS = {
    "course": set(),
    "exercises": {"course"},
    "authoring": {"exercises"},
    "autograder": {"authoring", "course", "exercises"},
    "gradebook": {"authoring", "autograder", "exercises"},
}
# Arrows that only some modules of a package may use.
ONLY_IN = {
    ("display", "ros"): {"display/live_view.py", "display/drive.py"},
}
ONLY_IN_CLASSROOM = {
    ("autograder", "authoring"): {"classroom/autograder/make_answer_key.py"},
}
# These may import every package: the command line, and the modules that its commands start.
CALLERS = {"cli.py", "doctor", "lab"}
# Modules beside the packages, which import none of them.
BESIDE = {"__init__.py", "learner_errors.py", "ros_domain.py"}
CALLS_OTHER_PEOPLES_CODE = ("ros/", "display/", "classroom/exercises/", "classroom/autograder/")
SHOWS_OTHER_PEOPLES_VALUES = {"classroom/gradebook/grades_folder.py"}  # they harm one page only


def modules():
    return sorted(path for path in PACKAGE.rglob("*.py"))


def relative(path):
    return path.relative_to(PACKAGE).as_posix()


def module_name(path):
    return ".".join(path.relative_to(PACKAGE.parent).with_suffix("").parts).removesuffix(".__init__")


def imported_names(path):
    """Absolute names of everything that a module imports, also inside functions."""
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(node, ast.Import):
            yield from (alias.name for alias in node.names)
        elif isinstance(node, ast.ImportFrom):
            base = node.module or ""
            if node.level:
                package = ["imgproc_course", *path.relative_to(PACKAGE).parent.parts]
                package = package[: len(package) - node.level + 1]
                base = ".".join([*package, base] if base else package)
            yield base
            yield from (f"{base}.{alias.name}" for alias in node.names)


def package_of(path):
    return path.relative_to(PACKAGE).parts[0]


def packages_imported(path):
    """Our other packages that a module imports."""
    parts = (name.split(".") for name in imported_names(path))
    names = {part[1] for part in parts if part[0] == "imgproc_course" and len(part) > 1}
    return (names & ARROWS.keys()) - {package_of(path)}


def part_of(path):
    """The part of the classroom that a module belongs to: a package, or the name of a module beside them."""
    return path.relative_to(PACKAGE / "classroom").parts[0].removesuffix(".py")


def parts_imported(path):
    """The other parts of the classroom that a module of it imports."""
    parts = (name.split(".") for name in imported_names(path))
    names = {part[2] for part in parts if part[:2] == ["imgproc_course", "classroom"] and len(part) > 2}
    return names - {part_of(path)}


@pytest.mark.parametrize("package", ARROWS)
def test_a_package_imports_exactly_what_the_design_says(package):
    paths = [path for path in modules() if package_of(path) == package]
    assert set().union(*map(packages_imported, paths)) == ARROWS[package]


@pytest.mark.parametrize("part", CLASSROOM_ARROWS)
def test_a_part_of_the_classroom_imports_exactly_what_the_design_says(part):
    paths = [path for path in modules() if package_of(path) == "classroom" and part_of(path) == part]
    assert paths and set().union(*map(parts_imported, paths)) == CLASSROOM_ARROWS[part]


def test_the_classroom_imports_nothing_else_of_the_course():
    paths = [path for path in modules() if package_of(path) == "classroom"]
    names = {name for path in paths for name in imported_names(path) if name.startswith("imgproc_course")}
    assert {name for name in names if name.split(".")[1:2] != ["classroom"]} == set()


@pytest.mark.parametrize(("arrow", "allowed"), ONLY_IN.items())
def test_an_arrow_that_only_some_modules_may_use(arrow, allowed):
    package, imported = arrow
    paths = [path for path in modules() if package_of(path) == package]
    assert {relative(path) for path in paths if imported in packages_imported(path)} == allowed


@pytest.mark.parametrize(("arrow", "allowed"), ONLY_IN_CLASSROOM.items())
def test_an_arrow_that_only_some_modules_of_the_classroom_may_use(arrow, allowed):
    part, imported = arrow
    paths = [path for path in modules() if package_of(path) == "classroom" and part_of(path) == part]
    assert {relative(path) for path in paths if imported in parts_imported(path)} == allowed


def test_the_arrows_make_no_circle():
    assert TopologicalSorter(ARROWS).static_order()
    assert list(TopologicalSorter(CLASSROOM_ARROWS).static_order())[-1] == "gradebook"


def test_no_modules_import_one_another():
    names = {module_name(path): path for path in modules()}
    imports = {
        name: {base for base in imported_names(path) if base in names and not name.startswith(f"{base}.")}
        for name, path in names.items()
    }
    pairs = {tuple(sorted([a, b])) for a in imports for b in imports[a] if a != b and a in imports[b]}
    assert pairs == set()


def test_every_package_has_its_arrows():
    assert {package_of(path) for path in modules()} - CALLERS - BESIDE == ARROWS.keys()
    assert [name for name in BESIDE if packages_imported(PACKAGE / name)] == []
    inside = {part_of(path) for path in modules() if package_of(path) == "classroom"} - {"__init__"}
    assert inside == CLASSROOM_ARROWS.keys()


def importing(root):
    return [path for path in modules() if root in {name.split(".")[0] for name in imported_names(path)}]


def test_only_ros_imports_rclpy_and_only_the_renderer_panda3d():
    assert {package_of(path) for path in importing("rclpy")} == {"ros"}
    assert [relative(path) for path in importing("panda3d")] == ["simulation/renderer.py"]


def catches_everything(handler):
    names = [n.id for n in ast.walk(handler.type) if isinstance(n, ast.Name)] if handler.type else ["bare"]
    return bool({"Exception", "BaseException", "bare"} & set(names))


def test_every_exception_is_caught_only_where_other_peoples_code_is_called():
    catching = [
        f"{relative(path)}, line {node.lineno}"
        for path in modules()
        if not relative(path).startswith(CALLS_OTHER_PEOPLES_CODE)
        and relative(path) not in SHOWS_OTHER_PEOPLES_VALUES
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8")))
        if isinstance(node, ast.ExceptHandler) and catches_everything(node)
    ]
    assert catching == []


def test_modules_are_named_after_what_they_are_about():
    vague = {"utils", "helpers", "common", "misc", "util", "helper"}
    assert [relative(p) for p in modules() if p.stem in vague] == []


def tracked_files():
    listed = subprocess.run(["git", "ls-files", "-z"], cwd=ROOT, capture_output=True, text=True)
    if listed.returncode:
        pytest.fail("not a git checkout: the files to look at are those that git tracks")
    return [ROOT / name for name in listed.stdout.split("\0") if name]


def test_no_file_names_this_machine_or_a_package_index():
    forbidden = re.compile(
        "|".join(
            [
                re.escape(f"{ROOT}/"),
                r"(?<![\w.])" + re.escape(f"{Path.home()}/"),
                r"--(?:extra-)?index-url",
                r"pypi\." + "org",
            ]
        )
    )
    allowed = {"tests/test_imports.py"}
    matches = []
    for path in tracked_files():
        name = path.relative_to(ROOT).as_posix()
        if name in allowed or not path.is_file() or path.suffix in {".mcap", ".gz", ".png", ".jpg", ".db3"}:
            continue
        text = path.read_text(encoding="utf-8", errors="replace")
        matches += [f"{name}: {match[0]}" for match in forbidden.finditer(text)]
    assert matches == []


@pytest.mark.parametrize("name", ["lab", "test", "opencv5", "uv", "nbgrader"])
def test_requirements_are_pinned_and_hashed(name):
    text = (ROOT / f"environment/requirements-{name}.txt").read_text(encoding="utf-8")
    requirements = re.split(r"\n(?=\S)", text.strip())
    assert len(requirements) >= (1 if name in ("opencv5", "uv") else 50)
    for requirement in requirements:
        assert re.match(r"[a-z0-9][a-z0-9.-]*==\S+", requirement), requirement.splitlines()[0]
        assert requirement.count("--hash=sha256:") >= 1, requirement.splitlines()[0]


def test_the_real_rclpy_is_required_only_where_its_wheels_exist():
    text = (ROOT / "environment/requirements-lab.txt").read_text(encoding="utf-8")
    lines = [line for line in text.splitlines() if line.startswith("ros-")]
    assert len(lines) > 50
    assert all("platform_machine == 'x86_64' and sys_platform == 'linux'" in line for line in lines)
