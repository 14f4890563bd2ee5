"""JupyterHub's configuration for a class on one machine.

environment/class/start names the class's folder and the interpreter.

CLASS_LOGIN=shared: one password for the class. All servers run under the account that started the class, each
in a home of its own in homes/. CLASS_LOGIN=pam, which needs root: learners are users of this machine.
"""

import os
from pathlib import Path

c = get_config()  # noqa: F821 - JupyterHub, which runs this file, defines it

FOLDER = Path(os.environ["CLASS_FOLDER"])
PYTHON = Path(os.environ["CLASS_PYTHON"])
DOMAINS = 101  # ROS allows 0 to 101; 0 stays free for other work on this machine

names = (FOLDER / "users.txt").read_text(encoding="utf-8").lower().split()
c.Authenticator.admin_users = {name[1:] for name in names if name.startswith("*")}
c.Authenticator.allowed_users = {name.lstrip("*") for name in names}
if os.environ["CLASS_LOGIN"] == "shared":
    c.JupyterHub.authenticator_class = "shared-password"
    c.SharedPasswordAuthenticator.user_password = (FOLDER / "password.txt").read_text().strip()
    c.SharedPasswordAuthenticator.admin_password = (FOLDER / "password_teacher.txt").read_text().strip()
    c.JupyterHub.spawner_class = "simple"
    c.SimpleLocalProcessSpawner.home_dir_template = str(FOLDER / "homes" / "{username}")
else:
    c.JupyterHub.authenticator_class = "pam"

c.JupyterHub.bind_url = "http://127.0.0.1:8000"
c.ConfigurableHTTPProxy.command = [str(PYTHON.with_name("configurable-http-proxy"))]
c.JupyterHub.cleanup_servers = True  # no learner's server outlives the hub
c.Spawner.cmd = [str(PYTHON), str(Path(__file__).with_name("learner.py"))]
c.Spawner.default_url = "/lab/tree/index.ipynb"
c.Spawner.start_timeout = c.Spawner.http_timeout = 120  # seconds: thirty servers may start at once
c.Spawner.environment = {
    "PATH": f"{PYTHON.parent}{os.pathsep}{os.environ['PATH']}",
    "ROS_AUTOMATIC_DISCOVERY_RANGE": "LOCALHOST",
    "NBCLASSROOM_COURSE": str(Path(__file__).resolve().parents[2] / "notebooks" / "course.toml"),
    # Learners share the processor: a library that starts a thread for each core slows all of them down.
    "OMP_NUM_THREADS": "1",
    "OPENBLAS_NUM_THREADS": "1",
}


def choose_domain(spawner):
    """Gives a learner's server the ROS domain that belongs to their number in the hub: 1 to 101."""
    spawner.environment = {**spawner.environment, "ROS_DOMAIN_ID": str(1 + spawner.user.id % DOMAINS)}


c.Spawner.pre_spawn_hook = choose_domain
