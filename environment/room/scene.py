"""The scene of the recorded drive, made coarse enough to be drawn 30 times a second.

Geometry comes from environment/drive/render_scene.py. What the drivable room adds: a second marker on the
wall behind the start, and the lighting of an evening.
"""

import sys
from pathlib import Path

import bpy  # isort: skip  (first: it makes bmesh and mathutils importable)
import bmesh
import cv2
import numpy as np
from mathutils import Vector
from mathutils.bvhtree import BVHTree

sys.path.insert(0, str(Path(__file__).parents[1] / "drive"))
import render_scene as drive

FRAME = 30  # where the moving things stand while their light is baked
MOVERS = ("person", "toycar", "ball")
# Thin things on top of others: painted into the texture below, as two surfaces so close would flicker.
DECALS = ("tape", "slit", "band")
SMOOTH = {
    *("s_base", "s_seat", "s_bk", "s_arm", "s_pillow", "c_cush", "torso", "pelvis", "shoeL", "shoeR"),
    *("body", "cab", "slip0", "slip1", "slipt0", "slipt1"),
}
ROUND = {
    "head": 0.3,
    "hair": 0.3,
    "handL": 0.15,
    "handR": 0.15,
    "ball": 0.7,
}  # share of the faces that is kept
FLAT = {"sign", "stand", "carton", "book", "pict_fr"}
ROOM_LABELS = {"wall", "skirting", "door", "window"}
WALL_MARKER = {"id": 12, "side": drive.MARKER_SIDE, "position": (drive.X0 + 0.004, 0.55, 0.45)}


def stem(name):
    return name.split(".")[0]


def build():
    """The whole scene at FRAME, with coarse modifiers."""
    bpy.ops.wm.read_factory_settings(use_empty=True)
    drive.settings(16, 2)
    for part in ("room", "furniture", "signs", "person", "toycar", "ball"):
        getattr(drive, f"build_{part}")()
    build_wall_marker()
    for ob in bpy.data.objects:
        for modifier in list(ob.modifiers):
            coarsen(ob, modifier)
        share = 0.4 if ob.name.endswith("_m") else ROUND.get(ob.name)
        if share and ob.type == "MESH":
            ob.modifiers.new("fewer", "DECIMATE").ratio = share
    bpy.context.scene.frame_set(FRAME)
    bpy.context.view_layer.update()
    bpy.data.objects["outside"].visible_shadow = False  # or it shuts the sun out


def build_wall_marker():
    dictionary = cv2.aruco.getPredefinedDictionary(cv2.aruco.DICT_4X4_50)
    image = cv2.aruco.generateImageMarker(dictionary, WALL_MARKER["id"], 480)
    image = cv2.copyMakeBorder(image, 80, 80, 80, 80, cv2.BORDER_CONSTANT, value=255)
    image = np.repeat(np.where(image > 128, 236, 18).astype(np.uint8)[..., None], 3, 2)
    side = WALL_MARKER["side"] * 640 / 480
    half_turn = (0, 0, np.pi / 2)
    drive.panel(
        "wall_marker", side, side, image, WALL_MARKER["position"], half_turn, "marker", 0.7, None, thick=0
    )


def coarsen(ob, modifier):
    name, vertices = stem(ob.name), len(ob.data.vertices)
    if modifier.type == "SUBSURF":
        modifier.levels = modifier.render_levels = 1 if vertices <= 8 else 0
    elif modifier.type == "BEVEL":
        if modifier.segments == 3 and name in SMOOTH:
            modifier.segments = 2
        elif name in FLAT or (modifier.width < 0.0055 and vertices <= 8):
            ob.modifiers.remove(modifier)
        else:
            modifier.segments = 1


def atlas_of(ob):
    """The texture that an object is painted on."""
    root = ob
    while root.parent:
        root = root.parent
    label = drive.LABELS[ob.pass_index]
    if root.name in MOVERS:
        return "movers"
    if ob.name == "outside":
        return "outside"
    if stem(ob.name) in ("sign", "marker", "wall_marker"):
        return "signs"
    if label in ("floor", "rug"):
        return label
    return "room" if label in ROOM_LABELS or stem(ob.name) in ("ceiling",) else "furniture"


def world_triangles(mesh, matrix):
    """Triangles (N, 3, 3) of a mesh in the world, and the polygon of each."""
    mesh.calc_loop_triangles()
    matrix = np.array(matrix)
    vertices = np.array([v.co for v in mesh.vertices]).reshape(-1, 3) @ matrix[:3, :3].T + matrix[:3, 3]
    triangles = np.array([t.vertices for t in mesh.loop_triangles]).reshape(-1, 3)
    return vertices[triangles], np.array([t.polygon_index for t in mesh.loop_triangles])


def evaluated_mesh(ob, depsgraph, number):
    """A copy with modifiers applied; attributes: each vertex's own coordinates, each face's label, object."""
    mesh = bpy.data.meshes.new_from_object(
        ob.evaluated_get(depsgraph), preserve_all_data_layers=True, depsgraph=depsgraph
    )
    own = np.empty(len(mesh.vertices) * 3, np.float32)
    mesh.vertices.foreach_get("co", own)
    mesh.attributes.new("own", "FLOAT_VECTOR", "POINT").data.foreach_set("vector", own)
    for name, value in (("label", ob.pass_index), ("object", number)):
        values = np.full(len(mesh.polygons), value, np.int32)
        mesh.attributes.new(name, "INT", "FACE").data.foreach_set("value", values)
    return mesh


def collect():
    """Copies of all meshes as {atlas: [(copy, original)]}, decals, object names, joints of the movers."""
    depsgraph = bpy.context.evaluated_depsgraph_get()
    parts, decals, names, joints = {}, [], [], {}
    originals = [o for o in bpy.data.objects if o.type in ("MESH", "FONT")]
    for ob in sorted(
        originals, key=lambda o: stem(o.name) != "tape"
    ):  # tape lies below the slit and the writing
        if ob.type == "FONT" or stem(ob.name) in DECALS:
            mesh = bpy.data.meshes.new_from_object(ob.evaluated_get(depsgraph), depsgraph=depsgraph)
            color = drive.srgb(ob.active_material.name.split("_")[1])
            decals.append((ob.parent.name, world_triangles(mesh, ob.matrix_world)[0], color))
            continue
        mesh = evaluated_mesh(ob, depsgraph, len(names))
        copy = bpy.data.objects.new("copy_" + ob.name, mesh)
        bpy.context.scene.collection.objects.link(copy)
        copy.matrix_world, copy.pass_index = ob.matrix_world, ob.pass_index
        parts.setdefault(atlas_of(ob), []).append((copy, ob))
        if atlas_of(ob) == "movers":
            joint = ob
            while joint.type != "EMPTY" and joint.parent:
                joint = joint.parent
            joints[len(names)] = joint.name
        names.append(ob.name)
    for ob in bpy.data.objects:
        if ob.type in ("MESH", "FONT") and not ob.name.startswith("copy_"):
            ob.hide_render = True
    return parts, decals, names, joints


def prepare_materials():
    """Own coordinates from the attribute, images from the UV map; no metal: it has no diffuse light."""
    for material in bpy.data.materials:
        tree = material.node_tree
        for node in list(tree.nodes):
            if node.type == "TEX_COORD" and node.outputs["Object"].is_linked:
                own = tree.nodes.new("ShaderNodeAttribute")
                own.attribute_name = "own"
                for edge in list(node.outputs["Object"].links):
                    tree.links.new(own.outputs["Vector"], edge.to_socket)
            elif node.type == "TEX_IMAGE":
                uv = tree.nodes.new("ShaderNodeUVMap")
                uv.uv_map = "image"
                tree.links.new(uv.outputs[0], node.inputs[0])
            elif node.type == "BSDF_PRINCIPLED":
                node.inputs["Metallic"].default_value = 0


def solid_tree(parts):
    """All closed bodies of these atlases, to ask what hides a place."""
    vertices, faces = [], []
    for atlas, pairs in parts.items():
        for copy, ob in pairs:
            if atlas == "outside" or drive.LABELS[ob.pass_index] == "plant":
                continue
            matrix, offset = np.array(copy.matrix_world), len(vertices)
            own = np.array([v.co for v in copy.data.vertices])
            vertices += list(map(tuple, own @ matrix[:3, :3].T + matrix[:3, 3]))
            faces += [tuple(i + offset for i in polygon.vertices) for polygon in copy.data.polygons]
    return BVHTree.FromPolygons(vertices, faces, all_triangles=False)


def camera_places(tree):
    """Places at the camera's height over free floor, (N, 3)."""
    random = np.random.default_rng(0)
    places = []
    for x in np.arange(drive.X0 + 0.25, drive.X1 - 0.2, 0.45):
        for y in np.arange(drive.Y0 + 0.25, drive.Y1 - 0.2, 0.45):
            place = Vector((x + random.uniform(-0.1, 0.1), y + random.uniform(-0.1, 0.1), 0.2))
            distance = tree.ray_cast(place, Vector((0, 0, -1)))[3]
            if distance is not None and abs(distance - 0.2) < 0.02:
                places.append(place)
    return np.array(places)


def is_visible(polygon, vertices, places, tree, two_sided):
    corners = vertices[list(polygon.vertices)]
    normal = np.cross(corners[1] - corners[0], corners[-1] - corners[0])
    length = np.linalg.norm(normal)
    if length < 1e-12:
        return False
    normal, center = normal / length, corners.mean(0)
    points = [center, *(center + (corners[:8] - center) * 0.9)]
    if polygon.area > 0.02:
        points += list(center + (corners[:4] - center) * 0.5)
    for point in points:
        towards = places - point
        height = towards @ normal
        indices = np.nonzero((height > 1e-3) | two_sided)[0]
        for i in indices[np.argsort((towards[indices] ** 2).sum(1))][:40:2]:
            length = float(np.linalg.norm(towards[i]))
            start = Vector(point + np.sign(height[i]) * normal * 3e-4)
            if tree.ray_cast(start, Vector(towards[i] / length), length)[0] is None:
                return True
    return False


def remove_faces(mesh, faces):
    edited = bmesh.new()
    edited.from_mesh(mesh)
    edited.faces.ensure_lookup_table()
    bmesh.ops.delete(edited, geom=[edited.faces[i] for i in faces], context="FACES")
    edited.to_mesh(mesh)
    edited.free()
    mesh.update()


def remove_unseen_faces(parts, tree):
    places = camera_places(tree)
    for atlas, pairs in parts.items():
        for copy, ob in pairs:
            mesh, matrix = copy.data, np.array(copy.matrix_world)
            if atlas == "floor":
                remove_faces(mesh, [p.index for p in mesh.polygons if p.normal.z < 0.9])
            if atlas in ("movers", "outside", "floor"):
                continue
            vertices = np.array([v.co for v in mesh.vertices]) @ matrix[:3, :3].T + matrix[:3, 3]
            leaf = drive.LABELS[ob.pass_index] == "plant"
            unseen = [p.index for p in mesh.polygons if not is_visible(p, vertices, places, tree, leaf)]
            if unseen:
                remove_faces(mesh, unseen)
    return len(places)


def cut_behind_picture(parts):
    """Removes the face of the frame behind the picture, 0.8 mm: two faces so close flicker."""
    copy = next(copy for copy, ob in parts["furniture"] if ob.name == "pict_fr")
    edited = bmesh.new()
    edited.from_mesh(copy.data)
    front = [face for face in edited.faces if face.normal.x < -0.9]
    bmesh.ops.inset_region(edited, faces=front, thickness=0.04)
    bmesh.ops.delete(edited, geom=front, context="FACES_ONLY")
    edited.to_mesh(copy.data)
    edited.free()
    own = np.empty(len(copy.data.vertices) * 3, np.float32)
    copy.data.vertices.foreach_get("co", own)
    copy.data.attributes["own"].data.foreach_set("vector", own)


def set_lighting(lighting):
    """`day` is the recorded drive's light. In the `evening` the lamp is on, and the window is dark."""
    if lighting == "day":
        return
    for name, energy, color in (
        ("sun", 0.0, None),
        ("win", 1.2, (0.45, 0.6, 1)),
        ("lamp", 60.0, (1, 0.78, 0.52)),
    ):
        light = bpy.data.lights[name]
        light.energy = energy
        if color:
            light.color = color
    for material in bpy.data.materials:
        for node in material.node_tree.nodes:
            if node.type == "EMISSION":
                node.inputs["Strength"].default_value = 0.01
    background = bpy.context.scene.world.node_tree.nodes["Background"]
    background.inputs["Color"].default_value = (0.01, 0.01, 0.012, 1)
