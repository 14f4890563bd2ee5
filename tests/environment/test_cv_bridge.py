"""The folder environment/cv_bridge, by which other people's nodes find the course's converter."""

import os
import subprocess
import sys
from pathlib import Path

import pytest
from nbclassroom.authoring.masters import read_master

ROOT = Path(__file__).parents[2]
FOR_OTHER_NODES = ROOT / "environment" / "cv_bridge"
(LESSON,) = (ROOT / "notebooks" / "masters").glob("*_images_as_messages.py")


@pytest.mark.parametrize("is_installed", [False, True])
def test_other_peoples_nodes_import_it_as_cv_bridge_where_none_is_installed(tmp_path, is_installed):
    # Lesson 03, down to the checks of its section 6: on a robot you only change the import.
    cells = [cell for cell in read_master(LESSON).cells if cell.role in ("", "given", "predict")]
    end = next(number for number, cell in enumerate(cells) if cell.source.startswith("### A view"))
    program = "\n".join(cell.source for cell in cells[:end] if cell.kind == "code")
    program = program.replace("imgproc_course.messages.cv_bridge", "cv_bridge")
    program += "\nprint(CvBridge.__module__)"
    if is_installed:
        program = "from cv_bridge import CvBridge; from cv_bridge.core import WHO; print(CvBridge, WHO)"
        (tmp_path / "cv_bridge").mkdir()
        (tmp_path / "cv_bridge" / "__init__.py").write_text("from .core import CvBridge")
        (tmp_path / "cv_bridge" / "core.py").write_text("CvBridge, WHO = 'the installed one', __name__")
    environment = os.environ | {"PYTHONPATH": f"{FOR_OTHER_NODES}{os.pathsep}{tmp_path}"}
    command = [sys.executable, "-c", program]
    process = subprocess.run(command, env=environment, capture_output=True, text=True, timeout=60)
    expected = "the installed one cv_bridge.core" if is_installed else "imgproc_course.messages.cv_bridge"
    assert (process.stdout.splitlines()[-1:], process.stderr) == ([expected], "")
