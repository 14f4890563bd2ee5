"""The doctor's checks of what is installed: Python, kernel, packages, OpenCV, recording; and of the disk."""

import importlib.metadata
import importlib.util
import os
import pkgutil
import re
import shutil
import sys
import sysconfig
from pathlib import Path

import imgproc_course
from imgproc_course.doctor.report import failure, failure_of, ok, warning

SET_UP = "run environment/lab again: it repairs the packages"
ENOUGH_DISK = 200 << 20  # bytes
VENV = Path(imgproc_course.__file__).resolve().parents[1] / ".venv"


def check_pythonpath():
    """Whether packages in PYTHONPATH hide the course's own; those of a sourced ROS for this Python may."""
    ros = f"/python3.{sys.version_info.minor}/" if os.environ.get("AMENT_PREFIX_PATH") else os.pathsep
    folders = os.environ.get("PYTHONPATH", "").split(os.pathsep)
    foreign = pkgutil.iter_modules([folder for folder in folders if folder and ros not in folder])
    own = pkgutil.iter_modules([sysconfig.get_path("purelib")])
    hidden = {module.name for module in foreign} & {module.name for module in own}
    if hidden:
        problem = f"packages there come before the course's own: {', '.join(sorted(hidden)[:5])}"
        yield failure("PYTHONPATH", problem, "unset PYTHONPATH; environment/lab does not use it")


def check_python():
    version = ".".join(map(str, sys.version_info[:3]))
    if (3, 11) <= sys.version_info[:2] <= (3, 13):
        yield ok("Python", version)
    else:
        yield failure("Python", version, "the course needs 3.11 to 3.13: run environment/lab again")
    yield from _package("imgproc-course")


def check_kernel():
    """Whether the notebook, or a JupyterLab started now, uses the environment that holds the course."""
    if importlib.util.find_spec("jupyter_client") is None:
        return  # check_packages reports that JupyterLab is missing
    own_names = (None, "python", "python3", f"python3.{sys.version_info.minor}", sys.executable)
    if VENV.is_dir() and Path(sys.prefix).resolve() != VENV.resolve():
        problem = "this Python belongs to another environment, not to the course's .venv"
        remedy = "start JupyterLab with environment/lab; in the notebook: Kernel > Change Kernel > Python 3"
        yield warning("kernel", problem, remedy)
    elif _kernel_of_jupyter() in own_names:
        yield ok("kernel", "from the course's own environment")
    else:
        problem = "Jupyter's kernel python3 belongs to another environment, which may not have the course"
        yield warning("kernel", problem, "start JupyterLab with environment/lab, which uses the course's own")


def _kernel_of_jupyter():
    from jupyter_client.kernelspec import KernelSpecManager, NoSuchKernel

    if in_notebook():
        return None
    try:
        return KernelSpecManager().get_kernel_spec("python3").argv[0]
    except (NoSuchKernel, IndexError):
        return None


def check_packages():
    for name in ("numpy", "jupyterlab", "ipywidgets", "nbval"):
        yield from _package(name)


def _package(name):
    try:
        yield ok(name, importlib.metadata.version(name))
    except importlib.metadata.PackageNotFoundError:
        yield failure(name, "is not installed", SET_UP)


def check_opencv():
    """Whether exactly one distribution of OpenCV is installed, loads, and has the Haar cascades."""
    versions = {
        distribution.metadata["Name"]: distribution.version
        for distribution in importlib.metadata.distributions()
        if re.fullmatch(r"opencv(-contrib)?-python(-headless)?", distribution.metadata["Name"] or "")
    }
    if len(versions) > 1:
        problem = f"{' and '.join(sorted(versions))} are both installed into one folder and break each other"
        remedy = f"pip uninstall {' '.join(sorted(versions))}; then delete .venv and {SET_UP}"
        yield failure("OpenCV", problem, remedy)
        return
    try:
        import cv2

        version = cv2.__version__
    except (ImportError, AttributeError) as error:
        yield failure("OpenCV", f"does not load ({error})", f"delete .venv and {SET_UP}")
        return
    folder = getattr(getattr(cv2, "data", None), "haarcascades", None)
    count = len(list(Path(folder).glob("haarcascade_*.xml"))) if folder else 0
    if count:
        yield ok("OpenCV", f"{version}, with {count} Haar cascades")
    else:
        remedy = f"face detection needs OpenCV 4: {SET_UP}"
        yield warning("OpenCV", f"{version}, without Haar cascades", remedy)


def check_recording():
    from imgproc_course.messages import ConversionError
    from imgproc_course.recording import RecordingError, open_recording

    try:
        with open_recording("drive") as drive:
            rows, cols, _ = drive.frame(0).shape
            yield ok("recording", f"{len(drive)} frames of {cols}×{rows}, {drive.rate:g} per second")
    except (RecordingError, ConversionError) as error:
        yield failure_of("recording", error, "git checkout -- imgproc_course/recording/drive")


def check_room():
    from imgproc_course.simulation.renderer import software_pipe

    try:
        software_pipe()
        yield ok("room", "its renderer loads")
    except RuntimeError as error:
        is_missing = importlib.util.find_spec("panda3d") is None  # some systems have no wheel of it
        yield (warning if is_missing else failure)("room", *str(error).split("; ", 1))


def check_disk():
    if re.search(r'[\s"$`{}\\]', str(VENV.parent)) or len(str(VENV.parent)) > 108:
        problem = 'the path of the course has a space, one of " $ ` { } \\, or more than 108 characters'
        yield warning("folder", problem, "lesson 10 may fail here: move the course, then run environment/lab")
    free = shutil.disk_usage(Path.cwd()).free
    if free >= ENOUGH_DISK:
        yield ok("disk", "enough space for your work")
    else:
        problem = f"{free >> 20} MiB free where your lessons are"
        yield warning("disk", problem, "free some space before you go on")


def in_notebook():
    get_ipython = getattr(sys.modules.get("IPython"), "get_ipython", lambda: None)
    return hasattr(get_ipython(), "kernel")
