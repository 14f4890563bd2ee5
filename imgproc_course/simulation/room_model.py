"""The room as arrays: triangles, labels, joints, and the free floor. environment/room makes the files."""

import functools
import json
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import cv2
import numpy as np

from ..geometry import triangle_planes

FILES = Path(__file__).parent / "room"
NO_JOINT = -1
BALLS = ("ball", "second ball", "third ball")  # the model's, and joints like it
FACES_OUTWARD = "plant"  # the one kind that is seen from both sides


@dataclass(frozen=True, eq=False)
class RoomModel:
    """Triangles of the room; those of movers in the frames of their joints."""

    triangles: np.ndarray  # (N, 3, 3) float32, metres
    texture: np.ndarray  # (N, 3, 2) float32
    label: np.ndarray  # (N,) uint8
    joint: np.ndarray  # (N,) int, NO_JOINT for what stands still
    atlas: np.ndarray  # (N,) int, index into atlas_names
    atlas_names: list[str]
    joint_names: list[str]
    joint_tree: dict[str, dict[str, Any]]  # {name: parent and offset}, parents first
    markers: dict[str, np.ndarray]
    label_names: dict[int, str]

    @functools.cached_property
    def planes(self):
        """Normals and offset (4, N) float64 of the triangles' planes."""
        normals, offsets = triangle_planes(self.triangles)
        return np.vstack([normals.T, offsets])


def load_room(folder=FILES):
    names = ("triangles", "texture", "label", "joint", "atlas")
    with np.load(folder / "geometry.npz") as file:
        arrays = {name: file[name] for name in names}
    description = json.loads((folder / "scene.json").read_text(encoding="utf-8"))
    _add_balls(arrays, description)
    return RoomModel(
        **arrays,
        atlas_names=description["atlases"],
        joint_names=description["joints"],
        joint_tree=description["joint_tree"],
        markers={name: np.array(pose) for name, pose in description["markers"].items()},
        label_names={int(number): name for number, name in description["labels"].items()},
    )


def _add_balls(arrays, description):
    """Adds a joint, and the ball's triangles once more, for each further one of BALLS."""
    joints = description["joints"]
    (rows,) = np.nonzero(arrays["joint"] == joints.index("ball"))
    for name in BALLS[1:]:
        for key, array in arrays.items():
            arrays[key] = np.concatenate([array, array[rows]])
        arrays["joint"][-len(rows) :] = len(joints)
        joints.append(name)
        description["joint_tree"][name] = description["joint_tree"]["ball"]


def read_image(name):
    """(H, W, 3) uint8 BGR, of a file of the room."""
    pixels = cv2.imread(str(FILES / name))
    if pixels is None:
        raise FileNotFoundError(
            f"the room's file {name} is missing or damaged; restore it: "
            "git checkout -- imgproc_course/simulation/room"
        )
    return pixels


class FreeSpace:
    """How far each place on the floor is from the nearest thing that stands still, below the robot's top."""

    def __init__(self, distance, origin, cell):
        """distance (rows, columns) in millimetres"""
        self._millimetres = distance.tolist()  # single numbers are read faster from a list
        self.metres = distance / 1000
        self.origin = np.asarray(origin, float).tolist()  # (x, y), the corner of the first cell
        self.cell = float(cell)  # its side

    @classmethod
    def load(cls):
        """Of the recorded room."""
        with np.load(FILES / "free_space.npz") as file:
            return cls(**file)

    def distance(self, x, y):
        """Metres from (x, y) to the nearest obstacle, between the cells' centers; 0 outside of the room."""
        col, row = (x - self.origin[0]) / self.cell - 0.5, (y - self.origin[1]) / self.cell - 0.5
        height, width = len(self._millimetres), len(self._millimetres[0])
        if not (0 <= col < width - 1 and 0 <= row < height - 1):
            return 0.0
        i, j = int(row), int(col)
        down, right = row - i, col - j
        (a, b), (c, d) = (line[j : j + 2] for line in self._millimetres[i : i + 2])
        return ((a * (1 - right) + b * right) * (1 - down) + (c * (1 - right) + d * right) * down) / 1000

    def away(self, x, y, reach=0.02):
        """Unit vector (x, y) that leads away from the nearest obstacle."""
        dx = self.distance(x + reach, y) - self.distance(x - reach, y)
        dy = self.distance(x, y + reach) - self.distance(x, y - reach)
        length = (dx * dx + dy * dy) ** 0.5
        return (dx / length, dy / length) if length > 0 else (0.0, 0.0)
