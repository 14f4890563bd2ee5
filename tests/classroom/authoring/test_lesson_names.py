import pytest
from nbclassroom.authoring.lesson_names import lessons_named, name_in_stem

LESSONS = ("grayscale", "grayscale_node", "faces")


@pytest.mark.parametrize(
    ("text", "named"),
    [
        ("04_grayscale", ["grayscale"]),
        ("ada_05_grayscale_node-1", ["grayscale_node"]),
        ("ada/grayscale_node (2)", ["grayscale_node"]),
        ("grayscale and faces", ["grayscale", "faces"]),
        ("surfaces", []),
        ("grayscales", []),
        ("04", []),
    ],
)
def test_a_lesson_is_named_by_whole_words(text, named):
    assert lessons_named(text, LESSONS) == named


@pytest.mark.parametrize(
    ("stem", "name"),
    [
        ("ada_04_grayscale", "ada"),
        ("ada_04_grayscale-1", "ada"),
        ("04_grayscale_student-2", "student-2"),
        ("student (2)", "student (2)"),
        ("04_grayscale (2)", ""),
        ("grayscale and faces", "and faces"),
        ("surfaces", "surfaces"),
    ],
)
def test_a_file_is_named_after_a_learner(stem, name):
    assert name_in_stem(stem, LESSONS) == name
    assert name_in_stem(stem, ()) == stem
