"""`check` of a controller in a kernel as in JupyterLab: its progress, and an interrupt."""

import os

import pytest
from jupyter_client.manager import KernelManager
from nbclassroom.authoring.lesson_files import lesson_files
from nbclassroom.authoring.masters import read_master
from plane_env import PARTS, RIGHT, course_on_a_plane, driving_on_a_plane

SET_UP = "from imgproc_course.exercises import check"


@pytest.fixture
def kernel(write_master, tmp_path):
    """A kernel that finds the check of an exercise, and takes itself for a learner's."""
    (tmp_path / "checks").mkdir()
    with driving_on_a_plane():
        text = lesson_files(read_master(write_master("80_driving", **PARTS)))["checks/driving.json"]
    (tmp_path / "checks" / "driving.json").write_text(text)
    environment = {name: value for name, value in os.environ.items() if name != "PYTEST_CURRENT_TEST"}
    manager = KernelManager(kernel_name="python3")
    with course_on_a_plane() as variables:
        manager.start_kernel(env=environment | variables, cwd=tmp_path)
        client = manager.client()
        client.start_channels()
        client.wait_for_ready(timeout=150)
        yield manager, client
        client.stop_channels()
        manager.shutdown_kernel(now=True)


def run(client, source, hook=lambda message: None):
    """(the reply to a cell, {type of a message: the contents of those that it sent})."""
    messages = {}

    def collect(message):
        messages.setdefault(message["msg_type"], []).append(message["content"])
        hook(message)

    reply = client.execute_interactive(
        source, timeout=150, output_hook=collect, allow_stdin=False, stop_on_error=False
    )
    return reply["content"], messages


def test_a_kernel_shows_progress_and_is_interrupted(kernel):
    manager, client = kernel
    assert run(client, SET_UP)[0]["status"] == "ok"
    _, messages = run(client, f"{RIGHT}\ncheck('test-drive', control)")
    (bar,) = messages["display_data"]
    shown = [update["data"] for update in messages["update_display_data"]]
    assert "Driving 3 scenarios" in bar["data"]["text/html"] and len(shown) == 180 // 20 + 1
    assert 'value="0.56"' in shown[4]["text/html"] and shown[-1] == {"text/plain": "", "text/html": ""}
    (result,) = messages["execute_result"]
    assert result["data"]["text/plain"].startswith("test-drive: all 3 checks pass.")
    slow = RIGHT.replace("    return", "    __import__('time').sleep(0.04)\n    return")
    interrupted = []  # once: what ends a check changes its progress bar too

    def interrupt(message):
        if message["msg_type"] == "update_display_data" and not interrupted:
            interrupted.append(True)
            manager.interrupt_kernel()

    reply, messages = run(client, f"{slow}\ncheck('test-drive', control)", interrupt)
    assert reply["ename"] == "CheckInterrupted" and "execute_result" not in messages
    assert reply["traceback"] == ["The check was interrupted. Run its cell again: it drives from the start."]
    _, messages = run(client, f"{RIGHT}\nprint(check('test-drive', control).passed)")
    assert messages["stream"][0]["text"] == "True\n"
