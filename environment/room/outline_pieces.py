"""Outlines of the pieces of furniture, seen from above: `python environment/room/outline_pieces.py PIECES`.

PIECES is the folder with geometry.npz and scene.json. outlines.json has, for each piece, its convex `hull`, and
the outlines of its `body`, the part between the heights of the robot's body; for "room" those of walls and
skirtings. Polygons [[x, y], ...] in whole millimetres, in the frame of the piece.
"""

import json
import sys
from pathlib import Path

import cv2
import numpy as np

BODY_HEIGHTS = (0.02, 0.22)  # metres, as in compose.py, which needs bpy
MARGIN = 5  # millimetres around what is drawn


def clipped(corners, low, high):
    """The part (K, 3) of a polygon between two heights."""
    for sign, height in ((1, low), (-1, high)):
        kept = []
        for p, q in zip(corners, [*corners[1:], *corners[:1]], strict=True):
            a, b = sign * (p[2] - height), sign * (q[2] - height)
            if a >= 0:
                kept.append(p)
            if (a < 0) != (b < 0):
                kept.append(p + (q - p) * (a / (a - b)))
        corners = kept
    return corners


def outlines(triangles, mode):
    """Outlines of what stands between BODY_HEIGHTS, to 1 mm."""
    parts = [clipped(list(t), *BODY_HEIGHTS) for t in triangles.astype(float)]
    parts = [np.rint(np.array(p)[:, :2] * 1000).astype(np.int32) for p in parts if len(p) > 1]
    if not parts:
        return []
    origin = np.concatenate(parts).min(0) - MARGIN
    width, height = np.concatenate(parts).max(0) - origin + MARGIN
    image = np.zeros((height, width), np.uint8)
    for part in parts:
        cv2.fillConvexPoly(image, cv2.convexHull(part - origin), 1)
        cv2.polylines(image, [part - origin], True, 1)
    found, _ = cv2.findContours(image, mode, cv2.CHAIN_APPROX_NONE)
    return [(cv2.approxPolyDP(c, 1.0, True)[:, 0] + origin).tolist() for c in found]


def hull(triangles):
    points = np.rint(triangles.reshape(-1, 3)[:, :2] * 1000).astype(np.int32)
    return cv2.convexHull(points)[:, 0].tolist()


def main(folder):
    geometry = np.load(folder / "geometry.npz")
    names = list(json.loads((folder / "scene.json").read_text(encoding="utf-8"))["origins"])
    triangles, piece = geometry["triangles"], geometry["piece"]
    stays = (piece < 0) & (geometry["joint"] < 0) & (geometry["label"] > 1)
    result = {"room": {"body": outlines(triangles[stays], cv2.RETR_CCOMP)}}
    for number, name in enumerate(names):
        own = triangles[piece == number]
        body = [] if name == "rug" else outlines(own, cv2.RETR_EXTERNAL)
        result[name] = {"hull": hull(own), "body": body}
    text = json.dumps(result, separators=(",", ":")).replace('},"', '},\n"')
    (folder / "outlines.json").write_text(text + "\n", encoding="utf-8")


if __name__ == "__main__":
    main(Path(sys.argv[1]))
