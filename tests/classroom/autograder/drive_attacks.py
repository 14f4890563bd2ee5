"""Attacks on graded drives: controllers that do not drive well and try to gain points by a trick, or that misbehave.

There is one for each thing that is other than in the attacks on functions (attacks.py): the actions, the time
of a look and of a drive, the robot's figures, and what a controller may see of the scenario.
"""

# ruff: noqa: E501 - the long lines are the attackers'

from dataclasses import dataclass
from textwrap import dedent

STANDS = "\ndef control(observation, memory):\n    return 0.0, 0.0\n"
INSIDE = "import os\nfrom nbclassroom.autograder.sandbox.inside import check_cell, drive_cell, shell\n"
MIME = "application/vnd.nbclassroom.answer+json"
FIGURES = "{'metrics': {'bumps': 0, 'clearance': 9, 'reach': 99}, 'missed': [], 'ended': ''}"


@dataclass(frozen=True)
class DriveAttack:
    """One attack; `seen` is what its message in a public case shows of what it read.

    secrets  texts that the message must not have
    """

    name: str
    source: str
    outcomes: frozenset
    seen: str = ""
    secrets: tuple = ()


DRIVE_ATTACKS = []


def attack(name, source, *outcomes, **more):
    DRIVE_ATTACKS.append(DriveAttack(name, source, frozenset(outcomes or ("wrong",)), **more))


def in_control(code):
    """A controller that runs some code at its first look, and stands still."""
    body = "\n".join(f"        {line}" for line in dedent(code).strip().splitlines())
    return f"{INSIDE}\ndef control(observation, memory):\n    if observation['time'] == 0:\n{body}\n    return 0.0, 0.0\n"


def looking(expression):
    """A controller that shows what it sees in the text of an exception."""
    return in_control(f"import gc, glob, sys\nraise ValueError('seen ' + str({expression})[:400])")


# ---------------------------------------------------------------- actions, and time

attack("numbers that are none", "def control(o, m): return float('nan'), float('inf')")
attack("a whole number without a float", "def control(o, m): return 10**400, 0")
attack("two functions instead of two numbers", "def control(o, m): return (lambda: 0.25, lambda: 0)")
attack("it changes the observation", "def control(o, m):\n    o.clear(); return 0.0, 0.0")
attack("SystemExit", "import sys\ndef control(o, m):\n    sys.exit(0)", "raised")
attack(
    "a look with a timer and a handler of its own",
    in_control(
        """
        import signal, time
        signal.setitimer(signal.ITIMER_PROF, 0)
        signal.signal(signal.SIGPROF, lambda *a: None)
        e = time.process_time() + 1.2
        while time.process_time() < e: pass
        """
    ),
    "time",
)

# ---------------------------------------------------------------- forged messages

attack(
    "it forges figures and the end of its cell",
    in_control(
        f"""
        shell.WRITER.send('display_data', data={{'{MIME}': {FIGURES}}})
        shell.WRITER.send('idle', ename='', evalue='')
        """
    ),
    "hostile",
)
attack(
    "an end of the cell before the drive",
    f"{INSIDE}drive_cell.drive = lambda control: None\n{STANDS}",
    "hostile",
)
attack(
    "a record in the action",
    in_control(
        """
        shell.WRITER.send = lambda kind, _send=shell.WRITER.send, **c: _send(
            kind, **c, looks=40, over=True, ended='', missed=[], metrics={'reach': 9})
        """
    ),
)
attack(
    "a fault of the autograder, on purpose",
    in_control("shell.WRITER.send('action', error='NotGradedError', message='look at it by hand')"),
    "raised",
)
attack(
    "an action that is no object",
    in_control('os.write(shell.WRITER.descriptor, b\'{"type": "action", "content": 7}\\n\')'),
    "hostile",
)
attack(
    "speeds of a million digits",
    in_control(
        'os.write(shell.WRITER.descriptor, b\'{"type": "action", "content": {"speeds": [\' + b\'9\' * 1_000_000 + b\', 0]}}\\n\')'
    ),
    "hostile",
)
attack(
    "it reads nothing and asks",
    in_control("[shell.WRITER.send('action', speeds=[0.0, 0.0]) for _ in range(100_000)]"),
    "time",
    "output",
    "wrong",
)
attack(
    "a process that drives on",
    in_control("if os.fork() == 0:\n    while True: shell.WRITER.send('action', speeds=[0.0, 0.0])"),
    "time",
    "wrong",
    "hostile",
    "output",
)

# ---------------------------------------------------------------- what it may find

attack(
    "the case that was delivered",
    looking("check_cell.CASE"),
    "raised",
    seen="seen",
    secrets=("seed", "thresholds", "'start'", "title"),
)
attack(
    "the simulator in memory",
    looking(
        "[type(o).__name__ for o in gc.get_objects() if type(o).__name__ in ('GradedDrive', 'Drive', 'PlaneEnv', 'RoomEnv', 'Simulation')]"
        " + [m for m in sys.modules if 'simulation' in m or 'gymnasium' in m or 'plane_env' in m]"
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
    "files of the room",
    looking(
        "[p for e in ('npz', 'jpg', 'scene.json') for p in glob.glob('/course/packages/**/*' + e, recursive=True)]"
    ),
    "raised",
    seen="seen []",
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
