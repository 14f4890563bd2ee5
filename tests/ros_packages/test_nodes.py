"""The installed executables of both packages: what their plain nodes publish, and how they end."""

import signal

import cv2
import pytest

pytestmark = pytest.mark.ros

GRAY, EDGE = "image_gray_processor", "image_edge_detection"
NODES = {GRAY: "gray", EDGE: "edges"}


def output_of(name, frame, low=50, high=150):
    gray = cv2.cvtColor(frame, cv2.COLOR_BGR2GRAY)
    return gray if name == GRAY else cv2.Canny(gray, low, high)


@pytest.mark.parametrize("name", NODES)
def test_every_image_gives_its_result_with_the_header_and_a_bad_one_is_logged(
    name, start_executable, collect, camera, tools
):
    process = start_executable(name)
    collector, before = collect(f"/{name}/{NODES[name]}"), camera.stamp
    frame = tools.make_frame(3)
    camera.get_result(collector, tools.message_of(frame))
    cut = tools.message_of(frame)
    cut.data = cut.data[:100]
    for _ in range(3):  # best effort may lose some
        camera.send(cut)
    frame = tools.make_frame(4)
    result = camera.get_result(collector, tools.message_of(frame))
    expected = output_of(name, frame)
    assert (tools.pixels(result) == expected).all() and expected.std() > 0
    assert result.header.frame_id == "camera_front"
    assert before < tools.nanoseconds(result) <= camera.stamp
    process.wait_for(r"\[ERROR\].*got 100")
    assert process.leave(signal.SIGINT) == 0
    assert "Traceback" not in process.output


def test_new_thresholds_count_from_the_next_image_on(start_executable, parameters_of, collect, camera, tools):
    process = start_executable(EDGE, "-p", "low:=20")
    collector, frame = collect(f"/{EDGE}/edges"), tools.contrasts()
    parameters = parameters_of(EDGE)
    assert parameters.get("low", "high") == [20, 150]
    result = camera.get_result(collector, tools.message_of(frame))
    assert (tools.pixels(result) == output_of(EDGE, frame, 20, 150)).all()
    assert parameters.set(low=300, high=600) == (True, "")
    result = camera.get_result(collector, tools.message_of(frame))
    assert (tools.pixels(result) == output_of(EDGE, frame, 300, 600)).all()
    assert (output_of(EDGE, frame, 300, 600) != output_of(EDGE, frame, 20, 150)).any()
    assert process.leave() == 0


def test_a_remapped_node_in_a_namespace(start_executable, collect, camera, tools):
    process = start_executable(GRAY, "-r", "__ns:=/robot", "-r", "__node:=mono")
    frame = tools.make_frame(1)
    result = camera.get_result(collect("/robot/mono/gray"), tools.message_of(frame))
    assert (tools.pixels(result) == output_of(GRAY, frame)).all()
    assert process.leave() == 0
