from ..node.kind import NodeKind


class Kind(NodeKind):
    """A function that returns the files of a ROS 2 package: they are read, and their node is driven."""

    name = "package"
    kernel_modules = ("feed",)

    def run(self, answer, *arguments):
        from .feed import feed_package

        return feed_package(answer, *arguments)
