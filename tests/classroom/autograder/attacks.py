"""Attacks on the autograder: each is the source of a wrong answer that tries to gain points by a trick.

There is one attack for each thing that grading defends: the one that reaches deepest. Others are in
test_channels.py (what one kernel leaves for the next), test_sandbox.py (what is hidden, system calls, memory
of all processes together), test_allowed_modules.py (modules), test_verdict.py (forged values), and
tests/classroom/gradebook/form_attacks.py (cells, metadata, files, archives and names of a submission).
"""

# ruff: noqa: E501 - the long lines are the attackers'

from dataclasses import dataclass
from pathlib import Path
from textwrap import dedent

from nbclassroom.authoring.masters import read_master
from nbclassroom.autograder.pool import Limits, autograde
from nbclassroom.autograder.results import NO_DETAILS, GradedSubmission
from nbclassroom.exercises.page import page_of

MASTERS = Path(__file__).parent / "masters"
LESSON = "attacked"
SEED = 8_675_309
# Short, so that endless answers end soon; long enough for two kernels on a busy machine.
SHORT = Limits(grace=0.5, wall_factor=4, wall_grace=2.0, memory=1 << 30, output=2 << 20)
RIGHT = {
    "attacked-double": "def double(pixels):\n"
    "    return np.minimum(pixels.astype(int) * 2, LIMIT).astype(np.uint8)",
    "attacked-mean": "def mean(values):\n    return sum(values) / len(values)",
}


def page_with(key, own, right):
    """The page of right answers, below a cell of the learner's own."""
    page = page_of(right, key.lessons[LESSON])
    cells = [{"kind": "own", "source": own, "exercise": "", "file": ""}, *page["cells"]]
    return page | {"cells": cells, "checks": {id: number + 1 for id, number in page["checks"].items()}}


@dataclass(frozen=True)
class Attack:
    """One attack.

    outcomes    the outcomes that its cases may have
    reported    text that the public case's message must contain
    unreported  text that it must not contain, "" if there is none
    harms_own   whether it costs the same learner's other answer its points, as it would in Run All
    """

    name: str
    source: str
    outcomes: frozenset
    reported: str = ""
    unreported: str = ""
    harms_own: bool = False


WRONG = "\ndef double(pixels):\n    return np.zeros(pixels.shape, np.uint8)\n"
ATTACKS = []


def attack(name, source, *outcomes, wrong=False, **more):
    """Add an attack; `wrong` appends an honest wrong answer, `more` are fields of it."""
    source = dedent(source) + (WRONG if wrong else "")
    ATTACKS.append(Attack(name, source, frozenset(outcomes or ("wrong",)), **more))


# ---------------------------------------------------------------- the result is to be forged

attack(
    "comments that direct nbval",
    "# NBVAL_SKIP\n# NBVAL_RAISES_EXCEPTION\n# NBVAL_IGNORE_OUTPUT\n",
    wrong=True,
)
attack(
    "transformers of source and syntax tree",
    """
    import ast
    class Drop(ast.NodeTransformer):
        def visit_Expr(self, node):
            return ast.Pass()
    get_ipython().ast_transformers.append(Drop())
    get_ipython().input_transformers_post.append(lambda lines: ["pass\\n"])
    """,
    wrong=True,
)
attack(
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
)
attack(
    "what compares, and what the check calls, is replaced",
    """
    from nbclassroom.autograder.sandbox.inside import check_cell
    from nbclassroom.exercises import comparison
    np.allclose = np.array_equal = lambda *a, **k: True
    comparison.compare = np.testing.assert_array_equal = lambda *a, **k: None
    check_cell.emit = lambda *_arguments: print("passed")
    """,
    "hostile",
    harms_own=True,
    wrong=True,
)
attack(
    "a thread patches and prints later",
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
    wrong=True,
)
attack(
    "modules that shadow others",
    """
    import pathlib, sys
    for name in ("numpy", "json", "imgproc_course", "coverage", "nbval", "sitecustomize", "IPython"):
        pathlib.Path(f"{name}.py").write_text("raise SystemExit")
    sys.path[:] = ["."]
    sys.path_importer_cache.clear()
    sys.modules.pop("imgproc_course", None)
    """,
    "wrong",
    "raised",
    wrong=True,
)
MIME = "application/vnd.nbclassroom.answer+json"
attack(
    "an answer of its own is shown beside the check's",
    f"""
    def double(pixels):
        from IPython.display import display
        display({{"{MIME}": {{"calls": []}}}}, raw=True)
        return pixels
    """,
    "hostile",
)
attack(
    "an answer that nests deeper than it is read",
    f"""
    def double(pixels):
        return pixels
    import IPython.display
    ANSWER, real = 1, IPython.display.display
    for _ in range(900): ANSWER = [ANSWER]
    IPython.display.display = lambda shown, raw=False: real({{"{MIME}": ANSWER}}, raw=True)
    """,
    "hostile",
    harms_own=True,
)
attack(
    "a value whose data are too short for its shape",
    """
    from nbclassroom.autograder.sandbox.inside import check_cell
    from nbclassroom.exercises import running
    FORM = {"type": "ndarray", "dtype": "uint8", "shape": [3, 4], "data": "AAAA"}
    check_cell.running.call = lambda *a, **k: running.CallResult(value=FORM)
    check_cell.shorten_form = lambda form, most: form
    """,
    "hostile",
    harms_own=True,
    wrong=True,
)
attack(
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
)
# What the sources below do with the kernel's own socket.
TO_THE_SOCKET = """
import json, os, stat, sys
def double(pixels):
    for fd in range(3, 64):
        try:
            if stat.S_ISSOCK(os.fstat(fd).st_mode):
                STEP
        except OSError: pass
    return pixels
"""
FORGED_END = f"""for kind, content in (
                    ("display_data", {{"data": {{"{MIME}": "passed"}}, "metadata": {{}}}}),
                    ("idle", {{"ename": "", "evalue": ""}}),
                ):
                    os.write(fd, (json.dumps({{"type": kind, "content": content}}) + "\\n").encode())"""
OF_ANOTHER_PROGRAM = """os.set_inheritable(fd, True)
                end = b'{"type": "idle", "content": {"ename": "", "evalue": ""}}\\n'
                os.execv(sys.executable, ["python", "-S", "-c", f"import os; os.write({fd}, {end})"])"""
for _name, _step, *_outcomes in (
    ("the kernel's messages are forged", FORGED_END, "hostile", "wrong"),
    (
        "bytes that are no message",
        'os.write(fd, b\'{"n": [[[[\\xff\\n\' + b"[" * 100_000 + b"\\n")',
        "hostile",
    ),
    ("a message without end", 'while True: os.write(fd, b"x" * 65536)', "output"),
    ("the socket in the hands of another program", OF_ANOTHER_PROGRAM, "hostile", "crashed"),
):
    attack(_name, TO_THE_SOCKET.replace("STEP", _step), *_outcomes)
for _name, _message in {
    "an error in a cell that does not exist": '{"type": "errors", "content": {"errors": [[-9999, "NameError", ""]]}}',
    "a cell that is no number": '{"type": "tried", "content": {"text": "x", "cell": 1e999}}',
    "an attempt that is no text": '{"type": "tried", "content": {"text": 7}}',
}.items():
    _step = f"os.write(fd, {_message!r}.encode() + b'\\n')"
    attack(_name, TO_THE_SOCKET.replace("STEP", _step), "hostile")
attack(
    "lines that take long to search for a name",
    "import " * 20_000 + "\n" * 20_000 + "\ndef double(pixels): return lost",
    "raised",
)
attack("the way out is closed", "import os\nos.closerange(3, 256)\n", wrong=True)

# ---------------------------------------------------------------- expected values are to be known


def remembered():
    """{input: expected value} of the public check as the lesson's pack has them, as bytes."""
    (master,) = map(read_master, MASTERS.glob("*.py"))
    declared = next(exercise for exercise in master.exercises if exercise.id == "attacked-double")
    solution = declared.function_of(declared.solution, "solution")
    calls = [pixels for case in declared.public for (pixels,) in declared.arguments(case)]
    return {pixels.tobytes(): solution(pixels).tobytes() for pixels in calls}


CONSTANTS = f"""
import hashlib
from nbclassroom.autograder.sandbox.inside import check_cell
from nbclassroom.exercises.canonical import decode
PACK = {remembered()!r}
ANSWERS = [np.frombuffer(data, np.uint8) for data in PACK.values()]
calls = []
def fitted(values, pixels):
    return np.resize(values, pixels.shape).astype(np.uint8)
def double(pixels):
    calls.append(pixels.copy())
    BODY
"""
for _name, _body in (
    (
        "another constant in each call, by counting calls",
        "return fitted([0, 255, 128, 200][len(calls) % 4], pixels)",
    ),
    (
        "the pack's expected value by a hash of the input",
        "table = {hashlib.sha256(given).digest(): value for given, value in zip(PACK, ANSWERS)}\n"
        "    return fitted(table.get(hashlib.sha256(pixels).digest(), ANSWERS[0]), pixels)",
    ),
    (
        "the input of the case's last call, from the check's memory",
        "return fitted(decode(check_cell.CASE['calls'][-1])[0], pixels)",
    ),
):
    attack(_name, CONSTANTS.replace("BODY", _body))
attack(
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
)
attack(
    "keys, masters and submissions are looked for on the disk",
    """
    def double(pixels):
        import os
        ends = (".ipynb", ".seed", ".json", "mistakes.py", "answer_key.py")
        found = [folder for folder in ("/work", "/home", "/root", "/srv", "/mnt", "/opt", "/var") if os.path.exists(folder)]
        for top in ("/course/packages", "/tmp", "/dev/shm", "/etc"):
            for folder, _, names in os.walk(top):
                found += [name for name in names if name.endswith(ends) or top in ("/tmp", "/dev/shm")]
        raise RuntimeError(f"found {found}, {len(os.listdir('/proc/self/fd')) < 16}")
    """,
    "raised",
    reported="found [], True",
)
attack(
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
)
attack(
    "the hidden inputs, carried out",
    """
    def double(pixels):
        error = type(f"Seen_{pixels.tolist()}", (Exception,), {})
        print("seen", pixels.tolist())
        raise error(f"seen {pixels.tolist()}")
    """,
    "raised",
    reported="seen",
)

# ---------------------------------------------------------------- beyond the sandbox

attack(
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
)
attack(
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
)
attack(
    "becoming root again, or more important than others",
    """
    import os
    def double(pixels):
        done = []
        for step in (
            lambda: os.setuid(0),
            lambda: os.setgid(0),
            lambda: os.chroot("/tmp"),
            lambda: os.mknod("/tmp/x", 0o60666, 1),
            lambda: os.setpriority(os.PRIO_USER, 0, -20),
            lambda: os.sched_setscheduler(0, os.SCHED_FIFO, os.sched_param(50)),
        ):
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
)
# Kernels are started ahead: in the same group one would wait for the next check or submission.
attack(
    "whatever is there is killed in the last check",
    """
    import os, signal
    def double(pixels):
        if len(pixels) == 5:
            for pid in (0, -1, 1, *range(2, 400)):
                try:
                    os.kill(pid, signal.SIGKILL)
                except OSError:
                    pass
        return pixels
    """,
)
attack(
    "processes that stay, and keep the machine busy",
    """
    import os
    def double(pixels):
        for _ in range(5):
            if os.fork() == 0:
                os.setsid()
                if os.fork() == 0:
                    while True: pass
                os._exit(0)
        return pixels
    """,
    "wrong",
    "raised",
    "hostile",  # where os.fork() fails, a copy may answer, too
)

# ---------------------------------------------------------------- more than an answer may use

attack(
    "a loop without end that ignores signals",
    """
    import signal
    def on(*a):
        while True: pass
    def double(pixels):
        signal.setitimer(signal.ITIMER_PROF, 0)
        signal.signal(signal.SIGXCPU, on)
        signal.pthread_sigmask(signal.SIG_BLOCK, set(signal.Signals))
        while True: pass
    """,
    "time",
)
attack(
    "the process stops itself",
    "import os, signal\ndef double(pixels):\n    os.kill(os.getpid(), signal.SIGSTOP)\n    while True: signal.pause()\n",
    "time",
)
attack(
    "more memory than it may have",
    "def double(pixels):\n    return [np.empty(1 << 28, np.uint8) for _ in range(64)]\n",
    "memory",
)
attack(
    "seven hundred megabytes while it waits for the next check",
    "held = np.ones(700 << 20, np.uint8)\ndef double(pixels):\n    return pixels\n",
    "wrong",
    "memory",
    "time",
)
attack(
    "more processes than it may start",
    """
    import os, time
    def double(pixels):
        started = 0
        try:
            for _ in range(1_000):
                if os.fork() == 0:
                    time.sleep(600)
                started += 1
        except OSError:
            pass
        raise RuntimeError(f"stopped at {'few' if started < 24 else 'many'}")
    """,
    "raised",
    reported="stopped at few",
)
attack(
    "more open files than it may have",
    """
    import os
    def double(pixels):
        held = []
        try:
            for _ in range(1_000):
                held += os.pipe()
        except OSError:
            pass
        raise RuntimeError(f"stopped at {'few' if len(held) < 256 else 'many'}")
    """,
    "raised",
    reported="stopped at few",
)
attack(
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
    reported="stopped after little",
)
attack(
    "one large file",
    """
    def double(pixels):
        with open("/dev/shm/large", "wb") as file:
            file.truncate(1 << 40)
    """,
    "raised",
    "crashed",
)
attack(
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
    reported="stopped at few",
)
attack(
    "larger limits",
    """
    import resource
    def double(pixels):
        done = []
        for kind in ("CPU", "AS", "NPROC", "FSIZE", "NOFILE", "CORE"):
            try:
                resource.setrlimit(getattr(resource, f"RLIMIT_{kind}"), (resource.RLIM_INFINITY,) * 2)
                done.append(kind)
            except (ValueError, OSError):
                pass
        raise RuntimeError(f"done {done}")
    """,
    "raised",
    reported="done []",
)

# ---------------------------------------------------------------- the autograder, or a page, is to fail

attack("a source of a megabyte", "x = '" + "a" * 1_000_000 + "'\n", "raised", wrong=True)
attack("lone surrogates and null bytes", "x = '\ud800'\ny = '\x00'\n", "wrong", "raised", wrong=True)
attack(
    "a hundred thousand brackets",
    "x = " + "(" * 90_000 + ")" * 90_000 + "\n",
    "raised",
    "missing",
    "crashed",
    "time",
    "wrong",
    wrong=True,
)
attack(
    "markup and marks that turn the writing around",
    """
    def double(pixels):
        raise ValueError("<script>alert(1)</script>\\x1b[31mred\\x1b[0m\\u202eevil\\x00\\u2028")
    """,
    "raised",
    reported="\\u202e",
    unreported="\x1b",
)
attack(
    "an exception of a megabyte in each of its texts",
    """
    def double(pixels):
        raise type("E" * 1_000_000, (Exception,), {})("/ipykernel_" * 90_000)
    """,
    "raised",
)
attack(
    "an exception whose words end the process",
    """
    class Ends(Exception):
        def __str__(self): raise SystemExit
        __repr__ = __str__
    def double(pixels):
        raise Ends
    raise Ends
    """,
    "raised",
    "crashed",
)
attack(
    "groups of exceptions, twenty thousand deep, with megabytes of notes",
    """
    def double(pixels):
        error = ValueError("x")
        for _ in range(20_000): error = ExceptionGroup("g", [error])
        for _ in range(1_000): error.add_note("n" * 10_000)
        raise error
    """,
    "raised",
    "crashed",
    "memory",
)
attack(
    "a value that contains itself",
    "def double(pixels):\n    loop = []\n    loop.append(loop)\n    return loop\n",
)
attack(
    "an array larger than the memory",
    "def double(pixels):\n    return np.broadcast_to(np.uint8(1), (1 << 20, 1 << 20))\n",
    "memory",
    "wrong",
)
attack(
    "an array over a file that is not there any more",
    """
    import os
    def double(pixels):
        shown = np.memmap("/tmp/file", np.uint8, "w+", shape=(3, 4096))
        os.truncate("/tmp/file", 0)
        return np.frombuffer(shown, np.uint8)
    """,
    "crashed",
)
attack(
    "a message whose fields are messages, without end",
    """
    class Message:
        _fields_and_field_types = {f"f{number}": "x" for number in range(100_000)}
        def __getattr__(self, name): return Message()
    def double(pixels):
        return Message()
    """,
    "time",
    "memory",
    "output",
)
attack(
    "a class of array that fails whenever it is looked at",
    """
    class Fails(np.ndarray):
        def __array_finalize__(self, other): raise SystemError("no")
        def __getattribute__(self, name): raise SystemError(name)
    def double(pixels):
        return np.ndarray.__new__(Fails, pixels.shape, np.uint8)
    """,
    "wrong",
    "raised",
)


# ---------------------------------------------------------------- grading them all


@dataclass(frozen=True)
class AttackResult:
    """What an attack achieved.

    result     GradedSubmission of the attack
    neighbor   GradedSubmission of the honest submission after it
    alone      GradedSubmission of an honest submission before all attacks
    """

    result: GradedSubmission
    neighbor: GradedSubmission
    alone: GradedSubmission
    harms_own: bool = False

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
        if exercise_of(self.result, "attacked-mean").points != 7 and not self.harms_own:
            harm.append("its own other exercise")
        if NO_DETAILS in (self.exercise.body, self.exercise.review):
            harm.append("its page")
        return tuple(harm)


def grade_attacks(key):
    """Grade an honest submission, then each attack with an honest submission after it; {name: AttackResult}."""
    submissions = [("alone", LESSON, RIGHT)]
    for attack in ATTACKS:
        submissions.append((attack.name, LESSON, RIGHT | {"attacked-double": attack.source}))
        submissions.append((f"after {attack.name}", LESSON, RIGHT))
    results = {result.name: result for result in autograde(submissions, key, limits=SHORT, workers=2)}
    alone = results["alone"]
    return {
        one.name: AttackResult(results[one.name], results[f"after {one.name}"], alone, one.harms_own)
        for one in ATTACKS
    }


def exercise_of(result, id):
    """One GradedExercise of a GradedSubmission."""
    return next(exercise for exercise in result.exercises if exercise.id == id)
