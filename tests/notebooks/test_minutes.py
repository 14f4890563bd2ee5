"""The minutes of the lessons: the rule against the walks, and every page that shows minutes."""

import re
from pathlib import Path

import pytest
from nbclassroom.authoring.masters import find_masters, read_master

ROOT = Path(__file__).parents[2]
MASTERS = ROOT / "notebooks" / "masters"
# Minutes of core and whole, estimated section by section without sight of the course's own: 125 words a
# minute, code read once, each exercise thought out, written, checked and mended, what is tried or waited for.
# Of 12 to 14, 16 to 18 and 20 the mean of two estimates, which differ by at most 22 percent.
ESTIMATES = {
    "00": (26, 26), "01": (30, 71), "02": (28, 58), "03": (40, 86), "04": (36, 47), "05": (55, 78),
    "06": (67, 76), "07": (48, 55), "08": (33, 106), "09": (40, 106), "10": (44, 92), "11": (69, 69),
    "12": (88, 165), "13": (80, 145), "14": (90, 112), "15": (109, 124), "16": (69, 80), "17": (84, 97),
    "18": (67, 79), "19": (76, 98), "20": (114, 281),
}  # fmt: skip


@pytest.mark.parametrize("path", find_masters(MASTERS), ids=lambda path: path.stem)
def test_the_minutes_agree_with_an_estimate_within_15_percent(path):
    master = read_master(path)
    core, whole = ESTIMATES[master.number]
    assert 0.85 <= master.core_minutes / core <= 1.15
    assert 0.85 <= master.minutes / whole <= 1.15


def test_every_numbered_section_shows_its_minutes_and_every_lesson_its_time():
    for path in find_masters(MASTERS):
        text = path.read_text("utf-8")
        headings = re.findall(r"^# #{2,3} \d+ · .*$", text, re.M)
        assert [line for line in headings if "[[minutes" not in line] == [], path.name
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
