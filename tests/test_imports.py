"""The rules of the project: which package imports which, and what no file may contain."""

import ast
import re
import subprocess
from graphlib import TopologicalSorter
from pathlib import Path

import pytest
from nbclassroom.autograder.sandbox import bubblewrap

ROOT = Path(__file__).parents[1]
COURSE = ROOT / "imgproc_course"
CLASSROOM = ROOT / "nbclassroom" / "nbclassroom"

# Each package of the course, and exactly those of its packages that its modules import. The design allows no
# other import, and an arrow that is no longer used must be removed.
COURSE_ARROWS = {
    "messages": set(),
    "imaging": set(),
    "geometry": set(),
    "recording": {"extras", "messages"},
    "simulation": {"extras", "geometry"},
    "ros": {"learner_errors", "messages", "recording", "ros_domain", "simulation"},
    "display": {"extras", "learner_errors", "messages", "ros"},
    "exercises": {"course_file"},
}
# The same of the classroom.
CLASSROOM_ARROWS = {
    "course": set(),
    "exercises": {"course"},
    "authoring": {"course", "exercises"},
    "autograder": {"authoring", "course", "exercises"},
    "gradebook": {"authoring", "autograder", "course", "exercises"},
    "lab": {"authoring", "course", "exercises"},
    "league": {"autograder", "course", "exercises", "gradebook"},
    "cli": {"authoring", "autograder", "course", "gradebook", "lab", "league"},
}
ARROWS = {COURSE: COURSE_ARROWS, CLASSROOM: CLASSROOM_ARROWS}
# Arrows that only some modules of a package may use.
ONLY_IN = {
    (COURSE, "display", "ros"): {"display/live_view.py", "display/drive.py"},
    (CLASSROOM, "autograder", "authoring"): {"autograder/make_answer_key.py"},
}
# These may import every package of the course: the command line, and the modules that its commands start.
CALLERS = {"cli", "doctor"}
# Modules beside the packages, which import none of them.
BESIDE = {"__init__", "learner_errors", "ros_domain", "course_file", "extras"}
CALLS_OTHER_PEOPLES_CODE = ("ros/", "display/", "exercises/", "autograder/", "authoring/build.py")
SHOWS_OTHER_PEOPLES_VALUES = {"gradebook/grade.py"}  # they harm one page only


def modules(package):
    return sorted(path for path in package.rglob("*.py"))


def relative(path):
    return path.relative_to(folder_of(path)).as_posix()


def folder_of(path):
    return COURSE if path.is_relative_to(COURSE) else CLASSROOM


def module_name(path):
    parts = path.relative_to(folder_of(path).parent).with_suffix("").parts
    return ".".join(parts).removesuffix(".__init__")


def imported_names(path):
    """Absolute names of everything that a module imports, also inside functions."""
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(node, ast.Import):
            yield from (alias.name for alias in node.names)
        elif isinstance(node, ast.ImportFrom):
            base = node.module or ""
            if node.level:
                package = path.relative_to(folder_of(path).parent).parent.parts
                package = package[: len(package) - node.level + 1]
                base = ".".join([*package, base] if base else package)
            yield base
            yield from (f"{base}.{alias.name}" for alias in node.names)


def part_of(path):
    """The package that a module belongs to, or the name of a module beside them."""
    return path.relative_to(folder_of(path)).parts[0].removesuffix(".py")


def parts_imported(path):
    """The other packages of the same distribution that a module imports."""
    parts = (name.split(".") for name in imported_names(path))
    names = {part[1] for part in parts if part[0] == folder_of(path).name and len(part) > 1}
    known = ARROWS[folder_of(path)].keys() | (BESIDE if folder_of(path) == COURSE else set())
    return (names & known) - {part_of(path)}


@pytest.mark.parametrize(("folder", "part"), [(folder, part) for folder in ARROWS for part in ARROWS[folder]])
def test_a_package_imports_exactly_what_the_design_says(folder, part):
    paths = [path for path in modules(folder) if part_of(path) == part]
    assert paths and set().union(*map(parts_imported, paths)) == ARROWS[folder][part]


def test_the_classroom_imports_nothing_of_the_course_and_the_course_the_classroom_at_two_places():
    assert importing(CLASSROOM, "imgproc_course") == []
    assert [relative(path) for path in importing(COURSE, "nbclassroom")] == [
        "cli.py",
        "exercises/__init__.py",
    ]


def test_only_the_folder_of_a_kind_of_answer_asks_for_the_kind():
    asks = re.compile(r"\b(subject|kind\.name) (==|!=|in|not in) (?!NAMES)|isinstance\([^\n]*Kind\)")
    paths = [path for path in modules(CLASSROOM) if "kinds" not in path.parts]
    code = {relative(path): path.read_text(encoding="utf-8") for path in paths}
    assert [f"{name}: {found[0]}" for name, text in code.items() for found in asks.finditer(text)] == []


def imported_at_once(path):
    """Modules of the classroom's exercises that a module imports when it is imported itself."""
    tree = ast.parse(path.read_text(encoding="utf-8"))
    package = path.relative_to(CLASSROOM.parent).parent.parts
    for node in tree.body:
        if isinstance(node, ast.ImportFrom):
            above = ".".join(package[: len(package) - node.level + 1]) if node.level else ""
            base = f"{above}.{node.module or ''}".strip(".")
            for name in (base, *(f"{base}.{alias.name}" for alias in node.names)):
                file = CLASSROOM.parent / f"{name.replace('.', '/')}.py"
                if file.is_relative_to(CLASSROOM / "exercises") and file.exists():
                    yield file.relative_to(CLASSROOM / "exercises").with_suffix("").as_posix()


def test_the_sandbox_has_each_module_that_its_modules_import():
    inside = (CLASSROOM / "autograder" / "sandbox" / "inside").glob("*.py")
    there = [CLASSROOM / "exercises" / f"{name}.py" for name in bubblewrap.modules_of_exercises()]
    imported = {name for path in [*inside, *there] for name in imported_at_once(path)}
    assert len(imported) > 8 and imported - {*bubblewrap.modules_of_exercises()} == set()


def test_no_file_of_the_classroom_names_the_course():
    named = re.compile("imgproc|kachaka", re.IGNORECASE)
    paths = [path for path in CLASSROOM.rglob("*") if path.suffix in (".py", ".txt", ".html", ".toml")]
    assert [str(path) for path in paths if named.search(path.read_text(encoding="utf-8"))] == []


@pytest.mark.parametrize(("arrow", "allowed"), ONLY_IN.items())
def test_an_arrow_that_only_some_modules_may_use(arrow, allowed):
    folder, part, imported = arrow
    paths = [path for path in modules(folder) if part_of(path) == part]
    assert {relative(path) for path in paths if imported in parts_imported(path)} == allowed


def test_the_arrows_make_no_circle():
    assert TopologicalSorter(COURSE_ARROWS).static_order()
    assert list(TopologicalSorter(CLASSROOM_ARROWS).static_order())[-1] == "cli"


@pytest.mark.parametrize("folder", ARROWS)
def test_no_modules_import_one_another(folder):
    names = {module_name(path): path for path in modules(folder)}
    imports = {
        name: {base for base in imported_names(path) if base in names and not name.startswith(f"{base}.")}
        for name, path in names.items()
    }
    pairs = {tuple(sorted([a, b])) for a in imports for b in imports[a] if a != b and a in imports[b]}
    assert pairs == set()


def test_every_package_has_its_arrows():
    assert {part_of(path) for path in modules(COURSE)} - CALLERS - BESIDE - {
        "command"
    } == COURSE_ARROWS.keys()
    assert [name for name in BESIDE if parts_imported(COURSE / f"{name}.py")] == []
    assert {part_of(path) for path in modules(CLASSROOM)} - {
        "__init__",
        "__main__",
    } == CLASSROOM_ARROWS.keys()


def importing(folder, root):
    paths = modules(folder)
    return [path for path in paths if root in {name.split(".")[0] for name in imported_names(path)}]


def test_only_ros_imports_rclpy_and_only_the_renderer_panda3d():
    assert {part_of(path) for path in importing(COURSE, "rclpy")} == {"ros"}
    assert [relative(path) for path in importing(COURSE, "panda3d")] == ["simulation/renderer.py"]
    assert importing(CLASSROOM, "rclpy") == importing(CLASSROOM, "panda3d") == []


def catches_everything(handler):
    names = [n.id for n in ast.walk(handler.type) if isinstance(n, ast.Name)] if handler.type else ["bare"]
    return bool({"Exception", "BaseException", "bare"} & set(names))


def test_every_exception_is_caught_only_where_other_peoples_code_is_called():
    catching = [
        f"{relative(path)}, line {node.lineno}"
        for path in modules(COURSE) + modules(CLASSROOM)
        if not relative(path).startswith(CALLS_OTHER_PEOPLES_CODE)
        and relative(path) not in SHOWS_OTHER_PEOPLES_VALUES
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8")))
        if isinstance(node, ast.ExceptHandler) and catches_everything(node)
    ]
    assert catching == []


def test_modules_are_named_after_what_they_are_about():
    vague = {"utils", "helpers", "common", "misc", "util", "helper"}
    assert [relative(p) for p in modules(COURSE) + modules(CLASSROOM) if p.stem in vague] == []


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


@pytest.mark.parametrize(
    "path", [*(ROOT / "environment").glob("requirements-*.txt")], ids=lambda path: path.stem
)
def test_requirements_are_pinned_and_hashed(path):
    requirements = re.split(r"\n(?=\S)", path.read_text(encoding="utf-8").strip())
    assert len(requirements) == 1 or len(requirements) >= 50
    for requirement in requirements:
        assert re.match(r"[a-z0-9][a-z0-9.-]*==\S+", requirement), requirement.splitlines()[0]
        assert requirement.count("--hash=sha256:") >= 1, requirement.splitlines()[0]


def test_the_real_rclpy_is_required_only_where_its_wheels_exist():
    text = (ROOT / "environment/requirements-lab.txt").read_text(encoding="utf-8")
    lines = [line for line in text.splitlines() if line.startswith("ros-")]
    assert len(lines) > 50
    assert all("platform_machine == 'x86_64' and sys_platform == 'linux'" in line for line in lines)
