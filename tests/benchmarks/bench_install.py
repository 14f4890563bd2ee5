"""Both distributions as pip gives them: sdists, wheels made from these, and their tests there.

Required: the course's wheel brings NumPy, SciPy and OpenCV and nothing else, at most 450 MB; tests of
messages, imaging and geometry pass there. With the extra `ros` and what they compare with, all of them pass;
the tests of nbclassroom pass with its wheel, and its unit tests with both wheels, beside this course's
lessons. No test sees the checkout.

    .venv/bin/python tests/benchmarks/bench_install.py [--dist FOLDER]    FOLDER keeps sdists and wheels
"""

import argparse
import os
import shutil
import subprocess
import sys
import tarfile
import tempfile
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
UV = Path(sys.executable).with_name("uv")
MOST_MEGABYTES = 450
# Tests that need neither message classes, the recording, nor what results are compared with.
BARE = ("messages/test_encodings.py", "messages/test_copied_folder.py", "imaging/test_bad_images.py")
BARE += ("geometry/test_camera_model.py", "geometry/test_planes.py", "geometry/test_poses.py")
TOOLS = ("pytest", "hypothesis")
UNIT = ("authoring", "exercises")  # folders of tests/classroom
COMPARED_WITH = ("scikit-image", "gtsam", "pillow", "backports.zstd", "opencv-python-headless<5")


def run(*command, folder=ROOT):
    subprocess.run([str(part) for part in command], cwd=folder, check=True)


def build(project, dist, folder):
    """The wheel of a project, built from its unpacked sdist."""
    run(sys.executable, "-m", "hatchling", "build", "-t", "sdist", "-d", dist, folder=project)
    name = "imgproc_course" if project == ROOT else project.name
    (sdist,) = dist.glob(f"{name}-*.tar.gz")
    with tarfile.open(sdist) as archive:
        archive.extractall(folder, filter="data")
    unpacked = folder / sdist.name.removesuffix(".tar.gz")
    run(sys.executable, "-m", "hatchling", "build", "-t", "wheel", "-d", dist, folder=unpacked)
    (wheel,) = dist.glob(f"{name}-*.whl")
    return wheel


def install(environment, *requirements):
    """The Python of an environment with these packages."""
    if not environment.exists():
        run(UV, "venv", "-q", "-p", sys.executable, environment)
    python = environment / "bin" / "python"
    run(UV, "pip", "install", "-q", "--no-config", "--python", python, *requirements)
    return python


def names_in(python):
    command = [UV, "pip", "list", "-q", "--python", python, "--format", "freeze"]
    listed = subprocess.run(command, capture_output=True, text=True, check=True).stdout
    return {line.partition("==")[0] for line in listed.splitlines()}


def megabytes(folder):
    files = (path for path in folder.rglob("*") if path.is_file() and not path.is_symlink())
    return sum(path.stat().st_size for path in files) / 1e6


def run_tests(python, folder, *names):
    """Run tests in a copy, which has no checkout around it."""
    print(f"{Path(python).parents[1].name}: {' '.join(names)}", flush=True)
    # Without the tests' own conftest.py: the profile by which no test asserts on a clock is given here.
    options = ("-q", "--import-mode=importlib", "-p", "no:cacheprovider", "--hypothesis-profile=ci")
    run(python, "-m", "pytest", *options, *names, folder=folder)


def main(dist, folder):
    tests = folder / "tests"
    for name in ("messages", "imaging", "geometry"):
        shutil.copytree(ROOT / "tests" / name, tests / name)
    shutil.copytree(ROOT / "nbclassroom" / "tests", tests / "nbclassroom")
    course, classroom = (build(project, dist, folder) for project in (ROOT, ROOT / "nbclassroom"))
    begun = time.monotonic()
    python = install(folder / "bare", course)
    seconds, size = time.monotonic() - begun, megabytes(folder / "bare")
    print(f"bare: {seconds:.0f} s, {size:.0f} MB, {', '.join(sorted(names_in(python)))}")
    assert names_in(python) == {"imgproc-course", "numpy", "opencv-python-headless", "scipy"}
    assert size <= MOST_MEGABYTES, size
    install(folder / "bare", *TOOLS)
    run_tests(python, tests, *BARE)
    python = install(folder / "ros", f"{course}[ros]", *TOOLS, *COMPARED_WITH)
    assert not names_in(python) & {"rapidocr", "onnxruntime", "nbclassroom", "gymnasium"}
    run_tests(python, tests, "messages", "imaging", "geometry")
    python = install(folder / "classroom", classroom, *TOOLS)
    run_tests(python, tests, "nbclassroom")
    lessons = folder / "lessons"
    for name in ("tests", "notebooks"):
        shutil.copytree(ROOT / name, lessons / name)
    shutil.copy(ROOT / "pyproject.toml", lessons)  # pytest's settings
    python = install(folder / "both", "-r", ROOT / "environment" / "requirements-test.txt")
    install(folder / "both", "--no-deps", course, classroom)
    run_tests(python, lessons, "-n2", *(f"tests/classroom/{name}" for name in UNIT))


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--dist", type=Path)
    chosen = parser.parse_args().dist
    os.environ.pop("PYTHONPATH", None)
    with tempfile.TemporaryDirectory(prefix="bench-install-") as made:
        dist = (chosen or Path(made) / "dist").resolve()
        dist.mkdir(parents=True, exist_ok=True)
        main(dist, Path(made))
