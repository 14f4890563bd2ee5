"""What JupyterHub starts for each learner: lays out the lessons in their home, then runs their JupyterLab."""

import os
import shutil
import sys
from pathlib import Path

from nbclassroom.lab import server
from nbclassroom.lab.working_copies import update_lessons

folder = Path.home() / "my_lessons"
changes = update_lessons(target=folder)
server.trust([folder / name for name in changes.written if name.endswith(".ipynb")])
server.configure(folder)
# JupyterHub's server reads the style sheet from the home folder only.
style = Path.home() / ".jupyter" / "custom"
if not style.exists():
    shutil.copytree(server.CONFIGURATION / "custom", style)
os.execv(sys.executable, [sys.executable, "-m", "jupyterhub.singleuser", *sys.argv[1:]])
