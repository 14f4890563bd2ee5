from dataclasses import replace

from .... import course
from ..kind import Kind as AnyKind


class NodeKind(AnyKind):
    """What classes of nodes and packages, which have a node, have in common."""

    has_sentences = explains_enough = refuses_parts = True

    def modules(self):
        return course.node_modules()

    def prepare(self):
        from .ros_double import offer_modules

        offer_modules()

    def has_inputs(self, calls):
        return any(steps for _, steps in calls)  # what __init__ makes has none, and the task says what it is

    def argument_names(self, answer):
        return ["part", "steps"]

    def explain(self, exercise, call):
        from .feedback import NODE_ERRORS, sentence_on_node

        if call.result.error in NODE_ERRORS:
            return "\nin your ".join(filter(None, (call.result.message, call.result.line)))
        values = call.expected.value, call.result.value
        sentence = call.difference and sentence_on_node(*values, call.arguments)
        return sentence or super().explain(exercise, call)

    def advice_on_error(self, exercise, result):
        from .feedback import advice_on_node_error

        return advice_on_node_error(result) or super().advice_on_error(replace(exercise, names=None), result)

    def images_of(self, exercise, call):
        """The first image that it published, and that differs, with what was sent and what was expected."""
        from ...answer_images import answer_images
        from ...canonical import canonical
        from .feedback import differing_images

        images = call.difference and differing_images(call.expected.value, call.result.value, call.arguments)
        if not images or images[1].shape != images[2].shape:
            return ()
        given, expected, actual = (canonical(image) for image in images)
        return answer_images(given, "", expected, actual, images[1] != images[2])


class Kind(NodeKind):
    """A class of a node."""

    name, noun = "node", "class"
    kernel_modules = ("feed", "recording_node", "ros_double")
    tries_changes = True

    def name_of(self, function):
        return function

    def can_be_answer(self, value):
        return isinstance(value, type)

    def run(self, answer, *arguments):
        from .feed import feed

        return feed(answer, *arguments)
