"""The sandbox: what it hides, the error if there is none, and what it leaves behind."""

import os
import platform
import subprocess
import sys
import time
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import psutil
import pytest
from nbclassroom.autograder.sandbox import bubblewrap
from nbclassroom.autograder.sandbox.bubblewrap import Limits, used_under
from nbclassroom.autograder.sandbox.fork_server_client import KernelFactory
from printed import run_printing

pytestmark = pytest.mark.sandbox


def test_the_environment_and_the_paths_reveal_nothing():
    with KernelFactory() as kernel_factory:
        kernel = kernel_factory.start((), 30)
        code = "import os, sys\nprint(os.environ, sys.path, sys.prefix, os.uname())"
        _, printed = run_printing(kernel, code)
        kernel.stop()
    checkout = Path(bubblewrap.__file__).parents[4]
    for trace in (str(Path.home()), str(checkout), os.uname().nodename, "PYTEST", "VIRTUAL_ENV"):
        assert trace not in printed


def test_what_lies_beside_the_systems_folders_is_not_inside(monkeypatch, tmp_path):
    """A checkout in /usr/src would have the key, another environment in Conda's folder somebody's files."""
    for name in ("lib/python3.11/site-packages", "envs", "share"):
        (tmp_path / name).mkdir(parents=True)
    (tmp_path / "lib64").symlink_to("lib")
    monkeypatch.setattr(bubblewrap, "python_folder", lambda: (tmp_path, Path("/python")))
    monkeypatch.setattr(bubblewrap.course, "roots", lambda: [Path("/usr/share/man")])
    options = " ".join(bubblewrap._system_folders())
    assert f" --ro-bind {tmp_path}/lib /python/lib --symlink lib /python/lib64 " in options
    for hidden in ("/python/lib/python3.11/site-packages", "/usr/share/man"):
        assert f" --tmpfs {hidden} --remount-ro {hidden}" in options
    for name in ("/python/envs", "/usr/src", " /usr /usr ", " /etc /etc "):
        assert name not in options


def test_an_installed_copy_of_the_course_is_empty_inside(monkeypatch, tmp_path):
    """It would have the autograder, and a link to the checkout says where the masters are."""
    tmp_path.chmod(0o755)
    (tmp_path / "imgproc_course" / "messages").mkdir(parents=True)
    (tmp_path / "nbclassroom" / "autograder").mkdir(parents=True)
    (tmp_path / "__editable__.imgproc_course.pth").write_text("/home/teacher/course\n")
    (tmp_path / "beside.py").touch()
    folders = {**bubblewrap._package_folders(), tmp_path: "/course/site-9"}
    monkeypatch.setattr(bubblewrap, "_package_folders", lambda: folders)
    code = "import os\nos.chdir('/course/site-9')\nprint(*sorted(os.listdir()))\n"
    code += "print(os.listdir('imgproc_course'), os.listdir('nbclassroom'))\n"
    code += "try: print(open('__editable__.imgproc_course.pth').read())\nexcept OSError: pass\n"
    code += "print([n for n in os.listdir('/course/packages/nbclassroom/autograder')])"
    with KernelFactory() as kernel_factory:
        kernel = kernel_factory.start((), 30)
        printed = run_printing(kernel, code)[1]
        kernel.stop()
    names = "__editable__.imgproc_course.pth beside.py imgproc_course nbclassroom"
    assert printed.split("\n")[:2] == [names, "[] []"]
    assert "teacher" not in printed and "['__init__.py', 'sandbox']" in printed


def test_the_systems_limits_follow_from_the_case():
    assert Limits(grace=2).cpu(0.5) == 3
    assert Limits(grace=1, wall_factor=2, wall_grace=3).deadline(4) == 13


def test_fork_servers_have_no_kernel_user_in_common(monkeypatch):
    """The system counts processes by user."""
    users = []
    monkeypatch.setattr(bubblewrap.os, "geteuid", lambda: 0)
    for process in (41, 42):
        monkeypatch.setattr(bubblewrap.os, "getpid", lambda process=process: process)
        users.append(bubblewrap.kernel_user())
    assert users == [2_010_496, 2_010_752]  # each has 256


def problem_with(monkeypatch, folder, script):
    bubblewrap.sandbox_problem.cache_clear()
    program = folder / "bwrap"
    if script:
        program.write_text(f"#!/bin/sh\n{script}\n")
        program.chmod(0o755)
    monkeypatch.setenv("PATH", str(folder))
    try:
        return bubblewrap.sandbox_problem()
    finally:
        bubblewrap.sandbox_problem.cache_clear()


def test_without_bubblewrap_the_error_says_what_to_install(monkeypatch, tmp_path):
    assert "sudo apt-get install bubblewrap" in problem_with(monkeypatch, tmp_path, "")


def test_without_user_namespaces_the_error_says_how_to_allow_them(monkeypatch, tmp_path):
    problem = problem_with(
        monkeypatch, tmp_path, "echo 'bwrap: setting up uid map: Permission denied' >&2; exit 1"
    )
    assert "setting up uid map: Permission denied" in problem
    assert "sysctl -w kernel.unprivileged_userns_clone=1" in problem


def test_a_trial_that_does_not_end_is_no_sandbox(monkeypatch, tmp_path):
    monkeypatch.setattr(bubblewrap, "_TRIAL_SECONDS", 0.2)
    assert "(no sandbox within 0.2 s)" in problem_with(monkeypatch, tmp_path, "exec /bin/sleep 60")


def test_on_another_system_the_error_says_where_to_grade(monkeypatch):
    monkeypatch.setattr(bubblewrap.sys, "platform", "darwin")
    bubblewrap.sandbox_problem.cache_clear()
    assert bubblewrap.sandbox_problem().startswith(
        "grading needs Linux, this is darwin: grade in a container"
    )
    bubblewrap.sandbox_problem.cache_clear()


# ---------------------------------------------------------------- all processes together


def test_pages_that_processes_share_are_counted_once():
    code = "import os, time\nheld = bytearray(b'x' * (200 << 20))\n"
    code += "[os.fork() or time.sleep(60) for _ in range(3)]\nprint(flush=True)\ntime.sleep(60)"
    top = subprocess.Popen([sys.executable, "-c", code], stdout=subprocess.PIPE)
    top.stdout.readline()
    (apart, _), (once, _) = (used_under(top.pid, enough) for enough in (1 << 40, 0))
    for process in [*psutil.Process(top.pid).children(), top]:
        process.kill()
    top.communicate()
    assert apart > 4 * (200 << 20) and 200 << 20 < once < 300 << 20
    assert used_under(top.pid, 0) == (0, 0.0)  # it has ended


BOMB = """
import os, time
for _ in range(20):
    if os.fork() == 0:
        x = np.ones(120 << 20, np.uint8)
        time.sleep(600)
time.sleep(600)
"""


def test_all_processes_of_a_kernel_together_keep_to_its_memory():
    most = 0
    with KernelFactory(limits=Limits(memory=1 << 30, wall_grace=15)) as kernel_factory:
        kernel = kernel_factory.start((), 5)
        with ThreadPoolExecutor(1) as beside:
            ended = beside.submit(kernel.run, BOMB)
            while not ended.done():
                most = max(most, used_under(kernel_factory._process.pid, 0)[0])
                time.sleep(0.2)
        assert ended.result().ended == "memory"
        assert most < 2 << 30  # it tries to use 2.4 GB
        kernel.stop()
        after = kernel_factory.start((), 5)
        ran = after.run("import time\nx = np.ones(120 << 20, np.uint8)\ntime.sleep(0.2)\nassert x[-1] == 1")
        assert (ran.error, ran.ended) == (("", ""), "")
        after.stop()


REFUSED = """
import ctypes, os, subprocess, threading
libc = ctypes.CDLL(None, use_errno=True)
file = os.open("/usr/bin/env", os.O_RDONLY)
calls = {call: () for call in (CALLS)}
# With what would make it succeed: a process in a user namespace, System V's memory, semaphores and queues,
# a file system written out, a file in memory, a lease on a file (F_SETLEASE, F_RDLCK).
calls |= {56: (0x10000000 | 17, 0, 0, 0, 0), 29: (0, 1 << 20, 0o1600), 64: (0, 1, 0o1600), 68: (0, 0o1600)}
calls |= {306: (file,), 319: (b"x", 0), 72: (file, 1024, 0), 272: (0x10000000,)}
for call, arguments in calls.items():
    result = libc.syscall(call, *(arguments or [0] * 6))
    if (result, ctypes.get_errno()) != (-1, 1):
        print(call, result, ctypes.get_errno())
thread = threading.Thread(target=print, args=("a thread",))
thread.start()
thread.join()
print(subprocess.run(["echo", "a process"], capture_output=True, text=True).stdout, end="")
"""
# clone, shmget, fcntl, semget, msgget, syslog, sync, mount, add_key, request_key, keyctl, unshare, syncfs,
# setns, memfd_create, io_uring_setup, fsopen, memfd_secret; asm/unistd.h
CALLS = "56, 29, 72, 64, 68, 103, 162, 165, 248, 249, 250, 272, 306, 308, 319, 425, 430, 447"


@pytest.mark.skipif(platform.machine() != "x86_64", reason="the calls are made by their numbers")
def test_calls_that_nobody_counts_or_that_slow_others_are_refused_and_threads_are_not():
    with KernelFactory() as kernel_factory:
        kernel = kernel_factory.start((), 30)
        run, printed = run_printing(kernel, REFUSED.replace("CALLS", CALLS))
        kernel.stop()
    assert (printed.splitlines(), run.error) == (["a thread", "a process"], ("", ""))


# ---------------------------------------------------------------- a user who is not root

MARKS = """
import os
written = set()
for path in {line.split()[1] for line in open("/proc/self/mounts")}:
    try:
        os.mkdir(path + "/mark")
        written.add(path)
    except OSError:
        pass
"""
UNPRIVILEGED = f"""
from nbclassroom.autograder.sandbox.fork_server_client import KernelFactory
from nbclassroom.autograder.sandbox.bubblewrap import used_under
with KernelFactory() as kernel_factory:
    kernel = kernel_factory.start(("scipy",), 30)
    print(kernel.run("import os, scipy; raise ValueError(f'{{os.getuid()}} {{scipy.__name__}}')").error[1])
    print(kernel.run("raise ValueError(open('/proc/self/status').read().count('0000000000000000'))").error[1])
    kernel.run({MARKS!r})
    print(kernel.run("raise ValueError(sorted(written))").error[1])
    kernel.stop()
"""


def as_another_user():
    """The command that runs Python as a user who is not root, with Python's folder readable for everybody."""
    if os.geteuid() != 0:
        return [sys.executable]
    base, home = Path(sys.base_prefix).resolve(), Path("~root").expanduser()
    opened = ""
    if base.is_relative_to(home):
        opened = f"mount --bind {base} /mnt && mount -t tmpfs -o mode=755 t {home} && mkdir -p {base}"
        opened += f" && mount --bind /mnt {base} && "
    user = "setpriv --reuid 4242 --regid 4242 --clear-groups"
    return ["unshare", "--mount", "sh", "-c", f'{opened}exec {user} {sys.executable} "$@"', "sh"]


def test_a_user_who_is_not_root_has_a_sandbox_too():
    done = subprocess.run(
        [*as_another_user(), "-c", UNPRIVILEGED],
        env={name: os.environ[name] for name in ("PATH", "NBCLASSROOM_COURSE")} | {"HOME": "/tmp"},
        cwd="/",
        capture_output=True,
        text=True,
        timeout=120,
    )
    lines = done.stdout.split("\n")
    assert lines[0].endswith(" scipy"), done.stderr[-2000:]
    assert lines[2] == "['/dev/shm', '/tmp']"  # its own; the next kernel would find what it wrote elsewhere
    assert int(lines[1]) >= 5  # inheritable, permitted, effective, bounding, ambient: all empty


def test_a_kernel_does_not_see_which_folders_are_mounted_in_it():
    """No page can filter every form of a path, such as its hexadecimal digits."""
    with KernelFactory() as kernel_factory:
        kernel = kernel_factory.start((), 30)
        read = "[open(f'/proc/{place}/mountinfo').read() for place in ('self', 'thread-self', 1)]"
        assert kernel.run(f"raise ValueError({read})").error == ("ValueError", "['', '', '']")
        kernel.stop()
