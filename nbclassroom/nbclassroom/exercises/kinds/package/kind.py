from ..node.kind import Kind as NodeKind


class Kind(NodeKind):
    """A function that returns the files of a ROS 2 package: they are read, and their node is driven."""

    name, noun = "package", "function"
    kernel_modules = ("feed",)
    tries_changes = False

    def name_of(self, function):
        return f"{function}()"

    def can_be_answer(self, value):
        return callable(value)

    def run(self, answer, *arguments):
        from .feed import feed_package

        return feed_package(answer, *arguments)
