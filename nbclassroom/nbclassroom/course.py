"""What a course tells the classroom: its course.toml, read when it is first asked for a value.

`course.title` is the value of `title` there; KEYS lists all of them. The file lies in the folder of the
lessons. The environment variable NBCLASSROOM_COURSE names it, for the processes of this one too; without it,
it is the first course.toml in the working folder, its folder notebooks/, and the same of the folders above.
"""

import importlib
import importlib.metadata
import importlib.util
import os
import tomllib
from functools import lru_cache
from pathlib import Path

VARIABLE = "NBCLASSROOM_COURSE"
FILE = "course.toml"

# The keys of a course.toml, with what holds if a course does not have one; `name` and `title` have all.
KEYS: dict[str, str | list[str] | None] = {
    "name": None,  # an identifier, under which the notebooks' metadata keep what the classroom stores
    "title": None,
    "version": "0",  # if it has no distribution
    "distribution": "",  # what pip calls the course's package: its version is the course's
    "package": "",  # the course's own package
    "face": "nbclassroom.exercises",  # the module from which lessons import check, hint and solution
    "command": "python -m nbclassroom",  # the course's command line
    "lab_command": "python -m nbclassroom start",
    "learners_folder": "../my_lessons",  # of the working copies, from the folder of course.toml
    # Functions that prepare the lab: each is called with a function that prints, before JupyterLab starts.
    "lab_prepare": [],
    "packages": [],  # of the course's package: those that an exercise may allow in its answers
    "modules": [],  # files of the package that these import
    "hidden_folders": [],  # of the package: what nobody's answer may read
    "always_allowed": [],  # modules that every answer may use
    "silent_packages": [],  # of the package: in grading something stands in their place that does nothing
    # Modules that only show something, such as a progress bar: every answer may use them, and in grading a
    # silent one stands in their place.
    "display_only": [],
    # What a node may import: rclpy, these packages of messages, and cv_bridge, or what stands for it.
    "ros_messages": [],
    "cv_bridge": "",
    # What a driving exercise drives in: a Gymnasium environment, what of its observation a controller gets,
    # the room of a scenario, and a map of it with the path. They are imported when a drive begins.
    "drive_environment": "",
    "drive_observation": "",
    "drive_room": "",
    "drive_map": "",
    "drive_allowed": [],  # what a controller may import
    # The list of functions that give advice on an error of a learner's function, wherever it is called.
    "error_advisers": "",
    # The league: the scenario of a room by two secret numbers, what a drive in it is worth, what a controller
    # may import beside `drive_allowed`, and a controller that drives beside the class.
    "league_scenario": "",
    "league_score": "",
    "league_allowed": [],
    "league_baseline": "",
}


class CourseError(ValueError):
    """There is no course.toml, or it cannot be used; the message says what to do."""


def use(path):
    """Take this course.toml, whatever the working folder is, unless another one was chosen before."""
    os.environ.setdefault(VARIABLE, str(Path(path).resolve()))


def file():
    """The path of the course.toml. CourseError: there is none."""
    if named := os.environ.get(VARIABLE):
        return Path(named).resolve()
    here = Path.cwd()
    for folder in (here, *here.parents):
        for path in (folder / FILE, folder / "notebooks" / FILE):
            if path.is_file():
                return path
    raise CourseError(f"no {FILE} in {here} or above; go to the folder of a course, or set {VARIABLE}")


def folder():
    """The folder of the lessons, in which course.toml lies."""
    return file().parent


def learners_folder():
    """The folder of the working copies of the user of this machine."""
    return (folder() / _read(file())["learners_folder"]).resolve()


def folders_of_lessons():
    """[`folder`], or [] if there is no course.toml: a learner's lessons stand without it."""
    try:
        return [folder()]
    except CourseError:
        return []


def node_modules():
    return ("rclpy", *_read(file())["ros_messages"], "cv_bridge")


def release():
    values = _read(file())
    if values["distribution"]:
        return importlib.metadata.version(values["distribution"])
    return values["version"]


def package_folder():
    """The folder of the course's package; None if it has no package."""
    name = _read(file())["package"]
    spec = importlib.util.find_spec(name) if name else None
    places = spec.submodule_search_locations if spec else None
    return Path(places[0]).resolve() if places else None


def roots():
    """The folders that hold the lessons, the course's package and this one: nothing shows their paths."""
    folders = [each.parent for each in folders_of_lessons()]
    folders += [package.parent] if (package := package_folder()) else []
    return [*folders, Path(__file__).resolve().parents[1]]


def load(place):
    """What a value of course.toml names as "module:name"."""
    module, _, name = place.partition(":")
    return getattr(importlib.import_module(module), name)


def __getattr__(name):
    if name not in KEYS:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    return _read(file())[name]


@lru_cache(maxsize=4)
def _read(path):
    try:
        values = tomllib.loads(path.read_text(encoding="utf-8"))
    except (OSError, UnicodeDecodeError, tomllib.TOMLDecodeError) as error:
        raise CourseError(f"{path}: it cannot be read: {error}") from error
    unknown = ", ".join(sorted(values.keys() - KEYS.keys()))
    missing = ", ".join(name for name, usual in KEYS.items() if usual is None and name not in values)
    if unknown or missing:
        problem = f"it has no {missing}" if missing else f"nothing reads {unknown}"
        raise CourseError(f"{path}: {problem}; the keys are {', '.join(KEYS)}")
    for name, value in values.items():
        kind, text = (list, "a list of texts") if isinstance(KEYS[name], list) else (str, "a text")
        if not isinstance(value, kind):
            raise CourseError(f"{path}: {name} must be {text}, and is {value!r}")
    return {
        name: tuple(value) if isinstance(value, list) else value for name, value in (KEYS | values).items()
    }
