"""What simulations of one room share: the laser, the renderers and their views."""

import math
from functools import cached_property

import cv2
import numpy as np

from .depth import TriangleDepth
from .laser import Laser, crosses, cut
from .renderer import ColorRenderer, NumberRenderer, configure_panda3d
from .wheels import DISCS

FLAT = ("floor", "rug")
KINDS = {"skirting": "wall", "toy": "building blocks", "clutter": "slippers"}  # of what stands low
OUTLINE_HEIGHTS = (0.03, 0.06, 0.105, 0.2, 0.35)  # metres


class Scene:
    """A Room as sensors see it, made with the first use; simulations of one thread can share it."""

    def __init__(self, room):
        configure_panda3d()  # a missing one is told here, not with the first image
        self.room = room
        self._color_views, self._number_views = {}, {}

    @cached_property
    def laser(self):
        return Laser(self.room.model)

    @cached_property
    def number_renderer(self):
        return NumberRenderer(self.room.model)

    def color_view(self, model, lighting):
        """A ColorRenderer, its view for a camera, and the two maps from its drawn image to the camera's."""
        key = model, lighting
        if key not in self._color_views:
            renderer = ColorRenderer(self.room, lighting)
            view = renderer.add_view(model, 1.15 if model.width <= 640 else 1.0)
            pixels = view.pinhole.project(model.rays())
            col, row = np.moveaxis(pixels, -1, 0)
            row = view.pinhole.height - 1 - row  # the first row is at the bottom
            maps = cv2.convertMaps(col.astype(np.float32), row.astype(np.float32), cv2.CV_16SC2)
            self._color_views[key] = renderer, view, *maps
        return self._color_views[key]

    def number_view(self, model):
        """The view of `number_renderer` for a camera, and the TriangleDepth of its pixels."""
        if model not in self._number_views:
            view = self.number_renderer.add_view(model)
            self._number_views[model] = view, TriangleDepth(self.room.model, model, view.pinhole)
        return self._number_views[model]

    @cached_property
    def _outlines(self):
        """Segments (N, 2, 2) of what stands still at some heights of the body, and their labels (N,)."""
        model = self.room.model
        flat = [number for number, name in model.label_names.items() if name in FLAT]
        is_still = (model.joint < 0) & ~np.isin(model.label, flat)
        triangles, labels = model.triangles[is_still], model.label[is_still]
        parts = [(cut(triangles, z), labels[crosses(triangles, z)]) for z in OUTLINE_HEIGHTS]
        return [np.concatenate(arrays) for arrays in zip(*parts, strict=True)]

    def thing_at(self, place):
        """The name of what stands nearest to the body at (x, y, yaw)."""
        segments, labels = self._outlines
        x, y, yaw = place
        c, s = math.cos(yaw), math.sin(yaw)
        first, edge = segments[:, 0], segments[:, 1] - segments[:, 0]
        length = np.maximum((edge**2).sum(1), 1e-12)
        nearest = []
        for a, b, radius in DISCS:
            way = (x + a * c - b * s, y + a * s + b * c) - first
            along = np.clip((way * edge).sum(1) / length, 0, 1)
            nearest.append(np.hypot(*(way - along[:, None] * edge).T) - radius)
        name = self.room.model.label_names[int(labels[np.min(nearest, 0).argmin()])]
        return KINDS.get(name, name)

    def close(self):
        """Frees the images; it cannot be used any more."""
        for renderer, *_ in self._color_views.values():
            renderer.close()
        if "number_renderer" in vars(self):
            self.number_renderer.close()
