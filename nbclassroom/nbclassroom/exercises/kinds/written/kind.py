from ..kind import Kind as AnyKind


class Kind(AnyKind):
    """Text in a Markdown cell, or the last figure of a code cell."""

    name, noun = "written", "answer"
    graded_by_person = True
    cell_kinds = ("markdown", "code")

    def name_of(self, function):
        return "your answer"

    def declaration_rules(self, function, points, rubric):
        yield bool(function), f"function={function!r}, expected none for subject='written'"
        is_whole = isinstance(points, int) and not isinstance(points, bool)
        yield not is_whole or points < 1, f"points={points!r}, expected a whole number > 0"
        lines = rubric if isinstance(rubric, tuple | list) else ()
        if lines and all(map(_is_line, lines)):
            most = sum(max(0, worth) for _, worth in lines)
            yield is_whole and most < points, f"its rubric gives at most {most} points, expected {points}"
        else:
            yield True, f'rubric={rubric!r}, expected (("what to look for", points), ...)'

    def look_at(self, exercise):
        from .self_assessment import self_assessment

        return self_assessment(exercise)


def _is_line(line):
    """Whether a line of a rubric is (text, whole number that is not 0)."""
    is_pair = isinstance(line, tuple | list) and len(line) == 2
    return is_pair and isinstance(line[0], str) and bool(line[0].strip()) and type(line[1]) is int and line[1]
