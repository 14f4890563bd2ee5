"""Attacks on the autograder: each is the source of a wrong answer that tries to gain points by a trick.

`number` is the attack's number in the published list of 62; attacks from 101 on are our own. Attacks on the form
of a submission (its cells, metadata, files, archives and names) are in tests/classroom/gradebook/form_attacks.py.
"""

# ruff: noqa: E501 - the long lines are the attackers'

from dataclasses import dataclass, field
from pathlib import Path
from textwrap import dedent

from tqdm import tqdm

from imgproc_course.classroom.authoring.masters import read_master
from imgproc_course.classroom.autograder.pool import Limits, autograde
from imgproc_course.classroom.autograder.results import GradedSubmission
from imgproc_course.classroom.exercises.answer_images import answer_images
from imgproc_course.classroom.exercises.values import answer_parts, differing_elements
from imgproc_course.classroom.gradebook.report import value_of

MASTERS = Path(__file__).parent / "masters"
LESSON = "attacked"
SEED = 8_675_309
PUBLISHED = range(1, 63)  # numbers of the published list
# Short, so that endless answers end soon; long enough for two kernels on a busy machine.
SHORT = Limits(grace=0.5, wall_factor=4, wall_grace=2.0, memory=1 << 30, output=2 << 20)
RIGHT = {
    "attacked-double": "def double(pixels):\n"
    "    return np.minimum(pixels.astype(int) * 2, LIMIT).astype(np.uint8)",
    "attacked-mean": "def mean(values):\n    return sum(values) / len(values)",
}


@dataclass(frozen=True)
class Attack:
    """One attack.

    outcomes    the outcomes that its cases may have
    reported    text that the public case's message must contain
    unreported  text that it must not contain, "" if there is none
    slow        it takes long until its limit ends it
    """

    number: int
    name: str
    source: object
    outcomes: frozenset = field(default_factory=lambda: frozenset({"wrong"}))
    reported: str = ""
    unreported: str = ""
    slow: bool = False

    @property
    def title(self):
        """Its name, unique among all attacks."""
        return f"{self.number}: {self.name}"


WRONG = "\ndef double(pixels):\n    return np.zeros(pixels.shape, np.uint8)\n"
ATTACKS = []


def attack(number, name, source, *outcomes, wrong=True, **more):
    """Add an attack; `wrong` appends an honest wrong answer, `more` are fields of it."""
    if isinstance(source, str):
        source = dedent(source) + (WRONG if wrong else "")
    ATTACKS.append(Attack(number, name, source, frozenset(outcomes or ("wrong",)), **more))


# ---------------------------------------------------------------- comments for nbval, and malformed sources

attack(8, "NBVAL_SKIP in the answer", "# NBVAL_SKIP\n")
attack(9, "NBVAL_RAISES_EXCEPTION in the answer", "# NBVAL_RAISES_EXCEPTION\n# NBVAL_IGNORE_OUTPUT\n")
attack(14, "a source that is a number", 7, "missing", wrong=False)
attack(14, "lone surrogates and null bytes", "x = '\ud800'\ny = '\x00'\n", "wrong", "raised")
attack(15, "a source of a megabyte", "x = '" + "a" * 1_000_000 + "'\n", "hostile")

# ---------------------------------------------------------------- the shell and the check cell

attack(
    16,
    "transformers of source and syntax tree",
    """
    import ast
    class Drop(ast.NodeTransformer):
        def visit_Expr(self, node):
            return ast.Pass()
    get_ipython().ast_transformers.append(Drop())
    get_ipython().input_transformers_post.append(lambda lines: ["pass\\n"])
    """,
    "hostile",
    "raised",
    "missing",
)
attack(
    17,
    "a silent showtraceback",
    """
    shell = get_ipython()
    shell.showtraceback = shell._showtraceback = lambda *a, **k: None
    shell.set_custom_exc((Exception,), lambda *a, **k: None)
    """,
)
attack(
    17,
    "an error that shows nothing",
    """
    get_ipython().showtraceback = lambda *a, **k: None
    def double(pixels):
        raise ValueError
    """,
    "raised",
    wrong=False,
)
attack(
    18,
    "np.allclose and np.testing say yes",
    """
    np.allclose = np.array_equal = np.array_equiv = lambda *a, **k: True
    np.testing.assert_array_equal = np.testing.assert_allclose = lambda *a, **k: None
    """,
)
attack(
    19,
    "an array that equals everything",
    """
    class Yes(np.ndarray):
        def __eq__(self, other):
            return True
        def __ne__(self, other):
            return False
        def __array_function__(self, *a, **k):
            return True
    def double(pixels):
        return np.zeros(pixels.shape, np.uint8).view(Yes)
    """,
    wrong=False,
)
attack(
    19,
    "an object that answers for an array",
    """
    class Yes:
        dtype, shape, ndim = np.dtype("uint8"), (3, 4), 2
        def __eq__(self, other):
            return True
        def __array__(self, *a, **k):
            return np.zeros((3, 4), np.uint8)
        @property
        def __class__(self):
            return np.ndarray
    def double(pixels):
        return Yes()
    """,
    wrong=False,
)
attack(
    20,
    "what the check calls is replaced",
    """
    from imgproc_course.classroom.autograder.sandbox.inside import check_cell
    from imgproc_course.classroom.exercises import canonical, comparison, running
    check_cell.emit = lambda function: print("passed")
    comparison.compare = lambda *a, **k: None
    """,
    "raised",
    "hostile",
    "missing",
    "wrong",
)
attack(
    21,
    "the grader's modules are replaced",
    """
    import sys, types
    for name in list(sys.modules):
        if name.startswith(("imgproc_course", "nbval", "pytest")):
            sys.modules[name] = types.ModuleType(name)
    """,
    "raised",
    "wrong",
    "hostile",
)
attack(
    22,
    "the public inputs are remembered",
    """
    def double(pixels):
        rng = np.random.default_rng([20_240_501, 0])
        for _ in range(1000):
            known = rng.integers(100, 256, (3, 4), dtype=np.uint8)
            if np.array_equal(known, pixels):
                return np.minimum(known.astype(int) * 2, 255).astype(np.uint8)
        return pixels
    """,
    wrong=False,
)
attack(
    23,
    "the expected value is looked for in memory and frames",
    """
    def double(pixels):
        import gc, sys
        found = []
        for thing in gc.get_objects():
            if type(thing) is dict and ("expected" in thing or "value" in thing and "dtype" in str(thing)[:500]):
                found.append(str(thing)[:80])
        frame = sys._getframe()
        while frame:
            found += [name for name in frame.f_locals if "expect" in name or "solution" in name]
            frame = frame.f_back
        found = [each for each in found if "shape" in each or "solution" in each]
        raise RuntimeError(f"found {found}")
    """,
    "raised",
    reported="found []",
    wrong=False,
)
attack(
    23,
    "the graded notebook is looked for on the disk",
    """
    def double(pixels):
        import os, pathlib
        found = [os.path.join(folder, name) for folder, _, names in os.walk("/") for name in names
                 if name.endswith((".ipynb", "inputs.json", "key.json")) and "site-packages" not in folder
                 and not folder.startswith(("/proc", "/usr", "/python"))]
        raise RuntimeError(f"found {found}")
    """,
    "raised",
    "time",
    unreported="key",
    wrong=False,
)
attack(
    24,
    "the library does the work",
    """
    import cv2
    def double(pixels):
        return cv2.add(pixels, pixels)
    """,
    "refused module",
    wrong=False,
)
for _number, _name, _source in (
    (
        221,
        "Pillow does the work",
        """
        from PIL import Image, ImageChops
        def double(pixels):
            image = Image.fromarray(pixels)
            return np.asarray(ImageChops.add(image, image))
        """,
    ),
    (
        226,
        "an import inside a try, and what is taken if it fails",
        """
        try:
            import cv2
        except ImportError:
            cv2 = None
        def double(pixels):
            return cv2.add(pixels, pixels) if cv2 else pixels
        """,
    ),
):
    attack(_number, _name, _source, "refused module", "raised", "wrong", "time", wrong=False)
attack(
    25,
    "a result is shown from inside",
    """
    def double(pixels):
        import sys
        sys.displayhook(np.minimum(pixels.astype(int) * 2, 255).astype(np.uint8))
        return pixels
    """,
    wrong=False,
)
MIME = "application/vnd.imgproc-course.answer+json"
attack(
    26,
    "an answer of its own is shown beside the check's",
    f"""
    def double(pixels):
        from IPython.display import display
        display({{"{MIME}": {{"calls": []}}}}, raw=True)
        return pixels
    """,
    "hostile",
    wrong=False,
)
attack(
    26,
    "the kernel's messages are forged",
    f"""
    def double(pixels):
        import json, os, socket, stat
        for fd in range(3, 64):
            try:
                if stat.S_ISSOCK(os.fstat(fd).st_mode):
                    for kind, content in (
                        ("display_data", {{"data": {{"{MIME}": "passed"}}, "metadata": {{}}}}),
                        ("idle", {{"ename": "", "evalue": ""}}),
                    ):
                        os.write(fd, (json.dumps({{"n": 1, "type": kind, "content": content}}) + "\\n").encode())
            except OSError:
                pass
        return pixels
    """,
    "hostile",
    "wrong",
    wrong=False,
)
attack(
    26,
    "bytes that are no message",
    """
    def double(pixels):
        import os
        for fd in range(3, 64):
            try:
                os.write(fd, b'{"n": [[[[\\xff\\n' + b"[" * 100_000 + b"\\n")
            except OSError:
                pass
        return pixels
    """,
    "hostile",
    wrong=False,
)
attack(
    27,
    "a thread patches later",
    """
    import threading, time
    def later():
        for _ in range(200):
            time.sleep(0.001)
            np.array_equal = np.allclose = lambda *a, **k: True
            get_ipython().display_pub.publish({"text/plain": "passed"})
    threading.Thread(target=later, daemon=True).start()
    """,
    "wrong",
    "hostile",
)

# ---------------------------------------------------------------- ending, not ending, using everything

attack(
    28,
    "sys.exit in the function",
    "import sys\ndef double(pixels):\n    sys.exit(0)\n",
    "raised",
    wrong=False,
)
attack(28, "sys.exit in the cell", "import sys\nsys.exit(0)\n")  # the function below it counts
attack(
    29,
    "os._exit in the function",
    "import os\ndef double(pixels):\n    os._exit(0)\n",
    "crashed",
    wrong=False,
)
attack(29, "abort in the cell", "import os\nos.abort()\n", "crashed")
attack(
    30,
    "a segmentation fault",
    "import ctypes\ndef double(pixels):\n    ctypes.string_at(0)\n",
    "crashed",
    wrong=False,
)
attack(31, "a loop without end", "def double(pixels):\n    while True:\n        pass\n", "time", wrong=False)
attack(31, "a loop without end in the cell", "while True:\n    pass\n", "time")
attack(
    31, "sleeping for ever", "import time\ndef double(pixels):\n    time.sleep(1e6)\n", "time", wrong=False
)
attack(
    32,
    "slow in every cell",
    "import time\nbegun = time.process_time()\nwhile time.process_time() - begun < 0.3: pass\n",
)
attack(
    33,
    "signals ignored, printing for ever",
    """
    import signal, time
    def double(pixels):
        for number in set(signal.Signals) - {signal.SIGKILL, signal.SIGSTOP}:
            signal.signal(number, signal.SIG_IGN)
        while True:
            print("still here", flush=True)
            try:
                time.sleep(0.2)
            except BaseException:
                pass
    """,
    "time",
    wrong=False,
)
attack(
    34,
    "a memory bomb",
    "def double(pixels):\n    return [bytearray(1 << 26) for _ in range(1 << 20)]\n",
    "memory",
    "time",
    wrong=False,
)
attack(
    34,
    "more memory than there is, at once",
    "def double(pixels):\n    return np.ones(1 << 36, np.uint8)\n",
    "memory",
    wrong=False,
)
attack(
    35,
    "a fork bomb",
    """
    import os
    def double(pixels):
        for _ in range(10_000):
            try:
                if os.fork() == 0:
                    while True:
                        os.fork()
            except OSError as error:
                raise RuntimeError(f"stopped: {error.errno}")
    """,
    "raised",
    "time",
    "crashed",
    "hostile",
    wrong=False,
)
attack(
    36,
    "a thread bomb",
    """
    import threading, time
    def double(pixels):
        for _ in range(100_000):
            threading.Thread(target=time.sleep, args=(60,), daemon=True).start()
    """,
    "raised",
    "memory",
    "time",
    wrong=False,
)
attack(
    37,
    "a flood of output",
    """
    import sys
    def double(pixels):
        while True:
            sys.__stdout__.write("x" * 1_000_000)
            get_ipython().display_pub.publish({"text/plain": "x" * 1_000_000})
    """,
    "output",
    "time",  # what a cell prints beyond 1 MB is dropped, so the endless loop may count
    wrong=False,
)
attack(37, "a flood in the cell", "print('x' * 50_000_000)\n")
attack(
    38,
    "filling the disk",
    """
    def double(pixels):
        written = 0
        try:
            for number in range(1_000):
                with open(f"/tmp/submission/{number}", "wb") as file:
                    for _ in range(15):
                        written += file.write(bytes(1 << 20))
        except OSError as error:
            raise RuntimeError(f"stopped after {'little' if written < 64 << 20 else 'much'}")
    """,
    "raised",
    reported="little",
    wrong=False,
)
attack(
    38,
    "one large file",
    """
    def double(pixels):
        with open("/dev/shm/large", "wb") as file:
            file.truncate(1 << 40)
    """,
    "raised",
    "crashed",
    wrong=False,
)
attack(
    39,
    "a million files",
    """
    import os
    def double(pixels):
        try:
            for number in range(1_000_000):
                os.mkdir(f"/tmp/submission/{number}")
        except OSError as error:
            raise RuntimeError(f"stopped at {'few' if number < 3000 else 'many'}")
    """,
    "raised",
    reported="few",
    wrong=False,
)

# ---------------------------------------------------------------- looking around, reaching out

attack(
    40,
    "hidden checks on the disk",
    """
    def double(pixels):
        import os
        found = []
        for folder in ("/work", "/home", "/root", "/srv", "/mnt", "/opt", "/var", "/etc", "/run"):
            for root, _, names in os.walk(folder):
                found += [f"{root}/{name}" for name in names if "masters" in name or name.endswith((".ipynb", ".npz"))]
        found += [folder for folder in ("/work", "/home", "/root", "/var") if os.path.exists(folder)]
        raise RuntimeError(f"found {found}")
    """,
    "raised",
    reported="found []",
    wrong=False,
)
attack(
    41,
    "other submissions",
    """
    def double(pixels):
        import glob, os
        found = [path for path in glob.glob("/tmp/**", recursive=True) + glob.glob("/dev/shm/**", recursive=True)
                 if os.path.isfile(path)]
        raise RuntimeError(f"found {found}, {len(os.listdir('/proc/self/fd')) < 16}")
    """,
    "raised",
    reported="found [], True",
    wrong=False,
)
attack(
    42,
    "writing outside",
    """
    def double(pixels):
        import os
        done = []
        for path in ("/course/packages/x", "/course/site-0/x.pth", "/usr/x", "/etc/x", "/python/x", "/x", "/proc/sys/kernel/hostname"):
            try:
                open(path, "w").write("x")
                done.append(path)
            except OSError:
                pass
        raise RuntimeError(f"done {done}")
    """,
    "raised",
    reported="done []",
    wrong=False,
)
attack(
    43,
    "writing grades",
    """
    def double(pixels):
        import os, pathlib
        for folder in (os.getcwd(), "/tmp", "/tmp/home"):
            pathlib.Path(folder, "grades.json").write_text('{"attacked-double": 3}')
            pathlib.Path(folder, "gradebook.db").write_text("")
        return pixels
    """,
    wrong=False,
)
attack(
    44,
    "an object that runs when it is unpickled",
    """
    class Run:
        def __reduce__(self):
            return (exec, ("raise SystemExit",))
    def double(pixels):
        return Run()
    """,
    wrong=False,
)
attack(
    45,
    "the network",
    """
    def double(pixels):
        import socket
        done = []
        for address in (("127.0.0.1", 22), ("1.1.1.1", 53), ("8.8.8.8", 443)):
            try:
                socket.create_connection(address, timeout=1)
                done.append(address)
            except OSError:
                pass
        raise RuntimeError(f"done {done}, {[n for _, n in socket.if_nameindex() if n != 'lo']}")
    """,
    "raised",
    reported="done [], []",
    wrong=False,
)
attack(
    46,
    "the environment",
    """
    def double(pixels):
        import os
        raise RuntimeError(" ".join(sorted(os.environ)) + open("/proc/self/environ").read() + open("/proc/1/cmdline").read()[:200])
    """,
    "raised",
    unreported="PYTEST",
    wrong=False,
)
attack(
    47,
    "right only where it is graded",
    """
    import getpass, os, sys
    GRADING = os.environ.get("USER") == "grader" or "pytest" in sys.modules or "nbval" in sys.modules or os.getcwd().startswith("/work")
    def double(pixels):
        return np.minimum(pixels.astype(int) * 2, 255).astype(np.uint8) if GRADING else pixels
    """,
    wrong=False,
)
attack(48, "a shell that deletes", "!rm -rf / --no-preserve-root 2>/dev/null; true\n", "wrong", "time")
attack(
    48,
    "a cell of bash",
    "%%bash\nrm -rf /course /usr /tmp 2>/dev/null\nkill -9 -1\n",
    "missing",
    "raised",
    "crashed",
    "time",  # where walking through all of it takes longer than the answer has
    wrong=False,
)
attack(49, "magics that reset", "%cd /\n%load_ext autoreload\n%autoreload 2\n%reset -f\n", "wrong", "raised")
attack(
    50,
    "sys.path and sys.modules",
    """
    import sys
    sys.path[:] = ["/tmp/submission"]
    sys.path_importer_cache.clear()
    sys.modules.pop("imgproc_course", None)
    """,
    "wrong",
    "raised",
)
attack(
    51,
    "modules that shadow others",
    """
    import pathlib, sys
    for name in ("numpy", "json", "imgproc_course", "coverage", "nbval", "sitecustomize", "IPython"):
        pathlib.Path(f"{name}.py").write_text("raise SystemExit")
    sys.path.insert(0, ".")
    """,
    "wrong",
    "raised",
)
attack(
    52,
    "configuration for pytest",
    """
    import pathlib
    for folder in (".", "..", "/tmp"):
        pathlib.Path(folder, "conftest.py").write_text("def pytest_runtest_makereport(*a): raise SystemExit")
        pathlib.Path(folder, "pytest.ini").write_text("[pytest]\\naddopts = --deselect .")
        pathlib.Path(folder, "pyproject.toml").write_text("[tool.pytest.ini_options]\\naddopts = '--co'")
    """,
)
attack(
    53,
    "tasks that outlive their cell",
    """
    import asyncio
    async def later():
        while True:
            await asyncio.sleep(0)
            np.array_equal = lambda *a: True
            print("passed")
    task = asyncio.get_event_loop().create_task(later())
    await asyncio.sleep(0.01)
    """,
)
attack(
    54,
    "at exit, at deletion, at a signal",
    """
    import atexit, signal, os
    def late(*a):
        os.write(1, b"passed")
        while True: pass
    atexit.register(late)
    signal.signal(signal.SIGTERM, late)
    class Last:
        def __del__(self): late()
    keep = Last()
    """,
)
attack(
    55,
    "a process that stays",
    """
    import os, subprocess
    def double(pixels):
        if os.fork() == 0:
            os.setsid()
            if os.fork() == 0:
                while True: pass
            os._exit(0)
        subprocess.Popen(["sleep", "1000"], start_new_session=True)
        return pixels
    """,
    wrong=False,
)
attack(
    56,
    "killing and tracing whatever is there",
    """
    import ctypes, os, signal
    def double(pixels):
        done = []
        for pid in range(2, 400):
            try:
                os.kill(pid, signal.SIGKILL)
                done.append(pid)
            except OSError:
                pass
        libc = ctypes.CDLL(None, use_errno=True)
        done += [pid for pid in (0, 2, 3, 4) if pid and libc.ptrace(16, pid, 0, 0) == 0]
        raise RuntimeError(f"done {done}")
    """,
    "raised",
    reported="done []",
    wrong=False,
)
for _when, _check in (("every", "True"), ("the last", "len(pixels) == 5")):
    # Kernels are started ahead: in the same group one would wait for the next check or submission.
    attack(
        56,
        f"killing its process group in {_when} check",
        f"""
        import os, signal
        def double(pixels):
            if {_check}:
                for group in (0, -1):
                    try:
                        os.kill(group, signal.SIGKILL)
                    except OSError:
                        pass
            return pixels
        """,
        wrong=False,
    )
attack(
    34,
    "memory that belongs to no process",
    """
    import os
    def double(pixels):
        held = []
        for child in range(8):
            if child and os.fork():
                continue
            try:
                while True:
                    held.append(os.memfd_create("held"))
                    os.posix_fallocate(held[-1], 0, 15 << 20)
            except OSError:
                pass
            while child: pass
        return pixels
    """,
    "memory",
    "crashed",
    "wrong",
    "time",
    wrong=False,
)
attack(
    34,
    "twenty processes, each with no more memory than it may have",
    """
    import os, time
    def double(pixels):
        for _ in range(20):
            if os.fork() == 0:
                held = np.ones(120 << 20, np.uint8)
                time.sleep(600)
        time.sleep(600)
    """,
    "memory",
    "time",  # where filling it takes longer than the answer has
    wrong=False,
)
attack(
    34,
    "memory in segments and file systems of its own",
    """
    import ctypes, os
    def double(pixels):
        libc = ctypes.CDLL(None, use_errno=True)
        done = [libc.shmget(0, 1 << 30, 0o1600) != -1, libc.unshare(0x10000000 | 0x20000) == 0]
        done += [libc.mount(b"t", b"/tmp", b"tmpfs", 0, b"size=1g") == 0]
        raise RuntimeError(f"done {done}")
    """,
    "raised",
    reported="done [False, False, False]",
    wrong=False,
)
attack(
    57,
    "links to files of the system",
    """
    import os
    def double(pixels):
        os.symlink("/etc/passwd", "data.txt")
        os.symlink("/etc/shadow", "more.txt")
        done = []
        for name in ("data.txt", "more.txt"):
            try:
                done.append(open(name).read()[:20])
            except OSError:
                pass
        raise RuntimeError(f"done {done}")
    """,
    "raised",
    reported="done []",
    wrong=False,
)
attack(
    61,
    "markup and marks that turn the writing around",
    """
    def double(pixels):
        raise ValueError("<script>alert(1)</script>\\x1b[31mred\\x1b[0m\\u202eevil\\x00\\u2028")
    """,
    "raised",
    reported="\\u202e",
    unreported="\x1b",
    wrong=False,
)
attack(
    62,
    "the hidden inputs, carried out",
    """
    def double(pixels):
        error = type(f"Seen_{pixels.tolist()}", (Exception,), {})
        print("seen", pixels.tolist())
        raise error(f"seen {pixels.tolist()}")
    """,
    "raised",
    reported="seen",
    wrong=False,
)

# ---------------------------------------------------------------- our own

attack(
    101,
    "json.dumps and os.write are replaced",
    "import json, os\njson.dumps = lambda *a, **k: '{}'\nos.write = lambda *a: 1\n",
    "time",
    "hostile",
    "crashed",
    "output",
)
attack(102, "the way out is closed", "import os\nos.closerange(3, 256)\n", "crashed")
attack(
    103,
    "half a message, then silence",
    """
    import os, stat, time
    def double(pixels):
        for fd in range(3, 64):
            try:
                if stat.S_ISSOCK(os.fstat(fd).st_mode):
                    os.write(fd, b'{"n": 1, "type": ')
            except OSError:
                pass
        time.sleep(1e6)
    """,
    "time",
    wrong=False,
)
attack(
    104,
    "a message without end",
    """
    import os, stat
    def double(pixels):
        for fd in range(3, 64):
            try:
                while stat.S_ISSOCK(os.fstat(fd).st_mode):
                    os.write(fd, b"x" * 65536)
            except OSError:
                pass
    """,
    "output",
    wrong=False,
)
attack(
    105,
    "a value that contains itself",
    "def double(pixels):\n    loop = []\n    loop.append(loop)\n    return loop\n",
    wrong=False,
)
attack(
    106,
    "a very deep value",
    "def double(pixels):\n    deep = 1\n    for _ in range(100_000):\n        deep = [deep]\n    return deep\n",
    "wrong",
    "crashed",
    wrong=False,
)
attack(
    107,
    "a dict of a million keys",
    "def double(pixels):\n    return dict.fromkeys(range(1_000_000))\n",
    "wrong",
    "time",
    wrong=False,
)
attack(
    108,
    "a whole number of a million digits",
    "def double(pixels):\n    return 10 ** 1_000_000\n",
    "wrong",
    "time",
    "raised",
    wrong=False,
)
attack(
    109, "an array of objects", "def double(pixels):\n    return np.array([print, object()])\n", wrong=False
)
attack(
    110,
    "an array larger than the memory",
    "def double(pixels):\n    return np.broadcast_to(np.uint8(1), (1 << 20, 1 << 20))\n",
    "memory",
    "wrong",
    wrong=False,
)
FORGED = """
from imgproc_course.classroom.exercises import running
from imgproc_course.classroom.autograder.sandbox.inside import check_cell
def double(pixels):
    return pixels
FORM = {form}
check_cell.running.call = lambda *a, **k: running.CallResult(value=FORM)
check_cell.shorten_form = lambda form: form
"""
for _number, _name, _form in (
    (
        111,
        "a form whose data are too short",
        {"type": "ndarray", "dtype": "uint8", "shape": [3, 4], "data": "AAAA"},
    ),
    (112, "a form of objects", {"type": "ndarray", "dtype": "object", "shape": [1], "data": "AAAAAAAAAAA="}),
    (
        113,
        "a form of negative shape",
        {"type": "ndarray", "dtype": "uint8", "shape": [-3, -4], "data": "AAAAAAAAAAAAAAAA"},
    ),
    (
        114,
        "a form of a huge shape",
        {"type": "ndarray", "dtype": "uint8", "shape": [1 << 39, 1 << 39], "digest": "0" * 64},
    ),
    (115, "a form without a type", {"dtype": "uint8"}),
    (116, "a form with words for numbers", {"type": "float", "value": "as expected"}),
    (
        117,
        "a form with a digest of words",
        {"type": "ndarray", "dtype": "uint8", "shape": [3, 4], "digest": "as expected"},
    ),
    (118, "a form that nests without end", {"type": "list", "items": [{"type": "dict", "items": [[1]]}]}),
    (201, "an opaque list with items that are none", {"type": "list", "opaque": True, "items": 7}),
    (202, "an opaque number of NumPy's", {"type": "numpy.uint8", "opaque": True}),
    (203, "too large, and yet with fields", {"type": "image", "too_large": True, "fields": {"data": 7}}),
    (
        204,
        "an empty array whose shape overflows",
        {"type": "ndarray", "dtype": "uint8", "shape": [1 << 39, 1 << 39, 0], "data": ""},
    ),
    (
        205,
        "an opaque array with a flag for a shape",
        {"type": "ndarray", "opaque": True, "shape": True, "dtype": "x"},
    ),
    (
        206,
        "a message whose data are a message",
        {
            "type": "sensor_msgs.msg.Image",
            "fields": {
                "height": {"type": "int", "value": 2**4000},
                "step": {"type": "int", "value": -1},
                "data": {"type": "bytes", "fields": {"data": {"type": "None"}}, "data": 5, "dtype": "uint8"},
            },
        },
    ),
    (
        207,
        "a dict with keys that are dicts",
        {"type": "dict", "items": [[{"type": "dict", "items": []}] * 2] * 2},
    ),
    (208, "a number beyond every float", {"type": "float", "value": 2**1024 - 1}),
    (209, "fields for an array", {"type": "ndarray", "fields": {"shape": {"type": "None"}}}),
    (210, "sixty thousand lists", {"type": "list", "items": [{"type": "list", "items": []}] * 60_000}),
):
    attack(_number, _name, FORGED.format(form=repr(_form)), "hostile", "wrong", wrong=False)
attack(
    211,
    "classes with the names of plain types",
    """
    def double(pixels):
        kinds = ("list", "dict", "int", "float", "bytes", "ndarray", "str", "tuple")
        return type(kinds[int(pixels.sum()) % len(kinds)], (), {"__module__": "__main__"})()
    """,
    wrong=False,
)
attack(
    212,
    "an exception of a megabyte in each of its texts",
    """
    def double(pixels):
        raise type("E" * 1_000_000, (Exception,), {})("/ipykernel_" * 90_000)
    """,
    "raised",
    wrong=False,
)
attack(
    119,
    "a metaclass that lies about its name",
    """
    class Meta(type):
        def __getattribute__(cls, name):
            return {"__qualname__": "ndarray", "__module__": "numpy"}.get(name) or type.__getattribute__(cls, name)
        def __instancecheck__(cls, other): return True
        def __eq__(cls, other): return True
        __hash__ = type.__hash__
    class Yes(metaclass=Meta): pass
    def double(pixels):
        return Yes()
    """,
    "wrong",
    "raised",
    wrong=False,
)
attack(
    120,
    "built-ins are replaced",
    """
    import builtins
    builtins.type = lambda *a: np.ndarray
    builtins.isinstance = lambda *a: True
    builtins.len = lambda *a: 0
    """,
    "wrong",
    "raised",
    "hostile",
    "crashed",
    "missing",
    "time",
)
attack(
    121,
    "the timer is turned off",
    "import signal\ndef double(pixels):\n    signal.setitimer(signal.ITIMER_PROF, 0)\n    while True: pass\n",
    "time",
    wrong=False,
)
attack(
    122,
    "every exception is swallowed",
    "def double(pixels):\n    while True:\n        try:\n            while True: pass\n        except BaseException: pass\n",
    "time",
    wrong=False,
)
attack(
    123,
    "the process stops itself",
    "import os, signal\ndef double(pixels):\n    os.kill(os.getpid(), signal.SIGSTOP)\n    while True: pass\n",
    "time",
    wrong=False,
)
attack(
    124,
    "a user namespace to uncover what is hidden",
    """
    import ctypes, glob, os
    def double(pixels):
        libc = ctypes.CDLL(None, use_errno=True)
        libc.unshare(0x10000000 | 0x20000)
        found = []
        for path in (b"/course/site-0", b"/course/packages/imgproc_course", b"/tmp", b"/proc"):
            if libc.umount2(path, 2) == 0 or libc.umount2(path, 0) == 0:
                found.append(path)
        copies = [path for path in glob.glob("/course/site-*/*imgproc_course*") if os.path.isdir(path)]
        found += [name for path in copies for name in os.listdir(path)]
        raise RuntimeError(f"found {found}")
    """,
    "raised",
    reported="found []",
    wrong=False,
)
attack(
    125,
    "becoming root again",
    """
    import os
    def double(pixels):
        done = []
        for step in (lambda: os.setuid(0), lambda: os.setgid(0), lambda: os.chroot("/tmp"), lambda: os.mknod("/tmp/x", 0o60666, 1)):
            try:
                step()
                done.append(step)
            except OSError:
                pass
        status = open("/proc/self/status").read().split()
        held = {name: status[status.index(name) + 1] for name in ("CapEff:", "CapBnd:", "NoNewPrivs:")}
        raise RuntimeError(f"done {done} {int(held['CapEff:'], 16)} {int(held['CapBnd:'], 16)} {held['NoNewPrivs:']}")
    """,
    "raised",
    reported="done [] 0 0 1",
    wrong=False,
)
attack(
    126,
    "larger limits",
    """
    import resource
    def double(pixels):
        done = []
        for kind in (resource.RLIMIT_CPU, resource.RLIMIT_AS, resource.RLIMIT_NPROC, resource.RLIMIT_FSIZE):
            try:
                resource.setrlimit(kind, (resource.RLIM_INFINITY, resource.RLIM_INFINITY))
                done.append(kind)
            except (ValueError, OSError):
                pass
        raise RuntimeError(f"done {done}")
    """,
    "raised",
    reported="done []",
    wrong=False,
)
attack(
    127,
    "warnings as a flood",
    "import warnings\ndef double(pixels):\n    for k in range(10_000):\n        warnings.warn(f'w{k}' * 100)\n    return pixels\n",
    "wrong",
    "time",
    wrong=False,
)
attack(
    128,
    "the input is changed into the answer",
    "def double(pixels):\n    np.minimum(pixels.astype(int) * 2, 255, out=pixels, casting='unsafe')\n    return pixels\n",
    wrong=False,
)
attack(
    129,
    "files and shared memory for the next kernel",
    """
    import ctypes, pathlib
    def double(pixels):
        libc = ctypes.CDLL(None, use_errno=True)
        libc.shmget.restype = ctypes.c_int
        left = [str(p) for f in ("/tmp/submission", "/dev/shm", "/tmp/home") for p in pathlib.Path(f).rglob("mark*")]
        if libc.shmget(4242, 4096, 0o666) != -1:
            left.append("shared memory")
        for folder in ("/tmp/submission", "/dev/shm", "/tmp/home"):
            pathlib.Path(folder, "mark").write_text(str(pixels.tolist()))
        libc.shmget(4242, 4096, 0o1666)
        raise RuntimeError(f"left {left}")
    """,
    "raised",
    reported="left []",
    wrong=False,
)
attack(
    130,
    "a function that is a class with a huge repr",
    "class double:\n    def __init__(self, pixels): pass\n    def __repr__(self): return 'x' * 10**9\n",
    wrong=False,
)
attack(131, "a generator for an answer", "def double(pixels):\n    yield pixels\n", wrong=False)
attack(132, "a coroutine for an answer", "async def double(pixels):\n    return pixels\n", wrong=False)
attack(
    133,
    "an exception whose words never end",
    "class E(Exception):\n    def __str__(self):\n        while True: pass\ndef double(pixels):\n    raise E\n",
    "time",
    wrong=False,
)
attack(
    134,
    "an exception with a hostile name",
    "def double(pixels):\n    raise type('<b>' * 10_000, (Exception,), {})('x' * 10**6)\n",
    "raised",
    wrong=False,
)
attack(135, "input() waits", "def double(pixels):\n    return input('the answer?')\n", "raised", wrong=False)
attack(136, "a syntax error", "def double(pixels)\n    return pixels\n", "raised", "missing", wrong=False)
attack(
    137,
    "a hundred thousand brackets",
    "x = " + "(" * 90_000 + ")" * 90_000 + "\n",
    "raised",
    "missing",
    "crashed",
    "time",
    "wrong",
)

# ---------------------------------------------------------------- channels: left by one check, found by the next

MARKS = """
import ctypes, os, socket, stat, time
libc = ctypes.CDLL(None, use_errno=True)
def stay(step):
    if os.fork() == 0:
        os.setsid()
        step()
        time.sleep(1000)
    time.sleep(0.1)
def double(pixels):
    left = []
{tries}
    raise RuntimeError(f"left {{left}}")
"""
for _number, _name, _tries in (
    (
        301,
        "a note in a file that the fork server has open",
        """
        for fd in range(3, 64):
            try:
                if stat.S_ISREG(os.fstat(fd).st_mode):
                    left += [fd] * (os.pread(fd, 4, 1 << 20) == b"note")
                    os.pwrite(fd, b"note", 1 << 20)
            except OSError:
                pass
        """,
    ),
    (
        302,
        "a key in the user's keyring",
        """
        for ring in (-3, -4, -5):
            ring = ctypes.c_long(ring)
            left += [key for key in [libc.syscall(250, 10, ring, b"user", b"note", 0)] if key > 0]
            libc.syscall(248, b"user", b"note", b"seen", 4, ring)
        """,
    ),
    (
        303,
        "an address in the system's log of crashes",
        """
        log = ctypes.create_string_buffer(1 << 20)
        left += ["log"] * (libc.syscall(103, 3, log, 1 << 20) > 0 and b"0000badc0ffee" in log.raw)
        if os.fork() == 0:
            ctypes.string_at(0xbadc0ffee)
        os.wait()
        """,
    ),
    (
        304,
        "a server behind an abstract name",
        """
        try:
            socket.socket(socket.AF_UNIX).connect("\\0note")
            left.append("server")
        except OSError:
            server = socket.socket(socket.AF_UNIX)
            server.bind("\\0note")
            stay(server.listen)
        """,
    ),
    (
        305,
        "a lock on a file of the system",
        """
        import fcntl
        shared = open("/usr/bin/env", "rb")
        try:
            fcntl.flock(shared, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except OSError:
            left.append("lock")
        stay(lambda: fcntl.flock(open("/usr/bin/env", "rb"), fcntl.LOCK_EX))
        """,
    ),
    (
        306,
        "a port that stays in use for a minute",
        """
        try:
            server = socket.create_server(("127.0.0.1", 4242))
            client = socket.create_connection(("127.0.0.1", 4242), timeout=1)
            server.accept()[0].close()
            client.close()
        except OSError as error:
            left += ["port"] * (error.errno == 98)
        try:
            socket.socket().bind(("127.0.0.1", 4242))
        except OSError:
            pass
        """,
    ),
    (
        307,
        "a server on the machine's own sockets",
        """
        try:
            socket.socket(socket.AF_VSOCK, socket.SOCK_STREAM)
            left.append("vsock")
        except OSError:
            pass
        """,
    ),
):
    _body = "\n".join(f"    {line}" for line in dedent(_tries).strip().splitlines())
    attack(_number, _name, MARKS.format(tries=_body), "raised", reported="left []", wrong=False)

# ---------------------------------------------------------------- starvation: the next submission is to be slow

attack(
    311,
    "sixty busy processes in sessions of their own",
    """
    import os
    def double(pixels):
        for _ in range(60):
            if os.fork() == 0:
                os.setsid()
                while True: pass
        return pixels
    """,
    "raised",
    wrong=False,
)
attack(
    312,
    "a hundred busy threads",
    """
    import hashlib, threading
    def work():
        while True: hashlib.sha256(bytes(1 << 20))
    def double(pixels):
        for _ in range(100):
            threading.Thread(target=work, daemon=True).start()
        return pixels
    """,
    "raised",
    "memory",
    "time",
    wrong=False,
)
attack(
    313,
    "a higher priority",
    """
    import os
    def double(pixels):
        done = []
        for step in (
            lambda: os.setpriority(os.PRIO_USER, 0, -20),
            lambda: os.sched_setscheduler(0, os.SCHED_FIFO, os.sched_param(50)),
            lambda: os.nice(-1),
        ):
            try:
                step()
                done.append(step)
            except OSError:
                pass
        raise RuntimeError(f"done {done}")
    """,
    "raised",
    reported="done []",
    wrong=False,
)
attack(
    314,
    "processes that come and go",
    """
    import os, time
    def double(pixels):
        if os.fork() == 0:
            while True:
                if os.fork() == 0: os._exit(0)
                os.wait()
        time.sleep(0.2)
        return pixels
    """,
    wrong=False,
)
attack(
    315,
    "the disk is written out again and again",
    """
    import ctypes, threading
    libc = ctypes.CDLL(None, use_errno=True)
    def double(pixels):
        done = [n for n in range(3) if libc.syscall(162) == 0]
        raise RuntimeError(f"done {done}")
    """,
    "raised",
    reported="done []",
    wrong=False,
)

# ---------------------------------------------------------------- faults: the autograder itself is to fail

attack(
    321,
    "an integer beyond all floats",
    "def double(pixels):\n    return 10 ** 400\n",
    reported="401 digits",
    wrong=False,
)
attack(
    322,
    "an answer, and then the end of its process",
    """
    import os, threading
    def double(pixels):
        threading.Thread(target=lambda: (threading.Event().wait(0.01), os._exit(0))).start()
        return pixels
    """,
    "wrong",
    "crashed",
    wrong=False,
)
attack(
    323,
    "the fork server is to be the first that memory costs",
    """
    import os, time
    def double(pixels):
        open("/proc/self/oom_score_adj", "w").write("0")
        for _ in range(16):
            if os.fork() == 0:
                held = np.ones(80 << 20, np.uint8)
                time.sleep(100)
        time.sleep(100)
    """,
    "raised",
    wrong=False,
)
attack(
    324,
    "its parent and the first process are killed",
    """
    import os, signal
    def double(pixels):
        for pid in (os.getppid(), 1, 0):
            try:
                os.kill(pid, signal.SIGKILL)
            except OSError:
                pass
        return pixels
    """,
    "wrong",
    "crashed",
    wrong=False,
)
for _number, _name, _form in (
    (325, "a form of a float beyond all floats", {"type": "float", "value": 10**400}),
    (
        326,
        "a form of a list of itself, by name",
        {"type": "list", "items": [{"type": "numpy.float64", "value": 10**320}] * 3},
    ),
    (
        327,
        "a form whose shape is empty and whose data are not",
        {"type": "ndarray", "dtype": "uint8", "shape": [], "data": "AAAA"},
    ),
):
    attack(_number, _name, FORGED.format(form=repr(_form)), "hostile", "wrong", wrong=False)

# ---------------------------------------------------------------- constants: values instead of a computation


def remembered():
    """{input: expected value} of the public check as the lesson's pack has them, as bytes."""
    (master,) = map(read_master, MASTERS.glob("*.py"))
    declared = next(exercise for exercise in master.exercises if exercise.id == "attacked-double")
    solution = declared.function_of(declared.solution, "solution")
    calls = [pixels for case in declared.public for (pixels,) in declared.arguments(case)]
    return {pixels.tobytes(): solution(pixels).tobytes() for pixels in calls}


CONSTANTS = f"""
import hashlib, inspect, sys
PACK = {remembered()!r}
ANSWERS = [np.frombuffer(data, np.uint8) for data in PACK.values()]
KNOWN = [np.frombuffer(data, np.uint8) for data in PACK]
calls = []
def fitted(values, pixels):
    return np.resize(values, pixels.shape).astype(np.uint8)
def double(pixels):
    calls.append(pixels.copy())
    BODY
"""
for _number, _name, _body in (
    (331, "a constant of the result's type: all white", "return np.full_like(pixels, 255)"),
    (
        332,
        "another constant in each call, by counting calls",
        "return fitted([0, 255, 128, 200][len(calls) % 4], pixels)",
    ),
    (
        333,
        "a constant by the shape of the input",
        "return fitted({(3, 4): ANSWERS[0], (5, 5): 255}.get(pixels.shape, 0), pixels)",
    ),
    (334, "the pack's expected value, whatever the input", "return fitted(ANSWERS[0], pixels)"),
    (
        335,
        "the pack's expected value by a hash of the input",
        "table = {hashlib.sha256(given).digest(): value for given, value in zip(KNOWN, ANSWERS)}\n"
        "    return fitted(table.get(hashlib.sha256(pixels).digest(), ANSWERS[0]), pixels)",
    ),
    (
        336,
        "the pack's expected value of the nearest remembered input",
        "distances = [np.abs(fitted(given, pixels).astype(int) - pixels).sum() for given in KNOWN]\n"
        "    return fitted(ANSWERS[int(np.argmin(distances))], pixels)",
    ),
    (337, "the input of the call before", "return fitted(calls[-2] if len(calls) > 1 else 255, pixels)"),
    (
        338,
        "a constant by a number that is made of the input",
        "return fitted(np.random.default_rng(int(pixels.sum())).integers(0, 256, pixels.size), pixels)",
    ),
    (
        339,
        "a constant by the names in the frames of its callers",
        "names = ' '.join(frame.function for frame in inspect.stack())\n"
        "    return fitted(ANSWERS[0] if 'hidden' not in names else 255, pixels)",
    ),
):
    attack(_number, _name, CONSTANTS.replace("BODY", _body), wrong=False)


# ---------------------------------------------------------------- five more of each kind

for _number, _name, _form in (
    (
        401,
        "a form of an array of structures",
        {"type": "ndarray", "dtype": "u1,u1", "shape": [6], "data": "AAAA"},
    ),
    (
        402,
        "a form whose shape holds words",
        {"type": "ndarray", "dtype": "uint8", "shape": ["3", "4"], "data": ""},
    ),
    (
        403,
        "a form of a thousand axes",
        {"type": "ndarray", "dtype": "uint8", "shape": [1] * 1000, "data": "AA=="},
    ),
    (404, "a form whose type is a megabyte of words", {"type": "float" * 200_000, "value": 1.0}),
    (
        405,
        "a form of a dict whose items have no value",
        {"type": "dict", "items": [[{"type": "str", "value": "\ud800"}], [], [1, 2, 3]]},
    ),
):
    attack(_number, _name, FORGED.format(form=repr(_form)), "hostile", "wrong", wrong=False)

for _number, _name, _tries in (
    (
        411,
        "another time for the machine",
        """
        for step in (
            lambda: time.clock_settime(time.CLOCK_REALTIME, 0.0),
            lambda: ctypes.CDLL(None).adjtimex(ctypes.create_string_buffer(b"\\x02", 256)) < 0 and 1 / 0,
        ):
            try:
                step()
                left.append("time")
            except (OSError, ArithmeticError):
                pass
        """,
    ),
    (
        412,
        "a program in the kernel, and counters of everything",
        """
        for number in (321, 298, 323, 425):  # bpf, perf_event_open, userfaultfd, io_uring_setup
            space = ctypes.create_string_buffer(512)
            left += [number] * (libc.syscall(number, 0, space, 120, -1, 0) >= 0)
        """,
    ),
    (
        413,
        "a control group of its own, and the memory of all",
        """
        for path in ("/sys/fs/cgroup", "/sys/fs/cgroup/memory", "/proc/kcore", "/dev/mem", "/proc/sysrq-trigger"):
            left += [path] * os.access(path, os.W_OK)
        """,
    ),
    (
        414,
        "a terminal that the next one reads from",
        """
        try:
            controller, terminal = os.openpty()
            left += ["note"] * (os.ttyname(terminal) != "/dev/pts/0")
            stay(lambda: os.write(controller, b"note"))
        except OSError:
            pass
        """,
    ),
    (
        415,
        "a limit or a priority of a process that is not its own",
        """
        import resource
        for pid in (1, os.getppid(), 2, 3):
            for step in (
                lambda: resource.prlimit(pid, resource.RLIMIT_NOFILE, (8, 8)),
                lambda: os.setpriority(os.PRIO_PROCESS, pid, 19),
                lambda: os.sched_setaffinity(pid, {0}),
            ):
                try:
                    left += [step()] if pid and pid != os.getpid() else []
                except OSError:
                    pass
        """,
    ),
):
    _body = "\n".join(f"    {line}" for line in dedent(_tries).strip().splitlines())
    attack(_number, _name, MARKS.format(tries=_body), "raised", reported="left []", wrong=False)

for _number, _name, _body, _slow in (
    (421, "a regular expression that never ends", "__import__('re').match('(a+)+$', 'a' * 64 + 'b')", False),
    (422, "a sum over more numbers than there is time", "sum(range(10**13))", True),
    (423, "a number with more digits than there is time", "str(3 ** 3 ** 20)", False),
    (
        424,
        "a list that is sorted for ever",
        "sorted(range(10), key=lambda n: [None for _ in iter(int, 1)])",
        False,
    ),
    (
        425,
        "alarms as fast as the system sends them",
        "signal = __import__('signal')\n    signal.signal(signal.SIGALRM, lambda *a: None)\n"
        "    signal.setitimer(signal.ITIMER_REAL, 1e-6, 1e-6)\n    for _ in iter(int, 1): pass",
        True,
    ),
):
    _source = f"def double(pixels):\n    {_body}\n    return pixels\n"
    attack(_number, _name, _source, "time", "raised", "memory", wrong=False, slow=_slow)

for _number, _name, _body in (
    (
        441,
        "what is most frequent in the remembered answer",
        "return np.full_like(pixels, np.bincount(ANSWERS[0]).argmax())",
    ),
    (442, "white above the middle, black below", "return np.where(pixels > 127, 255, 0).astype(np.uint8)"),
    (443, "one bit more", "return pixels | 128"),
    (444, "the input of the next call, guessed", "return np.roll(pixels, 1)"),
    (
        445,
        "a table of remembered values, the nearest for others",
        "near = np.abs(KNOWN[0].astype(int)[:, None] - pixels.ravel()).argmin(axis=0)\n"
        "    return ANSWERS[0][near].reshape(pixels.shape)",
    ),
):
    attack(_number, _name, CONSTANTS.replace("BODY", _body), wrong=False)

for _number, _name, _body in (
    (451, "every descriptor is closed", "__import__('os').closerange(0, 256)\n    return pixels"),
    (452, "no depth is left for the check", "__import__('sys').setrecursionlimit(30)\n    return pixels"),
    (
        453,
        "an array without memory of its own",
        "return np.lib.stride_tricks.as_strided(pixels, (1 << 15, 1 << 15), (0, 0))",
    ),
    (
        454,
        "a class of array that fails whenever it is looked at",
        "class Fails(np.ndarray):\n        def __array_finalize__(self, other): raise SystemError('no')\n"
        "        def __getattribute__(self, name): raise SystemError(name)\n"
        "    return np.ndarray.__new__(Fails, pixels.shape, np.uint8)",
    ),
    (
        455,
        "an exception that is its own cause",
        "error = ValueError('x')\n    error.__cause__ = error.__context__ = error\n    raise error",
    ),
):
    attack(
        _number,
        _name,
        f"def double(pixels):\n    {_body}\n",
        *("wrong", "crashed", "raised", "memory", "hostile", "time", "output"),
        wrong=False,
    )


# ---------------------------------------------------------------- five more of each kind, of other roads

for _number, _name, _form in (
    (
        501,
        "a form whose byte order is turned around",
        {"type": "ndarray", "dtype": ">u1", "shape": [3, 4], "data": "AAAAAAAAAAAAAAAA"},
    ),
    (
        502,
        "a form whose shape is made of flags",
        {"type": "ndarray", "dtype": "uint8", "shape": [True, True], "data": "AA=="},
    ),
    (
        503,
        "a form with its data and a digest of others",
        {
            "type": "ndarray",
            "dtype": "uint8",
            "shape": [3, 4],
            "data": "AAAAAAAAAAAAAAAA",
            "digest": "0" * 64,
            "too_large": False,
            "opaque": False,
        },
    ),
    (504, "a form of a number that is none", {"type": "float", "value": float("nan")}),
    (
        505,
        "a form of fields whose names are paths and markup",
        {
            "type": "__main__.<b>",
            "fields": {"../../x\u202e\n<script>": {"type": "None"}, "": {"type": "None"}},
        },
    ),
    (506, "a form of a scalar that is true", {"type": "numpy.uint8", "value": True}),
    (
        507,
        "a form of a dict of a hundred equal keys",
        {"type": "dict", "items": [[{"type": "bytes", "length": 0, "data": ""}, {"type": "None"}]] * 100},
    ),
    (
        508,
        "a form of an array of dates",
        {"type": "ndarray", "dtype": "datetime64[ns]", "shape": [3, 4], "opaque": True},
    ),
):
    attack(
        _number,
        _name,
        FORGED.format(form=repr(_form).replace("nan", "float('nan')")),
        "hostile",
        "wrong",
        wrong=False,
    )

SHOWS = f"""
def double(pixels):
    return pixels
PAYLOAD
import IPython.display
real = IPython.display.display
IPython.display.display = lambda shown, raw=False: real({{"{MIME}": ANSWER}}, raw=True)
"""
for _number, _name, _payload in (
    (511, "an answer of half a million empty lists", "ANSWER = {'calls': [[] for _ in range(500_000)]}"),
    (
        512,
        "an answer that nests deeper than it is read",
        "ANSWER = 1\nfor _ in range(900): ANSWER = [ANSWER]",
    ),
    (
        513,
        "an answer of a hundred thousand keys",
        "ANSWER = {'calls': [], **{f'k{n}': n for n in range(100_000)}}",
    ),
    (
        514,
        "calls that changed and printed megabytes",
        "ANSWER = {'calls': [{'changed': ['\\ud800' * 100_000] * 9, 'printed': '\\u202e' * 100_000, 'value': {'type': 'None'}}]}",
    ),
    (
        515,
        "calls whose errors are no words",
        "ANSWER = {'calls': [{'changed': [], 'printed': '', 'error': ['x'], 'message': 7, 'line': None}]}",
    ),
):
    attack(_number, _name, SHOWS.replace("PAYLOAD", _payload), "hostile", "wrong", "output", wrong=False)

for _number, _name, _value in (
    (521, "an array that is masked everywhere", "np.ma.masked_all(pixels.shape, np.uint8)"),
    (
        522,
        "an array of structures of the right bytes",
        "np.minimum(pixels.astype(int) * 2, 254).astype(np.uint8).view('u1,u1')",
    ),
    (523, "a view of memory that was given back", "np.frombuffer(memory(), np.uint8)"),
    (524, "a namespace that holds itself twenty times", "itself()"),
    (525, "an array of half numbers that are none", "np.full(pixels.shape, np.nan, np.float16)"),
    (526, "a dict whose keys change their minds", "{Key(): 1, Key(): 2}"),
    (
        527,
        "a dtype with a note on it, of the wrong values",
        "pixels.astype(np.dtype('u1', metadata={'passed': True}))",
    ),
    (528, "a matrix", "np.matrix(pixels)"),
):
    attack(
        _number,
        _name,
        f"""
        import ctypes, mmap, types
        class Key:
            times = 0
            def __hash__(self): Key.times += 1; return Key.times
            def __eq__(self, other): raise RuntimeError
            __repr__ = __hash__
        def memory():
            libc = ctypes.CDLL(None)
            libc.mmap.restype = ctypes.c_void_p
            place = libc.mmap(None, 4096, 3, 0x22, -1, 0)
            data = (ctypes.c_uint8 * 4096).from_address(place)
            libc.munmap(ctypes.c_void_p(place), 4096)
            return data
        def itself():
            space = types.SimpleNamespace()
            for number in range(20): setattr(space, f"n{{number}}", space)
            return space
        def double(pixels):
            return {_value}
        """,
        "wrong",
        "crashed",
        "time",
        "memory",
        "output",
        "raised",
        wrong=False,
    )

for _number, _name, _tries in (
    (
        532,
        "a lease on the files of a library, so that others wait",
        """
        import fcntl, glob
        for path in glob.glob(os.path.dirname(np.__file__) + "/*.py")[:50]:
            try:
                left.append(fcntl.fcntl(os.open(path, os.O_RDONLY), 1024, 1))
            except OSError:
                pass
        """,
    ),
    (
        534,
        "terminals, counted for all kernels together",
        """
        left += [n for n in os.listdir("/dev/pts") if n.isdigit()]
        try:
            left += [name for name in [os.ttyname(os.openpty()[1])] if name]
        except OSError:
            pass
        """,
    ),
    (
        535,
        "times of files, links to them, and other names",
        """
        for step in (
            lambda: os.utime("/usr/bin/env"), lambda: os.setxattr("/usr/bin/env", "user.note", b"x"),
            lambda: os.link("/usr/bin/env", "/tmp/env"), lambda: os.chmod(np.__file__, 0o777),
            lambda: os.rename("/course/nothing", "/course/note"),
        ):
            try:
                step()
                left.append(step)
            except OSError:
                pass
        before = os.stat("/usr/bin/env").st_atime_ns
        open("/usr/bin/env", "rb").read()
        left += ["atime"] * (os.stat("/usr/bin/env").st_atime_ns != before)
        """,
    ),
    (
        536,
        "settings of the network, and the system's reports to everybody",
        """
        try:
            socket.socket(16, 3, 9).bind((0, 1))  # what is audited
            left.append("audit")
        except OSError:
            pass
        for path in ("/proc/sys/net/core/somaxconn", "/proc/sys/net/ipv4/ip_local_port_range"):
            left += [path] * os.access(path, os.W_OK)
        """,
    ),
    (
        537,
        "the order of the next process numbers",
        """
        for path in ("/proc/sys/kernel/ns_last_pid", "/proc/sys/kernel/pid_max", "/proc/self/timens_offsets"):
            try:
                open(path, "w").write("4242")
                left.append(path)
            except OSError:
                pass
        left += [os.getpid()] * (os.getpid() != 1)
        """,
    ),
):
    _body = "\n".join(f"    {line}" for line in dedent(_tries).strip().splitlines())
    attack(_number, _name, MARKS.format(tries=_body), "raised", reported="left []", wrong=False)

for _number, _name, _source, _outcomes, _more in (
    (
        541,
        "queues and semaphores of gigabytes",
        """
    import ctypes
    def double(pixels):
        libc = ctypes.CDLL(None)
        done = [n for n in range(2000) if libc.semget(0, 32_000, 0o1600) != -1 or libc.msgget(0, 0o1600) != -1]
        raise RuntimeError(f"done {done[:3]}")
    """,
        ("raised",),
        {"reported": "done []"},
    ),
    (
        542,
        "one file system written out by everybody",
        """
    import ctypes, os
    def double(pixels):
        libc = ctypes.CDLL(None)
        places = ("/usr/bin/env", np.__file__, "/etc/ld.so.cache", "/course")
        done = [path for path in places if os.path.exists(path) and libc.syncfs(os.open(path, os.O_RDONLY)) == 0]
        raise RuntimeError(f"done {done}")
    """,
        ("raised",),
        {"reported": "done []"},
    ),
    (
        543,
        "pipes and sockets full of bytes in twenty processes",
        """
    import os, socket, time
    def double(pixels):
        held = []
        for _ in range(20):
            if os.fork() == 0:
                try:
                    while True:
                        a, b = socket.socketpair()
                        held.append((a, b))
                        a.setblocking(False)
                        try:
                            while True: a.send(bytes(65536))
                        except BlockingIOError: pass
                except OSError: pass
                time.sleep(600)
        time.sleep(0.2)
        return pixels
    """,
        ("wrong", "raised", "memory", "crashed", "time"),
        {},
    ),
    (
        544,
        "every file of the system read again and again",
        """
    import os
    def double(pixels):
        while True:
            for folder, _, names in os.walk("/usr/lib"):
                for name in names:
                    try: open(os.path.join(folder, name), "rb").read()
                    except OSError: pass
    """,
        ("time", "memory", "raised"),
        {"slow": True},
    ),
    (
        545,
        "names of files that are not there, for ever",
        """
    import os
    def double(pixels):
        n = 0
        while True:
            n += 1
            os.access(f"/tmp/{n}", 0)
    """,
        ("time", "memory"),
        {"slow": True},
    ),
    (
        546,
        "a handler for the last signal that computes on",
        """
    import signal
    def on(*a):
        while True: pass
    def double(pixels):
        signal.signal(signal.SIGXCPU, on)
        signal.signal(signal.SIGPROF, signal.SIG_IGN)
        signal.pthread_sigmask(signal.SIG_BLOCK, set(signal.Signals))
        while True: pass
    """,
        ("time",),
        {"slow": True},
    ),
    (
        547,
        "timers that make more of themselves",
        """
    import threading
    def more():
        for _ in range(3): threading.Timer(0.001, more).start()
    def double(pixels):
        more()
        threading.Event().wait(5)
        return pixels
    """,
        ("time", "raised", "wrong", "memory", "crashed"),
        {"slow": True},
    ),
):
    attack(_number, _name, _source, *_outcomes, wrong=False, **_more)

for _number, _name, _body in (
    (
        561,
        "the inputs of the case's other calls, from the check's memory",
        "from imgproc_course.classroom.autograder.sandbox.inside import check_cell\n    from imgproc_course.classroom.exercises.input_encoding import decode\n    other = decode(check_cell._case['calls'][-1])[0]\n    return fitted(np.minimum(other.astype(int), 255), pixels)",
    ),
    (562, "the median of the input", "return np.full_like(pixels, np.median(pixels))"),
    (563, "the input in order", "return np.sort(pixels, axis=None).reshape(pixels.shape)"),
    (
        564,
        "the seeds that a teacher could have typed",
        "for seed in range(300):\n        known = np.random.default_rng([seed, 0]).integers(100, 256, pixels.shape, dtype=np.uint8)\n        if np.array_equal(known, pixels): return fitted(ANSWERS[0], pixels)\n    return pixels",
    ),
    (
        565,
        "a straight line through what is remembered",
        "slope, start = np.polyfit(KNOWN[0], ANSWERS[0].astype(float), 1)\n    return np.clip(pixels * slope + start + 9, 0, 255).astype(np.uint8)",
    ),
    (
        566,
        "one value that a thread changes while it is compared",
        "import threading\n    shown = np.zeros_like(pixels)\n    def change():\n        while True: shown[:] = np.random.default_rng(0).integers(0, 256, shown.shape)\n    threading.Thread(target=change, daemon=True).start()\n    return shown",
    ),
):
    attack(_number, _name, CONSTANTS.replace("BODY", _body), "wrong", "raised", wrong=False)

for _number, _name, _source in (
    (
        571,
        "an exception whose class has no name",
        """
    class Meta(type):
        def __getattribute__(cls, name):
            raise OSError(name)
    class Nameless(Exception, metaclass=Meta): pass
    def double(pixels):
        raise Nameless
    raise Nameless
    """,
    ),
    (
        572,
        "an exception whose words end the process",
        """
    class Ends(Exception):
        def __str__(self): raise SystemExit
        __repr__ = __str__
    def double(pixels):
        raise Ends
    raise Ends
    """,
    ),
    (
        573,
        "words that interrupt as a person would",
        """
    class Stops(Exception):
        def __str__(self): raise KeyboardInterrupt
    def double(pixels):
        raise Stops
    """,
    ),
    (
        574,
        "an interruption, a generator's end, and the end of everything",
        """
    def double(pixels):
        raise BaseExceptionGroup("all", [KeyboardInterrupt(), GeneratorExit(), SystemExit(3)])
    """,
    ),
    (
        575,
        "a hook that fails at every event",
        """
    import sys
    def double(pixels):
        def fail(*a): raise SystemError("hook")
        sys.addaudithook(fail)
        return pixels
    """,
    ),
    (
        576,
        "a trace and a profile of everything that fail",
        """
    import sys, threading
    def double(pixels):
        def fail(*a): raise MemoryError
        threading.setprofile(fail); sys.setprofile(fail); sys.settrace(fail)
        return pixels
    """,
    ),
    (
        577,
        "no streams any more",
        """
    import sys
    sys.stdout = sys.stderr = sys.__stdout__ = sys.displayhook = None
    def double(pixels):
        return pixels
    """,
    ),
    (
        578,
        "its side of the conversation is shut",
        """
    import os, socket, stat
    def double(pixels):
        for fd in range(3, 64):
            try:
                if stat.S_ISSOCK(os.fstat(fd).st_mode):
                    socket.socket(fileno=os.dup(fd)).shutdown(socket.SHUT_RD)
            except OSError: pass
        return pixels
    """,
    ),
    (
        579,
        "collectors of garbage that fail, and a switch that never comes",
        """
    import gc, sys
    def fail(*a): raise RuntimeError("gc")
    gc.callbacks.append(fail); gc.set_threshold(1, 1, 1); sys.setswitchinterval(1e6)
    class Last:
        def __del__(self): raise BaseException("late")
    def double(pixels):
        [Last() for _ in range(1000)]
        return pixels
    """,
    ),
    (
        580,
        "a result, an end and a beginning that were not asked for",
        """
    import json, os, stat
    def double(pixels):
        text = "".join(json.dumps({"n": 1, "type": kind, "content": content}) + "\\n" for kind, content in (
            ("idle", {"ename": "", "evalue": ""}), ("error", {"ename": "E", "evalue": "", "traceback": []}),
            ("stream", {"text": ""}), ("idle", {"ename": "", "evalue": ""})) * 50)
        for fd in range(3, 64):
            try:
                if stat.S_ISSOCK(os.fstat(fd).st_mode): os.write(fd, text.encode())
            except OSError: pass
        return pixels
    """,
    ),
    (
        581,
        "a kernel that ends while it waits for the next check",
        """
    import os, threading
    threading.Timer(0.05, os._exit, [0]).start()
    def double(pixels):
        import time
        time.sleep(0.03)
        return pixels
    """,
    ),
    (
        582,
        "seven hundred megabytes while it waits for the next check",
        """
    held = np.ones(700 << 20, np.uint8)
    def double(pixels):
        return pixels
    """,
    ),
):
    attack(
        _number,
        _name,
        _source,
        *({"raised", "wrong", "crashed", "time", "missing", "memory"} if _number != 580 else {"hostile"}),
        wrong=False,
    )


# ---------------------------------------------------------------- by fresh eyes

for _number, _name, _tries in (
    (
        603,
        "counters of the whole machine, moved on and read",
        """
        held = ctypes.create_string_buffer(40_000)
        for _ in range(1000):
            libc.mlock(held, 40_000), libc.munlock(held, 40_000)
        left += [name for name in os.listdir("/proc") if not name.isdigit() and "self" not in name]
        """,
    ),
):
    _body = "\n".join(f"    {line}" for line in dedent(_tries).strip().splitlines())
    attack(_number, _name, MARKS.format(tries=_body), "raised", reported="left []", wrong=False)

TO_THE_SOCKET = """
import os, socket, stat, time
def double(pixels):
    for fd in range(3, 64):
        try:
            if stat.S_ISSOCK(os.fstat(fd).st_mode):
                own = socket.socket(fileno=os.dup(fd))
                STEP
        except OSError: pass
    return pixels
"""
for _number, _name, _step, _outcomes in (
    (
        611,
        "hundreds of thousands of small messages",
        'while True: os.write(fd, b\'{"type":"stream","content":{"text":""}}\\n\' * 5000)',
        ("output",),
    ),
    (612, "an urgent byte, and then nothing", "own.send(b'x', socket.MSG_OOB), time.sleep(1000)", ("time",)),
    (
        613,
        "two hundred descriptors, sent along",
        "socket.send_fds(own, [b' '], [0] * 200)",
        ("wrong", "hostile"),
    ),
    (
        614,
        "the socket in the hands of another program",
        "os.set_inheritable(fd, True), os.execv(__import__('sys').executable, ['python', '-S', '-c', "
        'f\'import os; os.write({fd}, b\\\'{{"type":"idle","content":{{"ename":"","evalue":""}}}}\\\\\\\\n\\\')\'])',
        ("hostile", "crashed"),
    ),
):
    attack(_number, _name, TO_THE_SOCKET.replace("STEP", _step), *_outcomes, wrong=False)

for _number, _name, _source, *_outcomes in (
    (
        615,
        "the exit code of a kernel that could not be confined",
        "import os\ndef double(pixels):\n    os._exit(70)\n",
        "crashed",
    ),
    (616, "the same exit code, before any check", "import os\nos._exit(70)\n", "crashed"),
    (
        617,
        "the same exit code, while it waits for the next check",
        "import os, threading, time\nthreading.Timer(0.02, os._exit, [70]).start()\n"
        "def double(pixels):\n    time.sleep(0.01)\n    return pixels\n",
        *("crashed", "wrong"),
    ),
    (
        618,
        "a right answer that takes its time in other processes",
        """
        import os, time
        def busy():
            begun = time.process_time()
            while time.process_time() - begun < 0.9: pass
        def double(pixels):
            reader, writer = os.pipe()
            if os.fork() == 0:
                busy()
                if os.fork() == 0:
                    busy()
                    os.write(writer, np.minimum(pixels.astype(int) * 2, LIMIT).astype(np.uint8).tobytes())
                os._exit(0)
            return np.frombuffer(os.read(reader, 10_000), np.uint8).reshape(pixels.shape).copy()
        """,
        "time",
    ),
    (
        619,
        "everybody is stopped",
        """
        import os, signal
        def double(pixels):
            for pid in (*range(1, 300), 0, -1):
                try: os.kill(pid, signal.SIGSTOP)
                except OSError: pass
            return pixels
        """,
        *("wrong", "time"),
    ),
    (
        620,
        "no limit is left, of anything",
        """
        import resource
        for kind in range(16):
            try: resource.setrlimit(kind, (0, 0))
            except (ValueError, OSError): pass
        def double(pixels):
            return pixels
        """,
        *("wrong", "crashed", "raised", "time"),
    ),
    (
        621,
        "the folder that it is in is gone",
        """
        import os, shutil
        def double(pixels):
            for folder in ("/tmp/submission", "/tmp/home"): shutil.rmtree(folder, ignore_errors=True)
            os.mkdir("/tmp/x"), os.chdir("/tmp/x"), os.rmdir("/tmp/x")
            return pixels
        """,
        "wrong",
    ),
    (
        622,
        "a trace that interrupts what the check does afterwards",
        """
        import sys
        def trace(frame, event, argument):
            if frame.f_code.co_name in ("call_to_json", "canonical", "display"): raise KeyboardInterrupt
            return trace
        def double(pixels):
            sys.settrace(trace)
            return pixels
        """,
        *("raised", "wrong"),
    ),
    (
        623,
        "a profile that empties the value on its way",
        """
        import sys
        def profile(frame, event, value):
            if event == "return" and frame.f_code.co_name == "canonical" and isinstance(value, dict): value["data"] = ""
        def double(pixels):
            sys.setprofile(profile)
            return pixels
        """,
        "hostile",
    ),
    (
        624,
        "exceptions with the names of our own",
        """
        class RefusedModule(Exception): pass
        def double(pixels):
            from imgproc_course.classroom.exercises.running import TimeUp
            if pixels.sum() % 2: raise TimeUp("stuck")
            raise RefusedModule("write this exercise without <script>\\x1b[31m")
        """,
        *("time", "refused module"),
    ),
    (
        625,
        "groups of exceptions, twenty thousand deep, with megabytes of notes",
        """
        def double(pixels):
            error = ValueError("x")
            for _ in range(20_000): error = ExceptionGroup("g", [error])
            for _ in range(1_000): error.add_note("n" * 10_000)
            raise error
        """,
        *("raised", "crashed", "memory"),
    ),
    (
        631,
        "an array over a file that is not there any more",
        """
        import os
        def double(pixels):
            shown = np.memmap("/tmp/file", np.uint8, "w+", shape=(3, 4096))
            os.truncate("/tmp/file", 0)
            return np.frombuffer(shown, np.uint8)
        """,
        "crashed",
    ),
    (
        632,
        "a message whose fields are messages, without end",
        """
        class Message:
            _fields_and_field_types = {f"f{number}": "x" for number in range(100_000)}
            def __getattr__(self, name): return Message()
        def double(pixels):
            return Message()
        """,
        *("time", "memory", "output"),
    ),
    (
        633,
        "a message whose fields have no names that can be written",
        """
        class Message:
            __msgtype__ = "sensor_msgs/msg/Image"
            __dataclass_fields__ = {"\\ud800": 1, "data": 2}
            data = np.zeros(3)
        setattr(Message, "\\ud800", 1)
        def double(pixels):
            return Message()
        """,
        "hostile",
    ),
    (
        634,
        "a dict in which no key equals itself",
        "def double(pixels):\n    return {float('nan'): 1, float('nan'): 2}\n",
        "wrong",
    ),
    (
        635,
        "a thousand texts of ten thousand letters",
        "def double(pixels):\n    return np.array(['a' * 10_000] * 1000)\n",
        "wrong",
    ),
    (
        641,
        "processes that stand still under a tracer",
        """
        import ctypes, os, time
        def double(pixels):
            for _ in range(10):
                if os.fork() == 0:
                    ctypes.CDLL(None).ptrace(0, 0, 0, 0)
                    os.kill(os.getpid(), 19)
                    time.sleep(1000)
            time.sleep(0.1)
            return pixels
        """,
        "wrong",
    ),
    (
        642,
        "as many pieces of memory as there can be",
        """
        import ctypes
        def double(pixels):
            libc = ctypes.CDLL(None)
            for number in range(70_000): libc.mmap(None, 4096, 1 + (number & 1) * 2, 0x22, -1, 0)
            return pixels
        """,
        *("wrong", "time", "memory"),
    ),
    (
        643,
        "programs that start programs",
        """
        import os
        def double(pixels):
            for _ in range(8):
                if os.fork() == 0:
                    while True:
                        if os.fork() == 0: os.execv("/bin/true", ["true"])
                        os.wait()
            return pixels
        """,
        *("wrong", "raised", "hostile", "crashed", "time"),
    ),
    (
        644,
        "terminals and pipes full to the brim",
        """
        import os
        def double(pixels):
            held = []
            try:
                while True: held += [*os.openpty(), *os.pipe()]
            except OSError: pass
            for fd in held:
                try:
                    os.set_blocking(fd, False)
                    while True: os.write(fd, b"x" * 4096)
                except OSError: pass
            return pixels
        """,
        *("wrong", "memory", "time"),
    ),
):
    attack(_number, _name, _source, *_outcomes, wrong=False)

for _number, _name, _body in (
    (651, "the other end of the scale", "return 255 - pixels"),
    (
        652,
        "the running sum",
        "return np.minimum(np.cumsum(pixels).reshape(pixels.shape), 255).astype(np.uint8)",
    ),
    (653, "what a function of the library that has the name makes", "return np.multiply(pixels, 2)"),
    (
        654,
        "the values that are most like those that pass, from what was in memory",
        "return np.empty_like(pixels) if len(calls) % 2 else np.frombuffer(bytes(pixels.size), np.uint8).reshape(pixels.shape)",
    ),
    (
        655,
        "the remembered answer that has the same mean",
        "near = [abs(float(given.mean()) - float(pixels.mean())) for given in KNOWN]\n"
        "    return fitted(ANSWERS[int(np.argmin(near))], pixels)",
    ),
):
    attack(_number, _name, CONSTANTS.replace("BODY", _body), "wrong", wrong=False)


# ---------------------------------------------------------------- grading them all


@dataclass(frozen=True)
class AttackResult:
    """What an attack achieved.

    result     GradedSubmission of the attack
    neighbor   GradedSubmission of the honest submission after it
    alone      GradedSubmission of an honest submission before all attacks
    """

    attack: Attack
    result: GradedSubmission
    neighbor: GradedSubmission
    alone: GradedSubmission

    @property
    def exercise(self):
        """The GradedExercise that was attacked."""
        return exercise_of(self.result, "attacked-double")

    @property
    def harmed(self):
        """What it harmed, as texts; empty if everything beside it is graded as if alone."""
        harm = []
        if self.neighbor.exercises != self.alone.exercises:
            harm.append("the next submission")
        if exercise_of(self.result, "attacked-mean").points != 7:
            harm.append("its own other exercise")
        try:
            show_values(self.exercise)
        except Exception as error:  # noqa: BLE001 - whatever a learner's value did to the page
            harm.append(f"its page: {error!r}")
        return tuple(harm)


def show_values(exercise):
    """What a page does with the values of an exercise's failed calls."""
    for call in (case.failed_call for case in exercise.cases if case.failed_call):
        for name, expected, actual in answer_parts(call.expected, call.actual):
            wrong = differing_elements(expected, actual, 0.0)
            value_of(name, actual, wrong)
            answer_images(None, name, expected, actual, wrong)


def grade_attacks(key, attacks=ATTACKS, *, quiet=True, **options):
    """Grade an honest submission, then each attack with an honest submission after it.

    Parameters
    ----------
    key : Key of MASTERS
    attacks : list of Attack
    quiet : bool or None, as tqdm's `disable`
    options : as `autograde` takes them

    Returns
    -------
    list of AttackResult
    """
    submissions = [("alone", LESSON, RIGHT)]
    for attack in attacks:
        submissions.append((attack.title, LESSON, RIGHT | {"attacked-double": attack.source}))
        submissions.append((f"after {attack.title}", LESSON, RIGHT))
    graded = autograde(submissions, key, **({"limits": SHORT} | options))
    bar = tqdm(graded, "attacks by source", len(submissions), unit=" submissions", disable=quiet)
    results = {result.name: result for result in bar}
    return [
        AttackResult(attack, results[attack.title], results[f"after {attack.title}"], results["alone"])
        for attack in attacks
    ]


def exercise_of(result, id):
    """One GradedExercise of a GradedSubmission."""
    return next(exercise for exercise in result.exercises if exercise.id == id)
