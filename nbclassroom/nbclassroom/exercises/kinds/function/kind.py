from ...running import explain_call, overwrite_freed_memory
from ..kind import Kind as AnyKind

_EMIT = "from nbclassroom.autograder.sandbox.inside.check_cell import emit\n\nemit({function}{name})"


class Kind(AnyKind):
    """A function, whose values are compared; also what nodes and packages have in common with it."""

    name = "function"
    shows_values = tries_changes = True

    def check_source(self, exercise):
        name = "" if self.name == "function" else f', "{self.name}"'
        return _EMIT.format(function=exercise.function, name=name)

    def run_cases(self, exercise, answer, progress=None):
        """Until a call does not end in time, or is not attempted."""
        calls = []
        pairs = [(case, expected) for case in exercise.cases for expected in case.calls]
        for case, expected in pairs:
            overwrite_freed_memory(expected.result.value)
            call = exercise.judged_call(answer, case, expected)
            calls.append(call)
            if call.result.timed_out or call.result.error == "NotImplementedError":
                break  # a learner waits for one time limit, not for one per call
        return calls

    def known_mistake(self, exercise, calls):
        from ...judging import known_mistake

        return known_mistake(exercise, calls)

    def explain(self, exercise, call):
        return explain_call(call.result, call.difference, exercise.answer_name)

    def images_of(self, exercise, call):
        """The images of the first part of the answer that is a wrong image; else those that were given."""
        # Here, because it imports Pillow: the processes that grade import this package, and draw nothing.
        from ...answer_images import images_of_call

        return images_of_call(exercise.names, call) if call.result.finished else ()
