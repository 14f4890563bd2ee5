"""The furniture of the living room as pieces that can stand elsewhere. environment/room makes the files."""

import functools
import json
import math
from dataclasses import dataclass, replace

import numpy as np

from ..geometry import Pose
from .room_model import FILES, RoomModel, load_room

PIECES = FILES / "pieces"
SIGN = (-0.003, 0.0, 0.72, 0.0, 0.0, -0.707106781, 0.707106781)  # the sign's middle, from its piece's origin
BEARERS = {"marker": "stand", "wall_marker": "wall_marker", "sign": "sign"}


@dataclass(frozen=True, eq=False)
class Pieces:
    """Pieces of furniture; where one stands is (x, y, yaw), (*origins[name], 0.0) in the recorded room."""

    model: RoomModel  # the triangles of a piece are in its own frame
    piece: np.ndarray  # (N,) int, index into the names, -1 for what stays
    origins: dict[str, tuple[float, float]]
    hulls: dict[str, np.ndarray]  # polygons (K, 2) in the piece's frame, metres
    bodies: dict[str, list[np.ndarray]]  # of what is as high as the robot's body; "room": walls and skirtings

    @functools.cached_property
    def borders(self):
        """Points (N, 2) along the hull of each piece."""
        return {name: along(hull) for name, hull in self.hulls.items()}

    def placed(self, places):
        """A RoomModel in which each piece stands at (x, y, yaw)."""
        table = np.array([(*direction(yaw), x, y) for x, y, yaw in map(places.get, self.origins)])
        moves = self.piece >= 0
        c, s, x, y = table[self.piece[moves]].T[..., None]
        u, v, height = np.moveaxis(self.model.triangles[moves].astype(float), -1, 0)
        triangles = self.model.triangles.copy()
        triangles[moves] = np.stack([u * c - v * s + x, u * s + v * c + y, height], -1)
        return replace(self.model, triangles=triangles)

    def poses(self, places):
        """Poses (7,) in the map of sign and markers."""
        local = self.model.markers | {"sign": SIGN}
        return {name: moved(local[name], places[piece]) for name, piece in BEARERS.items()}


def direction(yaw):
    """Cosine and sine, rounded: so they are the same on every processor."""
    return round(math.cos(yaw), 12), round(math.sin(yaw), 12)


def turned(points, place):
    """Points (N, 2) of a piece that stands at (x, y, yaw)."""
    return turned_to_each(points, np.array([place]))[0]


def turned_to_each(points, places):
    """Points (M, N, 2) of a piece at each of the places (M, 3)."""
    c, s = np.array([direction(yaw) for yaw in places[:, 2].tolist()]).T[..., np.newaxis]
    x, y = points.T
    return np.stack([x * c - y * s + places[:, :1], x * s + y * c + places[:, 1:2]], -1)


def along(polygon, step=0.03):
    """Points (N, 2) along the border of a polygon, and its middle."""
    points = [polygon.mean(0, keepdims=True)]
    for p, q in zip(polygon, np.roll(polygon, -1, 0), strict=True):
        count = max(1, int(max(abs(q - p)) / step))
        points.append(p + (q - p) * (np.arange(count) / count)[:, None])
    return np.concatenate(points)


def moved(pose, place):
    """The pose (7,) in the map of what has a pose in the frame of a piece at (x, y, yaw)."""
    return np.round((Pose.planar(*place) @ Pose.from_vector(np.array(pose))).vector, 9)


@functools.cache
def load_pieces() -> Pieces:
    with np.load(PIECES / "geometry.npz") as file:
        piece = file["piece"].astype(int)
    origins = json.loads((PIECES / "scene.json").read_text(encoding="utf-8"))["origins"]
    outlines = json.loads((PIECES / "outlines.json").read_text(encoding="utf-8"))
    model = load_room(PIECES)
    return Pieces(
        model=model,
        piece=np.pad(piece, (0, len(model.joint) - len(piece)), constant_values=-1),
        origins={name: tuple(origin) for name, origin in origins.items()},
        hulls={name: np.array(outlines[name]["hull"]) / 1000 for name in origins},
        bodies={name: [np.array(p) / 1000 for p in own["body"]] for name, own in outlines.items()},
    )
