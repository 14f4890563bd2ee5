from ..kind import Kind as AnyKind


class Kind(AnyKind):
    """A function, whose values are shown."""

    name = "function"
    shows_values = tries_changes = True

    def images_of(self, exercise, call):
        """The images of the first part of the answer that is a wrong image; else those that were given."""
        # Here, because it imports Pillow: the processes that grade import this package, and draw nothing.
        from ...answer_images import images_of_call

        return images_of_call(exercise.names, call) if call.result.finished else ()
