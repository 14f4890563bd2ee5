"""Attacks on graded drives: controllers that do not drive well and try to gain points by a trick, or that misbehave.

Each ends with a controller that stands still, unless it has one of its own.
"""

# ruff: noqa: E501 - the long lines are the attackers'

from dataclasses import dataclass
from textwrap import dedent

STANDS = "\ndef control(observation, memory):\n    return 0.0, 0.0\n"
INSIDE = "from imgproc_course.classroom.autograder.sandbox.inside import check_cell, drive_cell, shell\n"
MIME = "application/vnd.imgproc-course.answer+json"


@dataclass(frozen=True)
class DriveAttack:
    """One attack; `seen` is what its message in a public case shows of what it read, `slow` as in `attacks`.

    secrets  texts that the message must not have
    """

    name: str
    source: str
    outcomes: frozenset
    seen: str = ""
    secrets: tuple = ()
    slow: bool = False


DRIVE_ATTACKS = []


def attack(name, source, *outcomes, stands=False, **more):
    source = dedent(source) + (STANDS if stands else "")
    DRIVE_ATTACKS.append(DriveAttack(name, source, frozenset(outcomes or ("wrong",)), **more))


def in_control(code, *, before=""):
    """A controller that runs some code at its first look, and stands still."""
    body = "\n".join(f"        {line}" for line in dedent(code).strip().splitlines())
    return f"{before}\ndef control(observation, memory):\n    if observation['time'] == 0:\n{body}\n    return 0.0, 0.0\n"


def looking(expression):
    """A controller that shows what it sees in the text of an exception."""
    return in_control(
        f"import os, sys, gc, glob\nraise ValueError('seen ' + str({expression})[:400])", before=INSIDE
    )


def found(expression):
    """A controller that shows what its cell found before the drive."""
    return looking("FOUND").replace(INSIDE, f"import glob\nFOUND = {expression}\n{INSIDE}")


# ---------------------------------------------------------------- controllers that misbehave (the published table)

attack(
    "it raises",
    "def control(o, m):\n    if o['time'] > 1: raise ValueError('seen it')\n    return 0.1, 0.0",
    "raised",
    seen="seen it",
)
attack("a KeyboardInterrupt", "def control(o, m):\n    raise KeyboardInterrupt", "raised")
attack("a SystemExit", "import sys\ndef control(o, m):\n    sys.exit(0)", "raised")
attack("it takes one argument", "def control(o): return 0.1, 0.3", "raised")
attack("the end of the process", "import os\ndef control(o, m):\n    os._exit(0)", "crashed")
attack("an endless loop", "def control(o, m):\n    while True: pass", "time")
attack(
    "an endless loop that catches all",
    "def control(o, m):\n    while True:\n        try:\n            while True: pass\n        except BaseException: pass",
    "time",
    slow=True,
)
attack("nan", "def control(o, m): return float('nan'), 0.0")
attack("infinity", "def control(o, m): return float('inf'), 0.0")
attack("None", "def control(o, m): pass")
attack("texts", "def control(o, m): return '0.1', 'x'")
attack("three numbers", "def control(o, m): return 1, 2, 3")
attack("a whole number without a float", "def control(o, m): return 10**400, 0")
attack(
    "a number of a megabyte",
    "import sys\nsys.set_int_max_str_digits(0)\ndef control(o, m): return 10**1_000_000, 0",
    "time",
    "wrong",
    slow=True,
)
attack("the greatest number", "def control(o, m): return -1e308, -1e308", "wrong")
attack("it prints much", "def control(o, m):\n    print('x' * 100_000); return 0.0, 0.0")
attack(
    "it sleeps in each look",
    "import time\ndef control(o, m):\n    time.sleep(5); return 0.1, 0.3",
    "time",
    slow=True,
)
attack(
    "it is slow in each look",
    "import time\ndef control(o, m):\n    e = time.process_time() + 0.2\n    while time.process_time() < e: pass\n    return 0.1, 0.0",
    "time",
    slow=True,
)
attack(
    "it takes all memory",
    "L = []\ndef control(o, m):\n    L.append(np.ones(50_000_000)); return 0.1, 0.3",
    "memory",
    "time",
    slow=True,
)
attack("it changes the observation", "def control(o, m):\n    o.clear(); return 0.0, 0.0")
attack(
    "it forges figures and the end of its cell",
    in_control(
        f"shell.WRITER.send('display_data', data={{'{MIME}': {{'metrics': {{'bumps': 0, 'clearance': 9, 'reach': 99}}, 'missed': [], 'ended': ''}}}}); shell.WRITER.send('idle', ename='', evalue='')",
        before=INSIDE,
    ),
    "hostile",
)
attack(
    "a thread that floods actions",
    in_control(
        "import threading\nthreading.Thread(target=lambda: [shell.WRITER.send('action', speeds=[0.0, 0.0]) for _ in range(200)]).start()",
        before=INSIDE,
    ),
    "wrong",
    "time",
    "crashed",
    "hostile",
    slow=True,
)

# ---------------------------------------------------------------- forged messages

attack(
    "an end of the cell before the drive",
    INSIDE + "drive_cell.drive = lambda control: None\n",
    "hostile",
    stands=True,
)
attack(
    "the verdict as an answer",
    in_control(f"shell.WRITER.send('display_data', data={{'{MIME}': 'passed'}})", before=INSIDE),
)
attack(
    "a record in the action",
    in_control(
        "shell.WRITER.send = lambda kind, _send=shell.WRITER.send, **c: _send(kind, **c, looks=40, over=True, ended='', missed=[], metrics={'reach': 9})",
        before=INSIDE,
    ),
)
attack(
    "speeds that are no numbers",
    in_control(
        "shell.WRITER.send = lambda kind, _send=shell.WRITER.send, **c: _send(kind, speeds={'linear': [1e999]})",
        before=INSIDE,
    ),
    "wrong",
    "hostile",
)
attack(
    "speeds nested deeply",
    in_control(
        "import json\nshell.WRITER.send = lambda kind, _send=shell.WRITER.send, **c: os.write(shell.WRITER.descriptor, b'{\"type\": \"action\", \"content\": {\"speeds\": ' + b'[' * 100_000 + b']' * 100_000 + b'}}\\n')",
        before=INSIDE + "import os\n",
    ),
    "hostile",
)
attack(
    "a whole number of a million digits in a message",
    in_control(
        'os.write(shell.WRITER.descriptor, b\'{"type": "action", "content": {"speeds": [\' + b\'9\' * 1_000_000 + b\', 0]}}\\n\')',
        before=INSIDE + "import os\n",
    ),
    "hostile",
)
attack(
    "a message that is no object",
    in_control(
        'os.write(shell.WRITER.descriptor, b\'{"type": "action", "content": 7}\\n\')',
        before=INSIDE + "import os\n",
    ),
    "hostile",
)
attack(
    "an error of another kind",
    in_control("shell.WRITER.send('action', error={'a': 1}, message=[2], line=3)", before=INSIDE),
    "raised",
)
attack(
    "a fault of the autograder, on purpose",
    in_control(
        "shell.WRITER.send('action', error='NotGradedError', message='look at it by hand')", before=INSIDE
    ),
    "raised",
)
attack(
    "a line without an end",
    in_control(
        "[os.write(shell.WRITER.descriptor, b'x' * 65536) for _ in range(100)]", before=INSIDE + "import os\n"
    ),
    "output",
    "hostile",
)
attack(
    "too many messages",
    in_control("[shell.WRITER.send('stream', text='x' * 10_000) for _ in range(1_000)]", before=INSIDE),
    "output",
)
attack(
    "it reads nothing and asks",
    in_control("[shell.WRITER.send('action', speeds=[0.0, 0.0]) for _ in range(100_000)]", before=INSIDE),
    "time",
    "output",
    "wrong",
    slow=True,
)

# ---------------------------------------------------------------- what it may find

attack(
    "the case that was delivered",
    looking("check_cell.delivered()"),
    "raised",
    seen="seen",
    secrets=("seed", "thresholds", "'start'", "title"),
)
attack(
    "objects in memory",
    looking(
        "[type(o).__name__ for o in gc.get_objects() if type(o).__name__ in ('GradedDrive', 'Drive', 'PlaneEnv', 'RoomEnv', 'Simulation')]"
    ),
    "raised",
    seen="seen []",
)
attack(
    "the frames above it",
    looking("[sorted(sys._getframe(k).f_locals) for k in range(1, 4)]"),
    "raised",
    seen="observation",
    secrets=("scenario", "env", "record"),
)
attack(
    "modules in memory",
    looking("[m for m in sys.modules if 'simulation' in m or 'gymnasium' in m or 'plane_env' in m]"),
    "raised",
    seen="seen []",
)
attack(
    "files of the room",
    found(
        "[p for e in ('npz', 'jpg', 'scene.json') for p in glob.glob('/course/**/simulation/**/*' + e, recursive=True)]"
    ),
    "raised",
    seen="seen []",
)
attack(
    "keys and scenarios",
    found(
        "[p for f in ('course', 'tmp', 'home', 'work', 'root') for n in ('*.inputs.json', 'key.json', '*.ipynb') for p in glob.glob(f'/{f}/**/{n}', recursive=True)]"
    ),
    "raised",
    seen="seen []",
)
attack(
    "the environment's variables",
    looking("sorted(os.environ)"),
    "raised",
    seen="seen",
    secrets=("IMGPROC", "PYTEST", "VIRTUAL"),
)
attack(
    "other processes",
    looking("[p for p in os.listdir('/proc') if p.isdigit() and p != str(os.getpid())]"),
    "raised",
    seen="seen []",
)
attack(
    "the parent's memory",
    looking("(os.getppid(), os.path.exists(f'/proc/{os.getppid()}/mem'))"),
    "raised",
    seen="seen (0, False)",
)
attack(
    "open files",
    looking(
        "[os.readlink('/proc/self/fd/' + f) for f in os.listdir('/proc/self/fd') if os.path.exists('/proc/self/fd/' + f)]"
    ),
    "raised",
    seen="socket",
    secrets=(".py", "key", "/work"),
)
attack(
    "the simulator in the answer",
    in_control(
        "from imgproc_course.simulation import Simulation\nraise ValueError('seen ' + str(Simulation(1)))"
    ),
    "refused module",
    "raised",
    secrets=("seen",),
)

# ---------------------------------------------------------------- time, and what it leaves

attack(
    "a timer of its own",
    in_control(
        "import signal, time\nsignal.setitimer(signal.ITIMER_PROF, 0)\ne = time.process_time() + 1.2\nwhile time.process_time() < e: pass"
    ),
    "time",
)
attack(
    "a handler of its own",
    in_control(
        "import signal, time\nsignal.signal(signal.SIGPROF, lambda *a: None)\ne = time.process_time() + 1.2\nwhile time.process_time() < e: pass"
    ),
    "time",
)
attack(
    "processes that compute beside it",
    in_control(
        "import os, time\nfor _ in range(2):\n    if os.fork() == 0:\n        while time.process_time() < 1: pass\n        os._exit(0)\nos.wait(), os.wait()"
    ),
    "time",
    slow=True,
)
attack(
    "a process that drives on",
    in_control(
        "import os\nif os.fork() == 0:\n    while True: shell.WRITER.send('action', speeds=[0.0, 0.0])",
        before=INSIDE,
    ),
    "time",
    "wrong",
    "hostile",
    "output",
    slow=True,
)
attack(
    "globals of the drive before",
    "LOOKS = 0\ndef control(o, m):\n    global LOOKS\n    LOOKS += 1\n    return (0.0 if LOOKS < 41 else 0.25), 0.0",
)
attack(
    "files of the drive before",
    "import os\nHERE = os.path.exists('/tmp/seen')\nopen('/tmp/seen', 'w').close()\ndef control(o, m):\n    return (0.25 if HERE else 0.0), 0.0",
)
attack(
    "the memory of the drive before",
    "def control(o, m, kept={}):\n    kept['n'] = kept.get('n', 0) + 1\n    return (0.0 if kept['n'] < 41 else 0.25), 0.0",
)
attack(
    "NumPy that reads another observation",
    INSIDE + "np.frombuffer = lambda *a, **k: np.zeros(360, np.float32)\n",
    "wrong",
    "raised",
    stands=True,
)
attack(
    "an observation that says how far it is",
    in_control("drive_cell._observation = lambda *a: {'time': 4.0}", before=INSIDE),
)
attack("a controller that is none", "control = 7", "raised")
attack("no controller", "x = 1", "missing")
attack("two functions instead of two numbers", "def control(o, m): return (lambda: 0.25, lambda: 0)")
