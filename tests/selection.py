"""Which tests run: a newcomer's, those of a lesson, or all; and in which order the workers take them."""

import re
from pathlib import Path

import pytest

IS_SHORT = pytest.StashKey[bool]()  # of a Config: whether only a newcomer's tests run
MASTERS = Path(__file__).parents[1] / "notebooks" / "masters"

# What only `environment/test --all` runs: paths below tests/, and what they are.
ONLY_IN_ALL = {
    "browser": "the pages in a browser",
    "notebooks": "lessons from 11 on, and all solutions",
    "ros_packages": "the ROS packages, built and started",
    "site": "the site",
    "environment/test_class": "the machine of a class",
    "classroom/autograder/test_attacks": "attacks on grading",
    "classroom/gradebook/test_teach": "a term of a class",
}
# Of these, the lessons 00 to 10 as shipped, and one in a browser, run always.
IN_EVERY_RUN = {
    "notebooks/test_lessons.py": r"test_nbval_finds_the_lesson.*\[(0\d|10)_",
    "browser/test_lessons.py": r"\[00_",
}

# Long tests start first: if they started last, the other workers would wait for them without work.
LONGEST_FIRST = ("ros_packages", "browser", "environment", "classroom", "notebooks", "simulation")
# Files whose tests wait more than they compute are spread among the others, which use the cores meanwhile.
WAITING = ("ros/",)
# A worker takes one file at a time. Of WHOLE_FOLDERS it takes all files, because what they share (a colcon
# workspace, a JupyterLab with its browser) takes long to make. Of SINGLE_TESTS it takes one test, a lesson.
WHOLE_FOLDERS = ("ros_packages", "browser")
SINGLE_TESTS = ("notebooks",)


def path_of(nodeid):
    """The path of a test below tests/, with its name."""
    return nodeid.removeprefix("tests/")


def group_of(nodeid):
    """The folder of a test below tests/, of the classroom's the one below it; "rules" for a file in none."""
    parts = path_of(nodeid).partition("::")[0].split("/")
    return "rules" if len(parts) == 1 else parts[parts[0] == "classroom"]


def is_left_out(nodeid):
    """Whether only `environment/test --all` runs a test, or any test of a file or folder."""
    path, _, test = path_of(nodeid).partition("::")
    if not path.startswith(tuple(ONLY_IN_ALL)):
        return False
    if test:
        return not re.search(IN_EVERY_RUN.get(path, "(?!)"), test)
    return path.endswith(".py") and path not in IN_EVERY_RUN


def is_of_lesson(nodeid, number):
    """Whether a test is about a lesson, as "04": the whole, one of its exercises, or by the file's name."""
    (master,) = (path for path in MASTERS.glob(f"{number}_*.py") if path.suffixes == [".py"])
    exercises = re.findall(r'\bexercise\(\s*"([\w-]+)"', master.read_text(encoding="utf-8"))
    test, _, parameter = path_of(nodeid).partition("[")
    names_lesson = test.startswith(f"notebooks/test_{master.stem[3:]}.py")
    return names_lesson or parameter.rstrip("]") in [master.stem, master.stem[3:], *exercises]


def places_of(scopes):
    """{scope: its place among all, from 0 to 1}; those of WAITING are evenly spread over the first part."""
    ordered = sorted(scopes, key=_place_in_longest_first)
    waits = {scope: path_of(scope).startswith(WAITING) for scope in ordered}
    places = {}
    for is_waiting, end in ((False, 1.0), (True, 0.8)):  # no long file begins last
        same = [scope for scope in ordered if waits[scope] == is_waiting]
        places |= {scope: end * number / len(same) for number, scope in enumerate(same)}
    return places


def _place_in_longest_first(scope):
    begins = (path_of(scope).startswith(name) for name in LONGEST_FIRST)
    return next((place for place, is_it in enumerate(begins) if is_it), len(LONGEST_FIRST))


def scope_of(nodeid):
    """A name; one worker runs all tests of one name, one after another."""
    folder = path_of(nodeid).partition("::")[0].partition("/")[0]
    if folder in SINGLE_TESTS:
        return nodeid
    return folder if folder in WHOLE_FOLDERS else nodeid.partition("::")[0]
