"""The sandbox: what it hides, what it says where there is none, and what it leaves."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

from imgproc_course.grading.kernel import sandbox
from imgproc_course.grading.kernel.groups import Group
from imgproc_course.grading.kernel.sandbox import Limits, places_of
from imgproc_course.grading.kernel.starting import Kernels

pytestmark = [pytest.mark.sandbox, pytest.mark.xdist_group("sandbox")]


def test_a_distribution_is_hidden_whole():
    places = places_of("cv2")
    assert f"{sandbox.SITE}/cv2" in places
    assert any(place.endswith(".libs") for place in places)
    assert f"{sandbox.SITE}/skimage" in places_of("skimage")


def test_a_room_a_submodule_and_the_standard_library_are_found():
    assert places_of("imgproc_course.imaging")[0] == f"{sandbox.OURS}/imgproc_course/imaging"
    assert f"{sandbox.SITE}/scipy/ndimage" in places_of("scipy.ndimage")
    assert any(place.endswith("/colorsys.py") for place in places_of("colorsys"))
    assert not [place for place in places_of("no_such_module") if "no_such" not in place]


def test_what_is_refused_is_hidden_for_one_kernel_and_there_for_the_next():
    folders = (f"{sandbox.SITE}/cv2", f"{sandbox.OURS}/imgproc_course/imaging")
    look = f"import os\nprint([len(os.listdir(p)) > 0 for p in {folders}])"
    with Kernels("fast") as kernels:
        first = kernels.start(("cv2", "imgproc_course.imaging"), 30)
        second = kernels.start((), 30)
        assert first.run(look).printed == "[False, False]\n"
        assert second.run(look).printed == "[True, True]\n"
        assert second.run("import cv2\nprint(cv2.add(1, 2)[0])").printed == "[3.]\n"
        first.stop()
        second.stop()


def test_the_forking_process_has_loaded_nothing_that_an_exercise_refuses():
    with Kernels("fast") as kernels:
        kernel = kernels.start((), 30)
        names = ("cv2", "scipy", "skimage", "imgproc_course.imaging", "nbval", "pytest")
        code = f"import sys\nprint([name for name in {names} if name in sys.modules])"
        assert kernel.run(code).printed == "[]\n"
        kernel.stop()


def test_the_environment_and_the_paths_tell_nothing():
    with Kernels("fast") as kernels:
        kernel = kernels.start((), 30)
        told = kernel.run("import os, sys\nprint(os.environ, sys.path, sys.prefix, os.uname())").printed
        kernel.stop()
    checkout = Path(sandbox.__file__).parents[3]
    for trace in (str(Path.home()), str(checkout), os.uname().nodename, "PYTEST", "VIRTUAL_ENV"):
        assert trace not in told


def test_its_limits_are_the_systems():
    assert Limits(grace=2).of_system(0.5)["cpu"] == 3
    assert Limits(grace=1, wall_factor=2, wall_grace=3).deadline(4) == 13


def refuses(monkeypatch, folder, script):
    sandbox.why_not.cache_clear()
    program = folder / "bwrap"
    if script:
        program.write_text(f"#!/bin/sh\n{script}\n")
        program.chmod(0o755)
    monkeypatch.setenv("PATH", str(folder))
    try:
        return sandbox.why_not()
    finally:
        sandbox.why_not.cache_clear()


def test_where_bubblewrap_is_missing_it_says_what_to_install(monkeypatch, tmp_path):
    assert "sudo apt-get install bubblewrap" in refuses(monkeypatch, tmp_path, "")


def test_where_namespaces_are_not_allowed_it_says_how_to_allow_them(monkeypatch, tmp_path):
    said = refuses(monkeypatch, tmp_path, "echo 'bwrap: setting up uid map: Permission denied' >&2; exit 1")
    assert "setting up uid map: Permission denied" in said
    assert "sysctl -w kernel.unprivileged_userns_clone=1" in said


def test_elsewhere_than_on_linux_it_says_where_to_grade(monkeypatch):
    monkeypatch.setattr(sandbox.sys, "platform", "darwin")
    sandbox.why_not.cache_clear()
    assert sandbox.why_not().startswith(
        "grading needs Linux, this is darwin: grade in the course's container"
    )
    sandbox.why_not.cache_clear()


def test_a_group_that_cannot_be_made_is_none(monkeypatch):
    from imgproc_course.grading.kernel import groups

    monkeypatch.setattr(groups, "_ROOT", Path("/nowhere"))
    group = Group(1 << 30, 64)
    assert group.folders == [] and not group.ran_out()
    group.remove()


def test_all_processes_of_a_kernel_together_keep_to_its_memory():
    group = Group(1 << 30, 64)
    made = bool(group.folders)
    group.remove()
    bomb = """
import os, time
for _ in range(12):
    if os.fork() == 0:
        x = np.ones(300 << 20, np.uint8)
        time.sleep(60)
x = np.ones(300 << 20, np.uint8)
time.sleep(1)
"""
    with Kernels("fast", limits=Limits(memory=1 << 30, wall_grace=120)) as kernels:
        kernel = kernels.start((), 5)
        ended = kernel.run(bomb).ended
        assert not made or ended == "memory" or kernels._zygote.ran_out()
        kernel.stop()
        after = kernels.start((), 5)
        assert after.run("print(1)").printed == "1\n"
        after.stop()


NOBODYS = """
from imgproc_course.grading.kernel.starting import Kernels
with Kernels("fast") as kernels:
    kernel = kernels.start(("cv2",), 30)
    print(kernel.run("import os; print(os.getuid(), os.listdir('/course/site-packages/cv2'))").printed)
    print(kernel.run("print(open('/proc/self/status').read().count('0000000000000000'))").printed)
    kernel.stop()
"""


def as_another_user():
    """The words that run Python as a user who is not root, with Python's folder opened to everybody."""
    if os.geteuid() != 0:
        return [sys.executable]
    base, home = Path(sys.base_prefix).resolve(), Path.home()
    opened = ""
    if base.is_relative_to(home):
        opened = f"mount --bind {base} /mnt && mount -t tmpfs -o mode=755 t {home} && mkdir -p {base}"
        opened += f" && mount --bind /mnt {base} && "
    user = "setpriv --reuid 4242 --regid 4242 --clear-groups"
    return ["unshare", "--mount", "sh", "-c", f'{opened}exec {user} {sys.executable} "$@"', "sh"]


def test_a_user_who_is_not_root_has_a_sandbox_too():
    done = subprocess.run(
        [*as_another_user(), "-c", NOBODYS],
        env={"PATH": os.environ["PATH"], "HOME": "/tmp"},
        cwd="/",
        capture_output=True,
        text=True,
        timeout=120,
    )
    lines = done.stdout.split("\n")
    assert lines[0].endswith(" []"), done.stderr[-2000:]
    assert int(lines[2]) >= 5  # inheritable, permitted, effective, bounding, ambient: all empty
