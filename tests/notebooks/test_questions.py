"""The questions that come back: their plan, their right answers, and that they go along in hand-outs."""

import json
import re
from collections import Counter
from pathlib import Path

import cv2
import numpy as np
import pytest
from all_masters import PATHS, all_masters
from nbclassroom.authoring.handout import hand_out
from nbclassroom.authoring.masters import QUESTIONS, read_questions

from imgproc_course.imaging import to_gray

NOTEBOOKS = Path(__file__).parents[2] / "notebooks"
ENTRIES = read_questions(NOTEBOOKS / "masters" / QUESTIONS)
ASKING = [path.stem[3:] for path in PATHS if path.stem >= "02"]


def routes():
    """The routes of the index, lists of lessons."""
    index = (NOTEBOOKS / "masters" / "index.py").read_text("utf-8")
    original, driving, _ = re.findall(r"^# - \*\*.* \(about \d+ hours\): .*$", index, re.M)
    first, more = (re.findall(r"\[\[(\w+)\]\]", text) for text in (original, driving))
    return [first, [*first, *more], list(all_masters())]


def earlier_lessons(lesson):
    """The lessons that every route to a lesson contains before it, in their order."""
    before = [route[: route.index(lesson)] for route in routes() if lesson in route]
    return [name for name in before[-1] if all(name in part for part in before)]


def source(name):
    return ENTRIES[name]["section"].partition("#")[0]


@pytest.mark.parametrize("lesson", ASKING)
def test_one_question_is_from_the_last_two_lessons_of_every_route_and_one_is_older(lesson):
    earlier, questions = earlier_lessons(lesson), all_masters()[lesson].questions
    places = sorted(earlier.index(source(name)) for name in questions)
    assert len(places) == 2
    oldest_recent, newest_old = len(earlier) - 2, max(0, len(earlier) - 4)
    assert places[0] <= newest_old and places[1] >= oldest_recent, (questions, earlier)


def test_a_question_comes_at_most_twice_and_only_in_lessons_that_exist():
    asked = Counter(name for lesson in ASKING for name in all_masters()[lesson].questions)
    assert set(asked) == set(ENTRIES) and max(asked.values()) <= 2
    assert {lesson for entry in ENTRIES.values() for lesson in entry["asked"]} <= set(all_masters())


@pytest.mark.parametrize("name", ENTRIES)
def test_a_question_is_from_a_section_of_the_core(name):
    lesson, _, number = ENTRIES[name]["section"].partition("#")
    heading = re.compile(rf"^#+ {number} · ", re.M)
    (section,) = [cell for cell in all_masters()[lesson].cells if heading.search(cell.source)]
    assert not section.deeper


@pytest.mark.parametrize("name", ENTRIES)
def test_the_right_answer_is_what_the_proof_computes(name):
    entry = ENTRIES[name]
    frame = np.random.default_rng(0).integers(0, 256, (720, 1280, 3), dtype=np.uint8)
    names = {"np": np, "cv2": cv2, "to_gray": to_gray, "frame": frame}
    if "options" in entry:
        assert entry["answer"] in entry["options"]
        assert eval(entry.get("proof", "True"), names)
    else:
        assert eval(entry["proof"], names) == entry["answer"]


@pytest.mark.parametrize("name", ENTRIES)
def test_every_reply_is_a_plain_sentence_of_its_own(name):
    replies = ENTRIES[name]["replies"]
    assert all(re.fullmatch(r"[^`*\[\]]{20,160}[.?]", reply) for reply in replies.values())
    assert len(set(replies.values())) == len(replies)


def test_the_right_letter_is_not_always_the_same():
    letters = Counter(entry["answer"] for entry in ENTRIES.values() if "options" in entry)
    assert set(letters) == {"a", "b", "c"} and max(letters.values()) < letters.total() / 2


def test_a_hand_out_has_the_answers_of_its_lessons(tmp_path):
    hand_out(tmp_path / "out", NOTEBOOKS, ["grayscale_node"])
    texts = json.loads((tmp_path / "out/texts/grayscale_node.json").read_text("utf-8"))
    stored = all_masters()["grayscale_node"].questions
    assert len(stored) == 2 and {name: texts[name] for name in stored} == stored
