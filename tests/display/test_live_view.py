"""The live view's thread, without a browser: what it shows, what it survives, when it stops."""

import sys
import threading

import cv2
import numpy as np
import pytest

from imgproc_course.display import live_view

module = sys.modules["imgproc_course.display.live_view"]
PATIENCE = 60


class Drive:
    """Replaces a Recording: frame k has the gray level 10 k."""

    rate = 100.0

    def __init__(self, count=10):
        self.requests = []
        self._count = count

    def __len__(self):
        return self._count

    def frame(self, k, encoding="bgr8"):
        self.requests.append((k, encoding))
        return np.full((72, 128, 3), 10 * k, np.uint8)


class Subscriber:
    """Replaces an ImageSubscriber."""

    topic = "/camera"

    def __init__(self, frames=()):
        self.frames, self.stopped = list(frames), False

    def latest(self):
        return None

    def wait(self, timeout):
        if self.frames:
            return self.frames.pop(0)
        raise TimeoutError("nothing came on /camera: nobody publishes it; call open_camera()")

    def stop(self):
        self.stopped = True


@pytest.fixture
def make_view(monkeypatch):
    """A function that makes a live view; the view behaves as if a browser replied."""
    views = []
    monkeypatch.setattr(module, "WITHOUT_BROWSER", 0.0)
    monkeypatch.setattr(module, "display", lambda output: None)

    def make(*arguments, **options):
        view = live_view(*arguments, **options)
        views.append(view)
        return view

    yield make
    for view in views:
        view.stop()


def until(condition):
    """Waits until a condition of another thread holds."""
    pause = threading.Event()
    for _ in range(PATIENCE * 100):
        if condition():
            return
        pause.wait(0.01)
    raise AssertionError(f"did not happen within {PATIENCE} s")


def decoded(view):
    return cv2.imdecode(np.frombuffer(view._screen.image.value, np.uint8), cv2.IMREAD_COLOR)


def message(view):
    return view._screen._message.value


def test_frames_of_a_recording_are_processed_and_shown(make_view):
    levels, drive = [], Drive(25)
    drive.rate = 5.0  # a busy machine may need a second between two frames; the drive begins again after 5
    view = make_view(drive, lambda frame: (levels.append(int(frame[0, 0, 0])), 255 - frame)[1])
    until(lambda: view.shown >= 3)
    view.stop()
    assert levels[:3] == sorted(levels[:3])
    assert decoded(view).shape == (360, 640, 3)
    assert abs(int(decoded(view)[5, 5, 0]) - (255 - levels[-1])) <= 2
    assert (view.value == 255 - levels[-1]).all()
    assert view.error is None


def test_a_recording_repeats_in_the_given_encoding(make_view):
    drive = Drive(3)
    view = make_view(drive, encoding="rgb8")
    until(lambda: view.shown >= 8)
    assert {k for k, _ in drive.requests} == {0, 1, 2}
    assert {encoding for _, encoding in drive.requests} == {"rgb8"}


def test_a_recording_of_one_frame_is_shown(make_view):
    drive = Drive(1)
    drive.rate = 0.0  # as a Recording says it
    view = make_view(drive)
    until(lambda: view.shown)
    assert (view.error, {k for k, _ in drive.requests}) == (None, {0})


@pytest.mark.parametrize(("encoding", "blue_green_red"), [("bgr8", (250, 0, 0)), ("rgb8", (0, 0, 250))])
def test_colours_follow_the_encoding(make_view, encoding, blue_green_red):
    colour = np.full((72, 128, 3), (250, 0, 0), np.uint8)
    view = make_view(Drive(), lambda frame: colour, encoding=encoding)
    until(lambda: view.shown)
    assert abs(decoded(view)[9, 9].astype(int) - blue_green_red).max() <= 4


def test_several_results_are_shown_side_by_side_with_their_titles(make_view):
    def both(frame):
        return {"dark & cold": np.zeros((72, 128), np.uint8), "edges": np.ones((72, 128), bool)}

    view = make_view(Drive(), both)
    until(lambda: view.shown)
    image = decoded(view)
    assert image.shape[1] == pytest.approx(960, abs=2)
    assert image[100, 100].tolist() == [0, 0, 0]
    assert image[100, 800].tolist() == [255, 255, 255]
    assert "dark &amp; cold" in view._screen._titles.value
    assert view._screen.image.height == str(image.shape[0])


def test_sliders_reach_the_function_while_it_runs(make_view):
    calls = []

    def edges(frame, low=100, high=200):
        calls.append((low, high))
        return frame

    view = make_view(Drive(), edges, thresholds=(0, 1020))
    until(lambda: calls)
    view._controls["thresholds"].value = (7, 9)
    until(lambda: calls[-1] == (7, 9))
    assert view.parameters == {"low": 7, "high": 9}
    assert view.call == "edges(frame, low=7, high=9)"
    view.reset()
    until(lambda: calls[-1] == (100, 200))


def test_an_exception_is_shown_with_the_learners_line_and_the_view_goes_on(make_view):
    broken = threading.Event()
    broken.set()

    def edges(frame):
        if broken.is_set():
            raise KeyError("<no such key>")
        return frame

    view = make_view(Drive(), edges)
    until(lambda: "KeyError" in message(view))
    assert "&lt;no such key&gt;" in message(view)
    assert "in edges, line" in message(view)
    assert "raise KeyError(" in message(view)
    assert isinstance(view.error, KeyError)
    assert view.shown == 0
    broken.clear()
    until(lambda: view.shown >= 2)
    assert view.error is None
    assert "KeyError" not in message(view)


@pytest.mark.parametrize(
    ("result", "error"),
    [
        (None, "returned None; it must end with `return`"),
        ([], "returned no image"),
        (
            np.zeros((4, 4)),
            "the result has dtype float64: give the values of black and white, for example limits=",
        ),
        (np.zeros((4, 4, 2), np.uint8), r"shape (4, 4, 2)"),
        ("edges", "the result is str, not an array"),
    ],
)
def test_a_result_that_is_not_an_image_is_reported(make_view, result, error):
    view = make_view(Drive(), lambda frame: result)
    until(lambda: error in message(view).replace("&#x27;", "'"))


def test_limits_show_a_signed_result(make_view):
    view = make_view(Drive(), lambda frame: np.full((72, 128), -1020, np.int16), limits=(-1020, 1020))
    until(lambda: view.shown)
    assert decoded(view)[9, 9].tolist() == [0, 0, 0]


def test_sys_exit_in_the_function_does_not_stop_the_view(make_view):
    view = make_view(Drive(), lambda frame: sys.exit("bye"))
    until(lambda: "SystemExit: bye" in message(view))
    assert view.running


def test_drawing_on_a_read_only_frame_names_the_remedy(make_view):
    def draw(frame):
        frame = frame.copy()
        frame.flags.writeable = False
        return cv2.rectangle(frame, (1, 1), (5, 5), (0, 0, 255))

    view = make_view(Drive(), draw)
    until(lambda: "draw on frame.copy()" in message(view))


def test_a_silent_topic_is_reported_and_the_view_goes_on(make_view):
    subscriber = Subscriber()
    view = make_view(subscriber)
    until(lambda: "call open_camera()" in message(view))
    assert view._status.value == "0.0 frames/s"
    subscriber.frames.append(np.zeros((72, 128, 3), np.uint8))
    until(lambda: view.shown == 1)
    view.stop()
    assert not subscriber.stopped  # it is the learner's own


def test_a_source_that_fails_is_reported(make_view):
    class Broken(Drive):
        def frame(self, k, encoding="bgr8"):
            raise RuntimeError("the disk is gone")

    view = make_view(Broken())
    until(lambda: "RuntimeError: the disk is gone" in message(view))
    assert view.running


def test_stop_start_and_stop_twice(make_view):
    thread_count = threading.active_count()
    view = make_view(Drive())
    until(lambda: view.shown)
    view.stop()
    view.stop()
    assert not view.running
    assert threading.active_count() == thread_count
    shown = view.shown
    view.start()
    view.start()
    until(lambda: view.shown > shown)
    view.stop()
    assert threading.active_count() == thread_count


def test_a_snapshot_has_frame_result_and_file(make_view, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    view = make_view(Drive(), lambda frame: np.full((72, 128), 77, np.uint8))
    until(lambda: view.shown)
    view.stop()
    first, second = view.snapshot(), view.snapshot()
    assert [first.path.name, second.path.name] == ["snapshot-001.png", "snapshot-002.png"]
    assert (cv2.imread(str(first.path), cv2.IMREAD_UNCHANGED) == 77).all()
    assert first.frame.shape == (72, 128, 3)
    assert view.snapshots[0].result.max() == 77
    assert ".snapshots[1] and snapshot-002.png" in message(view)


def test_snapshot_survives_a_folder_that_cannot_be_written(make_view, monkeypatch):
    def refuse(image):
        raise OSError("Read-only file system")

    monkeypatch.setattr(module, "_save", refuse)
    view = make_view(Drive())
    until(lambda: view.shown)
    assert view.snapshot().path is None
    assert "no file was written: Read-only file system" in message(view)


def test_running_the_same_cell_again_stops_its_earlier_view(make_view, monkeypatch):
    cell = [("cell-a", 1)]
    monkeypatch.setattr(module, "_running_cell", lambda: cell[0])
    first, neighbour = make_view(Drive()), make_view(Drive())
    cell[0] = ("cell-b", 2)
    view_of_cell_b = make_view(Drive())
    assert first.running and neighbour.running and view_of_cell_b.running
    cell[0] = ("cell-a", 3)
    second_run = make_view(Drive())
    assert [view.running for view in (first, neighbour, view_of_cell_b, second_run)] == [
        False,
        False,
        True,
        True,
    ]


def test_it_pauses_while_no_page_shows_it(make_view):
    view = make_view(Drive())
    until(lambda: view.shown)
    view._screen.image._view_count = 1
    view._screen.image._view_count = 0
    until(lambda: view._hidden)

    def shows_nothing_new():
        shown = view.shown
        threading.Event().wait(0.3)
        return view.shown == shown

    until(shows_nothing_new)  # one frame may be on its way when the page disappears
    shown = view.shown
    view._screen.image._view_count = 1
    until(lambda: view.shown > shown)


def test_without_a_browser_a_view_shows_one_frame_per_second(monkeypatch):
    monkeypatch.setattr(module, "display", lambda output: None)
    clock = [100.0]
    monkeypatch.setattr(module.time, "monotonic", lambda: clock[0])
    pacer = module._Pacer()
    assert pacer.interval() == module.WITHOUT_REPLY  # the cell that began the view may still run
    clock[0] += module.NO_BROWSER_AFTER
    assert pacer.interval() == module.WITHOUT_BROWSER
    pacer._reply.value = 1
    assert pacer.interval() == pytest.approx(0.85 / 30)


def test_a_browser_that_falls_behind_gets_fewer_frames(monkeypatch):
    clock = [100.0]
    monkeypatch.setattr(module.time, "monotonic", lambda: clock[0])
    pacer = module._Pacer()
    pacer._reply.value = 1
    intervals = []
    for _ in range(8):
        clock[0] += 1
        pacer.ping()
        clock[0] += 0.6
        pacer._reply.value = pacer._ping.value
        intervals.append(pacer.interval())
    assert intervals == sorted(intervals)
    assert intervals[-1] > 4 * intervals[0]
    pacer.ping()
    clock[0] += 1.1
    assert pacer.interval() == module.WITHOUT_REPLY  # no reply at all
    pacer._reply.value = pacer._ping.value
    for _ in range(12):
        clock[0] += 1
        pacer.ping()
        pacer._reply.value = pacer._ping.value
    assert pacer.interval() == pytest.approx(0.85 / 30)


@pytest.mark.parametrize(
    ("arguments", "options", "error"),
    [
        ((np.zeros((4, 4)),), {}, "cannot show ndarray live; expected a Camera"),
        (("recording",), {}, r'call live_view\(open_camera\("recording"\)\)'),
        (("drive",), {}, r'call live_view\(open_recording\("drive"\)\)'),
        ((Drive(0),), {}, "has no camera image"),
        ((Drive(), 5), {}, "process is int; expected a function"),
        ((Drive(),), {"low": (0, 5)}, "low: sliders need a function"),
        ((Drive(), lambda frame: frame), {"low": (0, 5)}, "has no parameter 'low'"),
    ],
)
def test_a_source_that_is_not_live_is_an_error_at_once(arguments, options, error):
    with pytest.raises(ValueError, match=error):
        live_view(*arguments, **options)


def test_the_stored_output_is_the_same_in_every_run(monkeypatch, tmp_path):
    stored = []
    (tmp_path / "texts").mkdir()
    (tmp_path / "texts" / "brakes.json").write_text('{"drive": {"caption": "A <drive>.", "alt": "A robot"}}')
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(module, "display", lambda output: stored.append(output._repr_mimebundle_()))
    for _ in range(2):
        view = live_view(Drive(), text="brakes/drive")
        view.stop()
        assert view._screen.image.tooltip == "A robot"
    for bundle in stored:
        assert bundle.pop("application/vnd.jupyter.widget-view+json")["version_major"] == 2
    assert (
        stored[0]
        == stored[1]
        == {
            "text/plain": "Live view: A <drive>.",
            "text/html": "<p>Live view: A &lt;drive&gt;. It moves when this cell is run.</p>",
        }
    )


@pytest.mark.ros
def test_a_view_subscribes_to_a_topic_or_camera_and_unsubscribes(make_view):
    from imgproc_course.ros import open_camera

    with open_camera(speed=3.0) as camera:
        for source in (camera, camera.topic):
            view = make_view(source, lambda frame: cv2.Canny(frame, 100, 200))
            until(lambda view=view: view.shown >= 3)
            assert view.value.shape == (720, 1280)
            assert set(np.unique(view.value)) == {0, 255}
            assert view.error is None
            view.stop()
            until(lambda: set(camera.subscribers().values()) == {0})
