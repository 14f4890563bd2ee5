"""What learners get: lessons without outputs and counters, and the files that the lessons read."""

import json
import re
from pathlib import Path

from .. import course
from ..exercises.atomic_write import write_file
from ..exercises.progress import LEARNERS_FOLDER
from .lesson_files import CHECKS, SOLUTIONS, TEXTS, without_outputs, zip_bytes
from .lesson_names import lesson_name
from .masters import find_lessons
from .references import GLOSSARY_PAGE

_PAGES = (".ipynb", ".html")


def hand_out(folder, source, names=(), *, with_solutions=False, zipped=False):
    """Write what learners get into a folder, in which no file is replaced; after an error nothing.

    The source holds built lessons with checks/ and solutions/. Without names, all lessons are taken; other
    notebooks and pages, such as the glossary, go along, without links to what does not. Zipped, <folder>.zip
    is written as well. Returns the number of lessons, and the Path of the zip file. ValueError: one line that
    says what to do.
    """
    folder, source = Path(folder), Path(source)
    chosen = find_lessons(source, names)
    left_out = {path.name for path in set(find_lessons(source)) - set(chosen)}
    if source.resolve() in (folder.resolve(), *folder.resolve().parents):
        raise ValueError(f"{folder} is in the folder of the lessons, {source}; give another folder")
    # Nothing else: a teacher's folder may hold a key, or submissions.
    pages = [path for path in sorted(source.iterdir()) if path.suffix in _PAGES or path.name == GLOSSARY_PAGE]
    texts = {path.name: without_outputs(path.read_bytes()) for path in pages if path.name not in left_out}
    # Links to what is not handed out become plain text.
    link = re.compile(rb"\[([^][]+)\]\(([^()#]*)(?:#[^()]*)?\)")
    files = {}
    for name, text in texts.items():
        files[name] = link.sub(lambda found: found[1] if found[2].decode() in left_out else found[0], text)
    for path in chosen:
        files |= _exercise_files(source, path, with_solutions)
        beside = [f"{TEXTS}/{lesson_name(path.stem)}.json", f"{lesson_name(path.stem)}.py"]
        if course.league_baseline.encode() in path.read_bytes():
            beside.append(course.league_baseline)
        files |= {name: (source / name).read_bytes() for name in beside if (source / name).is_file()}
    files[LEARNERS_FOLDER] = (json.dumps({"handout": course.release()}) + "\n").encode()
    if course.face == course.KEYS["face"]:  # the lessons import the classroom, which must find the course
        files[course.FILE] = course.file().read_bytes()
    archive = folder.with_name(f"{folder.name}.zip")
    outputs = {folder / name: data for name, data in files.items()}
    if zipped:
        outputs[archive] = zip_bytes({f"{folder.name}/{name}": data for name, data in files.items()})
    _refuse_to_replace(outputs)
    for path, data in outputs.items():
        write_file(path, data)
    return len(chosen), archive


def _exercise_files(source, lesson, with_solutions):
    """What check and hint need for a lesson, and what solution needs: {relative name: bytes}."""
    try:
        ids = [cell.get("id", "") for cell in json.loads(lesson.read_bytes())["cells"]]
    except (ValueError, KeyError, TypeError) as error:
        raise ValueError(f"{lesson.name} is not a notebook; build the lessons again") from error
    if not any(id.startswith("check-") for id in ids):
        return {}
    files = {}
    for folder in (CHECKS, SOLUTIONS) if with_solutions else (CHECKS,):
        path = source / folder / f"{lesson_name(lesson.stem)}.json"
        if not path.is_file():
            problem = f"{lesson.name} has exercises, but {folder}/{path.name} is missing beside it"
            command = f"{course.command} build{' --with-solutions' * (folder == SOLUTIONS)}"
            raise ValueError(f"{problem}; build the lessons again: {command}")
        files[f"{folder}/{path.name}"] = path.read_bytes()
    return files


def _refuse_to_replace(outputs):
    different = [
        str(path)
        for path, data in outputs.items()
        if path.exists() and (path.is_dir() or path.read_bytes() != data)
    ]
    if different:
        more = f" and {len(different) - 1} more" if len(different) > 1 else ""
        problem = f"{different[0]}{more} exists already and differs, and nothing was written"
        raise ValueError(f"{problem}; give another folder, or move the files away")
