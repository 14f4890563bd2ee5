"""What the installed nodes publish of the drive: the truth, pixel for pixel, under the header of its picture.

The truth is OpenCV's, computed here on the recording's frames; a picture is found again by its stamp.
"""

import cv2
import numpy as np
import pytest

pytestmark = pytest.mark.ros

GRAY, EDGE = "image_gray_processor", "image_edge_detection"


@pytest.fixture
def drive():
    from imgproc_course.recording import open_recording

    with open_recording("drive") as recording:
        yield recording


@pytest.fixture
def play(session, drive):
    """Plays the drive with the stamps of its recording, so that each picture is known again."""
    from imgproc_course.ros import open_camera

    with open_camera(speed=2.0, stamps="recorded") as camera:
        yield camera


def truths(frame):
    gray = cv2.cvtColor(frame, cv2.COLOR_BGR2GRAY)
    edges = cv2.Canny(gray, 50, 150)
    thrice = [cv2.cvtColor(picture, cv2.COLOR_GRAY2BGR) for picture in (gray, edges)]
    return {"gray": gray, "edges": edges, "view": np.hstack([frame, *thrice])}


def assert_true(ear, output, drive, tools):
    """Every message of the ear is the drive's picture of its stamp, processed. Returns how many pixels."""
    numbers = {int(stamp): k for k, stamp in enumerate(drive.stamps)}
    compared = 0
    for message in list(ear.messages):
        k = numbers[tools.nanoseconds(message)]
        expected = truths(drive.frame(k))[output]
        assert message.header.frame_id == drive.message(k).header.frame_id == "camera_front"
        assert message.encoding == ("bgr8" if output == "view" else "mono8")
        assert (message.height, message.width) == expected.shape[:2]
        differing = int((tools.pixels(message) != expected).sum())
        assert differing == 0, f"{differing} values differ in picture {k}"
        compared += expected.size
    return compared


def different_pictures(ears):
    return min(len(set(ear.stamps())) for ear in ears)


def test_gray_of_the_drive(start_node, listen, play, drive, tools, wait_until):
    process = start_node(GRAY)
    ear = listen(f"/{GRAY}/gray")
    wait_until(lambda: different_pictures([ear]) >= 30)
    assert process.leave() == 0
    assert assert_true(ear, "gray", drive, tools) >= 30 * 1280 * 720


def test_gray_edges_and_view_of_the_drive(start_node, listen, play, drive, tools, wait_until):
    process = start_node(EDGE)
    ears = {output: listen(f"/{EDGE}/{output}") for output in ("gray", "edges", "view")}
    wait_until(lambda: different_pictures(ears.values()) >= 10)
    assert process.leave() == 0
    for output, ear in ears.items():
        assert assert_true(ear, output, drive, tools) >= 10 * 1280 * 720


def test_a_compressed_topic_is_read_as_such_where_it_is_remapped_to(
    start_node, listen, play, drive, tools, wait_until
):
    process = start_node(GRAY, "-r", f"{tools.topic}:={tools.topic}/compressed")
    process.wait_for(rf"listening to {tools.topic}/compressed \(CompressedImage\)")
    ear = listen(f"/{GRAY}/gray")
    wait_until(lambda: different_pictures([ear]) >= 10)
    assert play.published == 0  # nobody asked for raw pictures
    assert process.leave() == 0
    assert assert_true(ear, "gray", drive, tools) >= 10 * 1280 * 720


def test_both_nodes_in_a_namespace_and_under_another_name(start_node, listen, camera, tools):
    gray = start_node(GRAY, "-r", "__ns:=/robot", "-r", "__node:=mono")
    edge = start_node(EDGE, "-r", "__ns:=/robot", "-p", "low:=20", "-p", "high:=60")
    ears = listen("/robot/mono/gray"), listen(f"/robot/{EDGE}/edges")
    frame = tools.picture(1)
    answers = [camera.get_answer(ear, tools.image(frame)) for ear in ears]
    expected = cv2.cvtColor(frame, cv2.COLOR_BGR2GRAY)
    assert (tools.pixels(answers[0]) == expected).all()
    assert (tools.pixels(answers[1]) == cv2.Canny(expected, 20, 60)).all()
    assert (gray.leave(), edge.leave()) == (0, 0)
