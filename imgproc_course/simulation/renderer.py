"""Draws the room on one processor core, with panda3d's software renderer: no GPU or display is needed."""

import functools
import itertools
import math
from typing import NamedTuple

import cv2
import numpy as np

from . import sheen
from .room_model import BALLS, FACES_OUTWARD, NO_JOINT

try:
    from panda3d import core as p3d
except ImportError:  # no wheel of panda3d for this platform
    p3d = None

NEAR, FAR = 0.06, 14.0  # metres
NEAREST = 0.01  # where images begin beside what the body touches: it can be closer than NEAR
LARGE_TEXEL = 2.0  # pixels
CHUNK = 1.6  # metres; what lies outside of the image is left out chunk by chunk
SKY = {"day": (0.97, 0.985, 1.0), "evening": (0.05, 0.07, 0.11)}
# The ball turns, so its texture holds colours alone. Light: ambient, then (direction, color) of two lamps.
BALL_LIGHT = {
    "day": (
        (0.62, 0.60, 0.59),
        ((-0.1, -1, -0.9), (0.62, 0.64, 0.66)),
        ((0.1, 0.15, -1), (0.30, 0.27, 0.22)),
    ),
    "evening": (
        (0.30, 0.24, 0.19),
        ((0.05, 0.1, -1), (0.66, 0.52, 0.38)),
        ((-0.1, -1, -0.4), (0.02, 0.02, 0.04)),
    ),
}
SHADOWS = dict.fromkeys(BALLS, (0.15, 0.15)) | {"toycar": (0.20, 0.13), "person": (0.30, 0.26)}  # metres
BLINDERS_ORDER = -1
FLOOR_ORDER, SHEEN_ORDER, RUG_ORDER, SHADOW_ORDER, OTHERS_ORDER = 0, 1000, 2000, 3000, 4000


@functools.cache
def configure_panda3d():
    """Settings of panda3d for the whole process, before its first use; RuntimeError without panda3d."""
    if p3d is None:
        raise RuntimeError(
            "the room needs panda3d, which is not installed: in the checkout, pip install '.[room]'; where it"
            " has no package for this platform, open_camera('recording') works without it"
        )
    p3d.load_prc_file_data(
        "",
        "load-display p3tinydisplay\nwindow-type offscreen\naudio-library-name null\nnotify-level error\n"
        "textures-power-2 down\ngarbage-collect-states 0\ntd-perspective-textures 1\n",
    )


def software_pipe():
    """The software renderer's pipe; the one that draws into an X window would complain without a display."""
    configure_panda3d()
    selection = p3d.GraphicsPipeSelection.get_global_ptr()
    pipe = selection.make_pipe("TinyOffscreenGraphicsPipe", "p3tinydisplay")
    if pipe is None:
        raise RuntimeError(
            "the room's renderer does not load: it needs libX11.so.6 of the system; install that: "
            "sudo apt install libx11-6 (Debian, Ubuntu), or sudo dnf install libX11 (Fedora)"
        )
    return pipe


def index_buffer(indices):
    primitive = p3d.GeomTriangles(p3d.Geom.UH_static)
    primitive.set_index_type(p3d.GeomEnums.NT_uint32)
    array = primitive.modify_vertices()
    array.unclean_set_num_rows(indices.size)
    memoryview(array).cast("B")[:] = indices.astype(np.uint32).tobytes()
    return primitive


def vertices(owner, points, **columns):
    """The format of vertices, and (N, bytes of a vertex) uint8: points (N, 3), then columns (N, count).

    Columns are texcoord, normal (both float32) and color (float32 or uint8). panda3d converts some of them in
    a buffer that belongs to their format, and formats of the same columns are one and the same: two threads
    that drew with it would now and then take each other's vertices. So a format has a column named after its
    owner, a renderer, unless nothing in it is converted: points x y z 1 and colors of four floats, which are
    also read fastest.
    """
    enums = p3d.GeomEnums
    contents = {"vertex": enums.C_point, "texcoord": enums.C_texcoord, "normal": enums.C_normal}
    contents |= {"color": enums.C_color, owner: enums.C_other}
    columns = {"vertex": np.column_stack([points, np.ones(len(points))]).astype(np.float32), **columns}
    if owner is not None:
        columns[owner] = np.zeros((len(points), 4), np.uint8)
    array_format = p3d.GeomVertexArrayFormat()
    for name, values in columns.items():
        kind = enums.NT_uint8 if values.dtype == np.uint8 else enums.NT_float32
        array_format.add_column(p3d.InternalName.make(name), values.shape[1], kind, contents[name])
    rows = np.concatenate([np.ascontiguousarray(v).view(np.uint8) for v in columns.values()], 1)
    return p3d.GeomVertexFormat.register_format(p3d.GeomVertexFormat(array_format)), rows


def geom_node(columns_format, rows, indices):
    """A node of triangles; format and rows as `vertices` gives them."""
    data = p3d.GeomVertexData("triangles", columns_format, p3d.Geom.UH_static)
    data.unclean_set_num_rows(len(rows))
    data.modify_array_handle(0).copy_data_from(rows.tobytes())
    geom = p3d.Geom(data)
    geom.add_primitive(index_buffer(indices))
    node = p3d.GeomNode("triangles")
    node.add_geom(geom)
    return node


def textured(owner, triangles, texture, normals=None):
    """Vertices that are equal in place and texture are shared: there are fewer to transform."""
    columns = [triangles.reshape(-1, 3), texture.reshape(-1, 2)]
    if normals is not None:
        columns.append(normals.reshape(-1, 3))
    rows = np.concatenate(columns, 1).astype(np.float32).round(5)
    order = np.lexsort(rows.T)  # several times as fast as np.unique(axis=0)
    rows = rows[order]
    new = np.concatenate([[True], (rows[1:] != rows[:-1]).any(1)])
    indices = np.empty(len(rows), int)
    indices[order] = np.cumsum(new) - 1
    points, texture, normals = np.split(rows[new], [3, 5], axis=1)
    lit = {"normal": normals} if normals.size else {}
    columns_format, rows = vertices(owner, points, texcoord=texture, **lit)
    return geom_node(columns_format, rows, indices)


def numbered(triangles, numbers):
    """Each triangle in one flat color: its number, low byte in blue."""
    points = triangles.reshape(-1, 3)
    colors = np.column_stack([numbers >> 16, numbers >> 8 & 255, numbers & 255, np.full_like(numbers, 255)])
    colors = np.repeat((colors / 255).astype(np.float32), 3, 0)
    columns_format, rows = vertices(None, points, color=colors)
    return geom_node(columns_format, rows, np.arange(len(rows)))


def as_texture(pixels, kind):
    """pixels (H, W, 3 or 4) uint8 BGR, H and W powers of two up to 4096."""
    texture = p3d.Texture()
    texture.setup_2d_texture(pixels.shape[1], pixels.shape[0], p3d.Texture.T_unsigned_byte, kind)
    texture.set_ram_image(cv2.flip(pixels, 0))
    texture.set_default_sampler(sampler(smooth=False))
    texture.set_quality_level(p3d.Texture.QL_best)  # without it filters are ignored
    texture.set_keep_ram_image(False)
    return texture


def sampler(smooth):
    """How a texture is read: the nearest texel, or, where texels are larger than pixels, between texels.

    The nearest texel of the nearest mipmap is by far the fastest. Between the texels of a mipmap this
    renderer interpolates wrongly, and any wrap mode but "repeat" takes its slow path.
    """
    state = p3d.SamplerState()
    state.set_minfilter(p3d.SamplerState.FT_nearest_mipmap_nearest)
    state.set_magfilter(p3d.SamplerState.FT_linear if smooth else p3d.SamplerState.FT_nearest)
    return state


class Chunk:
    """A part of what stands still, and how near it must be for its texels to be seen one by one."""

    def __init__(self, node, texture, triangles, corners):
        """corners (N, 3, 2): the triangles' texture coordinates"""
        self.node, self.texture = node, texture
        points = triangles.reshape(-1, 3).astype(float)
        self.center = (points.min(0) + points.max(0)) / 2
        self.radius = float(np.sqrt(((points - self.center) ** 2).sum(1).max()))
        self.size = texture.get_x_size(), texture.get_y_size()
        texels = corners.astype(float) * self.size
        self.texels_per_metre = math.sqrt(area(texels) / area(triangles.astype(float)))
        self.smooth = False

    def choose_filter(self, position, fx):
        """Interpolates between texels that are larger than LARGE_TEXEL pixels for an eye at (3,)."""
        x, y, z = position - self.center
        distance = max(math.sqrt(x * x + y * y + z * z) - self.radius, NEAR)
        smooth = fx / distance > LARGE_TEXEL * self.texels_per_metre
        if smooth != self.smooth:
            self.smooth = smooth
            use_texture(self.node, self.texture, smooth)


class View:
    """One camera and the image that it draws; `blinders` cover what its lens does not show."""

    def __init__(self, output, texture, camera, blinders, pinhole):
        self.output, self.texture, self.camera = output, texture, camera
        self.blinders, self.pinhole = blinders, pinhole


def use_texture(node, texture, smooth):
    stage = p3d.TextureStage.get_default()
    node.set_texture(stage, texture, sampler(smooth), 1)
    # Between texels this renderer reads half a texel too far to the left and below.
    half = (0.5 / texture.get_x_size(), 0.5 / texture.get_y_size()) if smooth else (0, 0)
    node.set_tex_offset(stage, *half)


def area(triangles):
    """The area of triangles (N, 3, 2 or 3) in all."""
    a, b = triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0]
    squared = (a * a).sum(1) * (b * b).sum(1) - (a * b).sum(1) ** 2
    return float(np.sqrt(np.maximum(squared, 0)).sum()) / 2


class ChunkOfTriangles(NamedTuple):
    """Triangles of one atlas, joint (None: they stand still) and order of drawing; rows (N,) in the room."""

    rows: np.ndarray
    atlas: str
    joint: str | None
    order: int
    is_two_sided: bool


def chunks_of(room):
    """Yields every ChunkOfTriangles of the room.

    Their order is fixed, or it would follow addresses in memory. Floor and rug come first: what lies on them
    is drawn without asking for depth.
    """
    leaf = next(k for k, v in room.label_names.items() if v == FACES_OUTWARD)
    number = 0
    for index, atlas in enumerate(room.atlas_names):
        mine = np.nonzero(room.atlas == index)[0]
        cell = np.floor(room.triangles[mine].mean(1) / CHUNK).astype(int)
        cell[room.joint[mine] != NO_JOINT] = 0
        keys = np.column_stack([room.joint[mine], room.label[mine] == leaf, cell])
        different, part = np.unique(keys, axis=0, return_inverse=True)
        for k in range(len(different)):
            rows = mine[part == k]
            joint = room.joint[rows[0]]
            name = None if joint == NO_JOINT else room.joint_names[joint]
            number += 1
            order = {"floor": FLOOR_ORDER, "rug": RUG_ORDER}.get(atlas, OTHERS_ORDER) + number
            yield ChunkOfTriangles(rows, atlas, name, order, bool(room.label[rows[0]] == leaf))


class Renderer:
    """A scene of the room, for one simulation; of its own views `render` draws one at a time.

    Two renderers share nothing: two threads can draw at the same time, each with its own.
    """

    _numbers = itertools.count()

    def __init__(self, room):
        self._pipe = software_pipe()
        self._engine = p3d.GraphicsEngine(self._pipe)
        self._name = f"renderer {next(self._numbers)}"  # of a column of its vertices
        self._root = p3d.NodePath("room")
        self._joints = {name: self._root.attach_new_node(name) for name in room.joint_tree}
        for chunk in chunks_of(room):
            node = self._add_chunk(room, chunk, self._joints[chunk.joint] if chunk.joint else self._root)
            node.set_bin("fixed", chunk.order)
            node.set_two_sided(chunk.is_two_sided)
            if chunk.atlas == "signs":  # a few millimetres before the wall: they must win at any distance
                node.set_depth_offset(1)

    def _add_chunk(self, room, chunk, parent):
        """The node of a ChunkOfTriangles below its parent."""
        raise NotImplementedError

    def place(self, joint_poses):
        """Puts every joint where its pose says, and hides those without one."""
        for name, joint in self._joints.items():
            if name in joint_poses:
                joint.set_mat(as_matrix(joint_poses[name]))
                joint.show()
            else:
                joint.hide()

    def add_view(self, camera, scale=1.0):
        """A view of all that a camera with a lens sees.

        It is drawn through a pinhole camera, `scale` times as finely; what the lens does not show is black.
        """
        pinhole = pinhole_covering(camera, scale)
        properties = p3d.FrameBufferProperties()
        properties.set_rgba_bits(8, 8, 8, 8)
        properties.set_depth_bits(24)
        size = p3d.WindowProperties(size=(pinhole.width, pinhole.height))
        flags = p3d.GraphicsPipe.BF_refuse_window
        output = self._engine.make_output(self._pipe, "view", 0, properties, size, flags)
        texture = p3d.Texture()
        output.add_render_texture(texture, p3d.GraphicsOutput.RTM_copy_ram)
        output.set_clear_color((0, 0, 0, 1))
        output.set_clear_color_active(True)
        path = self._root.attach_new_node(p3d.Camera("camera", software_lens(pinhole)))
        output.make_display_region().set_camera(path)
        output.set_active(False)
        blinders = path.attach_new_node(around_the_image(self._name, camera))
        blinders.set_color(0, 0, 0, 1)
        blinders.set_two_sided(True)
        blinders.set_bin("fixed", BLINDERS_ORDER)
        blinders.hide()
        return View(output, texture, path, blinders, pinhole)

    def render(self, view, pose, near=NEAR):
        """What an optical frame of this pose sees, lowest row first: (H, W, 4) uint8 BGRA, read-only.

        `near`: how many metres before the camera it begins.
        """
        view.camera.node().get_lens().set_near(near)
        right, down, forward = pose.rotation.T
        view.camera.set_mat(p3d.LMatrix4f(*right, 0, *forward, 0, *(-down), 0, *pose.position, 1))
        view.blinders.show()
        view.output.set_active(True)
        self._engine.render_frame()
        view.output.set_active(False)
        view.blinders.hide()
        pixels = np.frombuffer(view.texture.get_ram_image(), np.uint8)
        return pixels.reshape(view.pinhole.height, view.pinhole.width, 4)

    def close(self):
        self._engine.remove_all_windows()
        self._root.remove_node()


class NumberRenderer(Renderer):
    """Draws of each pixel its triangle's number, counted from 1, into blue, green and red; 0: nothing."""

    def _add_chunk(self, room, chunk, parent):
        node = parent.attach_new_node(numbered(room.triangles[chunk.rows], chunk.rows + 1))
        node.set_attrib(p3d.ColorAttrib.make_vertex())
        return node


class ColorRenderer(Renderer):
    """Draws the colors of a Room, with the shadows of what moves and the floor's sheen."""

    def __init__(self, room, lighting):
        self._lighting, self._chunks = lighting, []
        configure_panda3d()
        pixels = room.textures(lighting)
        self._textures = {name: as_texture(image, p3d.Texture.F_rgb) for name, image in pixels.items()}
        super().__init__(room.model)
        self._shadows = {}
        for number, (name, size) in enumerate(SHADOWS.items()):
            self._shadows[name] = self._add_shadow(size, SHADOW_ORDER + number)
        self._sheen = sheen.Sheen(lighting)
        self._sheen_geom = self._add_sheen()

    def _add_chunk(self, room, chunk, parent):
        triangles, corners = room.triangles[chunk.rows], room.texture[chunk.rows]
        is_ball = chunk.joint in BALLS  # its middle is at (0, 0, 0)
        normals = triangles / np.linalg.norm(triangles, axis=-1, keepdims=True) if is_ball else None
        node = parent.attach_new_node(textured(self._name, triangles, corners, normals))
        if is_ball:
            self._light_ball(node)
        if chunk.atlas == "outside":
            node.set_color(*SKY[self._lighting], 1)
            return node
        texture = self._textures[chunk.atlas]
        use_texture(node, texture, smooth=chunk.joint is not None)
        if chunk.joint is None and chunk.atlas not in ("room", "floor"):  # these have soft patterns
            self._chunks.append(Chunk(node, texture, triangles, corners))
        return node

    def _light_ball(self, node):
        ambient, *lamps = BALL_LIGHT[self._lighting]
        light = p3d.AmbientLight("ambient")
        light.set_color((*ambient, 1))
        node.set_light(self._root.attach_new_node(light))
        for number, (direction, color) in enumerate(lamps):
            light = p3d.DirectionalLight("lamp")
            light.set_priority(-number)  # or their order, and so a rounding, would follow addresses in memory
            light.set_color((*color, 1))
            light.set_direction(direction)
            node.set_light(self._root.attach_new_node(light))
        material = p3d.Material()
        material.set_diffuse((1, 1, 1, 1))
        material.set_ambient((1, 1, 1, 1))
        node.set_material(material)

    def _add_shadow(self, size, order):
        across = (np.arange(64) - 31.5) / 32
        distance = np.sqrt(across[:, None] ** 2 + across[None, :] ** 2)
        spot = np.zeros((64, 64, 4), np.uint8)
        spot[..., 3] = np.clip(1 - distance, 0, 1) * 150
        corners = np.array([(-1, -1), (1, -1), (1, 1), (-1, 1)], np.float32)
        flat = np.column_stack([corners * size, np.zeros(4)])[[[0, 1, 2], [0, 2, 3]]]
        texture = (corners[[[0, 1, 2], [0, 2, 3]]] + 1) / 2
        node = self._root.attach_new_node(textured(self._name, flat, texture))
        node.set_texture(as_texture(spot, p3d.Texture.F_rgba), 1)
        lay_on_floor(node, order)
        return node

    def _add_sheen(self):
        colors = np.zeros((len(self._sheen.vertices), 4), np.uint8)
        columns_format, self._sheen_rows = vertices(self._name, self._sheen.vertices, color=colors)
        node = geom_node(columns_format, self._sheen_rows, self._sheen.indices)
        # It changes with each image: without these its bounds would be computed as often.
        node.modify_geom(0).set_bounds(p3d.OmniBoundingVolume())
        node.set_bounds(p3d.OmniBoundingVolume())
        path = self._root.attach_new_node(node)
        path.set_attrib(p3d.ColorAttrib.make_vertex())
        lay_on_floor(path, SHEEN_ORDER)
        return node

    def place(self, joint_poses):
        """Puts the shadows under their owners, too."""
        super().place(joint_poses)
        for name, shadow in self._shadows.items():
            if name not in joint_poses:
                shadow.hide()
                continue
            shadow.show()
            pose = joint_poses[name]
            x, y, z = pose.position
            if name in BALLS:
                shadow.set_pos(x, y, z - 0.11 + 0.003)
            else:
                shadow.set_mat(as_matrix(pose))
                shadow.set_z(z + 0.003)

    def render(self, view, pose, near=NEAR):
        self._update_sheen(pose.position)
        for chunk in self._chunks:
            chunk.choose_filter(pose.position, view.pinhole.fx)
        return super().render(view, pose, near)

    def _update_sheen(self, position):
        self._sheen_rows[:, 16:20] = self._sheen.colors(position)
        geom = self._sheen_geom.modify_geom(0)
        vertices = geom.modify_vertex_data().modify_array(0)
        vertices.modify_handle().copy_data_from(self._sheen_rows.tobytes())
        indices = self._sheen.indices
        shining = self._sheen_rows[:, 19][indices].any(1)  # most of the floor near by does not
        geom.set_primitive(0, index_buffer(indices[shining]))


def lay_on_floor(path, order):
    """Draws a node over the floor, as dense as its alpha says, without asking for depth."""
    path.set_transparency(p3d.TransparencyAttrib.M_alpha)
    path.set_depth_write(False)
    path.set_depth_test(False)
    path.set_bin("fixed", order)


def as_matrix(pose):
    """panda3d's matrices act on row vectors."""
    x, y, z = pose.rotation.T
    return p3d.LMatrix4f(*x, 0, *y, 0, *z, 0, *pose.position, 1)


def software_lens(pinhole):
    """The lens of a pinhole camera, for this renderer.

    It fits the film into half a pixel less than the image, and cuts off the fraction of a corner's pixel:
    half a pixel more makes that a rounding.
    """
    width, height = pinhole.width - 0.5, pinhole.height - 0.5
    lens = p3d.PerspectiveLens()
    lens.set_film_size(width, height)
    lens.set_focal_length(pinhole.fx)
    lens.set_film_offset(width / 2 - 0.5 - pinhole.cx, pinhole.cy + 0.5 - height / 2)
    lens.set_near_far(NEAR, FAR)
    return lens


def around_the_image(owner, camera):
    """A frame close before the camera, from two pixels outside of its image on; it hides what is behind."""
    inner = camera.unproject(border(camera, 2, 41)) * NEAR * 1.01
    outer = inner * (2, 2, 1)
    next_inner, next_outer = np.roll(inner, -1, 0), np.roll(outer, -1, 0)
    corners = (inner, next_inner, outer), (outer, next_inner, next_outer)
    triangles = np.concatenate([np.stack(points, 1) for points in corners])
    right, down, forward = np.moveaxis(triangles, -1, 0)
    return textured(owner, np.stack([right, forward, -down], -1), np.zeros((len(triangles), 3, 2)))


def border(camera, margin, count):
    """Pixels (4 count, 2) as (column, row) around the image of a camera, so many pixels outside of it."""
    columns = np.linspace(-margin, camera.width - 1 + margin, count)
    rows = np.linspace(-margin, camera.height - 1 + margin, count)
    above, below = ([(column, row) for column in columns] for row in rows[[0, -1]])
    left, right = ([(column, row) for row in rows] for column in columns[[0, -1]])
    return [*above, *right, *below[::-1], *left[::-1]]


def pinhole_covering(model, scale=1.0):
    """The pinhole camera that sees every ray of a camera with a lens, `scale` times as finely."""
    fx, fy = model.fx * scale, model.fy * scale
    rays = model.unproject(border(model, 0.5, 65))
    low, high = rays.min(0), rays.max(0)
    width, height = math.ceil((high[0] - low[0]) * fx) + 2, math.ceil((high[1] - low[1]) * fy) + 2
    return type(model)(width, height, fx, fy, 0.5 - low[0] * fx, 0.5 - low[1] * fy)
