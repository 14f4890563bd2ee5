"""The pages beside the lessons, built from sources beside the masters: the glossary."""

from pathlib import Path

import nbformat

from imgproc_course.authoring.glossary import GLOSSARY, GLOSSARY_PAGE, glossary_notebook, read_glossary
from imgproc_course.authoring.references import References


def build_pages(masters_dir):
    """The pages that belong to a folder of masters.

    Parameters
    ----------
    masters_dir : Path

    Returns
    -------
    {file name: text}; empty if the folder has no sources of pages

    Raises
    ------
    MasterError : a source with an error
    """
    glossary = Path(masters_dir) / GLOSSARY
    terms = read_glossary(glossary)
    if not terms:
        return {}
    return {GLOSSARY_PAGE: nbformat.writes(glossary_notebook(terms, References(glossary))) + "\n"}


def page_differences(pages, folder):
    """How the stored pages of a folder differ from the built ones, as a list of lines."""
    return [
        f"{name}: it differs from its source in masters/; run imgproc-course build"
        for name, text in pages.items()
        if not (Path(folder) / name).is_file() or (Path(folder) / name).read_text(encoding="utf-8") != text
    ]
