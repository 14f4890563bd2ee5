"""Rays and distances in a furnished room, computed apart: in each piece's own frame, of its own triangles."""

import json
import math

import numpy as np

from imgproc_course.simulation.pieces import PIECES

BODY_HEIGHTS = (0.02, 0.22)  # metres
FLOOR = (1, 14)  # labels of floor and rug


class IndependentRoom:
    """What stands still in a room whose pieces stand at `places` {name: (x, y, yaw)}."""

    def __init__(self, places):
        with np.load(PIECES / "geometry.npz") as file:
            arrays = dict(file)
        names = list(json.loads((PIECES / "scene.json").read_text())["origins"])
        still = arrays["joint"] < 0
        self.groups = []  # (place, triangles in the piece's frame, labels)
        for number, place in [(-1, (0.0, 0.0, 0.0)), *enumerate(places[name] for name in names)]:
            rows = still & (arrays["piece"] == number)
            self.groups.append((place, arrays["triangles"][rows].astype(float), arrays["label"][rows]))
        self.segments = [self._body_segments(*group) for group in self.groups]
        share = np.linspace(0, 1, 40)[:, None, None]
        self.points = [(s[:, 0] + share * (s[:, 1] - s[:, 0])).reshape(-1, 2) for s in self.segments]

    @staticmethod
    def _into(place, points):
        """Points (..., 2 or 3) of the map in the frame of a piece."""
        c, s = math.cos(place[2]), math.sin(place[2])
        x, y = points[..., 0] - place[0], points[..., 1] - place[1]
        return np.stack([x * c + y * s, y * c - x * s, *np.moveaxis(points[..., 2:], -1, 0)], -1)

    def cast(self, origin, direction):
        """(distance, label) of the first triangle that a ray meets; (inf, 0) if none."""
        best = (math.inf, 0)
        for place, triangles, labels in self.groups:
            start, end = self._into(place, np.array([origin, origin + direction]))
            distance, row = first_hit(start, end - start, triangles)
            if distance < best[0]:
                best = (distance, int(labels[row]))
        return best

    @staticmethod
    def _body_segments(place, triangles, labels):
        """Edges (N, 2, 2) of what stands between the heights of the robot's body, in the piece's frame."""
        edges = [np.zeros((0, 2, 2))]
        for triangle in triangles[~np.isin(labels, (0, *FLOOR))]:
            corners = clipped(list(triangle))
            if len(corners) > 1:
                flat = np.array(corners)[:, :2]
                edges.append(np.stack([flat, np.roll(flat, -1, 0)], 1))
        return np.concatenate(edges)

    def body_distance(self, place):
        """Metres between the robot's body at (x, y, yaw) and what is in its way; negative inside."""
        c, s = math.cos(place[2]), math.sin(place[2])
        middle, half = np.array([0.0435, 0.0]), np.array([0.1935, 0.12])
        distances = [math.inf]
        for own, points in zip(self.groups, self.points, strict=True):
            x, y = (self._out_of(own[0], points) - place[:2]).T
            q = np.abs(np.stack([x * c + y * s, y * c - x * s], 1) - middle) - half
            outside = np.hypot(*np.maximum(q, 0).T)
            distances.append((outside + np.minimum(q.max(1), 0)).min(initial=math.inf))
        return min(distances)

    @staticmethod
    def _out_of(place, points):
        """Points (N, 2) of a piece in the map."""
        c, s = math.cos(place[2]), math.sin(place[2])
        x, y = points.T
        return np.stack([place[0] + x * c - y * s, place[1] + x * s + y * c], 1)

    def distance(self, point):
        """Metres from (x, y) to the nearest edge of what is in the robot's way."""
        return min(
            to_segments(self._into(place, np.array(point, float)), segments).min(initial=math.inf)
            for (place, _, _), segments in zip(self.groups, self.segments, strict=True)
        )


def clipped(corners):
    """The part of a polygon between BODY_HEIGHTS."""
    for sign, height in zip((1, -1), BODY_HEIGHTS, strict=True):
        kept = []
        for p, q in zip(corners, corners[1:] + corners[:1], strict=True):
            above, next_above = sign * (p[2] - height), sign * (q[2] - height)
            kept += [p] if above >= 0 else []
            if (above < 0) != (next_above < 0):
                kept.append(p + (q - p) * (above / (above - next_above)))
        corners = kept
    return corners


def first_hit(origin, direction, triangles):
    """(distance along the direction, row) of the nearest triangle, by Möller and Trumbore."""
    a = triangles[:, 0]
    first, second = triangles[:, 1] - a, triangles[:, 2] - a
    across = np.cross(direction, second)
    determinant = (first * across).sum(1)
    with np.errstate(all="ignore"):
        from_corner = origin - a
        u = (from_corner * across).sum(1) / determinant
        normal = np.cross(from_corner, first)
        v = (normal * direction).sum(1) / determinant
        distance = (second * normal).sum(1) / determinant
        hit = (u >= -1e-9) & (v >= -1e-9) & (u + v <= 1 + 1e-9) & (distance > 1e-6)
    distance = np.where(hit, distance, np.inf)
    row = int(distance.argmin())
    return float(distance[row]), row


def to_segments(point, segments):
    a, edge = segments[:, 0], segments[:, 1] - segments[:, 0]
    share = ((point - a) * edge).sum(1) / np.maximum((edge * edge).sum(1), 1e-12)
    nearest = a + np.clip(share, 0, 1)[:, None] * edge
    return np.hypot(*(nearest - point).T)


def compare(simulation, random, rays=90, pixels=120, points=200):
    """Differences of a Simulation without movers and noise: scan (m), depth (mm), labels equal, free (m)."""
    room = IndependentRoom(simulation.room.places)
    x, y, yaw = (float(v) for v in planar(simulation.pose("robot")))
    eye = np.array([x + 0.156 * math.cos(yaw), y + 0.156 * math.sin(yaw), 0.105])
    ranges, scan = simulation.scan().ranges, []
    for k in range(0, 360, 360 // rays):
        angle = yaw + math.radians(k)
        expected, _ = room.cast(eye, np.array([math.cos(angle), math.sin(angle), 0.0]))
        if 0.05 < expected < 7.9:
            scan.append(ranges[k] - expected)
    depth, labels = simulation.depth().astype(int), simulation.labels()
    camera, directions = simulation._camera_pose("front"), simulation.depth_camera().rays()
    height, width = depth.shape
    errors, equal = [], []
    for _ in range(pixels):
        row, column = int(random.integers(height)), int(random.integers(width))
        expected, label = room.cast(camera.position, camera.rotation @ directions[row, column])
        if math.isfinite(expected):
            errors.append(depth[row, column] - 1000 * expected)
            equal.append(label == labels[row, column])
    free, differences = simulation.room.free_space, []
    for place in random.uniform((-0.9, -2.1), (5.6, 2.3), (points, 2)):
        if free.distance(*place) > 0.02:
            differences.append(free.distance(*place) - room.distance(place))
    found = {"scan": scan, "depth": errors, "labels": equal, "free": differences}
    return {name: np.array(values) for name, values in found.items()}


def planar(pose):
    return pose[0], pose[1], 2 * math.atan2(pose[5], pose[6])
