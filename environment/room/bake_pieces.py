"""Bake what furnished rooms are made of: pieces that can be moved, and the light of the empty room.

    python bake_pieces.py OUT      needs bpy (see README.md); about half an hour of processor time

Writes OUT/geometry.npz, OUT/scene.json, and arrays of colours and light; compose_pieces.py makes files of
them. A second run bakes only what is not there yet.
"""

import argparse
import json
import math
import time
from pathlib import Path

import bake
import bpy
import numpy as np
import pieces
import scene
from scene import drive

COLORED = ("rug", "signs", "furniture", "room", "floor")
FLOOR_LIGHT, ROOM_LIGHT, FURNITURE_LIGHT = (1024, 704), (1024, 1024), (1024, 1024)  # texels
# The light on small cubes at these places of the empty room, metres.
PROBES = (np.linspace(-0.7, 5.4, 14), np.linspace(-1.9, 2.1, 10), np.linspace(0.1, 1.6, 6))
CUBE = 0.01  # metres, half a side
CUBE_FACES = (
    ((1, -1, -1), (1, 1, -1), (1, 1, 1), (1, -1, 1)),
    ((-1, 1, -1), (-1, -1, -1), (-1, -1, 1), (-1, 1, 1)),
    ((1, 1, -1), (-1, 1, -1), (-1, 1, 1), (1, 1, 1)),
    ((-1, -1, -1), (1, -1, -1), (1, -1, 1), (-1, -1, 1)),
    ((-1, -1, 1), (1, -1, 1), (1, 1, 1), (-1, 1, 1)),
    ((-1, 1, -1), (1, 1, -1), (1, -1, -1), (-1, -1, -1)),
)  # +x, -x, +y, -y, +z, -z
WOOD = (0.27, 0.15, 0.08)  # the mean colour of the floor
WORDS = (
    "KITCHEN",
    "OFFICE",
    "BEDROOM",
    "GARAGE",
    "LIBRARY",
    "STUDIO",
    "PANTRY",
    "LAUNDRY",
    "NURSERY",
    "CELLAR",
)
WORD_HEIGHT = 0.75  # metres: only the sign's first line is above


def write_geometry(out, parts, names, joints):
    """OUT/geometry.npz and OUT/scene.json; returns the joined object and the triangles of each atlas."""
    owner = {ob.name: pieces.piece_of(ob) for pairs in parts.values() for _, ob in pairs}
    origins = pieces.origins()
    markers = pieces.markers_in_pieces(origins)
    joined = {atlas: bake.join(pairs, atlas) for atlas, pairs in parts.items()}
    exported = {atlas: bake.triangles_of(ob) for atlas, ob in joined.items()}
    arrays = {f"{atlas}_{key}": value for atlas, part in exported.items() for key, value in part.items()}
    vertices, joint, joint_names, joint_tree = bake.moving_parts(exported["movers"], joints)
    arrays |= {"movers_vertices": vertices, "movers_joint": joint}
    np.savez_compressed(out / "geometry.npz", **arrays)
    description = {"labels": drive.LABELS, "objects": names, "joints": joint_names, "joint_tree": joint_tree}
    description |= {"markers": markers, "marker_side": drive.MARKER_SIDE, "origins": origins}
    description["piece_of"] = owner
    (out / "scene.json").write_text(json.dumps(description, indent=0))
    return joined, exported


class Baker:
    """The joined objects of the atlases, and what is baked of them into a folder."""

    def __init__(self, out, joined, exported, names):
        self.out, self.joined, self.exported, self.names = out, joined, exported, names
        self._started = time.time()

    def report(self, step):
        print(f"{time.time() - self._started:6.0f} s  {step}", flush=True)

    def save(self, name, make, dtype=np.float16):
        """Writes the array that `make` returns, unless it is there already."""
        path = self.out / f"{name}.npy"
        if not path.exists():
            array = make()
            np.save(path, array.astype(dtype))
            self.report(name)

    def show(self, *atlases):
        for atlas, ob in self.joined.items():
            ob.hide_render = atlas not in atlases

    def colors(self, decals):
        """The sign's first line is left out: `words` has it."""
        kept = [d for d in decals if not (d[0] == "sign" and d[1][..., 2].mean() > WORD_HEIGHT)]
        for atlas in COLORED:
            self.save(f"{atlas}_albedo", lambda atlas=atlas: self._colors(atlas, kept))

    def _colors(self, atlas, decals):
        samples = bake.COLOR_SAMPLES.get(atlas, 3)
        albedo = bake.bake(self.joined[atlas], bake.COLOR_SIZE[atlas], samples, {"COLOR"})
        painted = bake.paint_decals(albedo, self.exported[atlas], decals, self.names)
        self.report(f"{painted} decals painted")
        return albedo

    def words(self):
        """How much ink of each word is on each texel of the signs, 0 to 255."""
        for word in WORDS:
            self.save(f"word_{word}", lambda word=word: self._word(word), np.uint8)

    def _word(self, word):
        width, height = bake.COLOR_SIZE["signs"]
        page = np.zeros((height, width, 1))
        decal = ("sign", pieces.text_on_sign(word), (1.0,))
        if not bake.paint_decals(page, self.exported["signs"], [decal], self.names):
            raise RuntimeError(f"{word} found no face of the sign")
        return page[..., 0] * 255 + 0.5

    def buried(self, atlas, tree, size):
        self.save(f"{atlas}_buried", lambda: bake.buried_texels(self.exported[atlas], size, tree), bool)

    def dome(self):
        """The light on the furniture below a white sky, each piece alone on a wooden floor."""
        self.save("furniture_dome", self._dome)

    def _dome(self):
        mesh = self.joined["furniture"].data
        vertices = np.empty(len(mesh.vertices) * 3, np.float32)
        mesh.vertices.foreach_get("co", vertices)
        moved = pieces.moved_apart(self.joined["furniture"], self.names)
        mesh.vertices.foreach_set("co", moved.ravel())
        mesh.update()
        floor = pieces.wooden_floor(WOOD)
        self.show("furniture")
        with pieces.white_sky():
            light = bake.bake(self.joined["furniture"], FURNITURE_LIGHT, 16, {"DIRECT", "INDIRECT"})
        bpy.data.objects.remove(floor)
        mesh.vertices.foreach_set("co", vertices)
        mesh.update()
        return light

    def empty_room(self, lighting):
        """Bounced light, light of window and lamp, and the sun, each apart; and that of the probes."""
        scene.set_lighting(lighting)
        sun = bpy.data.lights["sun"]
        energy = sun.energy
        self.show("floor", "room", "outside")
        for atlas, size in (("floor", FLOOR_LIGHT), ("room", ROOM_LIGHT)):
            self._bake_light(atlas, size, f"{atlas}_{lighting}_indirect", {"INDIRECT"})
        self._bake_light("room", ROOM_LIGHT, f"room_{lighting}_direct", {"DIRECT"})
        if lighting == "day":
            self._bake_light("floor", FLOOR_LIGHT, "floor_day_sunny", {"DIRECT"})
        self.save(f"probes_{lighting}_indirect", lambda: self._probes({"INDIRECT"}))
        sun.energy = 0
        self._bake_light("floor", FLOOR_LIGHT, f"floor_{lighting}_direct", {"DIRECT"})
        self.save(f"probes_{lighting}_direct", lambda: self._probes({"DIRECT"}))
        sun.energy = energy

    def _bake_light(self, atlas, size, name, passes):
        samples = 12 if passes == {"INDIRECT"} else 8
        self.save(name, lambda: bake.bake(self.joined[atlas], size, samples, passes))

    def _probes(self, passes):
        """(x, y, z, face of the cube, 3) float32."""
        cubes, side, count = probe_cubes()
        light = bake.bake(cubes, (side * 2, side * 2), 64, passes)
        bpy.data.objects.remove(cubes)
        light = light.reshape(side, 2, side, 2, 3).mean((1, 3)).reshape(-1, 3)[:count]
        return light.reshape(*map(len, PROBES), len(CUBE_FACES), 3)


def probe_cubes():
    """A mesh of all probes, each face in a square of the atlas; squares in a row; faces in all."""
    centers = np.stack(np.meshgrid(*PROBES, indexing="ij"), -1).reshape(-1, 3)
    corners = centers[:, None, None] + CUBE * np.array(CUBE_FACES)
    count = len(centers) * len(CUBE_FACES)
    side = math.ceil(math.sqrt(count))
    square = np.stack([np.arange(count) % side, np.arange(count) // side], -1)[:, None]
    uv = (square + np.array([(0.02, 0.02), (0.98, 0.02), (0.98, 0.98), (0.02, 0.98)])) / side
    faces = np.arange(count * 4).reshape(-1, 4)
    cubes = drive.mesh("probes", corners.reshape(-1, 3).tolist(), faces.tolist(), uv.reshape(-1, 2))
    cubes.data.materials.append(pieces.plain_material((0.02, 0.02, 0.02)))
    bake.add_layers(cubes.data)
    bake.set_corner_values(cubes.data, uv.reshape(-1, 2))
    return cubes, side, count


def without_bumps():
    """They are finer than a texel of the light."""
    for material in bpy.data.materials:
        for node in material.node_tree.nodes:
            if node.type == "BUMP":
                node.inputs["Strength"].default_value = 0


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("out", type=Path)
    parser.add_argument("--geometry", action="store_true", help="stop before the colours are baked")
    arguments = parser.parse_args()
    arguments.out.mkdir(parents=True, exist_ok=True)
    scene.build()
    pieces.flatten_boxes()
    parts, decals, names, joints = scene.collect()
    scene.prepare_materials()
    scene.cut_behind_picture(parts)
    trees = {atlas: pieces.tree_of(parts[atlas]) for atlas in ("room", "furniture")}
    pieces.remove_unseen_faces(parts)
    baker = Baker(arguments.out, *write_geometry(arguments.out, parts, names, joints), names)
    for atlas, part in baker.exported.items():
        baker.report(f"{atlas}: {len(part['uv'])} triangles")
    if arguments.geometry:
        return
    bpy.context.scene.render.use_persistent_data = False
    baker.joined["outside"].visible_shadow = False
    baker.words()
    for atlas, size in (("room", ROOM_LIGHT), ("furniture", FURNITURE_LIGHT)):
        baker.buried(atlas, trees[atlas], size)
    baker.show(*COLORED)
    baker.colors(decals)
    without_bumps()
    baker.dome()
    for lighting in ("day", "evening"):
        baker.empty_room(lighting)


if __name__ == "__main__":
    main()
