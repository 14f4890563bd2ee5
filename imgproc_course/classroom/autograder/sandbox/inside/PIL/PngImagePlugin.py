"""Stands for PIL.PngImagePlugin."""


class PngInfo:
    """The texts of a PNG file that is never written."""

    def add_text(self, *_arguments, **_options):
        """Keep nothing."""
