"""Answers that a master contains, as learners would submit them."""


def sample_answers(exercise):
    """Answers that a learner could submit: the right one, the stub, and each known mistake.

    Parameters
    ----------
    exercise : Exercise, declared in a master

    Returns
    -------
    {name: source}: "right", "untouched", and the mistakes by their names. A mistake may call the solution or
    what stands beside the declaration or the mistakes; its source then contains both.
    """
    helpers = "from imgproc_course.exercises import exercise\n\n"
    helpers += f"{exercise.preparation}\n\n{exercise.helpers}\n\n"
    helpers += f"{exercise.solution}\n\nsolution = {exercise.function}\n\n"
    answers = {"right": exercise.solution, "untouched": exercise.stub}
    for mistake in exercise.mistakes:
        answers[mistake.name] = f"{helpers}{mistake.source}"
    return answers
