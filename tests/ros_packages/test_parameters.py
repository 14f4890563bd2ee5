"""The parameters of an ImageProcessor: described, changed while images arrive, all of a request or none."""

import cv2
import pytest

pytestmark = pytest.mark.ros

EDGE = "image_edge_detection"


@pytest.fixture
def gray_of(tools):
    return lambda frame: cv2.cvtColor(frame, cv2.COLOR_BGR2GRAY)


@pytest.fixture
def node(start_node):
    process = start_node(EDGE)
    yield process
    assert process.leave() == 0


@pytest.fixture
def parameters(node, parameters_of):
    return parameters_of(EDGE)


def test_each_parameter_has_a_range_and_a_description(parameters):
    low, high, sigma = parameters.describe("low", "high", "sigma")
    for threshold in (low, high):
        [limits] = threshold.integer_range
        assert (limits.from_value, limits.to_value) == (0, 1530)
        assert "a pixel above it is " in threshold.description and "4 h" in threshold.description
    [limits] = sigma.floating_point_range
    assert (limits.from_value, limits.to_value) == (0.0, 10.0)
    assert "pixels" in sigma.description
    assert parameters.get("low", "high", "sigma") == [50, 150, 0.0]


def test_thresholds_changed_in_mid_stream_take_effect_together(
    parameters, collect, camera, tools, gray_of, wait_until
):
    frame = tools.contrasts()
    gray, message = gray_of(frame), tools.message_of(frame)
    before, after, mixed = (cv2.Canny(gray, *pair) for pair in ((50, 150), (300, 600), (50, 600)))
    assert (before != after).any() and (before != mixed).any() and (after != mixed).any()
    collector = collect(f"/{EDGE}/edges")
    camera.send_until(lambda: len(collector.messages) >= 5, message)
    assert parameters.set(low=300, high=600) == (True, "")
    camera.send_until(lambda: (tools.pixels(collector.messages[-1]) == after).all(), message)
    camera.send_until(lambda: len(collector.messages) >= 12, message)
    published = [tools.pixels(message) for message in list(collector.messages)]
    is_new = [bool((edges == after).all()) for edges in published]
    assert all(new or (edges == before).all() for new, edges in zip(is_new, published, strict=True))
    assert is_new == sorted(is_new)  # first the old values, then the new ones


def test_low_above_high_is_refused_with_the_reason_and_nothing_changes(
    node, parameters, collect, camera, tools, gray_of
):
    for request in ({"low": 200}, {"low": 60, "high": 40}, {"sigma": 2.0, "low": 151}):
        accepted, reason = parameters.set(**request)
        low, high = request["low"], request.get("high", 150)
        assert not accepted
        assert reason == f"low ({low}) must not be above high ({high}); set both at once, or high first"
    assert parameters.get("low", "high", "sigma") == [50, 150, 0.0]
    frame = tools.make_frame(3)
    result = camera.get_result(collect(f"/{EDGE}/edges"), tools.message_of(frame))
    assert (tools.pixels(result) == cv2.Canny(gray_of(frame), 50, 150)).all()


REFUSED = [
    ({"high": 1531}, "Parameter high out of range. Min: 0, Max: 1530, value: 1531"),
    ({"low": -1, "high": 400}, "Parameter low out of range. Min: 0, Max: 1530, value: -1"),
    ({"sigma": 10.5}, "Parameter sigma out of range Min: 0.0, Max: 10.0, value: 10.5"),
    ({"sigma": float("nan")}, "Parameter sigma out of range Min: 0.0, Max: 10.0, value: nan"),
    ({"sigma": 11}, "Parameter sigma out of range. Min: 0, Max: 10, value: 11"),
    ({"sigma": "wide"}, "sigma must be a number, got 'wide'"),
    ({"sigma": True}, "sigma must be a number, got True"),
    ({"low": 60.5}, "Wrong parameter type, expected 'Type.INTEGER' got 'Type.DOUBLE'"),
]


def test_a_bad_value_is_refused_with_the_reason(parameters):
    assert [(request, *parameters.set(**request)) for request, _ in REFUSED] == [
        (request, False, reason) for request, reason in REFUSED
    ]
    assert parameters.get("low", "high", "sigma") == [50, 150, 0.0]
    assert parameters.set(sigma=1.5, low=50) == (True, "")


def test_sigma_accepts_whole_numbers_too(parameters, collect, camera, tools, gray_of):
    assert parameters.set(sigma=2) == (True, "")
    frame = tools.make_frame(4)
    blurred = cv2.GaussianBlur(gray_of(frame), (0, 0), 2)
    expected = cv2.Canny(blurred, 50, 150)
    assert (expected != cv2.Canny(gray_of(frame), 50, 150)).any()
    result = camera.get_result(collect(f"/{EDGE}/edges"), tools.message_of(frame))
    assert (tools.pixels(result) == expected).all()


@pytest.mark.parametrize(
    "assignment, reason",
    [
        ("low:=200", r"low \(200\) must not be above high \(150\); set both at once, or high first"),
        ("sigma:=-1.0", r"Parameter sigma out of range Min: 0\.0, Max: 10\.0, value: -1\.0"),
    ],
)
def test_a_bad_initial_value_ends_the_start_in_one_line(start, tools, assignment, reason):
    process = start(*tools.processor, EDGE, "--ros-args", "-p", assignment)
    assert process.wait(60) == 2
    [line] = process.output.splitlines()
    assert line.startswith("cannot start: ")
    process.wait_for(reason)


@pytest.mark.parametrize(
    "arguments, unknown",
    [
        (["--low", "40"], "--low 40"),
        (["--ros-args", "-p", "low:=40", "--", "extra"], "extra"),
    ],
)
def test_arguments_that_ros_would_ignore_end_the_start(start, tools, arguments, unknown):
    process = start(*tools.processor, EDGE, *arguments)
    assert process.wait(60) == 2
    assert process.output == (
        f"cannot start: unknown argument '{unknown}'; set a parameter with --ros-args -p NAME:=VALUE, "
        "remap a topic with --ros-args -r FROM:=TO\n"
    )


def test_a_middleware_that_is_not_installed_ends_the_start_in_one_line(start, tools):
    process = start(*tools.processor, EDGE, RMW_IMPLEMENTATION="rmw_none_such_cpp")
    assert process.wait(60) == 2
    assert process.output == (
        "cannot start: RMW_IMPLEMENTATION=rmw_none_such_cpp is set, but that middleware is not installed "
        "here; unset RMW_IMPLEMENTATION, then start again (in a notebook: restart the kernel)\n"
    )
