"""The learners' predictions, collected for the teacher to read.

A prediction is the source of a predict cell, `guess_share = 0.3  # your guess: how many percent?`. It is only
read as text: nothing of it is run or evaluated here.
"""

from collections import Counter

from .report import render_page

_NO_GUESS = ("None", "...", '""', "''", "?")
_LONGEST = 200  # characters of a guess


def predictions_page(learners, lessons, names):
    """The page of all predictions, HTML, or ""; `names` are {learner's name: the name to show}."""
    views = []
    for name, lesson in sorted(lessons.items(), key=lambda item: (item[1].number, item[0])):
        questions = _questions(learners, name, names)
        if questions:
            views.append({"title": lesson.title, "name": name, "questions": questions})
    return render_page("predictions.html", lessons=views) if views else ""


def _questions(learners, lesson, names):
    """[{id, question, guesses}] of a lesson; guesses: [(text, [names])], the most frequent one first."""
    asked, guesses = {}, {}
    for learner in learners:
        submission = learner.submissions.get(lesson)
        for id, source in submission.content.predictions.items() if submission else ():
            guess, question = _guess_and_question(source)
            if guess:
                asked.setdefault(id, Counter())[question] += bool(question)
                guesses.setdefault(id, {}).setdefault(guess, []).append(names[learner.name])
    return [
        {
            "id": id,
            # A learner can have changed the question too: most have not.
            "question": asked[id].most_common(1)[0][0],
            "guesses": sorted(guesses[id].items(), key=lambda item: (-len(item[1]), item[0])),
        }
        for id in sorted(asked, key=lambda id: (len(id), id))
    ]


def _guess_and_question(source):
    """(guess, question) of `guess_share = 0.3  # your guess: how many?`: "0.3", "guess_share: how many?"."""
    line = next((line for line in source.splitlines() if line.startswith("guess")), source)
    name, _, right = line.partition("=")
    guess, _, question = right.partition("# your guess:")
    guess, question = guess.strip(), question.strip()
    guess = "" if guess in _NO_GUESS else guess[:_LONGEST]
    return guess, f"{name.strip()}: {question}"[:_LONGEST] if question else ""
