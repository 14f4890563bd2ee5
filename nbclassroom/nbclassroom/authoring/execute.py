"""Execute a lesson in a real kernel as nbval will execute it, and make its outputs reproducible."""

import base64
import io
import os
import re
import subprocess
import tempfile
from itertools import groupby
from pathlib import Path

from nbclient import NotebookClient
from nbclient.exceptions import CellExecutionError, CellTimeoutError, DeadKernelError
from nbformat import NotebookNode
from nbformat.v4 import new_output
from PIL import Image

from .. import course
from ..exercises.atomic_write import write_file
from ..exercises.check_files import CHECKS_VARIABLE
from ..exercises.declaration import MasterError
from .rules import RAISING_TAGS

CELL_SECONDS = 120
_VARIABLES_LEFT_OUT = {"MPLBACKEND", "PYTHONWARNINGS", "FORCE_COLOR", "NO_COLOR"}
_VARIABLES_LEFT_OUT |= {"ROS_LOCALHOST_ONLY", "JPY_SESSION_NAME", CHECKS_VARIABLE}
_ANSI = re.compile(r"\x1b\[[0-9;]*m")
_ADDRESS = re.compile(r"\b0x[0-9a-f]{8,}\b")
_DATA_URI = re.compile(r"base64,[A-Za-z0-9+/=\s]+")
_WIDGET = "application/vnd.jupyter.widget-view+json"


def kernel_environment():
    """The environment of a lesson's kernel: the user's, without variables that would change outputs."""
    environment = {name: value for name, value in os.environ.items() if name not in _VARIABLES_LEFT_OUT}
    return environment | {
        # The lesson sees no other robot or lesson. ROS takes 0 to 101, of which tests take those from 60 on.
        "ROS_DOMAIN_ID": str(1 + os.getpid() % 59),
        "ROS_AUTOMATIC_DISCOVERY_RANGE": "LOCALHOST",
        "OPENCV_LOG_LEVEL": "ERROR",
        # ipykernel puts what C code prints (ROS's log, with its times) into the cell, except under pytest.
        # nbval runs in pytest, so it would miss that output.
        "PYTEST_CURRENT_TEST": "build",
        course.VARIABLE: str(course.file()),
    }


def execute(notebook, master_path, kernel_name="python3", files=None):
    """Execute a notebook in its own kernel, in a folder with these files; its outputs are stored in it.

    `files` are {relative path: text}, as `lesson_files` gives them.
    MasterError: a cell raised or did not finish, or the kernel died.
    """
    running = {"id": "the kernel's start"}
    with tempfile.TemporaryDirectory(prefix="lesson-") as folder:
        for name, text in (files or {}).items():
            write_file(Path(folder) / name, text)
        client = NotebookClient(
            notebook,
            timeout=CELL_SECONDS,
            kernel_name=kernel_name,
            resources={"metadata": {"path": folder}},
            record_timing=False,
            store_widget_state=False,
            coalesce_streams=True,
            on_cell_start=lambda cell, cell_index: running.update(id=cell.id),
        )
        quiet = {"stdout": subprocess.DEVNULL, "stderr": subprocess.DEVNULL}
        try:
            client.execute(env=kernel_environment() | {"IPYTHONDIR": f"{folder}/.ipython"}, **quiet)
        except CellExecutionError as error:
            reason = f"{error.ename}: {error.evalue}".splitlines()[0]
        except CellTimeoutError:
            reason = f"not finished after {CELL_SECONDS} s"
        except DeadKernelError:
            reason = "the kernel died"
        except RuntimeError as error:  # the kernel did not start in time
            reason = str(error)
        else:
            return
    raise MasterError(f"{Path(master_path).name}: cell {running['id']}: {reason}")


def normalize(notebook, master):
    """Remove what varies from run to run: times, widget models, dates in images, the order of streams."""
    notebook.metadata.language_info = {"name": "python", "file_extension": ".py", "mimetype": "text/x-python"}
    notebook.metadata.pop("widgets", None)
    code_cells = [cell for cell in notebook.cells if cell.cell_type == "code"]
    for count, cell in enumerate(code_cells, 1):
        cell.execution_count = count
        cell.metadata.pop("execution", None)
        cell.outputs = _merge_streams(cell.outputs)
        for output in cell.outputs:
            _normalize_output(output, count)
        raised = any(output.output_type == "error" for output in cell.outputs)
        if set(cell.metadata.get("tags", ())) & set(RAISING_TAGS) and not raised:
            problem = f"tagged {RAISING_TAGS[0]}, but nothing was raised"
            raise MasterError(f"{master.path.name}: cell {cell.id}: {problem}")


def _normalize_output(output, count):
    if output.output_type == "execute_result":
        output.execution_count = count
    if output.output_type == "error":
        # Frames inside libraries contain paths and line numbers of this machine.
        frames = [frame for frame in output.traceback if not _ANSI.sub("", frame).startswith("File ")]
        output.traceback = frames
    data = output.get("data", {})
    data.pop(_WIDGET, None)
    if "image/png" in data:  # the same pixels, without what names the program or the date
        file = io.BytesIO()
        with Image.open(io.BytesIO(base64.b64decode(data["image/png"]))) as image:
            image.info.clear()
            image.save(file, format="PNG")
        data["image/png"] = base64.b64encode(file.getvalue()).decode("ascii")


def _merge_streams(outputs):
    """Neighbouring chunks of one stream as one; stdout before stderr, because their order is a race."""
    merged: list[NotebookNode] = []
    for kind, group in groupby(outputs, lambda output: output.output_type):
        neighbours = list(group)
        if kind == "stream":
            texts = {"stdout": "", "stderr": ""}
            for output in neighbours:
                texts[output.name] += output.text
            neighbours = [new_output(kind, name=name, text=text) for name, text in texts.items() if text]
        merged += neighbours
    return merged


def refuse_traces(notebook, master):
    """Refuse outputs with a path of this machine, or with an address, which changes from run to run."""
    folders = {*course.roots(), Path.home(), master.path.parent.resolve()}
    names = [re.escape(str(folder)) + r"(?![\w.-])" for folder in sorted(folders) if folder != Path("/")]
    paths = re.compile("|".join([*names, re.escape(f"{tempfile.gettempdir()}/lesson-")]))
    for cell, master_cell in zip(notebook.cells, master.cells, strict=True):
        if master_cell.kind != "code":
            continue
        text, trace = "\n".join(output_texts(cell)), ""
        if path := paths.search(text):
            trace = f"a path of this machine, {path[0]}"
        elif not master_cell.varies and (address := _ADDRESS.search(text)):
            trace = f"the address {address[0]}, which changes with every run; show the value instead of the"
            trace += " object"
        if trace:
            raise MasterError(f"{master.path.name}: cell {cell.id}: its output contains {trace}")


def output_texts(cell):
    """The texts of a code cell's outputs, without colours and without the data of images."""
    for output in cell.outputs:
        yield _ANSI.sub("", output.get("text", ""))
        yield from (_ANSI.sub("", line) for line in output.get("traceback", ()))
        for mime_type, value in output.get("data", {}).items():
            if isinstance(value, str) and not mime_type.startswith(("image/png", "image/jpeg")):
                yield _ANSI.sub("", _DATA_URI.sub("", value))
