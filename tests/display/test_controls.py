"""Which control a range becomes, where the control starts, and what the function gets."""

import cv2
import ipywidgets as widgets
import pytest

from imgproc_course.display.controls import Controls


def canny(gray, low, high, *, sigma=0.0, aperture=3, l2_gradient=False, border="reflect"):
    raise AssertionError("controls never call the function")


def test_a_pair_that_must_not_cross_is_one_range_slider():
    controls = Controls(canny, {"thresholds": (0, 1020)})
    slider = controls["thresholds"]
    assert isinstance(slider, widgets.IntRangeSlider)
    assert (slider.min, slider.max, slider.step) == (0, 1020, 1)
    assert controls.values == {"low": 100, "high": 200}
    slider.value = (900, 950)
    assert controls.values == {"low": 900, "high": 950}


@pytest.mark.parametrize(
    "pair", ["low, high", "lower, upper", "minimum, maximum", "min, max", "threshold1, threshold2"]
)
def test_the_pair_may_have_other_names(pair):
    function = eval(f"lambda frame, {pair}: frame")
    controls = Controls(function, {"between": (0.0, 1.0)})
    assert isinstance(controls["between"], widgets.FloatRangeSlider)
    assert controls.values == dict(zip(pair.split(", "), (0.1, 0.2), strict=True))


def test_a_pair_starts_at_its_own_defaults():
    assert Controls(lambda f, low=50, high=150: f, {"t": (0, 255)}).values == {"low": 50, "high": 150}


@pytest.mark.parametrize(
    ("name", "range_", "widget_class", "value"),
    [
        ("sigma", (0, 5.0), widgets.FloatSlider, 0.0),
        ("aperture", (3, 7, 2), widgets.IntSlider, 3),
        ("low", (0, 1020), widgets.IntSlider, 500),
        ("low", (-8, 8), widgets.IntSlider, 0),
        ("low", (5, 6), widgets.IntSlider, 6),
        ("l2_gradient", True, widgets.Checkbox, True),
        ("border", ["constant", "reflect"], widgets.Dropdown, "reflect"),
        ("border", ["constant", "wrap"], widgets.Dropdown, "constant"),
        ("aperture", {"three": 3, "five": 5}, widgets.Dropdown, 3),
    ],
)
def test_class_and_start_of_a_control(name, range_, widget_class, value):
    controls = Controls(canny, {name: range_})
    assert type(controls[name]) is widget_class
    assert controls.values == {name: value}


def test_float_steps_are_round_numbers():
    assert Controls(canny, {"sigma": (0, 5.0)})["sigma"].step == 0.1
    assert Controls(canny, {"sigma": (0, 1.0)})["sigma"].step == 0.01
    assert Controls(canny, {"sigma": (0, 1, 0.25)})["sigma"].step == 0.25


def test_the_learners_own_widget_is_used():
    slider = widgets.IntSlider(min=1, max=9, value=7)
    controls = Controls(canny, {"aperture": slider})
    assert controls["aperture"] is slider
    slider.value = 5
    assert controls.values == {"aperture": 5}


def test_a_change_is_reported_once_and_reset_goes_back():
    reports = []
    controls = Controls(
        canny, {"sigma": (0, 5.0), "thresholds": (0, 1020)}, lambda: reports.append(controls.values)
    )
    controls["sigma"].value = 2.0
    controls["thresholds"].value = (10, 20)
    assert reports == [{"sigma": 2.0, "low": 100, "high": 200}, {"sigma": 2.0, "low": 10, "high": 20}]
    controls.reset()
    assert controls.values == {"sigma": 0.0, "low": 100, "high": 200}


def test_the_call_is_code_that_runs():
    controls = Controls(canny, {"thresholds": (0, 1020), "sigma": (0, 5.0), "border": ["reflect"]})
    controls["sigma"].value = 0.1 + 0.2
    assert controls.call == "canny(gray, low=100, high=200, sigma=0.3, border='reflect')"
    assert controls.call in controls.box.children[-1].value.replace("&#x27;", "'")


def test_any_keyword_is_accepted_for_a_function_written_in_c():
    assert Controls(cv2.Canny, {"threshold1": (0, 1020)}).values == {"threshold1": 500}


def test_any_keyword_is_accepted_for_a_function_that_takes_any():
    assert Controls(lambda f, **parameters: f, {"thresholds": (0, 10)}).values == {"thresholds": 5}


@pytest.mark.parametrize(
    ("ranges", "error"),
    [
        ({"sigmaa": (0, 5)}, "no parameter 'sigmaa'.*Did you mean sigma"),
        ({"thresholds": (0, 5), "low": (0, 5)}, "thresholds, low set a parameter twice"),
        ({"width": [1, 2]}, r"canny has no parameter 'width'; it has: gray, low, high, sigma"),
        ({"low": (5, 5)}, r"low=\(5, 5\): the first number must be below the second"),
        ({"low": (0, 10, 0)}, "the step must be above 0"),
        ({"low": (0, 10, 11)}, "the step must be above 0 and fit"),
        ({"low": 5}, r"low=5 is not a range: give \(low, high\)"),
        ({"low": (0, float("inf"))}, "is not a range"),
        ({"low": ("a", "b")}, "is not a range"),
        ({"border": []}, r"border=\[\] is not a range"),
        ({"low": widgets.Layout()}, "a Layout has no value; use a slider"),
    ],
)
def test_an_invalid_range_is_an_error_that_names_the_remedy(ranges, error):
    with pytest.raises(ValueError, match=error):
        Controls(canny, ranges)
