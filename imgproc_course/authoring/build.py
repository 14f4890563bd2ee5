"""Make lessons and their solved twins from masters: executed in a real kernel, and the same each time.

A lesson is executed as nbval will execute it, so that what is stored is what nbval finds.
"""

import base64
import hashlib
import os
import re
import struct
import subprocess
import tempfile
import time
from dataclasses import dataclass, field
from importlib.metadata import version
from pathlib import Path

import nbformat
from nbclient import NotebookClient
from nbclient.exceptions import CellExecutionError, CellTimeoutError, DeadKernelError
from nbformat.v4 import new_code_cell, new_markdown_cell, new_notebook

from imgproc_course.authoring.atomic_write import write_file
from imgproc_course.authoring.masters import RAISING, VARYING, find_masters, read_master
from imgproc_course.authoring.validation import prove
from imgproc_course.exercises.declaration import MASTERS_VARIABLE, MasterError

CELL_SECONDS = 120
_ANSI = re.compile(r"\x1b\[[0-9;]*m")
_ADDRESS = re.compile(r"\b0x[0-9a-f]{8,}\b")
_DATA_URI = re.compile(r"base64,[A-Za-z0-9+/=\s]+")
_WIDGET = "application/vnd.jupyter.widget-view+json"
_PNG_START = b"\x89PNG\r\n\x1a\n"
_PNG_NOTES = (b"tEXt", b"zTXt", b"iTXt", b"tIME", b"eXIf")


@dataclass
class Report:
    """What a build did: names of the lessons built, and problems (or differences), a line each."""

    built: list = field(default_factory=list)
    problems: list = field(default_factory=list)


def build(masters_dir, lessons_dir, solved_dir, names=(), say=print):
    """Build lessons and their solved twins.

    Each lesson is built by itself and written at its end, whole: a failure or Ctrl-C costs that one lesson
    and leaves its former file as it was.

    Parameters
    ----------
    masters_dir, lessons_dir, solved_dir : Path
    names : names of lessons; all where empty
    say : callable, takes a line of progress

    Returns
    -------
    Report
    """
    report = Report()
    for path, twins, problem in _built(masters_dir, lessons_dir, names, say, solved=True):
        if problem:
            report.problems.append(problem)
            continue
        for folder, notebook in zip((lessons_dir, solved_dir), twins, strict=True):
            text = nbformat.writes(notebook) + "\n"
            write_file(Path(folder) / f"{path.stem}.ipynb", text, permissions=0o644)
        report.built.append(path.stem)
    if not names:
        report.problems += _orphans(masters_dir, lessons_dir)
    return report


def compare_lessons(masters_dir, lessons_dir, names=(), say=print):
    """Build lessons without writing them, and say where they differ from the stored ones.

    Parameters
    ----------
    As `build`.

    Returns
    -------
    Report, its problems name the lesson and the cell
    """
    report = Report()
    for path, twins, problem in _built(masters_dir, lessons_dir, names, say, solved=False):
        if problem:
            report.problems.append(problem)
            continue
        report.problems += differences(twins[0], Path(lessons_dir) / f"{path.stem}.ipynb")
        report.built.append(path.stem)
    if not names:
        report.problems += _orphans(masters_dir, lessons_dir)
    return report


def _built(masters_dir, lessons_dir, names, say, *, solved):
    for path in find_masters(masters_dir, names):
        started = time.monotonic()
        say(f"{path.stem} ...")
        try:
            master = read_proven(path)
            twins = [build_lesson(master, Path(lessons_dir) / f"{path.stem}.ipynb")]
            if solved:
                twins.append(build_solved(master))
        except MasterError as error:
            yield path, None, str(error)
            continue
        kilobytes = len(nbformat.writes(twins[0])) / 1000
        say(f"{path.stem}: {kilobytes:.0f} kB, {time.monotonic() - started:.0f} s")
        yield path, twins, ""


def read_proven(path):
    """A master that keeps the format's rules, and whose exercises grade justly.

    Parameters
    ----------
    path : Path

    Returns
    -------
    Master

    Raises
    ------
    MasterError : what is wrong, a line each
    """
    master = read_master(path)
    complaints = [complaint for declared in master.exercises for complaint in prove(declared)]
    if complaints:
        raise MasterError("\n".join(f"{master.path.name}: {complaint}" for complaint in complaints))
    return master


def build_lesson(master, former=None):
    """The lesson of a master, executed.

    Parameters
    ----------
    master : Master
    former : Path of the lesson as built before, or None; a cell whose output varies keeps the stored one

    Returns
    -------
    NotebookNode

    Raises
    ------
    MasterError : an error in a cell, an output that cannot be the same again; a line with lesson and cell
    """
    lesson = _executed(master, solved=False)
    _keep_varying(lesson, former, master)
    _refuse_traces(lesson, master)
    return lesson


def build_solved(master):
    """The same with the solutions in the answers' places.

    Parameters
    ----------
    master : Master

    Returns
    -------
    NotebookNode
    """
    twin = _executed(master, solved=True)
    _refuse_traces(twin, master)
    return twin


def _executed(master, *, solved):
    notebook = unexecuted(master, solved=solved)
    execute(notebook, master.path)
    _normalise(notebook, master)
    return notebook


def unexecuted(master, *, solved=False):
    """A lesson, or its solved twin, without outputs.

    Parameters
    ----------
    master : Master
    solved : bool

    Returns
    -------
    NotebookNode
    """
    cells = []
    for cell in master.cells:
        source = cell.solved_source if solved else cell.source
        if cell.kind != "code":
            cells.append(new_markdown_cell(source, id=cell.id))
            continue
        tags = sorted({*cell.tags, *RAISING}) if set(cell.tags) & set(RAISING) else list(cell.tags)
        metadata = {"tags": tags} if tags else {}
        if cell.role == "check":
            metadata |= {"editable": False, "deletable": False}
        elif cell.role in ("answer", "given"):
            metadata |= {"deletable": False}
        cells.append(new_code_cell(source, id=cell.id, metadata=metadata))
    about = {
        "lesson": master.name,
        "title": master.title,
        "minutes": master.minutes,
        "version": version("imgproc-course"),
    }
    kernel = {"display_name": "Python 3 (ipykernel)", "language": "python", "name": "python3"}
    return new_notebook(cells=cells, metadata={"kernelspec": kernel, "imgproc_course": about})


# ---------------------------------------------------------------- running


def kernel_environment(masters_dir):
    """The environment of a lesson's kernel: the user's, without what would change a lesson's outputs.

    Parameters
    ----------
    masters_dir : Path

    Returns
    -------
    dict of str
    """
    environment = {
        name: value
        for name, value in os.environ.items()
        if name not in ("MPLBACKEND", "PYTHONWARNINGS", "FORCE_COLOR", "NO_COLOR", "ROS_LOCALHOST_ONLY")
    }
    return environment | {
        MASTERS_VARIABLE: str(Path(masters_dir).resolve()),
        "ROS_DOMAIN_ID": str(
            1 + os.getpid() % 100
        ),  # nobody else's robot or lesson is seen; ROS takes 0 to 101
        "ROS_AUTOMATIC_DISCOVERY_RANGE": "LOCALHOST",
        "OPENCV_LOG_LEVEL": "ERROR",
        # ipykernel puts what C code prints (ROS's log, with its times) into the cell, but not under pytest:
        # nbval, which runs in pytest, would miss it.
        "PYTEST_CURRENT_TEST": "imgproc-course build",
    }


def execute(notebook, master_path, kernel_name="python3"):
    """Execute a notebook in a kernel of its own, in an empty folder; fills in its outputs.

    Parameters
    ----------
    notebook : NotebookNode with cell ids
    master_path : Path of its master
    kernel_name : str

    Raises
    ------
    MasterError : a cell raised, did not end, or the kernel died
    """
    running = {"id": "the kernel's start"}

    def note(cell, cell_index):
        running["id"] = cell.id

    with tempfile.TemporaryDirectory(prefix="lesson-") as folder:
        client = NotebookClient(
            notebook,
            timeout=CELL_SECONDS,
            kernel_name=kernel_name,
            resources={"metadata": {"path": folder}},
            record_timing=False,
            store_widget_state=False,
            coalesce_streams=True,
            on_cell_start=note,
        )
        quiet = {"stdout": subprocess.DEVNULL, "stderr": subprocess.DEVNULL}
        environment = kernel_environment(Path(master_path).parent) | {
            "IPYTHONDIR": str(Path(folder) / ".ipython")
        }
        try:
            client.execute(env=environment, **quiet)
        except CellExecutionError as error:
            reason = f"{error.ename}: {error.evalue}".splitlines()[0]
        except CellTimeoutError:
            reason = f"not finished after {CELL_SECONDS} s"
        except DeadKernelError:
            reason = "the kernel died"
        else:
            return
    raise MasterError(f"{Path(master_path).name}: cell {running['id']}: {reason}")


# ---------------------------------------------------------------- the same each time


def _normalise(notebook, master):
    notebook.metadata.language_info = {"name": "python", "file_extension": ".py", "mimetype": "text/x-python"}
    notebook.metadata.pop("widgets", None)
    count = 0
    for cell in notebook.cells:
        if cell.cell_type != "code":
            continue
        count += 1
        cell.execution_count = count
        cell.metadata.pop("execution", None)
        cell.outputs = _streams_merged(cell.outputs)
        for output in cell.outputs:
            _normalise_output(output, count)
        raised = any(output.output_type == "error" for output in cell.outputs)
        if set(cell.metadata.get("tags", ())) & set(RAISING) and not raised:
            raise MasterError(
                f"{master.path.name}: cell {cell.id}: tagged {RAISING[0]}, but nothing was raised"
            )


def _normalise_output(output, count):
    if output.output_type == "execute_result":
        output.execution_count = count
    if output.output_type == "error":
        # Frames inside libraries hold paths and line numbers of this machine; the learner's own run shows
        # them.
        frames = [frame for frame in output.traceback if not _ANSI.sub("", frame).startswith("File ")]
        output.traceback = frames
    data = output.get("data", {})
    data.pop(_WIDGET, None)
    if "image/png" in data:
        data["image/png"] = _without_notes(data["image/png"])


def _streams_merged(outputs):
    """Neighbouring chunks of one stream as one; stdout before stderr: which comes first is a race."""
    merged = []
    for output in outputs:
        last = merged[-1] if merged else None
        if output.output_type != "stream":
            merged.append(output)
        elif last is not None and last.output_type == "stream" and last.name == output.name:
            last.text += output.text
        elif last is not None and last.output_type == "stream" and output.name == "stdout":
            before = merged[-2] if len(merged) > 1 else None
            if before is not None and before.output_type == "stream":
                before.text += output.text
            else:
                merged.insert(-1, output)
        else:
            merged.append(output)
    return merged


def _without_notes(encoded):
    """A PNG (base64) without the chunks that name the program or the day."""
    raw = base64.b64decode(encoded)
    kept, position = [_PNG_START], len(_PNG_START)
    while position + 12 <= len(raw):
        (length,) = struct.unpack(">I", raw[position : position + 4])
        chunk = raw[position : position + 12 + length]
        if chunk[4:8] not in _PNG_NOTES:
            kept.append(chunk)
        position += 12 + length
    return base64.b64encode(b"".join(kept)).decode("ascii")


def _keep_varying(notebook, former, master):
    """A cell whose output varies keeps what is stored, as long as no code up to it has changed."""
    stored = _stored(former)
    if stored is None:
        return
    old = {cell.id: cell for cell in stored.cells}
    for cell, known in zip(notebook.cells, master.cells, strict=True):
        unchanged = cell.id in old and _code_up_to(notebook, cell.id) == _code_up_to(stored, cell.id)
        if known.varies and unchanged:
            cell.outputs = old[cell.id].outputs


def _code_up_to(notebook, id):
    sources = []
    for cell in notebook.cells:
        if cell.cell_type == "code":
            sources.append(cell.source)
        if cell.id == id:
            return sources
    return None


def _refuse_traces(notebook, master):
    """Refuse outputs that name this machine, or hold an address, which is another one each time."""
    checkout = Path(__file__).resolve().parents[2]
    places = {
        str(checkout),
        str(Path.home()),
        tempfile.gettempdir() + "/lesson-",
        str(master.path.parent.resolve()),
    }
    places = {place for place in places if len(place) > 1}
    for cell, known in zip(notebook.cells, master.cells, strict=True):
        if known.kind != "code":
            continue
        text = "\n".join(_texts(cell))
        for place in sorted(places):
            if re.search(re.escape(place) + r"(?![\w.-])|" + re.escape(place) + "/", text) or (
                place.endswith("-") and place in text
            ):
                raise MasterError(
                    f"{master.path.name}: cell {cell.id}: its output holds a path of this machine, {place}"
                )
        address = None if known.varies else _ADDRESS.search(text)
        if address:
            raise MasterError(
                f"{master.path.name}: cell {cell.id}: its output holds the address {address[0]}, another one"
                " with every run; show the value instead of the object"
            )


def _texts(cell):
    for output in cell.outputs:
        yield output.get("text", "")
        yield from (_ANSI.sub("", line) for line in output.get("traceback", ()))
        for kind, value in output.get("data", {}).items():
            if isinstance(value, str) and not kind.startswith(("image/png", "image/jpeg")):
                yield _DATA_URI.sub("", value)


# ---------------------------------------------------------------- files


def _stored(path):
    """A lesson as stored, or None where there is none that can be read."""
    if path is None or not Path(path).is_file():
        return None
    try:
        return nbformat.read(path, as_version=4)
    except (ValueError, AttributeError, KeyError, TypeError):  # cut short, merged by hand, no notebook at all
        return None


def _orphans(masters_dir, lessons_dir):
    masters = {path.stem for path in find_masters(masters_dir)}
    return [
        f"{path.name}: there is no master for it; delete it, or bring its master back"
        for path in sorted(Path(lessons_dir).glob("*.ipynb"))
        if path.stem not in masters
    ]


def differences(built, stored_path):
    """Where a stored lesson differs from a built one.

    Parameters
    ----------
    built : NotebookNode
    stored_path : Path

    Returns
    -------
    list of str, a line for each cell that differs
    """
    stored_path = Path(stored_path)
    stored = _stored(stored_path)
    if stored is None:
        return [f"{stored_path.name}: not built yet, or no notebook; run imgproc-course build"]
    found = []
    if built.metadata != stored.metadata:
        found.append(f"{stored_path.name}: the lesson's metadata (title, minutes, version) differ")
    ids, stored_ids = [cell.id for cell in built.cells], [cell.id for cell in stored.cells]
    if ids != stored_ids:
        odd = next((one or other for one, other in _pairs(ids, stored_ids) if one != other), "")
        return [*found, f"{stored_path.name}: other cells than the master's, from {odd} on"]
    for new, old in zip(built.cells, stored.cells, strict=True):
        what = _what_differs(new, old)
        if what:
            found.append(f"{stored_path.name}: cell {new.id}: {what}")
    return found


def _pairs(one, other):
    length = max(len(one), len(other))
    return zip([*one, *[None] * (length - len(one))], [*other, *[None] * (length - len(other))], strict=True)


def _what_differs(new, old):
    if new.cell_type != old.cell_type or new.source != old.source:
        return "its source differs from the master"
    if new.metadata != old.metadata:
        return "its tags or metadata differ from the master"
    varies = VARYING in new.metadata.get("tags", ())
    if new.cell_type == "code" and not varies and new.outputs != old.outputs:
        return (
            f"its outputs differ from the stored ones\n    stored: {_sketch(old)}\n    now:    {_sketch(new)}"
        )
    return ""


def _sketch(cell):
    texts = [_ANSI.sub("", text).strip() for text in _texts(cell)]
    pictures = [
        f"{kind} {hashlib.sha256(value.encode()).hexdigest()[:8]}"
        for output in cell.outputs
        for kind, value in output.get("data", {}).items()
        if kind.startswith("image/") and isinstance(value, str)
    ]
    text = " | ".join([" ".join(text.split()) for text in texts if text] + pictures)
    return text[:300] or "nothing"
