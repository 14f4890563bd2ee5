"""The feedback of `check`."""

import re
from dataclasses import replace
from textwrap import dedent
from types import SimpleNamespace

import numpy as np
import pytest
from nbclassroom.exercises import check, checking, read_exercises
from nbclassroom.exercises.canonical import canonical
from nbclassroom.exercises.check_files import find_check_file
from nbclassroom.exercises.checking import run_check
from nbclassroom.exercises.lesson import ExpectedCall
from nbclassroom.exercises.names_read import CellRuns
from nbclassroom.exercises.running import CallResult
from readable_cell import run_cell
from template_master import write_carried_files


@pytest.fixture
def write_master(write_master, tmp_path, monkeypatch):
    """Writes a master, and the checks file that its lesson carries."""

    def write(**changed):
        path = write_master(**changed)
        parts = {"exercises": read_exercises(path), "cells": (), "texts": {}, "questions": {}}
        lesson = SimpleNamespace(name="doubling", path=path, **parts)
        write_carried_files(lesson, tmp_path)
        monkeypatch.setenv("NBCLASSROOM_CHECKS", str(tmp_path / "checks"))

    return write


@pytest.fixture(autouse=True)
def _master(write_master):
    write_master()


@pytest.fixture
def runs(monkeypatch):
    """The runs of cells that `check` knows, as in a kernel; the test starts them."""
    runs = CellRuns()
    monkeypatch.setattr(checking, "RUNS", runs)
    return runs


def right(pixels):
    return np.minimum(pixels.astype(np.uint16) * 2, 255).astype(np.uint8)


def test_a_right_answer_passes():
    result = check("test-double", right)
    assert result.passed and result.points == 3
    assert repr(result) == (
        "test-double: both checks pass.\n✓ Bright\n✓ Dark\n"
        "Points here: 3 of 3. Grading runs 1 more check on other inputs, worth 3."
    )


def stub(pixels):
    raise NotImplementedError("your turn")


def stub_without_a_message(pixels):
    raise NotImplementedError


@pytest.mark.parametrize("function", [stub, stub_without_a_message])
def test_the_stub_is_not_attempted(function):
    result = check("test-double", function)
    assert not result.attempted and not result.passed and result.points == 0
    assert repr(result).startswith("test-double: not attempted yet.\nWrite double() in its cell")


def test_a_stub_of_dots_is_not_attempted(write_master):
    dots = "def double(pixels):\n    ..."
    write_master(answer=f'# %% role="answer"\n{dots}')
    assert not check("test-double", run_cell(dots, {})["double"]).attempted


def wraps(pixels):
    return pixels * 2


def test_a_known_mistake_is_named_and_shown():
    result = check("test-double", wraps)
    assert result.mistake.name == "wraps"
    assert [case_result.passed for case_result in result.results] == [False, True]
    assert result.points == 1
    text = repr(result)
    assert "test-double: 1 of 2 checks pass." in text
    assert re.search(r"\d+ of 12 values differ; the first at row \d, col \d: expected 255, got \d+", text)
    assert "It wraps." in text and "Hint" not in text
    assert "given pixels: an array of shape (3, 4), uint8" in text
    assert re.search(r" \d+\*", text)  # a differing number, marked


def test_a_mistake_is_named_beside_another_fault():
    def wraps_and_fails(pixels):
        return pixels * 2 if pixels.ndim == 2 else None

    result = check("test-double", wraps_and_fails)
    assert [case_result.passed for case_result in result.results] == [False, False]
    assert result.mistake.name == "wraps"


def test_one_value_everywhere_beside_an_error_tells_no_mistake(write_master):
    write_master(
        mistake='# %% role="mistake" name="none" says="All 0."\ndef double(pixels):\n    return pixels * 0'
    )
    assert check("test-double", lambda pixels: pixels * 0).mistake.name == "none"
    assert check("test-double", lambda pixels: pixels * 0 if pixels.ndim == 2 else None).mistake is None


@pytest.mark.parametrize("exact_type", [True, False])
def test_a_mistake_with_wrong_values_is_named_in_another_type(exact_type, write_master):
    write_master(
        **{
            "exercise": '# %% role="exercise"\nexercise("test-double", function="double", time_limit=0.5,'
            f' hint="Widen.", exact_type={exact_type})\nSIDE = 3',
            "second mistake": '# %% role="mistake" name="floats" says="It returns floats."\n'
            "def double(pixels):\n    return np.minimum(pixels * 2.0, 255)",
        }
    )
    assert check("test-double", lambda pixels: (pixels * 2).astype(float)).mistake.name == "wraps"
    cut = check("test-double", lambda pixels: right(pixels).astype(np.int8))
    assert cut.mistake is None  # `wraps` has other values; these are right, as far as int8 holds them
    if exact_type:  # right values in a wrong type are no other mistake
        assert check("test-double", lambda pixels: right(pixels).astype(int)).mistake is None
        assert check("test-double", lambda pixels: right(pixels).astype(float)).mistake.name == "floats"


def test_after_a_try_that_fails_the_help_in_steps_is_named(write_master):
    stuck = 'Stuck? hint("test-double") gives help in steps.'
    assert stuck not in repr(check("test-double", wraps))  # the exercise has no hints
    write_master(
        exercise='# %% role="exercise"\nexercise("test-double", function="double", time_limit=0.5,'
        ' hints=("Widen.",))\nSIDE = 3'
    )
    result = check("test-double", wraps)
    assert repr(result).endswith(f"\n{stuck}") and stuck.replace('"', "&quot;") in result._repr_html_()
    assert not any("Stuck" in repr(check("test-double", function)) for function in (right, stub))


def test_an_unknown_mistake_gets_the_hint():
    result = check("test-double", lambda pixels: right(pixels) // 2)
    assert result.mistake is None
    assert "Hint: Widen." in repr(result)


def test_a_way_without_return_is_not_named_beside_the_one_change_that_helps():
    source = dedent("""
        def double(pixels):
            doubled = None
            for factor in (3, 2):
                if factor == 3:
                    break
                doubled = np.minimum(pixels.astype(np.uint16) * factor, 255).astype(np.uint8)
            if doubled is not None:
                return doubled
    """)
    double = run_cell(source, {"np": np})["double"]
    text = repr(check("test-double", double))
    assert "With one change in line 4, these checks pass." in text
    assert "no return is reached" not in text


def test_a_change_that_helps_in_the_shown_calls_alone_is_not_told(monkeypatch):
    data = find_check_file("test-double").exercise("test-double")
    pixels = np.full((3, 4), 7, np.uint8)
    (witness,) = [ExpectedCall((pixels,), CallResult(canonical(pixels * 3)))]
    others = replace(data, witnesses=(replace(data.cases[0], calls=(witness,)),))
    source = "def double(pixels):\n    return np.minimum(pixels.astype(int) * 1, 255).astype(np.uint8)"
    half = run_cell(source, {"np": np})["double"]
    assert "With one change" in repr(run_check(data, half))
    assert "With one change" not in repr(run_check(others, half))


@pytest.mark.parametrize(
    ("function", "text"),
    [
        (lambda pixels: None, "Expected an array of shape (3, 4), uint8, got None."),
        (
            lambda pixels: print(right(pixels)),
            "returned None. print only shows a value: write return in place",
        ),
        (lambda pixels: 1 / 0, "double() raised ZeroDivisionError: division by zero\n    in your line"),
        (lambda pixels: right(pixels).tolist(), "Expected an array of shape (3, 4), uint8, got a list of 3."),
        (lambda pixels: right(pixels)[:2], "Expected shape (3, 4), got an array of shape (2, 4)."),
        (lambda pixels: right(pixels).astype(int), "Expected uint8, got an array of int64."),
        (lambda pixels: right(pixels) + pixels.sort(), "double() raised TypeError"),
        (lambda: 3, "double() raised TypeError"),
        (lambda pixels: (_ for _ in ()).throw(GeneratorExit("x")), "double() raised GeneratorExit: x"),
        (lambda pixels: (_ for _ in ()).throw(NameError("x", name=5)), "double() raised NameError: x"),
        (lambda pixels: {"k" * 900: 1}, "got a dict with the keys 'kkk"),
    ],
)
def test_each_kind_of_wrong_answer_has_its_text(function, text):
    result = check("test-double", function)
    assert not result.passed
    assert text in repr(result)
    assert "np.minimum" not in repr(result) + result._repr_html_()  # never the solution


def test_a_changed_input_fails_though_the_answer_is_right():
    def changes(pixels):
        answer = right(pixels)
        pixels[:] = 0
        return answer

    result = check("test-double", changes)
    assert not result.passed
    assert (
        "double() changed its input pixels. Leave the input as it is: write into something new, such as"
        in repr(result)
    )


def test_an_endless_loop_is_stopped():
    def endless(pixels):
        while True:
            pass

    result = check("test-double", endless)
    assert [case_result.passed for case_result in result.results] == [False, False] and result.points == 0
    assert "double() did not finish in time and was stopped." in repr(result)
    assert "the computer was busy: check again." in repr(result)
    assert "A while loop may be endless" in repr(result)
    assert "✗ Dark\n    not run, because the call above did not finish\n" in repr(result)
    assert "not run, because" in result._repr_html_()


def test_prints_and_warnings_are_shown():
    def noisy(pixels):
        print("shape", pixels.shape)
        return np.uint8(np.float64(1) / np.zeros(1)[0] > 0) + pixels

    text = repr(check("test-double", noisy))
    assert "Your function printed:\n    shape (3, 4)" in text
    assert "NumPy or Python warned: divide by zero" in text


def test_a_refused_module_does_not_pass():
    def uses(pixels):
        import cv2

        return right(pixels) if cv2 else None

    result = check("test-double", uses)
    assert list(result.refused) == ["cv2"] and not result.passed
    assert "double() uses cv2. Write this exercise without it" in repr(result)
    assert "the values are right, but grading would refuse this answer" in repr(result)


def test_a_refused_module_comes_before_the_error_that_it_causes():
    def uses(pixels):
        import cv2

        return cv2.add(pixels)

    result = check("test-double", uses)
    first, second, third = repr(result).splitlines()[:3]
    assert first == "test-double: grading would refuse this answer."
    assert second.startswith("double() uses cv2. Write this exercise without it")
    assert third == "✗ Bright" and "double() raised error: OpenCV" in repr(result)
    html = result._repr_html_()
    assert html.index("double() uses cv2") < html.index("Bright") < html.index("double() raised")
    assert html.count("double() uses cv2") == 1


def test_a_refused_name_that_no_cell_imported_is_refused_too():
    namespace = run_cell("def double(pixels):\n    return cv2.add(pixels, pixels)\n", {})
    result = check("test-double", namespace["double"])
    assert list(result.refused) == ["cv2"]
    assert repr(result).splitlines()[1].startswith("double() uses cv2.")


def test_an_answer_of_two_arrays_is_two_tables(write_master):
    write_master(
        solution=(
            '# %% role="solution"\ndef double(pixels):\n'
            "    wide = pixels[:2, :2].astype(np.int32)\n    return wide * 2, wide"
        ),
        case='# %% role="case" title="Pair"\ndef inputs(rng):\n    return (np.uint8([[1, 2], [3, 4]]),)',
        second="",
    )

    def swapped(pixels):
        wide = pixels.astype(np.int32)
        return wide, wide

    text = repr(check("test-double", swapped))
    assert "In answer[0]: 4 of 4 values differ" in text
    assert (
        "    returned [0]: an array of shape (2, 2), int32, * differs\n     1* 2*\n     3* 4*\n"
        "    expected [0]: an array of shape (2, 2), int32, * differs\n     2* 4*\n     6* 8*\n"
        "Points"
    ) in text.replace("    Hint: Widen.\n", "")  # no tables of the part that is right
    html = check("test-double", swapped)._repr_html_()
    assert html.count("overflow-x: auto") == html.count('tabindex="0"') > 0  # the keyboard scrolls a table
    assert html.count("<table") == 3 and html.count("font-weight: 700") == 8
    assert all("white-space: nowrap" in cell for cell in re.findall("<td[^>]*>", html))


def test_the_first_wrong_image_of_several_is_drawn(write_master):
    write_master(
        solution=('# %% role="solution"\ndef double(pixels):\n    return pixels, np.minimum(pixels, 100)'),
        case='# %% role="case" title="Pair"\ndef inputs(rng):\n    return (np.full((20, 20), 200, "u1"),)',
        second="",
    )

    def second_wrong(pixels):
        other = np.minimum(pixels, 100)
        other[7, 3] = 99
        return pixels, other

    assert re.findall(r'alt="([^"]*)"', check("test-double", second_wrong)._repr_html_()) == [
        "given: 20 rows, 20 cols",
        "returned [1]: 20 rows, 20 cols",
        "expected [1]: 20 rows, 20 cols",
        "1 of 400 pixels differ, the first at row 7, col 3",
    ]


def test_beside_a_wrong_answer_that_is_no_image_the_given_images_are_drawn(write_master):
    write_master(
        solution='# %% role="solution"\ndef double(pixels):\n    return int(pixels.max())',
        case='# %% role="case" title="Size"\ndef inputs(rng):\n    return (np.full((20, 20), 200, "u1"),)',
        second="",
    )
    html = check("test-double", lambda pixels: 5)._repr_html_()
    assert re.findall(r'alt="([^"]*)"', html) == ["given pixels: 20 rows, 20 cols"]


def test_a_message_is_shown_by_its_fields_and_a_table_of_its_bytes(write_master):
    write_master(
        exercise=(
            '# %% role="exercise"\nfrom types import SimpleNamespace\n'
            'exercise("test-double", function="double", time_limit=0.5)'
        ),
        answer='# %% role="answer"\ndef double(message):\n    raise NotImplementedError',
        solution='# %% role="solution"\ndef double(message):\n    return message.height',
        case=(
            '# %% role="case" title="Message"\ndef inputs(rng):\n'
            "    data = bytes(range(100, 112))\n"
            '    return (SimpleNamespace(height=2, width=5, encoding="mono8", step=6, data=data),)'
        ),
        second="",
        hidden=(
            '# %% role="hidden" title="Message"\ndef inputs(rng):\n    return (SimpleNamespace(height=3),)'
        ),
        mistake='# %% role="mistake" name="one" says="One."\ndef double(message):\n    return 1',
        **{"second mistake": ""},
    )
    text = repr(check("test-double", lambda message: message.width))
    assert (
        "    given message: an object with the fields height=2, width=5, encoding='mono8', step=6,"
        " data=12 bytes (100, 101, 102, 103, 104, 105, 106, 107, …); data in rows of step bytes\n"
        "     100  101  102  103  104  105\n     106  107  108  109  110  111\n"
    ) in text


USES_MOST = "def double(pixels):\n    return np.minimum(pixels.astype(int) * 2, most).astype(np.uint8)\n"


def test_a_value_of_a_cell_that_was_changed_since_does_not_pass(runs):
    names = {"np": np, "most": 255}
    runs.start("most = 255", "mine")
    runs.start(USES_MOST, "answer-test-double")
    function = run_cell(USES_MOST, names)["double"]
    assert check("test-double", function).passed
    runs.start("least = 0", "mine")
    result = check("test-double", function)
    assert not result.passed and result.gone == {"most": "now makes least"} and result.points == 0
    assert repr(result).startswith("test-double: the values are right, but the page has changed since.\n")
    assert "most is older than the page: its cell now makes least. Python still has it" in repr(result)
    runs.start("most = 255", "mine")
    assert check("test-double", function).passed


def test_a_value_of_a_deleted_cell_does_not_pass(runs):
    runs.start("most = 255", "mine")
    runs.start(USES_MOST, "answer-test-double")
    runs._deleted.add("mine")
    result = check("test-double", run_cell(USES_MOST, {"np": np, "most": 255})["double"])
    assert not result.passed and result.gone == {"most": "was deleted"}


@pytest.mark.parametrize(
    "table",
    [
        "most = max([k for k in range(256)])",
        "most = max({k: k for k in range(256) if k > 3})",
        "class Table:\n    k = 255\n    last = k\nmost = Table.last",
    ],
)
def test_what_a_comprehension_or_a_class_binds_is_read_of_no_other_cell(runs, table):
    runs.start("for k in range(3):\n    print(k)", "mine")
    runs.start(f"{table}\n{USES_MOST}", "answer-test-double")
    runs._deleted.add("mine")
    result = check("test-double", run_cell(f"{table}\n{USES_MOST}", {"np": np, "k": 2})["double"])
    assert result.passed and result.gone == {}


def test_a_value_that_needs_a_refused_module_is_refused(runs):
    import cv2

    cells = ["import cv2", "most = cv2.countNonZero(np.ones(255))"]
    for cell in cells:
        runs.start(cell, cell)
    result = check("test-double", run_cell(USES_MOST, {"np": np, "most": 255, "cv2": cv2})["double"])
    assert result.refused == {"cv2": "a value or function that needs cv2"} and not result.passed


def test_html_is_escaped_and_marks_what_differs(write_master):
    header = '# %% role="mistake" name="wraps" says="Less <b>than</b> 255"'
    write_master(mistake=f"{header}\ndef double(pixels):\n    return pixels * 2")
    html = check("test-double", wraps)._repr_html_()
    assert "Less &lt;b&gt;than&lt;/b&gt; 255" in html
    assert html.count("font-weight: 700") > 0


def test_feedback_is_the_same_each_time():
    first, second = check("test-double", wraps), check("test-double", wraps)
    assert repr(first) == repr(second)
    assert first._repr_html_() == second._repr_html_()


def test_a_value_that_is_no_function_is_refused_with_the_remedy():
    with pytest.raises(
        TypeError,
        match="needs your function double itself, got a value of type int; run the cell with your function",
    ):
        check("test-double", 3)


def test_a_wrong_dtype_gets_the_dtype_and_not_the_hint():
    text = repr(check("test-double", lambda pixels: right(pixels).astype(np.int64)))
    assert (
        "The values are right; only the dtype is not: you return int64. End with .astype(np.uint8)." in text
    )
    assert "Hint" not in text


PAIR_CASE = '# %% role="case" title="Pair"\ndef inputs(rng):\n    return (np.full((5, 5), 9, "u1"),)'


def write_border_master(write_master, border_hint):
    write_master(
        exercise=(
            '# %% role="exercise"\nexercise("test-double", function="double", time_limit=0.5, hint="Widen.",'
            f' border_hint="{border_hint}")'
        ),
        case=PAIR_CASE,
        second="",
    )


def border_left_out(pixels):
    return np.pad(right(pixels)[1:-1, 1:-1], 1)


def test_a_wrong_border_gets_the_border_hint(write_master):
    write_border_master(write_master, "Repeat the border.")
    text = repr(check("test-double", border_left_out))
    assert "and there your result is 0: is the border never computed?" in text
    assert "Repeat the border." in text and "Widen." not in text
    text = repr(check("test-double", lambda pixels: right(pixels) - np.uint8(3)))
    assert "Hint: Widen." in text and "Repeat the border." not in text


def test_a_wrong_border_without_a_border_hint_gets_the_hint(write_master):
    write_border_master(write_master, "")
    text = repr(check("test-double", border_left_out))
    assert "is the border never computed?\n    Hint: Widen." in text


def test_a_numpy_scalar_gets_the_hint(write_master):
    write_master(
        solution='# %% role="solution"\ndef double(pixels):\n    return float(pixels.mean())',
    )
    assert "Hint: Widen." in repr(check("test-double", lambda pixels: float(pixels.mean() ** 2)))
    assert "Hint: Widen." in repr(check("test-double", lambda pixels: np.float64(pixels.mean() ** 2)))


def test_an_error_gets_advice_and_not_the_hint():
    text = repr(check("test-double", lambda pixels: pixels if pixels > 3 else 0))
    assert "`if` and `while` need one True or False" in text and "Hint" not in text


def test_the_case_that_the_mistake_explains_is_shown(write_master):
    write_master(
        case='# %% role="case" title="Flat"\ndef inputs(rng):\n    return (np.uint8([200]),)',
        second='# %% role="case" title="Square"\ndef inputs(rng):\n    return (np.uint8([[200, 150]]),)',
    )
    result = check("test-double", lambda pixels: pixels * 2 if pixels.shape[1] else 0)
    assert result.mistake.name == "wraps" and result.shown.case.title == "Square"
    assert repr(result).index("✗ Square") < repr(result).index("It wraps.")


def test_a_mistake_that_explains_one_case_of_two_is_not_named():
    result = check("test-double", lambda pixels: pixels * 2 if pixels.ndim == 2 else pixels)
    assert result.mistake is None
    assert "It wraps." not in repr(result)


def fills_a_part(pixels):
    doubled = np.empty_like(pixels)
    doubled[0] = right(pixels)[0]
    return doubled


def test_an_array_that_is_filled_in_part_does_not_pass_by_chance():
    assert not any(check("test-double", fills_a_part).results[0].passed for _ in range(20))


def test_a_practice_exercise_speaks_of_no_grading(write_master):
    write_master(
        exercise=(
            '# %% role="exercise"\nSIDE = 3\nexercise("test-double", function="double", practice=True)'
        ),
    )

    def uses(pixels):
        import cv2

        return right(pixels) if cv2 else None

    text = repr(check("test-double", uses))
    assert "the values are right, but this answer uses what is not allowed here" in text
    assert "rading" not in text and "Practice: no points." in text


def raise_left_in(pixels):
    raise NotImplementedError("your turn")
    return right(pixels)


def test_a_raise_that_is_left_in_place_is_told():
    result = check("test-double", raise_left_in)
    assert not result.attempted
    assert "The line with raise NotImplementedError is still there" in repr(result)


def contrast_with_white(colour):
    """The contrast of WCAG between white and a colour."""
    parts = [c / 3294.6 if c <= 10 else ((c / 255 + 0.055) / 1.055) ** 2.4 for c in colour]
    return 1.05 / (np.dot([0.2126, 0.7152, 0.0722], parts) + 0.05)


@pytest.mark.parametrize("function", [right, wraps, stub])
def test_the_colours_are_jupyterlabs_and_elsewhere_have_contrast(function):
    """The contrast of JupyterLab's own, in both themes, is seen in a browser."""
    html = check("test-double", function)._repr_html_()
    used = re.findall(r"[ ;\"]color: var\(--jp-[\w-]+, #(\w{6})\)", html)
    assert used and not re.findall(r"[ ;\"]color: #", html)
    assert all(contrast_with_white(bytes.fromhex(fallback)) >= 4.5 for fallback in used), used


def test_a_failing_check_without_points_is_no_full_success(write_master):
    write_master(
        case='# %% role="case" title="Bright" points=0\ndef inputs(rng):\n'
        "    return (np.uint8([[200, 100]]),)"
    )
    text = repr(check("test-double", lambda pixels: pixels * 2))
    assert "✗ Bright" in text and "✓ Dark" in text
    assert "Points here: 1 of 1. But a check fails, and grading takes points for that" in text
    assert "But a check fails" not in repr(check("test-double", right))
    assert "But a check fails" not in repr(check("test-double", lambda pixels: pixels * 3))


def run_answer_of(body, **changes):
    """The CheckResult of an answer cell of the exercise `test-double`."""
    source = f"def double(pixels):\n    {body}\n"
    names = run_cell(source, {"np": np, "LIMIT": 255})
    data = replace(find_check_file("test-double").exercise("test-double"), **changes)
    return run_check(data, names["double"])


def test_a_known_mistake_that_says_what_the_answer_does_is_not_named():
    right_and_wrong = "np.minimum(pixels.astype(int), 255)\n    return pixels * 2"
    says = (("It wraps: write np.minimum(pixels.astype(int), 255).", None), ("It wraps.", "wraps"))
    for sentence, name in says:
        exercise = find_check_file("test-double").exercise("test-double")
        mistakes = tuple(replace(mistake, says=sentence) for mistake in exercise.mistakes[:1])
        result = run_answer_of(right_and_wrong, mistakes=mistakes)
        assert (result.mistake.name if result.mistake else None) == name
