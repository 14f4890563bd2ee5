"""drive(robot) in a real browser, with the robot in the room: keys, buttons and a gamepad move it."""

import contextlib
import math
import re
import textwrap

import psutil
import pytest
from jupyter_page import NotebookPage, write_notebook
from playwright.sync_api import Error

pytestmark = [pytest.mark.browser, pytest.mark.ros]

CELLS = [
    """
    import time
    from imgproc_course.display import drive
    from imgproc_course.ros import Robot, open_camera

    camera = open_camera("room", rate=3)  # images per second: the machine has time for the rest
    robot = Robot()
    """,
    "view = drive(robot)",
    """
    def still():
        for _ in range(60):  # on a busy machine the last odometry comes late
            pose = robot.pose
            time.sleep(1)
            if robot.pose == pose:
                return True
        return False

    print(still(), len(view.trace) > 5)
    """,
    'robot.restart(lighting="evening")',
    "view.stop(); robot.close(); camera.stop()",
    "robot.restart(seed=1, start=(0.95, -1.3, 0.0))",  # before the boxes
]
PAD = ".imgproc-drive"
STATUS = "window.jupyterapp.shell.currentWidget.sessionContext.kernelDisplayStatus"
HELD_KEYS = ("ArrowUp", "ArrowLeft", "ArrowRight", "w", "a", "s", "d", "Space")
GAMEPAD = """axes => {
    const gamepad = {axes, buttons: []};
    navigator.getGamepads = () => [null, gamepad];
}"""


@pytest.fixture(scope="module")
def page(lab, browser):
    write_notebook(lab[1] / "drive.ipynb", [textwrap.dedent(cell).strip() for cell in CELLS])
    page = NotebookPage(browser, lab[0], "drive.ipynb")
    for cell in (0, 1):
        page.run_cell(cell)
    assert page.errors() == []
    page.wait_for_image()
    page.wait_until(lambda: numbers(page))
    yield page
    page.run_cell(4)
    page.close()


@pytest.fixture(autouse=True)
def at_rest(page):
    """Lets go of everything after a test: what one test held must not drive the robot in the next one."""
    yield
    page.page.evaluate(GAMEPAD, [0.0, 0.0])
    for key in HELD_KEYS:
        page.page.keyboard.up(key)
    page.page.mouse.up()
    page.page.evaluate("document.activeElement.blur()")


def numbers(page):
    """x, y, degrees, m/s and rad/s that stand beside the map; () before the first odometry."""
    text = page.page.locator(".imgproc-numbers").inner_text()
    return tuple(float(number) for number in re.findall(r"-?\d+(?:\.\d+)?", text))


def wait_for(page, condition):
    """Waits until the numbers fulfil a condition; on a busy machine the robot drives only now and then."""
    page.wait_until(lambda: (values := numbers(page)) and condition(*values), timeout=150)


def wait_for_stop(page):
    wait_for(page, lambda x, y, yaw, v, w: v == w == 0)


def test_keys_buttons_and_gamepad_drive_while_they_are_held(page):
    keyboard, pad = page.page.keyboard, page.page.locator(PAD)
    state = page.page.locator(".imgproc-state")
    page.wait_until(lambda: state.inner_text() == "not driving: no focus")
    pad.focus()
    cells = page.page.locator(".jp-Cell").count()
    for key, number, is_reached in (
        ("ArrowUp", 0, lambda x: x > 0.3),
        ("s", 0, lambda x: x < 0.1),
        ("a", 2, lambda degrees: degrees > 20),
        ("ArrowRight", 2, lambda degrees: degrees < 5),
    ):
        keyboard.down(key)
        wait_for(page, lambda *now, number=number, is_reached=is_reached: is_reached(now[number]))
        keyboard.up(key)
        wait_for_stop(page)
    keyboard.press("x")  # beside S: elsewhere in a notebook, A adds a cell and X cuts one
    page.run_cell(2)
    assert page.page.locator(".jp-Cell").count() == cells
    assert page.outputs(2) == ["True True\n"]
    assert page.page.locator(".imgproc-walls").get_attribute("d").count("M") > 50  # what the scanner has seen

    page.page.locator(f"{PAD} button[data-name=left]").hover()
    page.page.mouse.down()
    wait_for(page, lambda x, y, yaw, v, w: yaw > 20)
    page.page.mouse.up()
    wait_for_stop(page)
    keyboard.press("Tab")  # from "left" to "stop", and to "right"
    keyboard.press("Tab")
    keyboard.down("Space")
    wait_for(page, lambda x, y, yaw, v, w: yaw < 5)
    keyboard.up("Space")
    wait_for_stop(page)

    *start, heading, _, _ = numbers(page)
    page.page.evaluate(GAMEPAD, [0.14, -0.5])  # forward; to the side is within the dead zone
    wait_for(page, lambda x, y, yaw, v, w: math.dist(start, (x, y)) > 0.4)
    page.page.evaluate(GAMEPAD, [0.0, 0.0])
    wait_for_stop(page)
    turned = (numbers(page)[2] - heading + 180) % 360 - 180
    assert abs(turned) < 12  # degrees; without a dead zone it turns by 26


def test_a_bump_is_said_and_restart_begins_again(page):
    page.run_cell(5)
    wait_for(page, lambda x, y, yaw, v, w: x == y == yaw == 0)
    state, keyboard = page.page.locator(".imgproc-state"), page.page.keyboard
    page.page.locator(PAD).focus()
    keyboard.down("w")
    page.wait_until(lambda: state.inner_text() == "bumped: drive back", timeout=150)
    keyboard.up("w")
    page.screenshot("drive_bumped", PAD)
    keyboard.down("s")
    page.wait_until(lambda: state.inner_text() == "driving", timeout=150)
    keyboard.up("s")
    wait_for_stop(page)
    page.page.locator(".imgproc-restart").click()
    wait_for(page, lambda x, y, yaw, v, w: x == y == yaw == 0)
    assert page.page.locator(".imgproc-trace").get_attribute("points").split() == ["0,0"]
    assert state.inner_text() == "ready"


def test_everybody_can_read_and_use_it(page):
    for lighting, theme in (("day", "Light"), ("evening", "Dark")):
        page.set_theme(theme)
        if lighting == "evening":
            page.run_cell(3)
            wait_for(page, lambda x, y, yaw, v, w: x == y == yaw == 0)  # it begins again, and so does the map
            points = page.page.locator(".imgproc-trace").get_attribute("points")
            assert points.split() == ["0,0"]
        page.page.locator(PAD).focus()
        page.page.keyboard.down("w")
        page.page.keyboard.down("a")
        wait_for(page, lambda x, y, yaw, v, w: yaw > 30)
        page.page.keyboard.up("w")
        page.page.keyboard.up("a")
        assert page.violations() == []
        page.screenshot(f"drive_{lighting}_{theme}", PAD)
    page.set_theme("Light")


def test_without_focus_or_page_the_robot_stops(page):
    keyboard, pad = page.page.keyboard, page.page.locator(PAD)
    pad.focus()
    keyboard.down("d")
    wait_for(page, lambda x, y, yaw, v, w: w < -0.5)
    pad.blur()
    wait_for_stop(page)
    pad.focus()  # the key is still down: it must be pressed again
    page.page.wait_for_timeout(500)
    assert numbers(page)[3:] == (0, 0)
    keyboard.up("d")

    keyboard.down("ArrowLeft")
    wait_for(page, lambda x, y, yaw, v, w: w > 0.5)
    pad.evaluate("pad => pad.remove()")  # its last numbers stay; the kernel asks the robot
    page.run_cell(2)
    assert page.outputs(2)[0].startswith("True")
    keyboard.up("ArrowLeft")


def test_without_its_page_or_its_kernel_the_robot_stops_and_the_notebook_goes_on(page, lab, browser):
    from imgproc_course.ros import Robot, RosSession, open_camera

    with RosSession.current(), open_camera("room", rate=3) as camera, Robot() as robot:

        def stands_still():
            pose = robot.pose
            page.page.wait_for_timeout(1000)
            return robot.pose == pose

        def hold_a_key(page):
            page.run_cell(1)
            page.page.locator(PAD).focus()
            page.page.keyboard.down("ArrowLeft")
            page.wait_until(lambda: robot.odometry.twist.twist.angular.z > 0.5, timeout=150)

        crashing_page = NotebookPage(browser, lab[0], "drive.ipynb")
        hold_a_key(crashing_page)
        with crashing_page.page.expect_event("crash"), contextlib.suppress(Error):
            crashing_page.page.goto("chrome://crash")
        page.wait_until(stands_still, timeout=60)

        hold_a_key(page)
        (kernel,) = (user for user in camera.other_users if "drive.ipynb" in user)
        process = psutil.Process(int(re.search(r"pid (\d+)", kernel)[1]))
        command = process.cmdline()  # it names the kernel's connection file
        process.kill()
        page.wait_until(stands_still, timeout=60)
        page.page.keyboard.up("ArrowLeft")

        def is_started_again():
            others = (other for other in psutil.process_iter(["cmdline"]) if other.pid != process.pid)
            return any(other.info["cmdline"] == command for other in others)

        def runs_again():
            """JupyterLab connects by itself, which takes seconds; if not, it is asked to."""
            with contextlib.suppress(TimeoutError):
                page.wait_until(lambda: page.page.evaluate(STATUS) == "idle", timeout=30)
                page.run_cell(0, timeout=40)
                return "*" not in page.prompts()[0]
            page.page.evaluate("window.jupyterapp.commands.execute('kernelmenu:reconnect-to-kernel')")
            return False

        # JupyterLab says so in a dialog, but not if the page was not connected at that moment.
        button = page.page.locator(".jp-Dialog button", has_text="Ok")
        page.page.add_locator_handler(button, button.click)
        page.wait_until(is_started_again, timeout=60)
        page.wait_until(runs_again, timeout=240)
        hold_a_key(page)
        page.page.keyboard.up("ArrowLeft")
        wait_for_stop(page)
        assert page.errors() == []
