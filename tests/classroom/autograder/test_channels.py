"""What one kernel could leave for the next: the channels of `confine`'s list are tried.

The first kernel leaves a mark wherever it can. The second was forked before that, and looks for it after the
first has ended. `leave` and `look` are cells; `look` prints what it found.
"""

import platform

import pytest
from nbclassroom.autograder.sandbox import bubblewrap
from nbclassroom.autograder.sandbox.fork_server_client import KernelFactory
from printed import run_printing

pytestmark = [
    pytest.mark.sandbox,
    pytest.mark.skipif(platform.machine() != "x86_64", reason="some calls are made by their numbers"),
]
# A process that stays as long as it can; `run` is what it does first.
STAY = """
import os, time
if os.fork() == 0:
    os.setsid()
    {run}
    time.sleep(1000)
time.sleep(0.2)
"""
LIBC = "import ctypes, os, socket\nlibc = ctypes.CDLL(None, use_errno=True)\n"
CHANNELS = {
    "files": (
        "import pathlib\n"
        "for folder in ('/tmp', '/tmp/home', '/tmp/submission', '/dev/shm', '/dev', '/', '/course'):\n"
        "    try: pathlib.Path(folder, 'mark').write_text('seen')\n"
        "    except OSError: pass",
        "import glob\nprint(*[p for f in ('', 'tmp/', 'tmp/*/', 'dev/', 'dev/shm/', 'course/', 'var/')"
        " for p in glob.glob(f'/{f}mark')])",
    ),
    "open files of the fork server": (
        "",
        "import os\nprint(*[fd for fd in os.listdir('/proc/self/fd')[:-1] if int(fd) > 2][1:])",
    ),
    "keys of the user": (
        LIBC + "libc.syscall(248, b'user', b'mark', b'seen', 4, ctypes.c_long(-4))",
        LIBC + "found = libc.syscall(250, 10, ctypes.c_long(-4), b'user', b'mark', 0)\n"
        "print(found if found > 0 else '')",
    ),
    "counters of the whole machine": (
        LIBC + "held = ctypes.create_string_buffer(40_000)\n"
        "for _ in range(10): libc.mlock(held, 40_000), libc.munlock(held, 40_000)",
        "import os\n"
        "print(*[name for name in os.listdir('/proc') if not name.isdigit() and 'self' not in name])",
    ),
    "System V's memory, and message queues of POSIX": (
        LIBC + "libc.shmget(4242, 4096, 0o1666), libc.mq_open(b'/mark', 0o102, 0o666, None)",
        LIBC + "print(libc.shmget(4242, 4096, 0o666) + 1 or '', libc.mq_open(b'/mark', 2) + 1 or '')",
    ),
    "an abstract socket": (
        STAY.format(run="import socket; s = socket.socket(socket.AF_UNIX); s.bind('\\0mark'); s.listen()"),
        "import socket\n"
        "try: socket.socket(socket.AF_UNIX).connect('\\0mark'); print('seen')\n"
        "except OSError: pass",
    ),
    "a port that was used": (
        "import socket\n"
        "try:\n"
        "    server = socket.create_server(('127.0.0.1', 4242))\n"
        "    client = socket.create_connection(('127.0.0.1', 4242))\n"
        "    accepted, _ = server.accept()\n"
        "    accepted.close(); client.close(); server.close()\n"
        "except OSError: pass",
        "import socket\n"
        "try: socket.socket().bind(('127.0.0.1', 4242))\n"
        "except OSError as error: print('seen' if error.errno == 98 else '')",
    ),
    "sockets of the machine (vsock), and of packets": (
        "",
        "import socket\n"
        "socket.socket().close()\n"  # one that a namespace separates is not refused
        "for family in (socket.AF_VSOCK, socket.AF_ALG, socket.AF_PACKET):\n"
        "    try: print(socket.socket(family, socket.SOCK_STREAM))\n"
        "    except OSError as error: print('' if error.errno == 97 else error)",
    ),
    "a process": (
        STAY.format(run="pass"),
        "import os\n"
        "print(*[pid for pid in os.listdir('/proc') if pid.isdigit() and int(pid) != os.getpid()])",
    ),
    "a signal to all": (
        "import os, signal\n"
        "for target in (-1, 0):\n    try: os.kill(target, signal.SIGKILL)\n    except OSError: pass",
        "",  # it would have ended the second kernel
    ),
    "a lock on a shared file": (
        STAY.format(run="import fcntl; f = open('/usr/bin/env', 'rb'); fcntl.flock(f, fcntl.LOCK_EX)"),
        "import fcntl\n"
        "try: fcntl.flock(open('/usr/bin/env', 'rb'), fcntl.LOCK_EX | fcntl.LOCK_NB)\n"
        "except OSError: print('seen')",
    ),
    "niceness and processor affinity": (
        "import os\nos.setpriority(os.PRIO_USER, 0, 7)\nos.setpriority(os.PRIO_PROCESS, 0, 7)\n"
        "os.sched_setaffinity(0, {min(os.sched_getaffinity(0))})",
        "import os\nniceness, cores = os.getpriority(os.PRIO_PROCESS, 0), len(os.sched_getaffinity(0))\n"
        "print('' if (niceness, cores) == BEFORE else (niceness, cores))",
    ),
    "the host name, settings of the system": (
        "import glob, os\n"
        "try: __import__('socket').sethostname('seen')\n"
        "except OSError: pass\n"
        "for path in ('/proc/sys/kernel/hostname', *glob.glob('/proc/sys/net/ipv4/ip_*')):\n"
        "    try: os.close(os.open(path, os.O_WRONLY)); os.environ['SEEN'] = path\n"
        "    except OSError: pass\n"
        "print(os.environ.get('SEEN', ''))",
        "import os\nprint('' if os.uname().nodename == 'course' else os.uname().nodename)",
    ),
    "who is ended first when memory runs out": (
        "",
        "import os\n"
        "try: open('/proc/self/oom_score_adj', 'w').write('0')\n"
        "except OSError: pass\n"
        "score = open('/proc/self/oom_score_adj').read().strip()\nprint('' if score == '1000' else score)",
    ),
    "the system's log": (
        "import ctypes, os\nif os.fork() == 0:\n    ctypes.string_at(0x5eed5eed)\nos.wait()",
        LIBC + "size = libc.syscall(103, 3, buffer := ctypes.create_string_buffer(1 << 20), 1 << 20)\n"
        "print('seen' if size > 0 and b'5eed5eed' in buffer.raw else '')",
    ),
    "core files, also those that a program takes": (
        "import ctypes, os\nif os.fork() == 0:\n    ctypes.string_at(0x5eed5eed)\nos.wait()",
        "import glob, resource\n"
        "most = max(resource.getrlimit(resource.RLIMIT_CORE))\n"
        "print(*glob.glob('/tmp/**/core*', recursive=True), most if most > 1 else '')",
    ),
    "a terminal": (
        STAY.format(run="__import__('pty').fork()"),
        "import os\nprint(*set(os.listdir('/dev/pts')) - {'ptmx'})\n"
        "names = []\n"
        "try:\n    while len(names) < 50: names.append(os.ttyname(os.openpty()[1]))\n"
        "except OSError: print('' if names == [f'/dev/pts/{k}' for k in range(16)] else names)\n"
        "else: print('as many as one likes')",
    ),
    "environment, umask and random state": (
        "import os, random, builtins\nos.environ['MARK'] = 'seen'\nos.umask(0)\nrandom.seed(5)\n"
        "np.random.seed(5)\nbuiltins.mark = 'seen'\nnp.mark = 'seen'",
        "import os, random, builtins\n"
        "print('seen' if 'MARK' in os.environ or hasattr(builtins, 'mark') or hasattr(np, 'mark') else '',"
        " '' if os.umask(0) == 0o022 and random.random() == 0.8444218515250481 else 'seen')",
    ),
}


@pytest.fixture(scope="module")
def kernel_factory():
    with KernelFactory() as kernel_factory:
        yield kernel_factory


@pytest.mark.parametrize("name", CHANNELS)
def test_one_kernel_leaves_nothing_for_the_next(kernel_factory, name):
    leave, look = CHANNELS[name]
    first = kernel_factory.start((), 30)
    try:
        before = "import os\nraise ValueError((os.getpriority(0, 0), len(os.sched_getaffinity(0))))"
        _, before = first.run(before).error
        left, printed = run_printing(first, leave)
        assert (left.ended, printed.strip()) == ("", "")
    finally:
        first.stop()
    second = kernel_factory.start((), 30)
    try:
        assert second.run(f"BEFORE = {before}").ended == ""
        found, printed = run_printing(second, look)
        assert (found.ended, found.error) == ("", ("", ""))
        assert printed.split() == []
    finally:
        second.stop()


@pytest.mark.timeout(60)
def test_a_fork_server_that_has_lost_its_bubblewrap_ends_with_its_kernels(monkeypatch):
    """If bubblewrap is killed while it starts, what it starts may live on, in a session of its own."""
    command = bubblewrap.sandbox_command(confined=False)
    live_on = 'setsid sh -c \'"$@"; true\' sh "$@" & wait'
    monkeypatch.setattr(bubblewrap, "sandbox_command", lambda _: ["sh", "-c", live_on, "sh", *command])
    with KernelFactory(unsafe=True) as factory:
        kernel = factory.start((), 10)
        assert kernel.run("assert 6 * 7 == 42").error == ("", "")
        kernel.stop()
