import pytest
from nbclassroom.authoring.lesson_names import lessons_named, name_in_stem, without_lesson

LESSONS = ("grayscale", "grayscale_node", "faces")


@pytest.mark.parametrize(
    ("text", "named", "rest"),
    [
        ("04_grayscale", ["grayscale"], ""),
        ("03_grayscale_ada", ["grayscale"], "ada"),
        ("ada_05_grayscale_node-1", ["grayscale_node"], "ada_-1"),
        ("ada/grayscale_node (2)", ["grayscale_node"], "ada/ (2)"),
        ("grayscale and faces", ["grayscale", "faces"], "and faces"),
        ("surfaces", [], "surfaces"),
        ("grayscales", [], "grayscales"),
        ("04", [], "04"),
    ],
)
def test_a_lesson_is_named_by_whole_words(text, named, rest):
    assert lessons_named(text, LESSONS) == named
    assert without_lesson(text, LESSONS) == rest


@pytest.mark.parametrize(
    ("stem", "name"),
    [
        ("ada_04_grayscale", "ada"),
        ("ada_04_grayscale-1", "ada"),
        ("04_grayscale_student-2", "student-2"),
        ("student (2)", "student (2)"),
        ("04_grayscale (2)", ""),
    ],
)
def test_a_file_is_named_after_a_learner(stem, name):
    assert name_in_stem(stem, LESSONS) == name
    assert name_in_stem(stem, ()) == stem
