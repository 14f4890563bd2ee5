"""Draws the room on one processor core, with panda3d's software renderer: no GPU or display is needed."""

import functools
import math

import cv2
import numpy as np

from . import sheen
from .room_model import ATLASES, FACES_OUTWARD, FILES, NO_JOINT

try:
    from panda3d import core as p3d
except ImportError:  # no wheel of panda3d for this platform
    p3d = None

NEAR, FAR = 0.06, 14.0  # metres
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
SHADOWS = {"ball": (0.15, 0.15), "toycar": (0.20, 0.13), "person": (0.30, 0.26)}  # half sizes in metres
COLOR_MASK, ID_MASK = 0, 1
FLOOR_ORDER, SHEEN_ORDER, RUG_ORDER, SHADOW_ORDER, OTHERS_ORDER = 0, 1000, 2000, 3000, 4000


@functools.cache
def configure_panda3d():
    """Settings of panda3d for the whole process, before its first use.

    Raises
    ------
    RuntimeError : panda3d is not installed
    """
    if p3d is None:
        raise RuntimeError(
            "the room needs panda3d, which is not installed: there is no package of it for this platform; "
            "the recorded drive, open_camera('recording'), works without it"
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
    for number in range(selection.get_num_pipe_types()):
        kind = selection.get_pipe_type(number)
        if "Offscreen" in kind.get_name():
            return selection.make_pipe(kind)
    raise RuntimeError("this panda3d has no software renderer (p3tinydisplay)")


def index_buffer(indices):
    primitive = p3d.GeomTriangles(p3d.Geom.UH_static)
    primitive.set_index_type(p3d.GeomEnums.NT_uint32)
    array = primitive.modify_vertices()
    array.unclean_set_num_rows(indices.size)
    memoryview(array).cast("B")[:] = indices.astype(np.uint32).tobytes()
    return primitive


def geom_node(vertex_format, rows, indices):
    """A node of triangles; rows (N, bytes of a vertex) in the order of the format's columns."""
    data = p3d.GeomVertexData("triangles", vertex_format, p3d.Geom.UH_static)
    data.unclean_set_num_rows(len(rows))
    memoryview(data.modify_array(0)).cast("B")[:] = np.ascontiguousarray(rows).tobytes()
    geom = p3d.Geom(data)
    geom.add_primitive(index_buffer(indices))
    node = p3d.GeomNode("triangles")
    node.add_geom(geom)
    return node


def textured(triangles, texture, normals=None):
    """Vertices that are equal in place and texture are shared: there are fewer to transform."""
    columns = [triangles.reshape(-1, 3), texture.reshape(-1, 2)]
    vertex_format = p3d.GeomVertexFormat.get_v3t2()
    if normals is not None:
        columns.insert(1, normals.reshape(-1, 3))
        vertex_format = p3d.GeomVertexFormat.get_v3n3t2()
    rows = np.concatenate(columns, 1).astype(np.float32).round(5)
    rows, indices = np.unique(rows, axis=0, return_inverse=True)
    return geom_node(vertex_format, rows, indices.ravel())


def numbered(triangles, numbers):
    """Each triangle in one flat color: its number, low byte in blue."""
    rows = np.zeros((len(triangles) * 3, 16), np.uint8)
    rows[:, :12] = triangles.reshape(-1, 3).astype(np.float32).view(np.uint8).reshape(-1, 12)
    rows[:, 12:] = np.repeat(color_bytes(numbers >> 16, numbers >> 8 & 255, numbers & 255, 255), 3, 0)
    return geom_node(p3d.GeomVertexFormat.get_v3c4(), rows, np.arange(len(rows)))


def color_bytes(red, green, blue, alpha):
    """(N, 4) uint8 as panda3d packs a vertex color."""
    red = np.asarray(red)
    return np.stack([np.broadcast_to(c, red.shape) for c in (red, green, blue, alpha)], -1).astype(np.uint8)


def load_texture(name, lighting):
    pixels = cv2.imread(str(FILES / f"{name}_{lighting}.jpg"))
    if pixels is None:
        raise FileNotFoundError(
            f"the room's texture {name}_{lighting}.jpg is missing or damaged; restore it: "
            "git checkout -- imgproc_course/simulation/room"
        )
    return as_texture(pixels, p3d.Texture.F_rgb)


def as_texture(pixels, kind):
    """pixels (H, W, 3 or 4) uint8 BGR, H and W powers of two up to 4096."""
    texture = p3d.Texture()
    texture.setup_2d_texture(pixels.shape[1], pixels.shape[0], p3d.Texture.T_unsigned_byte, kind)
    texture.set_ram_image(np.ascontiguousarray(pixels[::-1]).tobytes())
    # Mipmaps between two levels carry from channel to channel in this renderer: the nearest level alone.
    texture.set_minfilter(p3d.SamplerState.FT_linear_mipmap_nearest)
    texture.set_magfilter(p3d.SamplerState.FT_linear)
    texture.set_quality_level(p3d.Texture.QL_best)  # without it filters are ignored
    texture.set_wrap_u(p3d.SamplerState.WM_clamp)
    texture.set_wrap_v(p3d.SamplerState.WM_clamp)
    texture.set_keep_ram_image(False)
    return texture


class View:
    """One camera and the image that it draws."""

    def __init__(self, output, texture, camera, model):
        self.output, self.texture, self.camera, self.model = output, texture, camera, model


class Renderer:
    """The scene of one simulation; of its own views `render` draws one at a time."""

    def __init__(self, room, lighting):
        self._pipe = software_pipe()
        self._engine = p3d.GraphicsEngine(self._pipe)
        self._root = p3d.NodePath("room")
        self._joints = {name: self._root.attach_new_node(name) for name in room.joint_tree}
        self._order = 0
        for number, atlas in enumerate(ATLASES):
            self._add_atlas(room, number, atlas, lighting)
        self._shadows = {}
        for number, (name, size) in enumerate(SHADOWS.items()):
            self._shadows[name] = self._add_shadow(size)
            self._shadows[name].set_bin("fixed", SHADOW_ORDER + number)
        self._sheen = sheen.Sheen(lighting)
        self._sheen_geom = self._add_sheen()

    def _add_atlas(self, room, number, atlas, lighting):
        texture = None if atlas == "outside" else load_texture(atlas, lighting)
        mine = np.nonzero(room.atlas == number)[0]
        leaf = room.label[mine] == next(k for k, v in room.label_names.items() if v == FACES_OUTWARD)
        cell = np.floor(room.triangles[mine].mean(1) / CHUNK).astype(int)
        cell[room.joint[mine] != NO_JOINT] = 0
        keys = np.column_stack([room.joint[mine], leaf, cell])
        for key in np.unique(keys, axis=0):
            chosen = mine[(keys == key).all(1)]
            joint = None if key[0] == NO_JOINT else room.joint_names[key[0]]
            parent = self._joints[joint] if joint else self._root
            triangles, corners = room.triangles[chosen], room.texture[chosen]
            if joint == "ball":
                colored = parent.attach_new_node(textured(triangles, corners, unit(triangles)))
                self._light_ball(colored, lighting)
            else:
                colored = parent.attach_new_node(textured(triangles, corners))
            if texture is None:
                colored.set_color(*SKY[lighting], 1)
            else:
                colored.set_texture(texture, 1)
            numbers = parent.attach_new_node(numbered(triangles, chosen + 1))
            numbers.set_attrib(p3d.ColorAttrib.make_vertex())
            # The order is fixed, or it would follow addresses in memory. Floor and rug come first: what lies
            # on them is drawn without asking for depth.
            self._order += 1
            order = {"floor": FLOOR_ORDER, "rug": RUG_ORDER}.get(atlas, OTHERS_ORDER) + self._order
            for node, other in ((colored, ID_MASK), (numbers, COLOR_MASK)):
                node.set_bin("fixed", order)
                node.hide(p3d.BitMask32.bit(other))
                node.set_two_sided(bool(key[1]))
                if atlas == "signs":  # a few millimetres before the wall: they must win at any distance
                    node.set_depth_offset(1)

    def _light_ball(self, node, lighting):
        ambient, *lamps = BALL_LIGHT[lighting]
        light = p3d.AmbientLight("ambient")
        light.set_color((*ambient, 1))
        node.set_light(self._root.attach_new_node(light))
        for direction, color in lamps:
            light = p3d.DirectionalLight("lamp")
            light.set_color((*color, 1))
            light.set_direction(direction)
            node.set_light(self._root.attach_new_node(light))
        material = p3d.Material()
        material.set_diffuse((1, 1, 1, 1))
        material.set_ambient((1, 1, 1, 1))
        node.set_material(material)

    def _add_shadow(self, size):
        """A soft dark spot on the floor."""
        across = (np.arange(64) - 31.5) / 32
        distance = np.sqrt(across[:, None] ** 2 + across[None, :] ** 2)
        spot = np.zeros((64, 64, 4), np.uint8)
        spot[..., 3] = np.clip(1 - distance, 0, 1) * 150
        corners = np.array([(-1, -1), (1, -1), (1, 1), (-1, 1)], np.float32)
        flat = np.column_stack([corners * size, np.zeros(4)])[[[0, 1, 2], [0, 2, 3]]]
        node = self._root.attach_new_node(textured(flat, (corners[[[0, 1, 2], [0, 2, 3]]] + 1) / 2))
        node.set_texture(as_texture(spot, p3d.Texture.F_rgba), 1)
        node.set_transparency(p3d.TransparencyAttrib.M_alpha)
        node.set_depth_write(False)
        node.set_depth_test(False)
        node.hide(p3d.BitMask32.bit(ID_MASK))
        return node

    def _add_sheen(self):
        vertices, indices = self._sheen.vertices, self._sheen.indices
        rows = np.zeros((len(vertices), 16), np.uint8)
        rows[:, :12] = vertices.astype(np.float32).view(np.uint8).reshape(-1, 12)
        node = geom_node(p3d.GeomVertexFormat.get_v3c4(), rows, indices)
        self._sheen_rows = rows
        path = self._root.attach_new_node(node)
        path.set_attrib(p3d.ColorAttrib.make_vertex())
        path.set_transparency(p3d.TransparencyAttrib.M_alpha)
        path.set_depth_write(False)
        path.set_depth_test(False)
        path.set_bin("fixed", SHEEN_ORDER)
        path.hide(p3d.BitMask32.bit(ID_MASK))
        return node

    def place(self, joint_poses):
        """Puts every joint where its pose says, and the shadows under their owners."""
        for name, pose in joint_poses.items():
            self._joints[name].set_mat(as_matrix(pose))
        for name, shadow in self._shadows.items():
            pose = joint_poses[name]
            x, y, z = pose.position
            if name == "ball":
                shadow.set_pos(x, y, z - 0.11 + 0.003)
            else:
                shadow.set_mat(as_matrix(pose))
                shadow.set_z(z + 0.003)

    def add_view(self, model, ids=False):
        """A view through a pinhole camera: its colors, or the number of each pixel's triangle."""
        properties = p3d.FrameBufferProperties()
        properties.set_rgb_color(True)
        properties.set_color_bits(24)
        properties.set_depth_bits(24)
        properties.set_alpha_bits(8)
        size = p3d.WindowProperties(size=(model.width, model.height))
        output = self._engine.make_output(
            self._pipe, "view", 0, properties, size, p3d.GraphicsPipe.BF_refuse_window
        )
        texture = p3d.Texture()
        output.add_render_texture(texture, p3d.GraphicsOutput.RTM_copy_ram)
        output.set_clear_color((0, 0, 0, 1))
        output.set_clear_color_active(True)
        lens = p3d.PerspectiveLens()
        lens.set_film_size(model.width, model.height)
        lens.set_focal_length(model.fx)
        lens.set_film_offset((model.width - 1) / 2 - model.cx, model.cy - (model.height - 1) / 2)
        lens.set_near_far(NEAR, FAR)
        node = p3d.Camera("camera", lens)
        node.set_camera_mask(p3d.BitMask32.bit(ID_MASK if ids else COLOR_MASK))
        camera = self._root.attach_new_node(node)
        output.make_display_region().set_camera(camera)
        output.set_active(False)
        return View(output, texture, camera, model)

    def render(self, view, pose):
        """What the view sees from a pose of its optical frame: (height, width, 4) uint8 BGRA, read-only.

        The first row is at the bottom. In a view of ids blue, green and red are the bytes of the triangle's
        number, counted from 1; 0 where nothing is.
        """
        right, down, forward = pose.rotation.T
        view.camera.set_mat(p3d.LMatrix4f(*right, 0, *forward, 0, *(-down), 0, *pose.position, 1))
        if not (view.camera.node().get_camera_mask() & p3d.BitMask32.bit(ID_MASK)).get_word():
            self._update_sheen(pose.position)
        view.output.set_active(True)
        self._engine.render_frame()
        view.output.set_active(False)
        pixels = np.frombuffer(view.texture.get_ram_image(), np.uint8)
        return pixels.reshape(view.model.height, view.model.width, 4)

    def _update_sheen(self, position):
        self._sheen_rows[:, 12:] = color_bytes(*self._sheen.colors(position))
        data = self._sheen_geom.modify_geom(0).modify_vertex_data()
        memoryview(data.modify_array(0)).cast("B")[:] = self._sheen_rows.tobytes()

    def close(self):
        self._engine.remove_all_windows()
        self._root.remove_node()


def unit(vectors):
    """Vectors (..., 3) at length 1."""
    return vectors / np.sqrt(vectors[..., :1] ** 2 + vectors[..., 1:2] ** 2 + vectors[..., 2:] ** 2)


def as_matrix(pose):
    """panda3d's matrices act on row vectors."""
    x, y, z = pose.rotation.T
    return p3d.LMatrix4f(*x, 0, *y, 0, *z, 0, *pose.position, 1)


def pinhole_covering(model, scale=1.0):
    """The pinhole camera that sees every ray of a camera with a lens, `scale` times as finely."""
    fx, fy = model.fx * scale, model.fy * scale
    columns, rows = np.linspace(-0.5, model.width - 0.5, 65), np.linspace(-0.5, model.height - 0.5, 65)
    border = [(c, r) for c in columns for r in rows[[0, -1]]] + [
        (c, r) for c in columns[[0, -1]] for r in rows
    ]
    rays = model.unproject(border)
    low, high = rays.min(0), rays.max(0)
    width, height = math.ceil((high[0] - low[0]) * fx) + 2, math.ceil((high[1] - low[1]) * fy) + 2
    return type(model)(width, height, fx, fy, 0.5 - low[0] * fx, 0.5 - low[1] * fy)
