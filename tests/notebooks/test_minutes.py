"""The minutes of the lessons: the rule against the walks, and every page that shows minutes."""

import re
from pathlib import Path

import pytest
from nbclassroom.authoring.masters import find_masters, read_master
from nbclassroom.authoring.minutes import MINUTES, minutes_of

ROOT = Path(__file__).parents[2]
MASTERS = ROOT / "notebooks" / "masters"
# Walks through the cores of the route *the original lesson*, as a second-year student without NumPy, ROS or
# image processing: the counts of the texts as they were walked, in the order of MINUTES, and the minutes. Two
# older walks, before written answers and live cells were counted, gave several lessons together; the last one
# has a row for each. (Older walks of single lessons were shorter: 03 took 33 minutes, without its exercise.)
CORES = {
    "00 to 04": (6100, 296, 23, 3, 5, 0, 0, 0, 173),
    "00 to 10": (13156, 578, 48, 4, 18, 12, 0, 0, 331),
    "00": (1095, 23, 1, 1, 1, 0, 0, 2, 24),
    "01": (1021, 60, 7, 1, 1, 0, 0, 0, 38),
    "02": (1010, 75, 7, 1, 1, 0, 0, 1, 42),
    "03": (1075, 85, 7, 1, 3, 0, 0, 3, 52),
    "04": (860, 52, 8, 1, 3, 0, 0, 0, 36),
    "05": (1483, 77, 3, 1, 13, 0, 1, 2, 91),
    "08": (1279, 85, 8, 1, 3, 0, 0, 1, 53),
    "09": (872, 68, 4, 1, 9, 0, 1, 2, 67),
    "10": (1261, 79, 4, 1, 1, 7, 0, 5, 59),
}
# Walks through whole lessons: each cell run in JupyterLab, each exercise tried before its hints were read.
# The minutes are estimates, section by section, for a learner who reads 100 technical words in a minute.
WALKED = {
    "04": (1622, 99, 11, 1, 3, 0, 0, 0, 60),
    "05": (2329, 127, 4, 2, 14, 0, 0, 0, 81),
    "15": (2838, 346, 7, 5, 35, 0, 0, 0, 141),
}


def ruled(counts, number):
    return minutes_of(dict(zip(MINUTES, counts, strict=True)), number)


@pytest.mark.parametrize("lessons", CORES)
def test_the_rule_agrees_with_the_walks_through_cores_within_15_percent(lessons):
    *counts, walked = CORES[lessons]
    assert 0.85 <= ruled(counts, lessons[:2]) / walked <= 1.15


@pytest.mark.parametrize("number", WALKED)
def test_the_rule_agrees_with_the_walks_through_whole_lessons_within_15_percent(number):
    *counts, walked = WALKED[number]
    assert 0.85 <= ruled(counts, number) / walked <= 1.15


def test_every_numbered_section_shows_its_minutes_and_every_lesson_its_time():
    for path in find_masters(MASTERS):
        text = path.read_text("utf-8")
        headings = re.findall(r"^# #{2,3} \d+ · .*$", text, re.M)
        assert [line for line in headings if "[[minutes]]" not in line] == [], path.name
        assert "**Time** [[minutes]]" in text, path.name


def hours(masters, *, core):
    return round(sum(master.core_minutes if core else master.minutes for master in masters.values()) / 60)


def test_index_first_lesson_and_readme_name_the_routes_with_their_hours():
    masters = {m.name: m for m in map(read_master, find_masters(MASTERS)) if not m.optional}
    index = (MASTERS / "index.py").read_text("utf-8")
    original, driving, whole = re.findall(r"^# - \*\*.* \(about \d+ hours\): .*$", index, re.M)
    route = {name: masters[name] for name in re.findall(r"\[\[(\w+)\]\]", original)}
    assert " ".join(master.number for master in route.values()) == "00 01 02 03 04 05 08 09 10"
    assert all(20 <= master.core_minutes <= 70 for master in route.values())
    assert 320 <= sum(master.core_minutes for master in route.values()) <= 360
    assert f"**The original lesson in one day** (about {hours(route, core=True)} hours)" in original
    further = {name: masters[name] for name in re.findall(r"\[\[(\w+)\]\]", driving)}
    assert f"**The driving robot** (about {hours(further, core=True)} hours)" in driving
    assert f"**The whole course** (about {hours(masters, core=False)} hours)" in whole
    sentence = f"*The original lesson in one day* is a route of about {hours(route, core=True)} hours"
    for page in (MASTERS / "00_start_here.py", ROOT / "README.md"):
        text = page.read_text("utf-8")
        assert sentence in text, page.name


def test_the_table_of_the_readme_shows_the_minutes_of_every_lesson():
    readme = (ROOT / "README.md").read_text("utf-8")
    rows = re.findall(r"^\| (\d\d) \| (.*?) \| .* \| (\d+) \| (\d+) \|$", readme, re.M)
    masters = [read_master(path) for path in find_masters(MASTERS)]
    assert rows == [(m.number, m.title, str(m.core_minutes), str(m.minutes)) for m in masters]
    counted = {master.name: master for master in masters if not master.optional}
    whole, core = hours(counted, core=False), hours(counted, core=True)
    assert len(masters) == len(counted) + 2
    assert (
        f"All lessons but the two optional ones take a beginner about {whole} hours, their cores {core}."
        in readme
    )
