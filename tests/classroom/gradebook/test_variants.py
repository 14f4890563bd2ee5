"""A key with variants: each learner is graded with one set of inputs, and a friend's values gain nothing."""

import json

import pytest
from click.testing import CliRunner
from submissions import MASTERS, SEED, answers_of, notebook, write
from tqdm import tqdm

from imgproc_course.classroom.autograder import make_answer_key
from imgproc_course.classroom.autograder.answer_key import KeyFolderError, load_key
from imgproc_course.classroom.autograder.make_answer_key import make_key
from imgproc_course.classroom.gradebook.answer_keys import load_keys
from imgproc_course.classroom.gradebook.grade import grade_submissions
from imgproc_course.cli import main

pytestmark = [pytest.mark.sandbox, pytest.mark.xdist_group("variants")]
LEARNERS = ("ada", "bob", "eve", "kim", "lou", "max")
# What a friend's page shows of the public check, hard-coded.
REMEMBERED = """
import base64

def double(pixels):
    known = {{{given!r}: {expected!r}}}
    given = base64.b64encode(pixels.tobytes()).decode()
    return np.frombuffer(base64.b64decode(known[given]), np.uint8).reshape(18, 24)
"""


@pytest.fixture(scope="module")
def variants_path(tmp_path_factory):
    path, labels = tmp_path_factory.mktemp("variants") / "key", []

    def bar(exercises, desc, **options):
        labels.append(desc)
        return tqdm(exercises, desc=desc, **options)

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(make_answer_key, "tqdm", bar)
        make_key(MASTERS, SEED, path, ["light"], variants=3)
    assert labels == [f"key, variant {number} of 3" for number in (1, 2, 3)]
    return path


@pytest.fixture
def graded(variants_path, submissions, tmp_path):
    """Grades the folder of submissions; {learner: their lesson in grades.json}."""

    def grade():
        grade_submissions(submissions, [variants_path], tmp_path / "grades", workers=1, quiet=True)
        grades = json.loads((tmp_path / "grades" / "grades.json").read_text())
        return {learner["name"]: learner["lessons"][0] for learner in grades["learners"]}

    return grade


def inputs_of(variant):
    return (variant.path / "light" / "light-double.inputs.json").read_text()


def test_variants_have_the_same_lessons_and_other_inputs(variants_path, key_path):
    key = load_key(variants_path)
    assert [variant.variant for variant in key.variants] == [1, 2, 3]
    assert len({variant.digest for variant in key.variants}) == len({*map(inputs_of, key.variants)}) == 3
    assert inputs_of(key) == inputs_of(load_key(key_path))  # the first one is the key without variants
    assert all(variant.lessons == key.lessons for variant in key.variants)
    assert SEED not in key.secret and len(key.secret) == 64
    chosen = [key.variant_for(name).variant for name in LEARNERS]
    assert chosen == [load_key(variants_path).variant_for(name).variant for name in LEARNERS]
    assert {*chosen} == {1, 2, 3}


def test_a_missing_variant_makes_the_key_unreadable(variants_path):
    third = variants_path / "variants" / "3"
    third.rename(third.with_name("9"))
    with pytest.raises(KeyFolderError, match="variants/3: there is no key"):
        load_key(variants_path)
    third.with_name("9").rename(third)
    text = (third / "key.json").read_text()
    (third / "key.json").write_text((variants_path / "key.json").read_text())
    with pytest.raises(KeyFolderError, match="it is not variant 3 of this key; make the key again"):
        load_key(variants_path)
    (third / "key.json").write_text(text)


def test_right_answers_pass_in_every_variant_and_grades_json_names_it(
    graded, light, submissions, tmp_path, variants_path
):
    for name in LEARNERS:
        write(submissions / f"{name}.ipynb", notebook(light, answers_of(light, "right")))
    key, lessons = load_key(variants_path), graded()
    assert {lesson["points"] for lesson in lessons.values()} == {6}
    for name in LEARNERS:
        variant = key.variant_for(name)
        assert (lessons[name]["variant"], lessons[name]["key"]) == (variant.variant, variant.digest)
    grades = json.loads((tmp_path / "grades" / "grades.json").read_text())
    assert [entry["variants"] for entry in grades["keys"]] == [[variant.digest for variant in key.variants]]
    assert (
        len([*(tmp_path / "grades" / "results").glob("*.answers.json")]) == 3
    )  # equal answers: once a variant
    assert graded() == lessons


def test_the_values_on_a_friends_page_gain_nothing_in_another_variant(
    graded, light, submissions, tmp_path, variants_path
):
    key = load_key(variants_path)
    write(submissions / "ada.ipynb", notebook(light, answers_of(light, 0)))
    graded()
    public = light.exercises[0].cases[0]
    content = key.variant_for("ada").content("light-double")
    given, expected = (
        content.canonical_arguments(public.id, 0)[0]["data"],
        content.expected[public.id][0]["data"],
    )
    page = (tmp_path / "grades" / "learners").glob("ada-*.html")
    assert f"checked with set {key.variant_for('ada').variant} of the inputs" in next(page).read_text()
    copied = answers_of(light, "untouched") | {
        "light-double": REMEMBERED.format(given=given, expected=expected)
    }
    for name in LEARNERS:
        write(submissions / f"{name}.ipynb", notebook(light, copied))
    points = {name: lesson["points"] for name, lesson in graded().items()}
    friends = {name for name in LEARNERS if key.variant_for(name) == key.variant_for("ada")}
    assert points == {name: int(name in friends) for name in LEARNERS}
    assert friends and set(LEARNERS) - friends


def test_a_key_is_redrawn_with_as_many_variants(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    words = ["key", "light", "--masters", str(MASTERS), "--out", "k"]
    made = CliRunner().invoke(main, [*words, "--variants", "2"])
    assert made.exit_code == 0 and "exercises with points 2, variants 2." in made.output
    old = load_keys([tmp_path / "k"])
    redrawn = CliRunner().invoke(main, [*words, "--redraw"])
    assert redrawn.exit_code == 0 and "variants 2." in redrawn.output
    new = load_keys([tmp_path / "k"])
    assert len({*map(inputs_of, [*old.keys[0].variants, *new.keys[0].variants])} | {""}) >= 3
    assert old.keys[0].secret != new.keys[0].secret
    assert load_key(tmp_path / "k-1").digest == old.keys[0].digest
