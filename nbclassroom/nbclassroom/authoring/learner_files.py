"""The files of a folder of lessons that learners get, and lessons without outputs."""

import contextlib
import io
import json
import re
import zipfile

from .. import course
from ..exercises.check_files import CHECKS, SOLUTIONS

KEEP_OUTPUT_TAG = "keep-output"
TEXTS = "texts"  # name of the folder of captions and alternative texts
_NOT_FOR_LEARNERS = re.compile(rf"\..*|masters|__pycache__|{course.FILE}|{CHECKS}|{SOLUTIONS}")


def files_for_learners(source):
    """All files of a folder of lessons that belong to learners as they are: no masters, checks, solutions."""
    files = [path for path in sorted(source.rglob("*")) if path.is_file()]
    return [
        file for file in files if not any(map(_NOT_FOR_LEARNERS.fullmatch, file.relative_to(source).parts))
    ]


def without_outputs(data):
    """The bytes of a notebook as a learner gets it: no outputs but of cells tagged to keep them, no counters.

    The bytes of another file stay as they are.
    """
    with contextlib.suppress(ValueError, KeyError, TypeError, AttributeError):
        notebook = json.loads(data)
        code = [cell for cell in notebook["cells"] if cell["cell_type"] == "code"]
        cells = [cell for cell in code if KEEP_OUTPUT_TAG not in cell.get("metadata", {}).get("tags", ())]
        if any(cell["outputs"] or cell["execution_count"] is not None for cell in cells):
            for cell in cells:
                cell["outputs"], cell["execution_count"] = [], None
            text = json.dumps(notebook, ensure_ascii=False, indent=1, sort_keys=True)
            return (text + "\n").encode()
    return data


def zip_bytes(files):
    """The bytes of a zip with {name: bytes}; the same files give the same bytes."""
    buffer = io.BytesIO()
    with zipfile.ZipFile(buffer, "w") as archive:
        for name, data in sorted(files.items()):
            info = zipfile.ZipInfo(name)  # which has no date of today
            info.external_attr = 0o644 << 16  # without it, unzip makes files that nobody can read
            archive.writestr(info, data, zipfile.ZIP_DEFLATED)
    return buffer.getvalue()
