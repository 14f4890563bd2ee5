"""Bake the living room: colours and light of every surface, as float arrays, and its geometry.

    python bake.py OUT [--samples 8]      needs bpy (see README.md); about twenty minutes on two cores

Writes OUT/geometry.npz, OUT/scene.json, and of each atlas OUT/<atlas>_albedo.npy, OUT/<atlas>_buried.npy and
OUT/<atlas>_<lighting>.npy. compose.py makes the textures of them.
A second run bakes only what is not there yet.
"""

import argparse
import json
import math
import time
from pathlib import Path

import bpy
import cv2
import numpy as np
import scene
from mathutils import Matrix
from scene import drive

# Texels of each atlas: width and height of colours and of light.
COLOR_SIZE = {
    "floor": (4096, 2048),
    "rug": (1024, 1024),
    "room": (2048, 2048),
    "furniture": (2048, 2048),
    "signs": (1024, 1024),
    "movers": (1024, 1024),
}
LIGHT_SIZE = {
    "floor": (1024, 704),
    "rug": (384, 384),
    "room": (1024, 1024),
    "furniture": (1024, 1024),
    "signs": (256, 256),
    "movers": (512, 512),
}
ORDER = ("rug", "signs", "movers", "furniture", "room", "floor")
# Samples of each texel's colour: the grooves between planks are thinner than a texel.
COLOR_SAMPLES = {"floor": 24}
# Samples of each texel's light, where noise would be seen: on smooth walls, and on a body that comes near.
LIGHT_SAMPLES = {"room": 128, "movers": 128}
# Between islands, as a part of the texture: mipmaps mix neighbours (the reveal of the window, and a corner).
MARGIN = {"room": 0.008}
# Texels per metre, relative to the other objects of the same atlas.
DENSITY = {
    **dict.fromkeys(("stand", "pict_fr", "block0", "block1", "block2", "block3", "block4"), 1.6),
    **dict.fromkeys(("carton", "t_top", "mug", "door", "dpanel", "dpanel2", "frame", "skirt"), 1.5),
    **dict.fromkeys(("pict", "head"), 1.4),
    "w0": 0.7,
    "ceiling": 0.4,
    "book": 1.1,
    "s_base": 0.8,
    "s_back": 0.8,
    "ball": 1.6,
}


def select(objects):
    bpy.ops.object.select_all(action="DESELECT")
    for ob in objects:
        ob.select_set(True)
    bpy.context.view_layer.objects.active = objects[0]


def corner_values(mesh, layer="atlas"):
    uv = np.empty(len(mesh.loops) * 2, np.float32)
    mesh.uv_layers[layer].data.foreach_get("uv", uv)
    return uv.reshape(-1, 2)


def set_corner_values(mesh, uv):
    mesh.uv_layers["atlas"].data.foreach_set("uv", np.asarray(uv, np.float32).ravel())


def add_layers(mesh):
    if len(mesh.uv_layers):
        mesh.uv_layers[0].name = "image"
    else:
        mesh.uv_layers.new(name="image")
    mesh.uv_layers.new(name="atlas")
    mesh.uv_layers["atlas"].active = True


def flat_layout(copy, atlas):
    """Floor and rug from above, the sky from the room: one rectangle; the rug's sides unfolded."""
    mesh, matrix = copy.data, np.array(copy.matrix_world)
    vertices = np.array([v.co for v in mesh.vertices])
    if atlas == "floor":  # cropped to the room
        world = vertices @ matrix[:3, :3].T + matrix[:3, 3]
        world[:, :2] = np.clip(world[:, :2], (drive.X0, drive.Y0), (drive.X1, drive.Y1))
        own = ((world - matrix[:3, 3]) @ np.linalg.inv(matrix[:3, :3]).T).astype(np.float32)
        mesh.vertices.foreach_set("co", own.ravel())
        mesh.attributes["own"].data.foreach_set("vector", own.ravel())
        mesh.update()
        vertices = own
    axes, uv = ([0, 2] if atlas == "outside" else [0, 1]), np.empty((len(mesh.loops), 2))
    for polygon in mesh.polygons:
        loops = list(polygon.loop_indices)
        corners = vertices[[mesh.loops[i].vertex_index for i in loops]]
        uv[loops] = corners[:, axes]
        if atlas == "rug" and abs(polygon.normal.z) < 0.9:
            down = vertices[:, 2].max() - corners[:, 2]
            uv[loops] += down[:, None] * np.array(polygon.normal)[None, :2]
    low, high = uv.min(0), uv.max(0)
    set_corner_values(mesh, (uv - low) / (high - low))


def unwrap(copy, name):
    """Islands of one object, at the object's density."""
    select([copy])
    bpy.ops.object.mode_set(mode="EDIT")
    bpy.ops.mesh.select_all(action="SELECT")
    bpy.ops.uv.smart_project(angle_limit=math.radians(60), island_margin=0.0, area_weight=0.0)
    bpy.ops.object.mode_set(mode="OBJECT")
    mesh = copy.data
    triangles, _ = scene.world_triangles(mesh, copy.matrix_world)
    uv = corner_values(mesh)
    corners = uv[np.array([t.loops for t in mesh.loop_triangles])]
    area = np.linalg.norm(
        np.cross(triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0]), axis=1
    ).sum()
    first, second = corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]
    uv_area = np.abs(first[:, 0] * second[:, 1] - first[:, 1] * second[:, 0]).sum()
    density = DENSITY.get(scene.stem(name), 1.0)
    set_corner_values(mesh, uv * math.sqrt(area / max(uv_area, 1e-12)) * density * 0.05)


def join(pairs, atlas):
    """One object an atlas, its islands packed."""
    pairs = [(copy, ob) for copy, ob in pairs if len(copy.data.polygons)]
    for copy, ob in pairs:
        add_layers(copy.data)
        if atlas in ("floor", "rug", "outside"):
            flat_layout(copy, atlas)
        else:
            unwrap(copy, ob.name)
    select([copy for copy, _ in pairs])
    if len(pairs) > 1:
        bpy.ops.object.join()
    joined = bpy.context.view_layer.objects.active
    joined.data.uv_layers["atlas"].active = True
    if atlas not in ("floor", "rug", "outside"):
        bpy.ops.object.mode_set(mode="EDIT")
        bpy.ops.mesh.select_all(action="SELECT")
        bpy.ops.uv.select_all(action="SELECT")
        bpy.ops.uv.pack_islands(
            rotate=True,
            rotate_method="CARDINAL",
            scale=True,
            margin_method="FRACTION",
            margin=MARGIN.get(atlas, 0.002),
            shape_method="AABB",
        )
        bpy.ops.object.mode_set(mode="OBJECT")
    return joined


def bake(joined, size, samples, passes):
    """One bake of Cycles, (height, width, 3) float32, first row at the bottom."""
    image = bpy.data.images.new("target", *size, float_buffer=True, alpha=True)
    image.colorspace_settings.name = "Linear Rec.709"
    for material in {slot.material for slot in joined.material_slots if slot.material}:
        nodes = material.node_tree.nodes
        target = nodes.get("TARGET") or nodes.new("ShaderNodeTexImage")
        target.name, target.image = "TARGET", image
        nodes.active = target
        for node in nodes:
            node.select = node == target
    joined.data.uv_layers["atlas"].active = True
    for layer in joined.data.uv_layers:
        layer.active_render = layer.name == "image"
    select([joined])
    cycles = bpy.context.scene.cycles
    cycles.samples, cycles.use_adaptive_sampling = samples, False
    bpy.ops.object.bake(
        type="DIFFUSE", pass_filter=passes, use_clear=True, margin=8, margin_type="EXTEND", uv_layer="atlas"
    )
    pixels = np.empty(size[0] * size[1] * 4, np.float32)
    image.pixels.foreach_get(pixels)
    bpy.data.images.remove(image)
    return pixels.reshape(size[1], size[0], 4)[..., :3].copy()


def triangles_of(joined):
    """World vertices (N, 3, 3), atlas coordinates (N, 3, 2), label and object of each triangle."""
    mesh = joined.data
    vertices, polygons = scene.world_triangles(mesh, joined.matrix_world)
    uv = corner_values(mesh)[np.array([t.loops for t in mesh.loop_triangles])]

    def of_faces(name, dtype):
        values = np.empty(len(mesh.polygons), np.int32)
        mesh.attributes[name].data.foreach_get("value", values)
        return values[polygons].astype(dtype)

    return {
        "vertices": vertices.astype(np.float32),
        "uv": uv,
        "label": of_faces("label", np.uint8),
        "object": of_faces("object", np.uint16),
    }


def buried_texels(part, size, tree):
    """Texels of the light inside other bodies or between the islands: (height, width) bool."""
    width, height = size
    owner = np.full((height, width), -1, np.int32)
    corners = part["uv"] * (width, height) - 0.5
    for k, triangle in enumerate(corners):
        cv2.fillConvexPoly(owner, np.round(triangle * 16).astype(np.int32), k, shift=4)
    rows, cols = np.nonzero(owner >= 0)
    triangle = owner[rows, cols]
    first, second = corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]
    area = first[:, 0] * second[:, 1] - first[:, 1] * second[:, 0]
    area = np.where(np.abs(area) < 1e-9, np.inf, area)[triangle]
    offset, first, second = (
        np.stack([cols, rows], 1) - corners[triangle, 0],
        first[triangle],
        second[triangle],
    )
    s = (offset[:, 0] * second[:, 1] - offset[:, 1] * second[:, 0]) / area
    t = (first[:, 0] * offset[:, 1] - first[:, 1] * offset[:, 0]) / area
    vertices = part["vertices"].astype(float)
    edges = vertices[:, 1:] - vertices[:, :1]
    normals = np.cross(edges[:, 0], edges[:, 1])
    normals /= np.linalg.norm(normals, axis=1, keepdims=True) + 1e-20
    places = vertices[triangle, 0] + s[:, None] * edges[triangle, 0] + t[:, None] * edges[triangle, 1]
    normals = normals[triangle]
    places += 1e-3 * normals
    buried = owner < 0
    for row, col, place, normal in zip(rows, cols, places.tolist(), normals.tolist(), strict=True):
        hit = tree.ray_cast(place, normal)
        buried[row, col] = hit[0] is not None and hit[1].dot(normal) > 0
    return buried


def paint_decals(albedo, part, decals, names, oversampling=4):
    """Writing, tape and bands into the colours of the face below them. Returns how many found their face."""
    height, width = albedo.shape[:2]
    painted = 0
    edges = part["vertices"][:, 1:] - part["vertices"][:, :1]
    normals = np.cross(edges[:, 0], edges[:, 1])
    areas = np.linalg.norm(normals, axis=1)
    normals /= areas[:, None] + 1e-20
    for parent, triangles, ink in decals:
        decal_normals = np.cross(triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0])
        decal_normals /= np.linalg.norm(decal_normals, axis=1, keepdims=True) + 1e-20
        below = np.nonzero(part["object"] == names.index(parent))[0]
        found = False
        for k in below[np.argsort(-areas[below])][:6]:
            distance = (triangles - part["vertices"][k, 0]) @ normals[k]
            over = (decal_normals @ normals[k] > 0.99) & (distance > 0).all(1) & (distance < 0.003).all(1)
            if over.any() and not found:
                basis = edges[k].T
                weights = np.linalg.lstsq(
                    basis, (triangles[over] - part["vertices"][k, 0]).reshape(-1, 3).T, rcond=None
                )
                uv = part["uv"][k, 0] + weights[0].T @ (part["uv"][k, 1:] - part["uv"][k, 0])
                found = fill(albedo, (uv * (width, height)).reshape(-1, 3, 2), ink, oversampling)
        painted += found
    return painted


def fill(albedo, triangles, ink, oversampling):
    height, width = albedo.shape[:2]
    low = np.clip(np.floor(triangles.min((0, 1))).astype(int) - 2, 0, (width, height))
    high = np.clip(np.ceil(triangles.max((0, 1))).astype(int) + 2, 0, (width, height))
    if (high <= low).any():
        return False
    mask = np.zeros((high - low)[::-1] * oversampling, np.uint8)
    corners = np.round(((triangles - low) * oversampling - 0.5) * 256).astype(np.int32)
    for triangle in corners:
        cv2.fillConvexPoly(mask, triangle, 255, cv2.LINE_AA, 8)
    cover = cv2.resize(mask, tuple(map(int, high - low)), interpolation=cv2.INTER_AREA)[..., None] / 255
    region = albedo[low[1] : high[1], low[0] : high[0]]
    region[:] = region * (1 - cover) + np.array(ink) * cover
    return True


def moving_parts(part, joints):
    """Vertices of the movers in the frames of their joints, each triangle's joint, and the tree of joints."""
    names = sorted(set(joints.values()))
    joint = np.array([names.index(joints[k]) for k in part["object"]], np.uint8)
    vertices = part["vertices"].astype(float)
    for i, name in enumerate(names):
        to_joint = np.array(bpy.data.objects[name].matrix_world.inverted())
        mine = joint == i
        vertices[mine] = vertices[mine] @ to_joint[:3, :3].T + to_joint[:3, 3]
    tree = {}
    for name in names:
        ob = bpy.data.objects[name]
        while ob:
            offset = [round(float(v), 6) for v in ob.location] if ob.parent else [0, 0, 0]
            tree[ob.name] = {"parent": ob.parent.name if ob.parent else None, "offset": offset}
            ob = ob.parent
    return vertices.astype(np.float32), joint, names, tree


def marker_poses():
    """[x, y, z, qx, qy, qz, qw] of the two markers: x along the sheet, z out of it, as in the recording."""
    poses = {}
    for name in ("marker", "wall_marker"):
        position, q, _ = (bpy.data.objects[name].matrix_world @ Matrix.Identity(4)).decompose()
        poses[name] = [round(float(v), 9) for v in (*position, q.x, q.y, q.z, q.w)]
    return poses


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("out", type=Path)
    parser.add_argument("--samples", type=int, default=8, help="light samples of each other texel")
    parser.add_argument("--lighting", nargs="*", default=["day", "evening"])
    parser.add_argument("--geometry", action="store_true", help="stop before the light is baked")
    arguments = parser.parse_args()
    out, started = arguments.out, time.time()
    out.mkdir(parents=True, exist_ok=True)

    def report(step):
        print(f"{time.time() - started:6.0f} s  {step}", flush=True)

    scene.build()
    parts, decals, names, joints = scene.collect()
    scene.prepare_materials()
    scene.cut_behind_picture(parts)
    tree = scene.solid_tree({atlas: pairs for atlas, pairs in parts.items() if atlas != "movers"})
    moving = scene.solid_tree({"movers": parts["movers"]})
    poses = marker_poses()
    report(f"{scene.remove_unseen_faces(parts, tree)} camera places, faces never seen removed")
    joined = {atlas: join(pairs, atlas) for atlas, pairs in parts.items()}
    report("islands packed")
    exported = {atlas: triangles_of(ob) for atlas, ob in joined.items()}
    arrays = {f"{atlas}_{key}": value for atlas, part in exported.items() for key, value in part.items()}
    vertices, joint, joint_names, joint_tree = moving_parts(exported["movers"], joints)
    arrays |= {"movers_vertices": vertices, "movers_joint": joint}
    np.savez_compressed(out / "geometry.npz", **arrays)
    description = {"labels": drive.LABELS, "objects": names, "joints": joint_names, "joint_tree": joint_tree}
    description |= {"markers": poses, "marker_side": drive.MARKER_SIDE}
    (out / "scene.json").write_text(json.dumps(description, indent=0))
    for atlas in ORDER:
        part = exported[atlas]
        uv = part["uv"]
        first, second = uv[:, 1] - uv[:, 0], uv[:, 2] - uv[:, 0]
        used = np.abs(first[:, 0] * second[:, 1] - first[:, 1] * second[:, 0]).sum() / 2
        report(f"{atlas}: {len(uv)} triangles, {100 * used:.0f} % of the texels used")
    if arguments.geometry:
        return

    for name, ob in joined.items():
        ob.hide_render = name == "movers"
    bpy.context.scene.render.use_persistent_data = False
    joined["outside"].visible_shadow = False
    for atlas in ORDER:
        joined["movers"].hide_render = atlas != "movers"
        path, buried = out / f"{atlas}_albedo.npy", out / f"{atlas}_buried.npy"
        if not path.exists():
            albedo = bake(joined[atlas], COLOR_SIZE[atlas], COLOR_SAMPLES.get(atlas, 3), {"COLOR"})
            painted = paint_decals(albedo, exported[atlas], decals, names)
            np.save(path, albedo.astype(np.float16))
            report(f"colours of {atlas}, {painted} decals painted")
        if atlas != "floor" and not buried.exists():
            bodies = moving if atlas == "movers" else tree
            np.save(buried, buried_texels(exported[atlas], LIGHT_SIZE[atlas], bodies))
            report(f"buried texels of {atlas}")
    for material in bpy.data.materials:  # finer than a texel of the light
        for node in material.node_tree.nodes:
            if node.type == "BUMP":
                node.inputs["Strength"].default_value = 0
    for lighting in arguments.lighting:
        scene.set_lighting(lighting)
        for atlas in ORDER:
            path = out / f"{atlas}_{lighting}.npy"
            if path.exists():
                continue
            joined["movers"].hide_render = atlas != "movers"
            samples = LIGHT_SAMPLES.get(atlas, arguments.samples)
            light = bake(joined[atlas], LIGHT_SIZE[atlas], samples, {"DIRECT", "INDIRECT"})
            np.save(path, light.astype(np.float16))
            report(f"light of {atlas}, {lighting}")


if __name__ == "__main__":
    main()
