"""ImageProcessor in a notebook's session: what is asked of `process`, what becomes of its errors."""

import json
import re
import threading

import numpy as np
import pytest

pytestmark = pytest.mark.ros

TOPIC = "/kachaka/front_camera/image_raw"


@pytest.fixture
def make_node(session):
    """Makes an ImageProcessor that the session spins."""

    def make(process, outputs=("gray",), **options):
        from imgproc_course.ros import ImageProcessor

        node = ImageProcessor("learner", process, outputs, context=session.context, **options)
        return session.add_node(node)

    return make


@pytest.fixture
def publish(session):
    """Publishes a frame on the camera's topic, with a stamp that counts from 1."""
    from rclpy.qos import qos_profile_sensor_data
    from sensor_msgs.msg import Image
    from std_msgs.msg import Header

    from imgproc_course.messages import array_to_image

    publisher = session.node.create_publisher(Image, TOPIC, qos_profile_sensor_data)
    sent = []

    def send(frame, encoding="bgr8"):
        sent.append(1)
        header = Header(frame_id="camera_front")
        header.stamp.sec = len(sent)
        publisher.publish(array_to_image(frame, encoding, header))
        return len(sent)

    send.publisher = publisher
    return send


@pytest.fixture
def ear(session):
    from rclpy.qos import qos_profile_sensor_data
    from sensor_msgs.msg import Image

    def listen(topic="/learner/gray"):
        messages = []
        session.node.create_subscription(Image, topic, messages.append, qos_profile_sensor_data)
        return messages

    return listen


FRAME = np.arange(4 * 6 * 3, dtype=np.uint8).reshape(4, 6, 3)


def send_until(condition, publish, wait_until, frame=FRAME, encoding="bgr8"):
    def answered():
        if condition():
            return True
        publish(frame, encoding)
        return wait_a_little(condition)

    def wait_a_little(condition):
        return threading.Event().wait(0.03) or condition()

    wait_until(answered)


def test_the_frame_is_bgr_and_may_be_drawn_on_whatever_the_camera_sends(make_node, publish, ear, wait_until):
    def process(frame):
        before = frame.copy()
        frame[:] = 0
        return {"gray": before}

    make_node(process)
    messages = ear()
    for frame, encoding in ((FRAME, "bgr8"), (FRAME[..., ::-1].copy(), "rgb8")):
        messages.clear()
        send_until(lambda: messages, publish, wait_until, frame, encoding)
        assert bytes(messages[-1].data) == FRAME.tobytes()
        assert (messages[-1].encoding, messages[-1].header.frame_id) == ("bgr8", "camera_front")


@pytest.mark.parametrize(
    "result, encoding",
    [
        (np.full((2, 3), 7, np.uint8), "mono8"),
        (np.full((2, 3, 3), 7, np.uint8), "bgr8"),
        (np.full((2, 3), 0.5, np.float32), "32FC1"),
        (np.full((2, 3), 700, np.uint16), "16UC1"),
    ],
    ids=["mono8", "bgr8", "32FC1", "16UC1"],
)
def test_what_process_returns_is_published_as_what_it_is(
    make_node, publish, ear, wait_until, result, encoding
):
    make_node(lambda frame: {"gray": result})
    messages = ear()
    send_until(lambda: messages, publish, wait_until)
    assert (messages[0].encoding, messages[0].height, messages[0].width) == (encoding, 2, 3)
    assert bytes(messages[0].data) == result.tobytes()


def divides_by_zero(frame):
    return {"gray": 1 // 0}


def stops(frame):
    raise StopIteration


@pytest.mark.parametrize(
    "process, said",
    [
        (divides_by_zero, r"process failed in line \d+ of test_processor.py \(return .* 1 // 0\}\): ZeroDiv"),
        (stops, r"process failed in line \d+ of test_processor.py \(raise StopIteration\): StopIteration"),
        (lambda frame: frame, r"must return a dict with the keys \['gray'\], and returned a ndarray"),
        (lambda frame: {"grey": frame}, r"keys \['gray'\], and returned \['grey'\]"),
        (lambda frame: {"gray": None}, r"process returned no picture: expected a NumPy array, got None"),
        (lambda frame: {"gray": lambda: 1 // 0}, r"process failed in line \d+ .*: ZeroDivisionError"),
        (lambda: {}, r"process failed .*: TypeError: .*takes 0 positional arguments but 1 was given"),
    ],
)
def test_a_mistake_of_the_learners_is_counted_and_said_and_the_node_goes_on(
    make_node, publish, ear, wait_until, process, said
):
    node = make_node(process)
    messages = ear()
    send_until(lambda: node.statistics()["failed"] >= 2, publish, wait_until)
    assert re.search(said, node.statistics()["last_error"])
    node._process = lambda frame: {"gray": frame}
    send_until(lambda: messages, publish, wait_until)
    numbers = node.statistics()
    assert numbers["received"] == numbers["processed"] + numbers["failed"] + numbers["unheard"]


def test_only_what_somebody_hears_is_computed(make_node, publish, ear, wait_until):
    asked = []

    def output(key):
        def compute():
            asked.append(key)
            return FRAME

        return compute

    node = make_node(lambda frame: {key: output(key) for key in ("gray", "view")}, ("gray", "view"))
    send_until(lambda: node.statistics()["unheard"] >= 2, publish, wait_until)
    assert asked == []
    messages = ear("/learner/view")
    send_until(lambda: messages, publish, wait_until)
    assert set(asked) == {"view"}


def test_of_pictures_that_wait_the_oldest_are_dropped_first(session, wait_until):
    """Twenty pictures come while the first is processed: then come the last five, in order."""
    from rclpy.context import Context
    from rclpy.executors import SingleThreadedExecutor

    from imgproc_course.messages import array_to_image
    from imgproc_course.ros import ImageProcessor

    context = Context()
    context.init()
    begun, go_on, seen = threading.Event(), threading.Event(), []

    def process(frame):
        begun.set()
        go_on.wait(30)
        seen.append(int(frame[0, 0, 0]))
        return {"gray": frame}

    node = ImageProcessor("slow", process, ["gray"], context=context)
    executor = SingleThreadedExecutor(context=context)
    executor.add_node(node)
    from rclpy.qos import qos_profile_sensor_data
    from sensor_msgs.msg import Image

    camera = session.node.create_publisher(Image, TOPIC, qos_profile_sensor_data)
    messages = []
    session.node.create_subscription(Image, "/slow/gray", messages.append, qos_profile_sensor_data)
    heard = node._publishers_of["gray"].get_subscription_count
    wait_until(
        lambda: heard() and camera.get_subscription_count() and node._subscription.get_publisher_count()
    )
    leaving = threading.Event()

    def spin():
        while not leaving.is_set():
            executor.spin_once(timeout_sec=0.05)

    thread = threading.Thread(target=spin)
    thread.start()
    try:
        camera.publish(array_to_image(np.full((2, 2, 3), 100, np.uint8), "bgr8"))
        assert begun.wait(30)
        for k in range(20):
            camera.publish(array_to_image(np.full((2, 2, 3), k, np.uint8), "bgr8"))
        # What was published has arrived when a later one, on a way of its own, has.
        arrived = []
        session.node.create_subscription(Image, TOPIC, arrived.append, qos_profile_sensor_data)
        last = array_to_image(np.full((2, 2, 3), 19, np.uint8), "bgr8")
        wait_until(lambda: (camera.publish(last), arrived)[1])
        go_on.set()
        wait_until(lambda: len(seen) >= 6)
        numbers = node.statistics()
    finally:
        leaving.set()
        go_on.set()
        thread.join()
        executor.shutdown()
        node.destroy_node()
        context.try_shutdown()
    assert seen[0] == 100
    assert seen[-1] == 19 and seen[1:] == sorted(seen[1:])
    assert len(seen) == 6 and numbers["lost"] >= 15


def test_settings_reach_process_and_a_check_refuses_what_does_not_go_together(
    make_node, publish, ear, wait_until
):
    from rclpy.parameter import Parameter

    from imgproc_course.ros import Setting

    def check(gain, offset):
        if gain * 100 + offset > 255:
            raise ValueError(f"gain {gain} and offset {offset} leave the range")

    seen = []

    def process(frame, gain, offset):
        seen.append((gain, offset))
        return {"gray": frame}

    settings = [Setting("gain", 1.0, 0, 4, "times"), Setting("offset", 5, 0, 255, "gray levels")]
    node = make_node(process, settings=settings, check=check)
    messages = ear()
    send_until(lambda: messages, publish, wait_until)
    assert set(seen) == {(1.0, 5)}
    refused = node.set_parameters_atomically([Parameter("gain", value=3), Parameter("offset", value=6)])
    assert (refused.successful, refused.reason) == (False, "gain 3.0 and offset 6 leave the range")
    assert node.set_parameters_atomically(
        [Parameter("gain", value=2), Parameter("offset", value=6)]
    ).successful
    seen.clear()
    messages.clear()
    send_until(lambda: len(messages) >= 2, publish, wait_until)
    assert seen[-1] == (2.0, 6) and isinstance(seen[-1][0], float)


def test_first_values_that_do_not_go_together_are_refused(session):
    from imgproc_course.ros import ImageProcessor, Setting

    def check(low):
        raise ValueError("never")

    with pytest.raises(ValueError, match="never"):
        ImageProcessor(
            "refused",
            print,
            ["gray"],
            settings=[Setting("low", 1, 0, 2, "")],
            check=check,
            context=session.context,
        )


def test_display_in_a_notebook_is_refused_because_windows_need_the_main_thread(make_node):
    from rclpy.parameter import Parameter

    node = make_node(lambda frame: {"gray": frame})
    result = node.set_parameters_atomically([Parameter("display", value=True)])
    assert not result.successful
    assert result.reason.startswith("display needs a process of the node's own (ros2 run)")


def test_statistics_are_published_while_somebody_listens(session, make_node, publish, ear, wait_until):
    from std_msgs.msg import String

    node = make_node(lambda frame: {"gray": frame})
    heard, messages = [], ear()
    session.node.create_subscription(String, "/learner/statistics", heard.append, 1)
    send_until(lambda: len(messages) >= 3, publish, wait_until)
    wait_until(lambda: heard and json.loads(heard[-1].data)["processed"] >= 3)
    numbers = json.loads(heard[-1].data)
    assert numbers.keys() == node.statistics().keys()
    median, slowest = numbers["latency_ms"]
    assert 0 < median <= slowest and numbers["process_ms"][0] <= median
    assert (numbers["failed"], numbers["lost"], numbers["last_error"]) == (0, 0, None)


SHOWS = """
import threading, time
import numpy as np
import imgproc_course.ros.processor as processor
from imgproc_course.messages import array_to_image
from imgproc_course.ros import ImageProcessor, RosSession, run_processor
from rclpy.qos import qos_profile_sensor_data
from sensor_msgs.msg import Image

shown = []
def show(pictures):
    if pictures:
        names = sorted(pictures), threading.current_thread() is threading.main_thread()
        print(*names, {title: picture.tolist() for title, picture in pictures.items()}, flush=True)
        raise KeyboardInterrupt
processor.window_problem = lambda: None
processor.show_windows = show
processor.close_windows = lambda: print("closed", flush=True)

session = RosSession.current()
camera = session.node.create_publisher(Image, processor.TOPIC, qos_profile_sensor_data)
def play():
    camera.publish(array_to_image(np.full((1, 2, 3), 9, np.uint8), "bgr8"))
session.node.create_timer(0.05, play)
def make():
    process = lambda frame: {"gray": frame[..., 0], "view": lambda: frame}
    node = ImageProcessor("shows", process, ["gray", "view"])
    return node
raise SystemExit(run_processor(make, ["--ros-args", "-p", "display:=true"]))
"""


def test_windows_show_every_output_in_the_main_thread_and_are_closed(run_python):
    code, out, err = run_python(SHOWS)
    assert code == 0, err
    assert out.splitlines() == [
        "['/shows/gray', '/shows/view'] True "
        "{'/shows/gray': [[9, 9]], '/shows/view': [[[9, 9, 9], [9, 9, 9]]]}",
        "closed",
    ]
    assert "Traceback" not in err


def test_an_opencv_that_fails_to_show_switches_display_off_and_the_node_goes_on(run_python):
    fails = SHOWS.replace(
        "        raise KeyboardInterrupt\n", "        import cv2; raise cv2.error('the screen is gone')\n"
    )
    leave = """
    def leave_when_off():
        import os, signal
        if not node.get_parameter("display").value: os.kill(os.getpid(), signal.SIGTERM)
    node.create_timer(0.1, leave_when_off)
    return node
"""
    ends = fails.replace("    return node\n", leave)
    code, out, err = run_python(ends)
    assert (code, out.count("True"), out.splitlines()[1:]) == (0, 1, ["closed"]), err
    assert "OpenCV cannot show the pictures" in err and "display is switched off" in err
    assert "Traceback" not in err


def test_no_screen_is_no_crash(monkeypatch):
    from imgproc_course.ros import windows

    monkeypatch.setenv("DISPLAY", ":77")
    monkeypatch.delenv("WAYLAND_DISPLAY", raising=False)
    # As OpenCV's window library does where no screen answers: it ends the process.
    monkeypatch.setattr(windows, "_PROBE", "import os; os.abort()")
    assert windows.window_problem() == (
        "display needs a screen, and none answers (DISPLAY is :77); start the node on a desktop"
    )
    monkeypatch.setattr(windows, "_PROBE", "pass")
    assert windows.window_problem() is None
    monkeypatch.setattr(windows, "PATIENCE", 0.2)
    monkeypatch.setattr(windows, "_PROBE", "import time; time.sleep(60)")
    assert windows.window_problem() == "display needs a screen, and none has answered for 0.2 s"


LEAVES = """
import os, signal
from imgproc_course.ros.processor import _Leaving
leaving = _Leaving()
print(leaving())
for number in (signal.SIGINT, signal.SIGTERM):
    os.kill(os.getpid(), number)
    print(leaving(), flush=True)
os.kill(os.getpid(), signal.SIGINT)
"""


def test_two_signals_wait_for_the_picture_at_hand_and_the_third_does_not(run_python):
    code, out, err = run_python(LEAVES)
    assert (code, out.split()) == (-2, ["False", "True", "True"])
    assert err.splitlines()[-1] == "KeyboardInterrupt"
