"""JupyterLab's configuration for the course, as Jupyter reads it: `c` holds what is configured.

nbclassroom.lab.server puts this folder first on Jupyter's configuration path. These values replace those
in the learner's home folder. An option on the command line replaces both.
"""

import os
import platform
from pathlib import Path

c = get_config()  # type: ignore[name-defined]  # noqa: F821 - Jupyter, which runs this file, defines it

c.Application.log_level = "WARN"  # Jupyter prints its address at every level
if "NBCLASSROOM_LESSONS" in os.environ:
    c.ServerApp.root_dir = os.environ["NBCLASSROOM_LESSONS"]
c.LabApp.default_url = "/lab/tree/index.ipynb"
c.LabApp.custom_css = True  # custom/custom.css

# This computer alone: no other computer can open the lessons, and JupyterLab asks no server for news.
c.ServerApp.ip = "127.0.0.1"
c.LabApp.news_url = None
c.LabApp.check_for_updates_class = "jupyterlab.NeverCheckForUpdate"

# Jupyter refuses to start as root unless it is allowed, and in a container the learner is root.
c.ServerApp.allow_root = hasattr(os, "geteuid") and os.geteuid() == 0

# Jupyter gives the browser a file in a hidden folder. A browser installed as a snap cannot read it, nor can a
# browser of Windows when JupyterLab runs under WSL. These get the address with its token instead.
c.ServerApp.use_redirect_file = not (
    Path("/snap/bin/firefox").exists() or "microsoft" in platform.release().lower()
)

# An image follows its slider at once, not 40 ms later.
c.ServerApp.kernel_websocket_connection_class = "nbclassroom.lab.server.PromptWebsocketConnection"
# Equal to Jupyter's interval, in place of three times as long: Tornado warns of that in the terminal.
c.ServerApp.tornado_settings = {"ws_ping_timeout": 30_000}
