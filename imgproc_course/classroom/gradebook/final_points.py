"""From the autograder's points to the final ones: a teacher's decisions first, then what lateness costs.

A decision on an exercise replaces its points; an excused exercise counts neither for nor against. A decision
on the whole lesson is final: it replaces its points, and lateness costs nothing more.
"""

from imgproc_course.classroom.gradebook.teacher_tables import plain_number


def settle_lesson(entry, decisions, policy):
    """Set the final points of a lesson's entry in grades.json, which has those of the autograder.

    `decisions` are those on this lesson of this learner; `policy` is a LatePolicy or None.
    """
    by_exercise = {decision.exercise: decision for decision in decisions}
    whole_lesson = by_exercise.pop("", None)
    entry["autograded_points"] = entry["points"]
    for exercise in entry["exercises"]:
        exercise["autograded_points"] = exercise["points"]
        _decide(exercise, by_exercise.get(exercise["id"]))
    if entry["exercises"]:
        entry["points"] = plain_number(sum(exercise["points"] for exercise in entry["exercises"]))
        entry["max_points"] = sum(exercise["max_points"] for exercise in entry["exercises"])
    entry["late_deduction"] = 0
    _decide(entry, whole_lesson)
    is_final = whole_lesson and (whole_lesson.excused or whole_lesson.points is not None)
    if is_final:
        entry["status"] = "graded"
    elif policy and entry["days_late"]:
        points = plain_number(entry["points"] * policy.factor(entry["days_late"]))
        entry["late_deduction"] = plain_number(entry["points"] - points)
        entry["points"] = points


def _decide(entry, decision):
    entry["decision"] = None
    if decision is None:
        return
    entry["decision"] = {name: getattr(decision, name) for name in ("points", "excused", "comment")}
    if decision.excused:
        entry["points"] = entry["max_points"] = 0
    elif decision.points is not None:
        entry["points"] = decision.points
