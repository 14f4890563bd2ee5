"""The furniture of the room as pieces that can be moved: which object belongs to which, where each stands,
and what of each can be seen from around it."""

import contextlib
import math

import bpy
import numpy as np
import scene
from bake import marker_poses
from mathutils import Vector
from mathutils.bvhtree import BVHTree
from scene import drive

# The piece of each object that has no parent; everything else stays where it is.
PIECE_OF = {
    **{
        name: name
        for name in ("sofa", "table", "chair", "shelf", "bin", "stand", "sign", "wall_marker", "rug")
    },
    **{"carton": "cartons", "carton.001": "cartons", "carton.002": "carton", "pot": "plant"},
    **{"slip0": "slippers", "slip1": "slippers", "pict_fr": "picture"},
    **{f"block{k}": "blocks" for k in range(5)},
}
ROOM, MOVER = "room", "mover"
EYE_HEIGHT = 0.2  # metres


def root_of(ob):
    while ob.parent:
        ob = ob.parent
    return ob


def piece_of(ob):
    if scene.atlas_of(ob) == "movers":
        return MOVER
    return PIECE_OF.get(root_of(ob).name, ROOM)


def by_piece(parts):
    """{piece: [(copy, original)]} of what stands still."""
    pieces = {}
    for atlas, pairs in parts.items():
        for copy, ob in pairs:
            if atlas not in ("movers", "outside"):
                pieces.setdefault(piece_of(ob), []).append((copy, ob))
    return pieces


def origins():
    """{piece: (x, y)}: where the first object of each stands in the recorded room."""
    places = {}
    for name, piece in PIECE_OF.items():
        places.setdefault(
            piece, [round(float(v), 6) for v in bpy.data.objects[name].matrix_world.translation[:2]]
        )
    return places


def markers_in_pieces(places):
    """The markers' poses, from the origins of their pieces."""
    poses = marker_poses()
    for marker, piece in (("marker", "stand"), ("wall_marker", "wall_marker")):
        x, y = places[piece]
        poses[marker][:2] = [round(poses[marker][0] - x, 9), round(poses[marker][1] - y, 9)]
    return poses


def world_vertices(copy):
    matrix = np.array(copy.matrix_world)
    return np.array([v.co for v in copy.data.vertices]).reshape(-1, 3) @ matrix[:3, :3].T + matrix[:3, 3]


def tree_of(pairs):
    """What hides: the bodies of pairs, but no leaves."""
    vertices, faces = [], []
    for copy, ob in pairs:
        if drive.LABELS[ob.pass_index] == "plant" and scene.stem(ob.name) == "leaf":
            continue
        offset = len(vertices)
        vertices += list(map(tuple, world_vertices(copy)))
        faces += [tuple(i + offset for i in polygon.vertices) for polygon in copy.data.polygons]
    return BVHTree.FromPolygons(vertices, faces, all_triangles=False)


def places_around(pairs, tree):
    """Places of a camera around a piece and, where there is room, below it: (N, 3)."""
    corners = np.concatenate([world_vertices(copy)[:, :2] for copy, _ in pairs])
    low, high = corners.min(0), corners.max(0)
    center, radius = (low + high) / 2, np.linalg.norm(high - low) / 2
    places = []
    for distance in (0.15, 0.7, 2.5):
        angles = np.linspace(0, 2 * math.pi, 20, endpoint=False) + distance
        ring = center + (radius + distance) * np.column_stack([np.cos(angles), np.sin(angles)])
        places += [(x, y, EYE_HEIGHT) for x, y in ring]
    for x in np.arange(low[0] + 0.1, high[0], 0.15):
        for y in np.arange(low[1] + 0.1, high[1], 0.15):
            place = Vector((x, y, EYE_HEIGHT))
            if tree.ray_cast(place, Vector((0, 0, -1)))[0] is None:
                places.append(tuple(place))
    return np.array(places)


def places_in_room():
    xs = np.arange(drive.X0 + 0.3, drive.X1 - 0.2, 0.45)
    ys = np.arange(drive.Y0 + 0.25, drive.Y1 - 0.1, 0.45)
    return np.array([(x, y, EYE_HEIGHT) for x in xs for y in ys])


def remove_unseen_faces(parts):
    """Removes the faces that nobody sees, wherever the pieces stand: each piece is looked at alone."""
    for piece, pairs in by_piece(parts).items():
        tree = tree_of(pairs)
        places = places_in_room() if piece == ROOM else places_around(pairs, tree)
        for copy, ob in pairs:
            unseen = unseen_faces(copy, ob, places, tree)
            if unseen:
                scene.remove_faces(copy.data, unseen)


def unseen_faces(copy, ob, places, tree):
    polygons, label = copy.data.polygons, drive.LABELS[ob.pass_index]
    if label == "floor":
        return [polygon.index for polygon in polygons if polygon.normal.z < 0.9]
    vertices = world_vertices(copy)
    return [p.index for p in polygons if not scene.is_visible(p, vertices, places, tree, label == "plant")]


def text_on_sign(word):
    """Triangles of the sign's first line with another word, (N, 3, 3) in the world."""
    ink = drive.plain("15171a", 0.5)
    turn = (math.pi / 2, 0, -math.pi / 2)
    text = drive.text3d(word, 0.115, (-0.0036, 0, 0.065), turn, ink, "sign", parent=bpy.data.objects["sign"])
    bpy.context.view_layer.update()
    depsgraph = bpy.context.evaluated_depsgraph_get()
    mesh = bpy.data.meshes.new_from_object(text.evaluated_get(depsgraph), depsgraph=depsgraph)
    triangles = scene.world_triangles(mesh, text.matrix_world)[0]
    bpy.data.objects.remove(text)
    return triangles


def moved_apart(joined, names):
    """The vertices of the furniture, (N, 3) float32, its pieces far from each other and from the room."""
    mesh = joined.data
    vertices = np.empty(len(mesh.vertices) * 3, np.float32)
    mesh.vertices.foreach_get("co", vertices)
    vertices = vertices.reshape(-1, 3)
    owner = np.empty(len(mesh.polygons), np.int32)
    mesh.attributes["object"].data.foreach_get("value", owner)
    order = sorted({*PIECE_OF.values(), ROOM})
    to_own = np.linalg.inv(np.array(joined.matrix_world)[:3, :3])
    number = {k: order.index(piece_of(bpy.data.objects[names[k]])) for k in np.unique(owner)}
    corners = {}
    for polygon in mesh.polygons:
        corners.setdefault(number[owner[polygon.index]], set()).update(polygon.vertices)
    for k, rows in corners.items():
        vertices[list(rows)] += to_own @ (40 + 12 * (k % 5), 12 * (k // 5), 0)
    return vertices


def plain_material(color):
    material = bpy.data.materials.new("plain")
    material.use_nodes = True
    material.node_tree.nodes["Principled BSDF"].inputs["Base Color"].default_value = (*color, 1)
    return material


def wooden_floor(color):
    corners = [(-500, -500, 0), (500, -500, 0), (500, 500, 0), (-500, 500, 0)]
    floor = drive.mesh("wooden floor", corners, [(0, 1, 2, 3)])
    floor.data.materials.append(plain_material(color))
    return floor


@contextlib.contextmanager
def white_sky():
    """No light but that of a white sky."""
    lights = {light: light.energy for light in bpy.data.lights}
    inputs = bpy.context.scene.world.node_tree.nodes["Background"].inputs
    color, strength = tuple(inputs["Color"].default_value), inputs["Strength"].default_value
    for light in lights:
        light.energy = 0
    inputs["Color"].default_value, inputs["Strength"].default_value = (1, 1, 1, 1), 1
    yield
    inputs["Color"].default_value, inputs["Strength"].default_value = color, strength
    for light, energy in lights.items():
        light.energy = energy


def flatten_boxes():
    """Boxes get flat faces: on rounded edges alone, their shading would spread over the whole face."""
    for ob in bpy.data.objects:
        is_soft = any(modifier.type == "SUBSURF" for modifier in ob.modifiers)
        if ob.type == "MESH" and len(ob.data.vertices) == 8 and not is_soft:
            for polygon in ob.data.polygons:
                polygon.use_smooth = False
