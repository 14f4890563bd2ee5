"""The house's own rules: which room imports which, and what no file may hold."""

import ast
import re
import subprocess
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[1]
PACKAGE = ROOT / "imgproc_course"

# room -> the rooms of ours that it may import at any depth of its code
ARROWS = {
    "messages": set(),
    "imaging": set(),
    "recording": {"messages"},
    "ros": {"messages", "recording"},
    "display": {"messages", "recording"},  # and ros, inside live_view alone
    "exercises": {"display"},
    "grading": {"exercises"},
}
MODULE_ARROWS = {"display/live_view.py": {"ros"}, "display/tuners.py": {"ros"}}
CALLS_OTHER_PEOPLES_CODE = {"ros", "display", "exercises"}


def modules():
    return sorted(path for path in PACKAGE.rglob("*.py"))


def relative(path):
    return path.relative_to(PACKAGE).as_posix()


def imported_names(path):
    """Absolute names of everything that a module imports, wherever in the module it does."""
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


def rooms_imported(path):
    for name in imported_names(path):
        parts = name.split(".")
        if parts[0] == "imgproc_course" and len(parts) > 1 and parts[1] in ARROWS:
            yield parts[1]


@pytest.mark.parametrize("path", modules(), ids=relative)
def test_imports_go_one_way(path):
    room = path.relative_to(PACKAGE).parts[0]
    if room not in ARROWS:
        return  # cli, doctor and the like may call every room
    allowed = ARROWS[room] | {room} | MODULE_ARROWS.get(relative(path), set())
    assert set(rooms_imported(path)) <= allowed


@pytest.mark.parametrize("path", modules(), ids=relative)
def test_only_ros_imports_rclpy(path):
    room = path.relative_to(PACKAGE).parts[0]
    roots = {name.split(".")[0] for name in imported_names(path)}
    assert room == "ros" or "rclpy" not in roots


@pytest.mark.parametrize("path", modules(), ids=relative)
def test_every_exception_is_caught_only_where_other_peoples_code_is_called(path):
    room = path.relative_to(PACKAGE).parts[0]
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(node, ast.ExceptHandler):
            names = [n.id for n in ast.walk(node.type) if isinstance(n, ast.Name)] if node.type else ["bare"]
            if {"Exception", "BaseException", "bare"} & set(names):
                assert room in CALLS_OTHER_PEOPLES_CODE, f"line {node.lineno}"


def test_modules_are_named_after_what_they_are_about():
    vague = {"utils", "helpers", "common", "misc", "util", "helper"}
    assert [relative(p) for p in modules() if p.stem in vague] == []


def test_there_are_modules_to_check():
    assert {p.relative_to(PACKAGE).parts[0] for p in modules()} >= {"messages", "recording", "ros", "display"}


def tracked_files():
    listed = subprocess.run(["git", "ls-files", "-z"], cwd=ROOT, capture_output=True, text=True)
    if listed.returncode:
        pytest.fail("not a git checkout: the files to look at are those that git tracks")
    return [ROOT / name for name in listed.stdout.split("\0") if name]


def test_no_file_names_this_machine_or_a_package_index():
    here = re.compile(
        "|".join(
            [
                re.escape(f"{ROOT}/"),
                r"(?<![\w.])" + re.escape(f"{Path.home()}/"),
                r"--(?:extra-)?index-url",
                r"pypi\." + "org",
            ]
        )
    )
    allowed = {"tests/test_house.py"}
    found = []
    for path in tracked_files():
        name = path.relative_to(ROOT).as_posix()
        if name in allowed or not path.is_file() or path.suffix in {".mcap", ".gz", ".png", ".jpg", ".db3"}:
            continue
        text = path.read_text(encoding="utf-8", errors="replace")
        found += [f"{name}: {match[0]}" for match in here.finditer(text)]
    assert found == []


@pytest.mark.parametrize("which", ["lab", "test", "opencv5", "uv", "nbgrader"])
def test_requirements_are_pinned_and_hashed(which):
    text = (ROOT / f"environment/requirements-{which}.txt").read_text(encoding="utf-8")
    requirements = re.split(r"\n(?=\S)", text.strip())
    assert len(requirements) >= (1 if which in ("opencv5", "uv") else 50)
    for requirement in requirements:
        assert re.match(r"[a-z0-9][a-z0-9.-]*==\S+", requirement), requirement.splitlines()[0]
        assert requirement.count("--hash=sha256:") >= 1, requirement.splitlines()[0]


def test_the_real_rclpy_is_asked_for_only_where_its_wheels_exist():
    text = (ROOT / "environment/requirements-lab.txt").read_text(encoding="utf-8")
    lines = [line for line in text.splitlines() if line.startswith("ros-")]
    assert len(lines) > 50
    assert all("platform_machine == 'x86_64' and sys_platform == 'linux'" in line for line in lines)
