"""environment/drive/record.py: it makes a recording of the raw material, with the same bytes every time."""

import json
import runpy
import subprocess
import sys
from pathlib import Path

import cv2
import numpy as np
import pytest

from imgproc_course.recording import open_recording

SCRIPT = Path(__file__).parents[2] / "environment" / "drive" / "record.py"


@pytest.fixture
def raw_material(tmp_path):
    folder = tmp_path / "raw"
    for name in ("camera", "depth_mm", "labels"):
        (folder / name).mkdir(parents=True)
    for k in range(3):
        cv2.imwrite(str(folder / f"camera/{k:04d}.jpg"), np.full((720, 1280, 3), 50 * k, np.uint8))
        cv2.imwrite(str(folder / f"depth_mm/{k:04d}.png"), np.full((360, 640), 1000 * k, np.uint16))
        cv2.imwrite(str(folder / f"labels/{k:04d}.png"), np.full((720, 1280), k, np.uint8))
    poses = ("camera_optical", "person", "ball", "toycar", "marker")
    truth = {
        "width": 1280,
        "height": 720,
        "fps": 10,
        "distortion_model": "plumb_bob",
        "K": [700.0, 0, 640, 0, 700.0, 360, 0, 0, 1],
        "D": [0.0] * 5,
        "labels": {"0": "background", "1": "floor"},
        "marker": {"dictionary": "DICT_4X4_50", "id": 7, "side": 0.25},
        "frames": {str(k): {name: [k, i, 0, 0, 0, 0, 1] for i, name in enumerate(poses)} for k in range(3)},
    }
    (folder / "truth.json").write_text(json.dumps(truth))
    return folder


def run(*arguments):
    return subprocess.run([sys.executable, SCRIPT, *map(str, arguments)], capture_output=True, text=True)


def test_two_runs_give_the_same_bytes_which_hold_the_raw_material(raw_material, tmp_path):
    for name in ("a", "b"):
        process = run(raw_material, "--out", tmp_path / name / "drive")
        assert process.returncode == 0, process.stderr
    for name in ("drive.mcap", "metadata.yaml"):
        assert (tmp_path / "a/drive" / name).read_bytes() == (tmp_path / "b/drive" / name).read_bytes()
    with open_recording(tmp_path / "a/drive") as drive:
        assert len(drive) == 3
        for k in range(3):
            assert bytes(drive.message(k).data) == (raw_material / f"camera/{k:04d}.jpg").read_bytes()
            assert drive.depth(k)[7, 7] == 1000 * k
            assert drive.labels(k)[7, 7] == k
        assert drive.pose("toycar", 2).tolist() == [2, 3, 0, 0, 0, 0, 1]


@pytest.fixture
def record(monkeypatch):
    """The script's main, with arguments, in this process."""

    def call(*arguments):
        monkeypatch.setattr(sys, "argv", [str(SCRIPT), *map(str, arguments)])
        runpy.run_path(str(SCRIPT), run_name="__main__")

    return call


def test_it_replaces_an_existing_folder_only_with_force(record, raw_material, tmp_path):
    out = tmp_path / "drive"
    out.mkdir()
    (out / "precious").touch()
    with pytest.raises(SystemExit, match="exists already: give --force"):
        record(raw_material, "--out", out)
    assert (out / "precious").exists()


def test_a_folder_without_raw_material_is_refused(record, tmp_path):
    with pytest.raises(SystemExit, match=r"has no truth\.json: give the folder with the raw material \(see"):
        record(tmp_path)
