"""A class on this machine, as environment/class/start runs it, and its learners, as the hub sees them."""

import contextlib
import fcntl
import json
import os
import signal
import socket
import subprocess
import sys
import tempfile
import time
import uuid
from pathlib import Path

import psutil
import requests
import websocket

ROOT = Path(__file__).resolve().parents[1]

# What a learner's notebook runs: receives images for some seconds, then looks at who else is in the graph.
RECEIVE = """
import json, os, time
import rclpy
from imgproc_course.ros import ImageSubscriber, RosSession, open_camera
with open_camera("recording") as camera, ImageSubscriber(camera.topic) as images:
    images.wait(timeout=60)
    end = time.monotonic() + {seconds}
    while time.monotonic() < end:
        images.wait(timeout=20)
    node = rclpy.create_node("probe", context=RosSession.current().context)
    time.sleep(2)
    publishers = node.count_publishers(camera.topic)
    print(json.dumps(dict(domain=os.environ["ROS_DOMAIN_ID"], home=os.environ["HOME"], publishers=publishers,
                          received=images.received, dropped=images.dropped)))
    node.destroy_node()
"""


# Runs a command in a mount namespace of its own. There, and nowhere else, an account belongs to each name,
# with the name as its password and an empty home; and others may enter what lies below root's home.
WITH_ACCOUNTS = """
set -euo pipefail
folder=$1 names=$2 opened=$3 number=61000
shift 3
cp /etc/passwd /etc/shadow "$folder"
mount -t tmpfs -o mode=755 tmpfs /home
for name in $names; do
    number=$((number + 1))
    echo "$name:x:$number:$number::/home/$name:/bin/bash" >>"$folder/passwd"
    echo "$name:$(openssl passwd -6 "$name"):20000:0:99999:7:::" >>"$folder/shadow"
    install -d -m 700 -o $number -g $number "/home/$name"
done
for file in passwd shadow; do mount --bind "$folder/$file" /etc/$file; done
mkdir "$folder/root"
mount --bind /root "$folder/root"
mount -t tmpfs -o mode=755 tmpfs /root
for place in $opened; do
    mkdir -p "$place"
    mount --bind "$folder$place" "$place"
done
exec "$@"
"""


class Class:
    """A running class; `folder` holds users.txt, the homes and JupyterHub's database.

    With `has_accounts`, which needs root: each learner has an account on this machine, and logs in by PAM.
    """

    def __init__(self, folder, names, options=(), *, has_accounts=False):
        self.folder = Path(folder)
        (self.folder / "users.txt").write_text("\n".join(names), encoding="utf-8")
        ports = _free_ports(3)
        self.url = f"http://127.0.0.1:{ports[0]}"
        self._lock = (Path(tempfile.gettempdir()) / "imgproc_course-class.lock").open("w")
        fcntl.flock(self._lock, fcntl.LOCK_EX)  # the ROS domains of two classes are the same
        self.log = self.folder / "hub.log"
        environment = os.environ | {
            "CLASS_PYTHON": sys.executable,
            "CLASS_FOLDER": str(self.folder),
            "CLASS_LOGIN": "pam" if has_accounts else "shared",
        }
        opened = {sys.base_prefix, str(ROOT)}
        below_root = " ".join(path for path in sorted(opened) if Path("/root") in Path(path).parents)
        accounts = " ".join(name.lstrip("*") for name in names)
        namespace = ["unshare", "--mount", "bash", "-c", WITH_ACCOUNTS, "bash", folder, accounts, below_root]
        with self.log.open("w") as log:
            self.process = subprocess.Popen(
                [
                    *(namespace if has_accounts else ()),
                    ROOT / "environment/class/start",
                    f"--url={self.url}",
                    f"--JupyterHub.hub_port={ports[1]}",
                    f"--ConfigurableHTTPProxy.api_url=http://127.0.0.1:{ports[2]}",
                    *options,
                ],
                env=environment,
                stdout=log,
                stderr=subprocess.STDOUT,
            )
        wait_for(self._answers, self)

    def _answers(self):
        assert self.process.poll() is None, self.log.read_text()
        with contextlib.suppress(requests.ConnectionError):
            return requests.get(f"{self.url}/hub/login", timeout=60).ok

    def processes(self):
        """Every process of a learner's: server, kernels, cameras, also those that were left behind."""
        found = []
        for process in psutil.process_iter():
            with contextlib.suppress(psutil.Error):
                if process.environ().get("HOME", "").startswith(str(self.folder)):
                    found.append(process)
        return found

    def close(self):
        self.process.send_signal(signal.SIGTERM)
        self.process.wait(240)
        self._lock.close()

    def __enter__(self):
        return self

    def __exit__(self, *exception):
        self.close()


class Learner:
    """A learner who has logged in, with a running server."""

    def __init__(self, hub, name, password=None):
        self.hub, self.name = hub, name
        self._browser = requests.Session()
        self._browser.get(f"{hub.url}/hub/login")
        password = password or (hub.folder / "password.txt").read_text().strip()
        form = {"username": name, "password": password, "_xsrf": self._xsrf()}
        self.login = self._browser.post(f"{hub.url}/hub/login", data=form, allow_redirects=False)
        if self.login.ok:
            self._browser.get(f"{hub.url}/hub/home")  # a new _xsrf cookie, which belongs to this login

    def _xsrf(self):
        return [cookie.value for cookie in self._browser.cookies if cookie.name == "_xsrf"][-1]

    def _api(self, method, path):
        headers = {"X-XSRFToken": self._xsrf(), "Referer": f"{self.hub.url}/hub/home"}
        url = f"{self.hub.url}/hub/api/users/{self.name}{path}"
        reply = self._browser.request(method, url, headers=headers, json={})
        assert reply.ok, reply.text
        return reply.json() if reply.text else None

    def start(self):
        self._api("POST", "/server")
        self.headers = {"Authorization": f"token {self._api('POST', '/tokens')['token']}"}

    def wait_until_ready(self):
        wait_for(lambda: self._api("GET", "")["servers"].get("", {}).get("ready"), self.hub)

    def get(self, path):
        return requests.get(f"{self.hub.url}/user/{self.name}/{path}", headers=self.headers, timeout=60)

    def run(self, code):
        """What the code prints in a new kernel of this learner's."""
        url = f"{self.hub.url}/user/{self.name}/api/kernels"
        kernel = requests.post(url, headers=self.headers, json={"name": "python3"}, timeout=60).json()["id"]
        address = f"{url.replace('http', 'ws', 1)}/{kernel}/channels"
        channel = websocket.create_connection(address, header=self.headers, timeout=120)
        header = {
            "msg_id": uuid.uuid4().hex,
            "msg_type": "execute_request",
            "session": "s",
            "username": "",
            "version": "5.3",
        }
        request = {"header": header, "parent_header": {}, "metadata": {}, "channel": "shell"}
        channel.send(json.dumps(request | {"content": {"code": code, "silent": False}}))
        printed, missing = (
            "",
            {"execute_reply", "idle"},
        )  # two channels: what is printed may come after the reply
        with contextlib.closing(channel):
            while missing:
                message = json.loads(channel.recv())
                if message["parent_header"].get("msg_id") != header["msg_id"]:
                    continue
                content = message["content"]
                if message["msg_type"] == "stream" and content["name"] == "stdout":
                    printed += content["text"]
                if message["msg_type"] == "execute_reply":
                    assert content["status"] == "ok", content
                missing -= {message["msg_type"], content.get("execution_state")}
        return printed


def _free_ports(count):
    with contextlib.ExitStack() as stack:
        sockets = [stack.enter_context(socket.socket()) for _ in range(count)]
        for free in sockets:
            free.bind(("127.0.0.1", 0))
        return [free.getsockname()[1] for free in sockets]


def wait_for(condition, hub, seconds=240):
    end = time.monotonic() + seconds
    while not condition():
        assert time.monotonic() < end, hub.log.read_text()
        time.sleep(0.3)
