"""The files that a lesson carries: what they hold, and how a stored one is compared."""

import json

import numpy as np
import pytest
from nbclassroom.authoring.build import build
from nbclassroom.authoring.lesson_files import lesson_file_differences, lesson_files
from nbclassroom.authoring.masters import read_master
from nbclassroom.exercises.check_files import read_check_file
from template_master import write_carried_files

CHECKS, SOLUTIONS, TEXTS = "checks/template.json", "solutions/template.json", "texts/template.json"


@pytest.fixture
def stored(write_master, tmp_path):
    """Writes the files of a changed template into a folder; returns them and the folder."""

    def write(*replacements, add=""):
        master = read_master(write_master(*replacements, add=add))
        write_carried_files(master, tmp_path)
        return lesson_files(master), tmp_path

    return write


def test_the_checks_hold_no_solution_and_the_solutions_hold_it(stored):
    files, _ = stored()
    assert list(files) == [CHECKS, SOLUTIONS]
    for secret in ("np.uint16) * 2", "    return pixels * 2", "Any pixels"):
        assert secret not in files[CHECKS]
    assert "uint8 ends at 255, and 200 * 2 became 144" in files[CHECKS]
    solution = json.loads(files[SOLUTIONS])["solutions"]["template-double"]
    assert "np.minimum(pixels.astype(np.uint16) * 2, LIMIT)" in solution["code"]


def test_the_texts_of_figures_are_stored_and_compared(stored):
    texts = (
        '\n# %% role="texts"\nfigure_texts = {"a": ("A.", "Ä.")}\n\n# %%\nshow(image, text="template/a")\n'
    )
    files, folder = stored(add=texts)
    assert json.loads(files[TEXTS]) == {"a": {"caption": "A.", "alt": "Ä."}}
    for change in (lambda path: path.write_text("{}"), lambda path: path.unlink()):
        change(folder / TEXTS)
        differences = lesson_file_differences(files, folder)
        assert [text.split("; ")[1] for text in differences] == ["run imgproc-course build"]


def test_a_module_beside_the_lesson_goes_along(stored, write_master):
    module = write_master().parent.parent / "template.py"
    module.write_text("NAME = 'ä'\n", encoding="utf-8")
    files, folder = stored()
    assert files["template.py"] == (folder / "template.py").read_text(encoding="utf-8") == "NAME = 'ä'\n"
    assert lesson_file_differences(files, folder) == []


def test_the_same_master_gives_the_same_bytes(stored):
    assert stored() == stored()


def test_an_argument_that_is_no_data_is_made_again(stored):
    files, folder = stored(
        ("return (rng.integers(100, 256, (3, 4), dtype=np.uint8),)", "return (make(rng), scale)"),
        (
            'exercise(\n    "template-double",\n    function="double",\n'
            '    time_limit=5,\n    allowed=("scipy",),',
            "def make(rng):\n    return rng.integers(0, 9, 4) + LIMIT\n\n"
            "def scale(values):\n    return values * 3\n\n"
            'exercise(\n    "template-double",\n    function="double",\n    practice=True,',
        ),
        (
            "def double(pixels):\n    return np.minimum(",
            "def double(pixels, scale=abs):\n    return np.minimum(",
        ),
    )
    exercise = read_check_file(folder / CHECKS).exercise("template-double")
    numbers, scale = exercise.cases[0].calls[0].arguments
    assert numbers.min() >= 255 and numbers.shape == (4,) and scale(5) == 15
    again = read_check_file(folder / CHECKS).exercise("template-double").cases[0].calls[0].arguments[0]
    np.testing.assert_array_equal(again, numbers)
    assert "rng.integers(0, 9, 4)" in files[CHECKS]


def test_a_difference_is_named_by_exercise(stored):
    files, folder = stored()
    assert lesson_file_differences(files, folder) == []
    data = json.loads(files[CHECKS])
    entry = data["exercises"]["template-double"]
    key = entry["cases"][0]["expected"][0]
    for change in (
        lambda: entry.update(title="Other"),
        lambda: entry["cases"][0].update(hint="Other"),
        lambda: data["values"][key].update(shape=[4, 3]),
        lambda: data["exercises"].clear(),
    ):
        change()
        (folder / CHECKS).write_text(json.dumps(data))
        assert lesson_file_differences(files, folder) == [
            f"{CHECKS}: template-double differs from the master; run imgproc-course build"
        ]
    (folder / CHECKS).write_text("{")
    assert lesson_file_differences(files, folder) == [f"{CHECKS}: damaged; run imgproc-course build"]
    (folder / CHECKS).write_text(files[CHECKS])
    (folder / SOLUTIONS).write_text("{}")
    assert lesson_file_differences(files, folder) == [
        f"{SOLUTIONS}: differs from the master; run imgproc-course build"
    ]
    (folder / SOLUTIONS).unlink()  # not released
    assert lesson_file_differences(files, folder) == []


def test_a_float_that_another_processor_rounds_differently_is_no_difference(stored):
    one = ".astype(np.float64) * 0.1 + 1"
    files, folder = stored(
        ("np.minimum(pixels.astype(np.uint16) * 2, LIMIT).astype(np.uint8)", f"pixels{one}"),
        ("    return pixels * 2", f"    return pixels{one} + 1"),
    )
    data = json.loads(files[CHECKS])
    for key, form in data["values"].items():
        if form.get("dtype") == "float64" and "data" in form:
            exercise = read_check_file(folder / CHECKS).exercise("template-double")
            if key == data["exercises"]["template-double"]["cases"][0]["expected"][0]:
                values = exercise.call(
                    lambda pixels: eval(f"pixels{one}") * (1 + 1e-15), exercise.cases[0].calls[0].arguments
                )
                assert values.value != form
                form["data"] = values.value["data"]
    (folder / CHECKS).write_text(json.dumps(data))
    assert lesson_file_differences(files, folder) == []


def test_build_writes_solutions_only_on_request(write_master, tmp_path):
    masters = write_master().parent
    lessons = tmp_path / "lessons"

    def built(**options):
        assert build(masters, lessons, tmp_path / "solved", progress=lines.append, **options).problems == []
        return sorted(path.relative_to(lessons).as_posix() for path in lessons.rglob("*.json"))

    lines = []
    assert built(with_solutions=True) == [CHECKS, SOLUTIONS]
    assert "checks 2 kB" in lines[-1]
    assert built() == [CHECKS]  # taken back
