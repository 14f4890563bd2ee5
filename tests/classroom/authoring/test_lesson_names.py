import pytest

from imgproc_course.classroom.authoring.lesson_names import is_lesson, lessons_named, without_lesson

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


def test_names_of_folders():
    assert [is_lesson(text, LESSONS) for text in ("faces", "19_faces", "07_gone", "ada", "04")] == [
        *(True, True, True),
        *(False, False),
    ]
    assert lessons_named("grayscale", ()) == []
