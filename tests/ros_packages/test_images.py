"""What ImageProcessors publish for the drive: the right pixels, with the header of the source image.

The expected pixels are OpenCV's, computed here from the recording's frames; the stamp identifies the frame.
"""

import cv2
import numpy as np
import pytest

pytestmark = pytest.mark.ros

GRAY, EDGE = "image_gray_processor", "image_edge_detection"


@pytest.fixture
def play(session, drive):
    """Plays the drive with the stamps of its recording, so that each image can be identified."""
    from imgproc_course.ros import open_camera

    with open_camera(speed=2.0, stamps="recorded") as camera:
        yield camera


def expected_outputs(frame):
    gray = cv2.cvtColor(frame, cv2.COLOR_BGR2GRAY)
    edges = cv2.Canny(gray, 50, 150)
    with_channels = [cv2.cvtColor(image, cv2.COLOR_GRAY2BGR) for image in (gray, edges)]
    return {"gray": gray, "edges": edges, "view": np.hstack([frame, *with_channels])}


def compare_with_drive(collector, output, drive, tools):
    """Asserts that each message is the output for the frame of its stamp. Returns the number of pixels."""
    numbers = {int(stamp): k for k, stamp in enumerate(drive.stamps)}
    compared = 0
    for message in list(collector.messages):
        k = numbers[tools.nanoseconds(message)]
        expected = expected_outputs(drive.frame(k))[output]
        assert message.header.frame_id == drive.message(k).header.frame_id == "camera_front"
        assert message.encoding == ("bgr8" if output == "view" else "mono8")
        assert (message.height, message.width) == expected.shape[:2]
        differing = int((tools.pixels(message) != expected).sum())
        assert differing == 0, f"{differing} values differ in frame {k}"
        compared += expected.size
    return compared


def distinct_images(collectors):
    return min(len(set(collector.stamps())) for collector in collectors)


def test_gray_edges_and_view_of_the_drive(start_node, collect, play, drive, tools, wait_until):
    process = start_node(EDGE)
    collectors = {output: collect(f"/{EDGE}/{output}") for output in ("gray", "edges", "view")}
    wait_until(lambda: distinct_images(collectors.values()) >= 10)
    assert process.leave() == 0
    for output, collector in collectors.items():
        assert compare_with_drive(collector, output, drive, tools) >= 10 * 1280 * 720


def test_a_topic_remapped_to_a_compressed_one_is_read_as_compressed(
    start_node, collect, play, drive, tools, wait_until
):
    process = start_node(GRAY, "-r", f"{tools.topic}:={tools.topic}/compressed")
    process.wait_for(rf"subscribed to {tools.topic}/compressed \(CompressedImage\)")
    collector = collect(f"/{GRAY}/gray")
    wait_until(lambda: distinct_images([collector]) >= 10)
    assert play.published == 0  # the raw topic had no subscriber
    assert process.leave() == 0
    assert compare_with_drive(collector, "gray", drive, tools) >= 10 * 1280 * 720
