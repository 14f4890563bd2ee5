"""The textures of furnished rooms: shadows, sun and word where they belong, and the same bytes everywhere."""

import json
import os
import subprocess
import sys

import cv2
import numpy as np
import pytest

from imgproc_course.simulation import room_model
from imgproc_course.simulation.room_light import FILES, WORDS, X0, X1, Y0, Y1, stored, textures
from imgproc_course.simulation.room_model import FILES as RECORDED_FILES

from .test_determinism import OLDER

# A room with cartons, table and blocks in the sun.
ROOM = {
    "sofa": (-0.32, 0.407, 1.571),
    "shelf": (5.44, 1.2, 0.0),
    "sign": (1.2, 2.297, 1.571),
    "wall_marker": (2.9, -2.096, 1.571),
    "picture": (-0.885, 0.4, 3.142),
    "rug": (4.2, -0.6, 1.6),
    "table": (4.2, -0.5, 0.1),
    "cartons": (2.0, 0.9, -0.5),
    "stand": (0.2, -1.7, 2.2),
    "plant": (5.2, -1.75, 0.4),
    "carton": (-0.6, -1.7, 0.2),
    "bin": (5.3, 2.05, 0.0),
    "chair": (1.5, -0.9, 1.0),
    "slippers": (3.0, -1.0, 0.7),
    "blocks": (2.7, 0.7, 0.0),
}


def recorded():
    """The pieces where they stand in the recorded room."""
    origins = json.loads((FILES / "scene.json").read_text(encoding="utf-8"))["origins"]
    return {piece: (x, y, 0.0) for piece, (x, y) in origins.items()}


def moved(**places):
    return {**ROOM, **places}


@pytest.fixture(scope="module")
def day():
    return textures(ROOM, "day")


@pytest.fixture(scope="module")
def evening():
    return textures(ROOM, "evening")


def floor_at(image, x, y, half=0.06):
    """The mean value of the floor's texture around a place in metres."""
    height, width = image.shape[:2]
    rows = [int((Y1 - v) / (Y1 - Y0) * height) for v in (y + half, y - half)]
    cols = [int((v - X0) / (X1 - X0) * width) for v in (x - half, x + half)]
    return image[slice(*rows), slice(*cols)].mean()


@pytest.mark.parametrize("lighting", ["day", "evening"])
def test_at_the_recorded_places_the_open_floor_is_as_in_the_recorded_room(lighting):
    ours = textures(recorded(), lighting)["floor"]
    theirs = cv2.imread(str(RECORDED_FILES / f"floor_{lighting}.jpg"))
    places = [
        (x, y) for x in np.arange(-0.6, 5, 0.3) for y in np.arange(-1.0, 0.0, 0.2) if x < 1.4 or x > 4.6
    ]
    differences = [floor_at(ours, *place) - floor_at(theirs, *place) for place in places]
    assert np.abs(differences).mean() < 4
    assert np.abs(differences).max() < 12


@pytest.mark.parametrize("lighting", ["day", "evening"])
def test_a_table_shades_the_floor_below_it_and_nowhere_else(lighting, request):
    here = request.getfixturevalue(lighting)["floor"]
    away = textures(moved(table=(0.6, 0.6, 0.1)), lighting)["floor"]
    assert floor_at(away, 0.5, 0.65) < 0.8 * floor_at(here, 0.5, 0.65)
    assert abs(floor_at(away, 3.6, -1.8) - floor_at(here, 3.6, -1.8)) < 2


def test_the_shadow_of_the_evening_lamp_falls_away_from_it(evening):
    stand = textures(moved(stand=(0.2, -0.2, 0.0)), "evening")["floor"]  # the lamp hangs at (1.6, -0.2)
    darker = {x: floor_at(stand, x, -0.2) / floor_at(evening["floor"], x, -0.2) for x in (0.0, 0.7)}
    assert darker[0.0] < 0.6
    assert darker[0.7] > 0.9


def test_the_sun_is_on_the_floor_only_by_day_and_not_behind_cartons(day, evening):
    sunny, shaded, beside = (
        floor_at(day["floor"], *place) for place in ((2.9, 1.2), (1.95, 0.55), (0.9, 0.9))
    )
    assert sunny > 1.6 * beside
    assert shaded < 0.6 * sunny
    assert floor_at(evening["floor"], 2.9, 1.2) < 1.1 * floor_at(evening["floor"], 2.0, -0.3)


@pytest.mark.parametrize("word", ["OFFICE", "LIBRARY"])
def test_the_word_is_on_the_sign_and_no_other_shines_through(word, day):
    image = textures(ROOM, "day", word)["signs"]
    ink, old = stored()[f"word_{word}"], stored()["word_KITCHEN"]
    top, left = stored()["sign_corner"]
    box = image[top : top + ink.shape[0], left : left + ink.shape[1]].mean(2)
    paper = box[(ink == 0) & (old == 0)]
    assert box[ink == 255].max() < 60 < 120 < paper.min()
    assert abs(box[(ink == 0) & (old == 255)].mean() - paper.mean()) < 3
    outside = np.ones(image.shape[:2], bool)
    outside[top : top + ink.shape[0], left : left + ink.shape[1]] = False
    assert (image[outside] == day["signs"][outside]).all()


def test_each_word_of_the_sign_is_stored():
    assert [name for name in stored() if name.startswith("word_")] == [f"word_{word}" for word in WORDS]


def test_a_missing_file_is_told_with_its_remedy(monkeypatch, tmp_path):
    monkeypatch.setattr(room_model, "FILES", tmp_path)
    with pytest.raises(FileNotFoundError, match=r"pieces/floor_day\.jpg is missing .* git checkout"):
        room_model.read_image("pieces/floor_day.jpg")


DIGESTS = {
    "day": "95b0fe33f3627c45247b697f3a981d3f76a2114354c12462819738e6da584689",
    "evening": "0b79b7e566cc5d70c308e0d6eba0c44059c946815697ced2206d5583fc9927c9",
}
PROGRAM = """if True:
    import hashlib, json, sys
    import cv2
    from numpy._core._multiarray_umath import __cpu_features__
    from imgproc_course.simulation.room_light import textures
    print(__cpu_features__["X86_V3"] or cv2.checkHardwareSupport(11))  # cv::CPU_AVX2
    for lighting in ("day", "evening"):
        images = textures(json.loads(sys.argv[1]), lighting, "STUDIO").values()
        print(hashlib.sha256(b"".join(image.tobytes() for image in images)).hexdigest())
"""


@pytest.mark.parametrize("settings", [{}, OLDER], ids=["this processor", "an older one"])
def test_every_processor_computes_the_same_bytes(settings):
    result = subprocess.run(
        [sys.executable, "-W", "ignore", "-c", PROGRAM, json.dumps(ROOM)],
        env={**os.environ, **settings},
        capture_output=True,
        text=True,
    )
    assert result.returncode == 0, result.stderr
    is_newer, *digests = result.stdout.split()
    assert digests == list(DIGESTS.values())
    assert not settings or is_newer == "False"
