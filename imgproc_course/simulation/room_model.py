"""The room as arrays: triangles, labels, joints, and the free floor. environment/room makes the files."""

import json
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from ..geometry import triangle_planes

FILES = Path(__file__).parent / "room"
# The renderer's texture coordinates and depths are true over short distances only.
LONGEST_EDGE = {"floor": 0.3, "rug": 0.35, "room": 0.4}
ATLASES = ("floor", "rug", "room", "furniture", "signs", "outside", "movers")
NO_JOINT = -1
FACES_OUTWARD = "plant"  # the one kind that is seen from both sides


@dataclass(frozen=True, eq=False)
class RoomModel:
    """Triangles of the room; those of movers in the frames of their joints.

    triangles (N, 3, 3) float32, metres · texture (N, 3, 2) float32 · label (N,) uint8 · joint (N,) int,
    NO_JOINT for what stands still · atlas (N,) int, index into ATLASES · normals (N, 3) and offsets (N,)
    float64 of the planes · joint_tree {name: parent and offset}, parents first
    """

    triangles: np.ndarray
    texture: np.ndarray
    label: np.ndarray
    joint: np.ndarray
    atlas: np.ndarray
    normals: np.ndarray
    offsets: np.ndarray
    joint_names: list[str]
    joint_tree: dict[str, dict[str, Any]]
    markers: dict[str, np.ndarray]
    label_names: dict[int, str]


def load_room():
    with np.load(FILES / "geometry.npz") as file:
        arrays = dict(file)
    description = json.loads((FILES / "scene.json").read_text(encoding="utf-8"))
    tree = description["joint_tree"]
    parts = []
    for number, name in enumerate(ATLASES):
        triangles, texture, label = (arrays[f"{name}_{kind}"] for kind in ("vertices", "uv", "label"))
        if name in LONGEST_EDGE:
            triangles, texture, label = bisect(triangles, texture, label, LONGEST_EDGE[name])
        joint = np.full(len(label), NO_JOINT)
        if name == "movers":
            joint = arrays["movers_joint"].astype(int)
        parts.append((triangles, texture, label, joint, np.full(len(label), number)))
    triangles, texture, label, joint, atlas = map(np.concatenate, zip(*parts, strict=True))
    planes = triangle_planes(triangles)
    joint_tree = {name: tree[name] for name in sorted(tree, key=lambda name: generation(tree, name))}
    markers = {name: np.array(pose) for name, pose in description["markers"].items()}
    label_names = {int(number): name for number, name in description["labels"].items()}
    names = description["joints"]
    return RoomModel(
        triangles, texture, label, joint, atlas, *planes, names, joint_tree, markers, label_names
    )


def generation(tree, name):
    """How many joints there are above this one."""
    parent = tree[name]["parent"]
    return 0 if parent is None else 1 + generation(tree, parent)


def bisect(triangles, texture, label, longest):
    """Cuts each triangle at the middle of its longest edge until no edge is longer than `longest` metres."""
    while True:
        edges = np.roll(triangles, -1, 1) - triangles
        squared = edges[..., 0] ** 2 + edges[..., 1] ** 2 + edges[..., 2] ** 2
        rows = np.nonzero(squared.max(1) > longest**2)[0]
        if not len(rows):
            return triangles, texture, label
        corner = squared[rows].argmax(1)
        keep = np.ones(len(triangles), bool)
        keep[rows] = False
        triangles = np.concatenate([triangles[keep], *halves(triangles[rows], corner)])
        texture = np.concatenate([texture[keep], *halves(texture[rows], corner)])
        label = np.concatenate([label[keep], label[rows], label[rows]])


def halves(corners, first):
    """The two halves of triangles (N, 3, K), cut between corner `first` and the one after it."""
    rows = np.arange(len(corners))
    a, b, c = (corners[rows, (first + k) % 3] for k in range(3))
    middle = (a + b) / 2
    return np.stack([a, middle, c], 1), np.stack([middle, b, c], 1)


class FreeSpace:
    """How far each place on the floor is from the nearest thing that stands still, below the robot's top."""

    def __init__(self):
        with np.load(FILES / "free_space.npz") as file:
            self._millimetres = file["distance"].tolist()  # single numbers are read faster from a list
            self._origin = file["origin"].tolist()
            self._cell = float(file["cell"])

    def distance(self, x, y):
        """Metres from (x, y) to the nearest obstacle, between the cells' centers; 0 outside of the room."""
        col, row = (x - self._origin[0]) / self._cell - 0.5, (y - self._origin[1]) / self._cell - 0.5
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
