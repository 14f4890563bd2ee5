"""The words of the lessons: explained before they are used, and lessons named, not numbered."""

import re
import sys
from pathlib import Path

sys.path.append(str(Path(__file__).parent))
from early_uses import early_uses
from nbclassroom.authoring.masters import find_masters, read_master
from nbclassroom.authoring.references import GLOSSARY, read_glossary

MASTERS = Path(__file__).parents[2] / "notebooks" / "masters"
NUMBERED = re.compile(r"\blessons? \d\d?\b|\b\d\d_\w+\.ipynb\b|^# # \d\d · ", re.I | re.M)


def test_no_lesson_uses_a_term_before_a_lesson_introduces_it_or_a_link_explains_it():
    masters = [read_master(path) for path in find_masters(MASTERS)]
    terms = read_glossary(MASTERS / GLOSSARY)
    assert len(masters) > 10 and len(terms) > 110
    assert list(map(str, early_uses(masters, terms))) == []


def test_masters_refer_to_lessons_by_name():
    paths = [*find_masters(MASTERS), *MASTERS.glob("*.mistakes.py"), MASTERS / GLOSSARY]
    numbered = [
        f"{path.name}: {match[0]}" for path in paths for match in NUMBERED.finditer(path.read_text("utf-8"))
    ]
    assert numbered == []
