"""The pages beside the lessons, built from sources beside the masters: glossary and cheat sheet."""

from pathlib import Path

from .cheat_sheet import CHEAT_SHEET, cheat_sheet_page
from .glossary import GLOSSARY, GLOSSARY_PAGE, glossary_page, read_glossary
from .references import References


def build_pages(masters_dir):
    """{file name: text} of the pages that belong to a folder of masters."""
    masters_dir, pages = Path(masters_dir), {}
    glossary, cheat_sheet = masters_dir / GLOSSARY, masters_dir / CHEAT_SHEET
    if terms := read_glossary(glossary):
        pages[GLOSSARY_PAGE] = glossary_page(terms, References(glossary))
    if cheat_sheet.exists():
        pages[CHEAT_SHEET] = cheat_sheet_page(cheat_sheet)
    return pages


def pages_without_source(masters_dir, folder):
    """The pages of a folder whose sources do not exist, as a list of Path."""
    sources = {GLOSSARY_PAGE: GLOSSARY, CHEAT_SHEET: CHEAT_SHEET}
    return [
        Path(folder) / page
        for page, source in sources.items()
        if (Path(folder) / page).exists() and not (Path(masters_dir) / source).exists()
    ]


def page_differences(pages, folder):
    """How the stored pages of a folder differ from the built ones, as a list of lines."""
    return [
        f"{name}: it differs from its source in masters/; run imgproc-course build"
        for name, text in pages.items()
        if not (Path(folder) / name).is_file() or (Path(folder) / name).read_text(encoding="utf-8") != text
    ]
