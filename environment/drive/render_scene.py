#!/usr/bin/env python3
"""Render the course's sample drive: a low home robot in a living room.

Everything in the scene is made here, by code: meshes, procedural materials,
texts, the fiducial marker.  No image or model of anybody else is loaded.

    python render_scene.py --out OUT --frames 0 45 89 [--spp 48] [--gt]

Writes OUT/rgb/NNNN.png   (rendered, distorted by the plumb_bob model below)
       OUT/gt/NNNN.npz    depth (float16 m, planar Z), ids (uint8), same lens
       OUT/truth.json     K, D, camera poses (ROS optical frame), object poses
World: ROS axes, metres (x forward, y left, z up).
"""

# Kept as it ran when the drive was rendered: this file documents how the images were made.
# ruff: noqa
# fmt: off
import argparse, json, math, os, random, sys, time
import bpy
import numpy as np
from mathutils import Matrix, Vector, Euler

# The module keeps oslquery (needed to compile the lens) in its own site-packages, which is not on sys.path.
sys.path.append(os.path.join(bpy.utils.resource_path('LOCAL'), 'python', 'lib',
                             'python%d.%d' % sys.version_info[:2], 'site-packages'))

W, H, FPS, NFRAMES = 1280, 720, 10, 90
FX = FY = 705.0
CX, CY = 639.5, 359.5
K1, K2, P1, P2, K3 = -0.170, 0.035, 0.0004, -0.0003, 0.0
CAM_H = 0.20
rnd = random.Random(7)

OSL_CAMERA = f"""
shader plumb_bob(output point position = 0.0, output vector direction = 0.0,
                 output color throughput = 1.0)
{{
  point r = camera_shader_raster_position();
  float xd = (r[0] * {W} - 0.5 - {CX}) / {FX};
  float yd = ((1.0 - r[1]) * {H} - 0.5 - {CY}) / {FY};
  float x = xd, y = yd;
  for (int i = 0; i < 40; i++) {{
    float q = x*x + y*y;
    float k = 1 + q*({K1} + q*({K2} + q*{K3}));
    float dx = 2*{P1}*x*y + {P2}*(q + 2*x*x);
    float dy = {P1}*(q + 2*y*y) + 2*{P2}*x*y;
    x = (xd - dx) / k;
    y = (yd - dy) / k;
  }}
  direction = normalize(vector(x, -y, 1.0));
}}
"""

# ------------------------------------------------------------------ materials
_MATS = {}


class NT:
    """Tiny helper to write node trees as expressions."""

    def __init__(self, mat):
        self.t = mat.node_tree
        self.t.nodes.clear()
        self.out = self.t.nodes.new('ShaderNodeOutputMaterial')
        self.b = self.t.nodes.new('ShaderNodeBsdfPrincipled')
        self.t.links.new(self.b.outputs[0], self.out.inputs[0])

    def n(self, kind, **kw):
        nd = self.t.nodes.new('ShaderNode' + kind)
        for k, v in kw.items():
            if k.startswith('_'):
                setattr(nd, k[1:], v)
            else:
                s = nd.inputs[k.replace('0x', '')] if not k.startswith('i') or not k[1:].isdigit() \
                    else nd.inputs[int(k[1:])]
                if isinstance(v, bpy.types.NodeSocket):
                    self.t.links.new(v, s)
                else:
                    s.default_value = v
        return nd

    def set(self, **kw):
        for k, v in kw.items():
            s = self.b.inputs[k.replace('_', ' ')]
            if isinstance(v, bpy.types.NodeSocket):
                self.t.links.new(v, s)
            else:
                s.default_value = v

    def coord(self, which='Object', scale=(1, 1, 1), rot=(0, 0, 0)):
        c = self.n('TexCoord').outputs[which]
        m = self.n('Mapping')
        m.inputs['Scale'].default_value = scale
        m.inputs['Rotation'].default_value = rot
        self.t.links.new(c, m.inputs['Vector'])
        return m.outputs[0]

    def noise(self, vec, scale, detail=6, rough=0.55):
        return self.n('TexNoise', Vector=vec, Scale=scale, Detail=detail, Roughness=rough).outputs[0]

    def ramp(self, fac, stops):
        r = self.n('ValToRGB', Fac=fac)
        e = r.color_ramp.elements
        while len(e) > 1:
            e.remove(e[-1])
        e[0].position, e[0].color = stops[0][0], (*stops[0][1], 1)
        for p, c in stops[1:]:
            x = e.new(p)
            x.color = (*c, 1)
        return r.outputs[0]

    def mix(self, a, b, fac, mode='MIX'):
        m = self.t.nodes.new('ShaderNodeMix')
        m.data_type, m.blend_type = 'RGBA', mode
        for i, v in ((0, fac), (6, a), (7, b)):
            if isinstance(v, bpy.types.NodeSocket):
                self.t.links.new(v, m.inputs[i])
            else:
                m.inputs[i].default_value = v if i == 0 else (*v, 1)
        return m.outputs[2]

    def math(self, op, a, b=0.0):
        m = self.t.nodes.new('ShaderNodeMath')
        m.operation = op
        for i, v in enumerate((a, b)):
            if isinstance(v, bpy.types.NodeSocket):
                self.t.links.new(v, m.inputs[i])
            else:
                m.inputs[i].default_value = v
        return m.outputs[0]

    def bump(self, h, strength=0.3, dist=0.002):
        self.set(Normal=self.n('Bump', Height=h, Strength=strength, Distance=dist).outputs[0])


def srgb(hexa):
    v = [int(hexa[i:i + 2], 16) / 255 for i in (0, 2, 4)]
    return tuple(c / 12.92 if c <= .04045 else ((c + .055) / 1.055) ** 2.4 for c in v)


def material(name, build):
    if name not in _MATS:
        m = bpy.data.materials.new(name)
        m.use_nodes = True
        build(NT(m))
        _MATS[name] = m
    return _MATS[name]


def plain(hexa, rough=0.5, metal=0.0, mottle=0.06, scale=30, bump=0.05):
    """A paint or plastic with faint mottling, so that nothing is perfectly flat."""
    c = srgb(hexa)

    def b(t):
        v = t.coord()
        n = t.noise(v, scale, 2.5, 0.65)
        t.set(Base_Color=t.ramp(n, [(.3, tuple(x * (1 - mottle) for x in c)),
                                    (.7, tuple(min(1, x * (1 + mottle)) for x in c))]),
              Roughness=rough, Metallic=metal)
        if bump:
            t.bump(n, bump)
    return material(f'plain_{hexa}_{rough}_{metal}_{mottle}_{scale}', b)


def m_floor(t):
    v = t.coord('Object')
    br = t.n('TexBrick', Vector=v, Scale=1.0)
    br.offset, br.squash = 0.37, 1.0
    br.inputs['Color1'].default_value = (0, 0, 0, 1)
    br.inputs['Color2'].default_value = (1, 1, 1, 1)
    br.inputs['Mortar'].default_value = (0.5, 0.5, 0.5, 1)
    br.inputs['Mortar Size'].default_value = 0.0016
    br.inputs['Mortar Smooth'].default_value = 0.2
    br.inputs['Brick Width'].default_value = 1.15
    br.inputs['Row Height'].default_value = 0.125
    plank = br.outputs['Color']
    # grain: shift each plank's own coordinates, then stretch along x
    sep = t.n('SeparateXYZ', Vector=v)
    shift = t.math('MULTIPLY', plank, 37.0)
    gv = t.n('CombineXYZ', X=t.math('ADD', sep.outputs[0], shift),
             Y=t.math('MULTIPLY', t.math('ADD', sep.outputs[1], shift), 11.0), Z=shift).outputs[0]
    g1 = t.noise(gv, 2.2, 5, 0.62)
    g2 = t.noise(gv, 14.0, 2, 0.7)
    wave = t.n('TexWave', Vector=gv, Scale=0.9, Distortion=6.0, Detail=1.5).outputs['Fac']
    tone = t.ramp(g1, [(.28, srgb('6b452a')), (.5, srgb('9a6a41')), (.72, srgb('b98a5b'))])
    col = t.mix(tone, srgb('7d5433'), t.math('MULTIPLY', wave, 0.35))
    col = t.mix(col, srgb('4a2e1b'), t.math('MULTIPLY', t.math('GREATER_THAN', g2, 0.64), 0.35))
    col = t.mix(col, t.ramp(plank, [(0, (.55, .52, .5)), (.5, (.8, .8, .8)), (1, (1, 1, 1))]), 0.85, 'MULTIPLY')
    col = t.mix(col, srgb('2a1a10'), br.outputs['Fac'])
    dust = t.noise(t.coord('Object', (1.3, 1.3, 1)), 3.0, 3, 0.7)
    t.set(Base_Color=col, Roughness=t.ramp(t.math('ADD', t.math('MULTIPLY', g2, .3), t.math('MULTIPLY', dust, .7)),
                                           [(.3, (.22,) * 3), (.75, (.5,) * 3)]))
    h = t.math('SUBTRACT', t.math('MULTIPLY', g2, 0.25), t.math('MULTIPLY', br.outputs['Fac'], 1.0))
    t.bump(h, 0.35, 0.002)


def m_wall(t):
    v = t.coord('Object')
    n = t.noise(v, 110, 1, 0.6)
    big = t.noise(v, 1.1, 2, 0.6)
    t.set(Base_Color=t.ramp(big, [(.3, srgb('cfc9bb')), (.7, srgb('dbd6ca'))]), Roughness=0.85)
    t.bump(n, 0.35, 0.0025)


def wood(dark, light, rough=0.4, axis=0):
    def b(t):
        s = [9, 9, 9]
        s[axis] = 0.9
        v = t.coord('Object', tuple(s))
        g = t.noise(v, 3.0, 4, 0.6)
        w = t.n('TexWave', Vector=v, Scale=1.1, Distortion=5.0, Detail=3.0).outputs['Fac']
        f = t.math('ADD', t.math('MULTIPLY', g, .7), t.math('MULTIPLY', w, .3))
        t.set(Base_Color=t.ramp(f, [(.3, srgb(dark)), (.7, srgb(light))]), Roughness=rough)
        t.bump(g, 0.15, 0.001)
    return material(f'wood_{dark}_{light}_{axis}', b)


def fabric(hexa, weave=420):
    c = srgb(hexa)

    def b(t):
        v = t.coord('Object')
        w1 = t.n('TexWave', Vector=t.coord('Object', (1, 1, 1), (.5, .6, .8)), Scale=weave / 6, Distortion=1.2).outputs['Fac']
        n = t.noise(v, 130, 2, 0.75)
        big = t.noise(v, 9, 2)
        f = t.math('ADD', t.math('MULTIPLY', n, .6), t.math('ADD', t.math('MULTIPLY', w1, .15), t.math('MULTIPLY', big, .25)))
        t.set(Base_Color=t.ramp(f, [(.35, tuple(x * .62 for x in c)), (.65, tuple(min(1, x * 1.25) for x in c))]),
              Roughness=0.95)
        t.set(**{'Sheen_Weight': 0.3})
        t.bump(t.math('ADD', n, t.math('MULTIPLY', big, 1.5)), 0.6, 0.004)
    return material('fabric_' + hexa, b)


def m_cardboard(t):
    v = t.coord('Object')
    n = t.noise(v, 60, 3, 0.7)
    fib = t.noise(t.coord('Object', (40, 40, 2)), 6, 2)
    f = t.math('ADD', t.math('MULTIPLY', n, .6), t.math('MULTIPLY', fib, .4))
    t.set(Base_Color=t.ramp(f, [(.3, srgb('9a7448')), (.7, srgb('bb935f'))]), Roughness=0.9)
    t.bump(fib, 0.2, 0.001)


def m_rug(t):
    v = t.coord('Object')
    sep = t.n('SeparateXYZ', Vector=v)
    x, y = sep.outputs[0], sep.outputs[1]
    wob = t.math('MULTIPLY', t.noise(v, 25, 3), 0.012)
    zig = t.math('PINGPONG', t.math('ADD', y, wob), 0.09)
    stripe = t.math('FRACT', t.math('MULTIPLY', t.math('ADD', t.math('ADD', x, zig), wob), 4.2))
    col = t.ramp(stripe, [(0, srgb('3d4f63')), (.30, srgb('3d4f63')), (.32, srgb('c9bfa8')), (.44, srgb('c9bfa8')),
                          (.46, srgb('8f3f36')), (.60, srgb('8f3f36')), (.62, srgb('b7ab92')), (.98, srgb('b7ab92')),
                          (1, srgb('3d4f63'))])
    pile = t.noise(v, 240, 1, 0.8)
    col = t.mix(col, t.ramp(pile, [(.3, (.35,) * 3), (.7, (1,) * 3)]), 0.6, 'MULTIPLY')
    t.set(Base_Color=col, Roughness=1.0)
    t.bump(t.math('ADD', pile, t.noise(v, 60, 3)), 0.9, 0.008)


def m_ball(t):
    v = t.coord('Object')
    sep = t.n('SeparateXYZ', Vector=v)
    a = t.math('ARCTAN2', sep.outputs[1], sep.outputs[0])
    s = t.math('FRACT', t.math('DIVIDE', t.math('ADD', a, math.pi), 2 * math.pi / 3))
    col = t.ramp(s, [(0, srgb('d8342a')), (.495, srgb('d8342a')), (.505, srgb('f3e9d6')), (1, srgb('f3e9d6'))])
    n = t.noise(v, 40, 3, .7)
    col = t.mix(col, t.ramp(n, [(.35, (.75,) * 3), (.6, (1,) * 3)]), 0.6, 'MULTIPLY')
    t.set(Base_Color=col, Roughness=0.32)
    t.bump(t.noise(v, 260, 2), 0.1, 0.001)


def image_mat(name, arr, rough=0.55):
    """arr: HxWx3 uint8, sRGB; mapped by UV."""
    def b(t):
        h, w = arr.shape[:2]
        im = bpy.data.images.new(name, w, h)
        px = np.ones((h, w, 4), np.float32)
        px[..., :3] = arr[::-1].astype(np.float32) / 255
        im.pixels.foreach_set(px.ravel())
        im.pack()
        tex = t.n('TexImage')
        tex.image = im
        tex.interpolation = 'Cubic'
        n = t.noise(t.coord('Object'), 90, 5)
        t.set(Base_Color=t.mix(tex.outputs[0], t.ramp(n, [(.3, (.93,) * 3), (.7, (1,) * 3)]), 1.0, 'MULTIPLY'),
              Roughness=rough)
    return material('img_' + name, b)


def m_emit(hexa, strength):
    def b(t):
        e = t.n('Emission', Strength=strength)
        e.inputs[0].default_value = (*srgb(hexa), 1)
        t.t.links.new(e.outputs[0], t.out.inputs[0])
    return material(f'emit_{hexa}_{strength}', b)


# ------------------------------------------------------------------ geometry
LABELS = {0: 'background', 1: 'floor', 2: 'wall', 3: 'door', 4: 'window', 5: 'sofa', 6: 'table', 7: 'chair', 8: 'box',
          9: 'ball', 10: 'shelf', 11: 'book', 12: 'sign', 13: 'marker', 14: 'rug', 15: 'plant', 16: 'person',
          17: 'toy', 18: 'skirting', 19: 'clutter'}
LID = {v: k for k, v in LABELS.items()}


def finish(ob, mat, label, bevel=0.0, smooth=False, parent=None, segs=3):
    if mat is not None:
        ob.data.materials.clear()
        ob.data.materials.append(mat)
    ob.pass_index = LID[label]
    if bevel:
        m = ob.modifiers.new('bev', 'BEVEL')
        m.width, m.segments, m.limit_method = bevel, segs, 'ANGLE'
        m.harden_normals = False
        smooth = True
    if smooth:
        for p in ob.data.polygons:
            p.use_smooth = True
    if parent is not None:
        ob.parent = parent
    return ob


def link(ob):
    bpy.context.scene.collection.objects.link(ob)
    return ob


def mesh(name, verts, faces, uv=None):
    me = bpy.data.meshes.new(name)
    me.from_pydata(verts, [], faces)
    if uv is not None:
        layer = me.uv_layers.new()
        layer.data.foreach_set('uv', np.array(uv, np.float32).ravel())
    me.update()
    return link(bpy.data.objects.new(name, me))


def box(name, size, loc, mat, label, bevel=0.004, rot=(0, 0, 0), parent=None, segs=3):
    sx, sy, sz = (s / 2 for s in size)
    v = [(x, y, z) for x in (-sx, sx) for y in (-sy, sy) for z in (-sz, sz)]
    f = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
    ob = mesh(name, v, f)
    ob.location, ob.rotation_euler = loc, rot
    return finish(ob, mat, label, min(bevel, 0.45 * min(size)), parent=parent, segs=segs)


def cushion(name, size, loc, mat, label, rot=(0, 0, 0), puff=0.5, parent=None, seed=0):
    """A soft block: subdivided box, rounded and dented by a noise displacement."""
    ob = box(name, size, loc, mat, label, 0, rot, parent)
    m = ob.modifiers.new('bev', 'BEVEL')
    m.width, m.segments = min(size) * 0.28 * puff * 2, 3
    m = ob.modifiers.new('sub', 'SUBSURF')
    m.levels = m.render_levels = 3
    tex = bpy.data.textures.new(name + 'tx', 'CLOUDS')
    tex.noise_scale = 0.22
    d = ob.modifiers.new('d', 'DISPLACE')
    d.texture, d.strength, d.mid_level, d.texture_coords = tex, 0.022, 0.5, 'GLOBAL'
    for p in ob.data.polygons:
        p.use_smooth = True
    return ob


def cyl(name, r, h, loc, mat, label, rot=(0, 0, 0), r2=None, bevel=0.003, n=32, parent=None):
    r2 = r if r2 is None else r2
    v, f = [], []
    for z, rr in ((-h / 2, r), (h / 2, r2)):
        v += [(rr * math.cos(2 * math.pi * i / n), rr * math.sin(2 * math.pi * i / n), z) for i in range(n)]
    f = [(i, (i + 1) % n, n + (i + 1) % n, n + i) for i in range(n)]
    f += [tuple(range(n - 1, -1, -1)), tuple(range(n, 2 * n))]
    ob = mesh(name, v, f)
    ob.location, ob.rotation_euler = loc, rot
    return finish(ob, mat, label, min(bevel, h * .4), smooth=True, parent=parent)


def ball(name, r, loc, mat, label, parent=None, scale=(1, 1, 1)):
    n, k = 48, 24
    v = [(0, 0, r)]
    for j in range(1, k):
        th = math.pi * j / k
        v += [(r * math.sin(th) * math.cos(2 * math.pi * i / n), r * math.sin(th) * math.sin(2 * math.pi * i / n),
               r * math.cos(th)) for i in range(n)]
    v.append((0, 0, -r))
    f = [(0, 1 + i, 1 + (i + 1) % n) for i in range(n)]
    for j in range(k - 2):
        a, b = 1 + j * n, 1 + (j + 1) * n
        f += [(a + i, b + i, b + (i + 1) % n, a + (i + 1) % n) for i in range(n)]
    a = 1 + (k - 2) * n
    f += [(a + i, len(v) - 1, a + (i + 1) % n) for i in range(n)]
    ob = mesh(name, v, f)
    ob.location, ob.scale = loc, scale
    return finish(ob, mat, label, smooth=True, parent=parent)


def panel(name, w, h, arr, loc, rot, label, rough=0.55, parent=None, thick=0.003):
    """A picture on the local XZ plane, facing local -Y, with a thin backing."""
    ob = mesh(name, [(-w / 2, 0, -h / 2), (w / 2, 0, -h / 2), (w / 2, 0, h / 2), (-w / 2, 0, h / 2)], [(0, 1, 2, 3)],
              [(0, 0), (1, 0), (1, 1), (0, 1)])
    ob.location, ob.rotation_euler = loc, rot
    finish(ob, image_mat(name, arr, rough), label, parent=parent)
    if thick:
        box(name + '_back', (w, thick, h), (0, thick / 2 + .0004, 0), plain('e8e6e0'), label, 0.0006, parent=ob)
    return ob


def text3d(body, size, loc, rot, mat, label, parent=None, align='CENTER'):
    c = bpy.data.curves.new('txt_' + body[:8], 'FONT')
    c.body, c.size, c.align_x, c.align_y, c.extrude = body, size, align, 'CENTER', 0.0003
    ob = link(bpy.data.objects.new(c.name, c))
    ob.location, ob.rotation_euler = loc, rot
    c.materials.append(mat)
    ob.pass_index = LID[label]
    if parent is not None:
        ob.parent = parent
    return ob


# ------------------------------------------------------------------ the room
X0, X1, Y0, Y1, ZC = -0.9, 5.6, -2.1, 2.3, 2.45          # back wall at X1, window at Y1, door in back wall
DOOR = (-1.55, -0.72)                                     # y range of the door in the back wall
WIN = (1.7, 3.5, 0.85, 2.15)                              # x0 x1 z0 z1 in the wall y = Y1


def wall_with_hole(name, axis, at, a0, a1, hole, mat, thick=0.12):
    """Wall made of four slabs around hole=(a0,a1,z0,z1); axis 'x': plane y=at, 'y': plane x=at."""
    h0, h1, z0, z1 = hole
    for i, (p, q, r, s) in enumerate(((a0, h0, 0, ZC), (h1, a1, 0, ZC), (h0, h1, 0, z0), (h0, h1, z1, ZC))):
        if q - p < 1e-6 or s - r < 1e-6:
            continue
        if axis == 'x':
            box(f'{name}{i}', (q - p, thick, s - r), ((p + q) / 2, at + thick / 2, (r + s) / 2), mat, 'wall', 0)
        else:
            box(f'{name}{i}', (thick, q - p, s - r), (at + thick / 2, (p + q) / 2, (r + s) / 2), mat, 'wall', 0)


def skirting(a, b, at, axis, inward):
    m = plain('efece4', .35)
    L = b - a
    for h, t in ((0.085, 0.014), (0.012, 0.02)):
        z = h / 2 if t == .014 else .006
        off = inward * t / 2
        if axis == 'x':
            box('skirt', (L, t, h), ((a + b) / 2, at + off, z), m, 'skirting', 0.004)
        else:
            box('skirt', (t, L, h), (at + off, (a + b) / 2, z), m, 'skirting', 0.004)


def build_room():
    wall = material('wall', m_wall)
    ob = box('floor', (X1 - X0 + .2, Y1 - Y0 + .2, .1), ((X0 + X1) / 2, (Y0 + Y1) / 2, -.05), material('floor', m_floor), 'floor', 0)
    box('ceiling', (X1 - X0 + .3, Y1 - Y0 + .3, .1), ((X0 + X1) / 2, (Y0 + Y1) / 2, ZC + .05), plain('eeeae2', .9), 'wall', 0)
    wall_with_hole('wl', 'x', Y1, X0, X1, WIN, wall)
    box('wr', (X1 - X0, .12, ZC), ((X0 + X1) / 2, Y0 - .06, ZC / 2), wall, 'wall', 0)
    box('w0', (.12, Y1 - Y0, ZC), (X0 - .06, (Y0 + Y1) / 2, ZC / 2), wall, 'wall', 0)
    wall_with_hole('wb', 'y', X1, Y0, Y1, (*DOOR, 0, 2.03), wall)
    skirting(X0, X1, Y1, 'x', -1)
    skirting(X0, X1, Y0, 'x', 1)
    skirting(Y0, DOOR[0] - .07, X1, 'y', -1)
    skirting(DOOR[1] + .07, Y1, X1, 'y', -1)
    # door
    white, trim = plain('d9d2c3', .38, scale=60), plain('efece4', .35)
    yc, w = sum(DOOR) / 2, DOOR[1] - DOOR[0]
    d = box('door', (.04, w - .008, 2.02), (X1 + .03, yc, 1.015), white, 'door', .003)
    for z0, z1 in ((.22, .92), (1.08, 1.85)):
        for y in (-.2, .2):
            box('dpanel', (.012, .28, z1 - z0), (-.024, y, (z0 + z1) / 2 - 1.015), white, 'door', .008, parent=d)
            box('dpanel2', (.012, .2, z1 - z0 - .08), (-.031, y, (z0 + z1) / 2 - 1.015), white, 'door', .006, parent=d)
    for y in (DOOR[0] - .035, DOOR[1] + .035):
        box('frame', (.025, .07, 2.04), (X1 - .0125, y, 1.02), trim, 'door', .005)
    box('frame', (.03, w + .18, .08), (X1 - .015, yc, 2.075), trim, 'door', .005)
    steel = plain('b9b7b2', .28, 1.0, .03)
    cyl('knob_r', .026, .012, (X1 - .002, DOOR[1] - .09, 1.0), steel, 'door', (0, math.pi / 2, 0))
    cyl('knob_s', .009, .06, (X1 - .03, DOOR[1] - .09, 1.0), steel, 'door', (0, math.pi / 2, 0))
    cyl('knob_h', .0095, .12, (X1 - .058, DOOR[1] - .145, 1.0), steel, 'door', (math.pi / 2, 0, 0), bevel=.006)
    # window: frame, muntins, sill, bright outside
    x0, x1, z0, z1 = WIN
    for x in (x0 + .03, (x0 + x1) / 2, x1 - .03):
        box('wfr', (.06, .05, z1 - z0), (x, Y1 + .05, (z0 + z1) / 2), trim, 'window', .006)
    for z in (z0 + .03, (z0 + z1) / 2 + .2, z1 - .03):
        box('wfr', (x1 - x0, .045, .06), ((x0 + x1) / 2, Y1 + .05, z), trim, 'window', .006)
    box('sill', (x1 - x0 + .16, .2, .03), ((x0 + x1) / 2, Y1 - .05, z0 - .015), trim, 'window', .006)
    ob = mesh('outside', [(x0 - 2, Y1 + 1.2, 0), (x1 + 2, Y1 + 1.2, 0), (x1 + 2, Y1 + 1.2, 3.5), (x0 - 2, Y1 + 1.2, 3.5)], [(0, 1, 2, 3)])
    finish(ob, m_emit('dfeaf5', 3.0), 'window')
    ob.visible_shadow = False
    ob.visible_diffuse = ob.visible_glossy = True
    # lights
    L = bpy.data.lights.new('win', 'AREA')
    L.shape, L.size, L.size_y, L.energy, L.color = 'RECTANGLE', x1 - x0, z1 - z0, 80, (.86, .93, 1)
    o = link(bpy.data.objects.new('win', L))
    o.location, o.rotation_euler = ((x0 + x1) / 2, Y1 + .14, (z0 + z1) / 2), (-math.pi / 2, 0, 0)
    o.visible_camera = False
    L = bpy.data.lights.new('sun', 'SUN')
    L.energy, L.angle, L.color = 26.0, math.radians(1.2), (1, .90, .76)
    o = link(bpy.data.objects.new('sun', L))
    dvec = Vector((-.10, -1, -1.02))
    o.rotation_euler = dvec.to_track_quat('-Z', 'Y').to_euler()
    L = bpy.data.lights.new('lamp', 'AREA')
    L.shape, L.size, L.energy, L.color = 'DISK', .5, 26, (1, .86, .68)
    o = link(bpy.data.objects.new('lamp', L))
    o.location, o.rotation_euler = (1.6, -.2, ZC - .05), (0, 0, 0)
    o.visible_camera = False


def build_furniture():
    # rug
    r = box('rug', (1.7, 1.2, .012), (2.55, .35, .006), material('rug', m_rug), 'rug', .005)
    r.rotation_euler = (0, 0, .06)
    # sofa along the left wall
    fb = fabric('4f6d74')
    s = link(bpy.data.objects.new('sofa', None))
    s.location = (4.1, 1.72, 0)
    cushion('s_base', (1.75, .82, .24), (0, 0, .22), fb, 'sofa', puff=.35, parent=s)
    for x in (-.42, .42):
        cushion('s_seat', (.8, .68, .17), (x, -.06, .40), fb, 'sofa', puff=.7, parent=s)
        cushion('s_bk', (.8, .2, .42), (x, .26, .63), fb, 'sofa', (-.18, 0, 0), puff=.8, parent=s)
    for x in (-.9, .9):
        cushion('s_arm', (.2, .84, .5), (x, 0, .36), fb, 'sofa', puff=.75, parent=s)
    cushion('s_pillow', (.4, .14, .36), (-.55, .02, .64), fabric('c9822f'), 'sofa', (-.45, .12, .25), puff=.95, parent=s)
    dark = wood('2b1c12', '4a3322')
    for x in (-.8, .8):
        for y in (-.34, .34):
            cyl('s_leg', .022, .11, (x, y, .055), dark, 'sofa', r2=.028, parent=s)
    # low table on the rug's far side
    oak = wood('8a5f36', 'b98c58', .35, 0)
    oakz = wood('8a5f36', 'b98c58', .4, 2)
    t = link(bpy.data.objects.new('table', None))
    t.location, t.rotation_euler = (3.45, .72, 0), (0, 0, .05)
    box('t_top', (.55, .95, .028), (0, 0, .405), wood('8a5f36', 'b98c58', .35, 1), 'table', .005, parent=t)
    for x in (-.24, .24):
        box('t_rail', (.02, .82, .06), (x * .95, 0, .36), oak, 'table', .003, parent=t)
        for y in (-.43, .43):
            box('t_leg', (.045, .045, .39), (x, y, .195), oakz, 'table', .005, parent=t)
    # mug and books on it
    mug = plain('2f5fa8', .25)
    cyl('mug', .042, .095, (-.05, -.22, .467), mug, 'clutter', bevel=.006, parent=t)
    # chair on the right
    c = link(bpy.data.objects.new('chair', None))
    c.location, c.rotation_euler = (3.15, -1.18, 0), (0, 0, 2.55)
    br = wood('5a3820', '8a5a34', .4, 2)
    brx = wood('5a3820', '8a5a34', .4, 0)
    box('c_seat', (.42, .42, .032), (0, 0, .45), brx, 'chair', .01, parent=c)
    cushion('c_cush', (.38, .38, .06), (0, 0, .49), fabric('8c2f2b'), 'chair', puff=.8, parent=c)
    for x in (-.18, .18):
        for y in (-.18, .18):
            h = .45 if y < 0 else .92
            cyl('c_leg', .016, h, (x, y * 1.04, h / 2), br, 'chair', r2=.02 if y < 0 else .015, parent=c)
        box('c_str', (.018, .34, .018), (x, 0, .2), br, 'chair', .004, parent=c)
    for z in (.62, .73, .85):
        box('c_slat', (.36, .016, .055), (0, .187, z), brx, 'chair', .006, parent=c)
    box('c_str', (.34, .018, .018), (0, -.187, .26), brx, 'chair', .004, parent=c)
    # shelf with books on the back wall
    sh = link(bpy.data.objects.new('shelf', None))
    sh.location = (X1 - .16, .62, 0)
    fr = wood('c7b497', 'e0d2b8', .45, 1)
    frz = wood('c7b497', 'e0d2b8', .45, 2)
    wsh = 1.0
    levels = (.06, .42, .78, 1.14, 1.5)
    for y in (-wsh / 2, wsh / 2):
        box('sh_s', (.28, .02, 1.54), (0, y, .77), frz, 'shelf', .002, parent=sh)
    box('sh_b', (.006, wsh, 1.5), (.137, 0, .77), frz, 'shelf', 0, parent=sh)
    for z in levels:
        box('sh_l', (.28, wsh - .02, .02), (0, 0, z), fr, 'shelf', .002, parent=sh)
    box('sh_k', (.012, wsh - .02, .05), (-.12, 0, .025), fr, 'shelf', .002, parent=sh)
    titles = ['ROS 2', 'OPENCV', 'VISION', 'ROBOTS', 'MATHS', 'PYTHON', 'ATLAS', 'OPTICS', 'SLAM', 'LINUX', 'SIGNALS', 'GARDEN',
              'COOKING', 'TRAINS', 'OCEAN', 'HISTORY']
    cols = ['7a2e2a', '2f4a6b', '46603d', 'c08a2d', '5b4a70', '2b2b2d', 'b8b0a0', '8c5a3a', '2f6f73', 'a33f55', 'd7c9a7', '3a4f8f']
    k = 0
    for z in levels[:4]:
        y = wsh / 2 - .03
        stop = -wsh / 2 + rnd.uniform(.08, .3)
        while y > stop:
            bw, bh, bd = rnd.uniform(.018, .052), rnd.uniform(.19, .29), rnd.uniform(.15, .2)
            lean = 0.0 if rnd.random() < .85 else rnd.uniform(.04, .10)
            m = plain(rnd.choice(cols), rnd.uniform(.35, .7), 0, .09, 45)
            b = box('book', (bd, bw - .0015, bh), (-.13 + bd / 2 + rnd.uniform(.0, .03), y - bw / 2, z + .011 + bh / 2), m, 'book', .003,
                    (lean, 0, 0), parent=sh)
            if bw > .026:
                ink = plain('e9dfc4' if rnd.random() < .7 else '201c18', .5)
                text3d(titles[k % len(titles)], min(.75 * bw, .024), (-bd / 2 - .0008, 0, rnd.uniform(-.02, .03)),
                       (math.pi / 2, -math.pi / 2, -math.pi / 2), ink, 'book', parent=b)
                k += 1
            if rnd.random() < .5:
                for zz in (-bh * .4, bh * .4):
                    box('band', (.001, bw * .96, .004), (-bd / 2 - .0003, 0, zz), plain('d9c48a', .4), 'book', 0, parent=b)
            y -= bw + (.004 if lean == 0 else .03)
    # cardboard boxes, right, near
    cb = material('cardboard', m_cardboard)
    tape = plain('c9a86a', .22)

    def carton(size, loc, rz, text, arrows=True):
        b = box('carton', size, loc, cb, 'box', .006, (0, 0, rz))
        sx, sy, sz = size
        box('tape', (sx * 1.002, .05, .0012), (0, 0, sz / 2), tape, 'box', 0, parent=b)
        box('tape', (.0012, .05, .08), (-sx / 2 - .0002, 0, sz / 2 - .04), tape, 'box', 0, parent=b)
        box('slit', (sx * .98, .002, .001), (0, 0, sz / 2 + .0006), plain('5c4326', .9), 'box', 0, parent=b)
        ink = plain('231b14', .8, 0, .3, 120)
        text3d(text, sz * .2, (-sx / 2 - .0006, 0, -sz * .05), (math.pi / 2, 0, -math.pi / 2), ink, 'box', parent=b)
        text3d('↑  THIS SIDE UP  ↑', sz * .085, (-sx / 2 - .0006, 0, -sz * .30), (math.pi / 2, 0, -math.pi / 2), ink, 'box', parent=b)
        return b
    carton((.42, .5, .34), (2.35, -1.62, .17), -.12, 'FRAGILE')
    carton((.3, .36, .24), (2.38, -1.62, .46), .22, 'BOOKS')
    carton((.26, .3, .22), (1.75, -1.25, .11), .42, 'TOYS')
    # plant in the far left corner
    pot = cyl('pot', .13, .26, (5.2, 1.2, .13), plain('b5623c', .75, 0, .1, 12), 'plant', r2=.165, bevel=.01)
    cyl('soil', .14, .02, (0, 0, .115), plain('2c2018', 1, 0, .4, 60), 'plant', parent=pot)

    def m_leaf(t):
        n = t.noise(t.coord(), 14, 5)
        t.set(Base_Color=t.ramp(n, [(.3, srgb('274d22')), (.7, srgb('4f8a3a'))]), Roughness=.4)
        t.bump(n, .2)
    leafm = material('leaf', m_leaf)
    for i in range(34):
        L, wd = rnd.uniform(.22, .5), rnd.uniform(.035, .06)
        n = 10
        v, f = [], []
        for j in range(n + 1):
            u = j / n
            ww = wd * math.sin(math.pi * min(1, u * .92 + .04)) ** .8
            x, z = L * u * .75, L * (u * .9 - .75 * u * u * rnd.uniform(.85, 1.0))
            v += [(x, -ww, z + .012), (x, 0, z), (x, ww, z + .012)]
        for j in range(n):
            a = 3 * j
            f += [(a, a + 1, a + 4, a + 3), (a + 1, a + 2, a + 5, a + 4)]
        o = mesh('leaf', v, f)
        o.location = (0, 0, .12 + rnd.uniform(0, .35))
        o.rotation_euler = (rnd.uniform(-.2, .2), rnd.uniform(-.9, -.1), rnd.uniform(0, 6.28))
        finish(o, leafm, 'plant', smooth=True, parent=pot)
        s_ = o.modifiers.new('s', 'SUBSURF')
        s_.render_levels = s_.levels = 1
    # picture over the sofa, socket, waste bin, slippers
    yy, xx = np.mgrid[0:360, 0:480] / 360.0
    art = np.zeros((360, 480, 3))
    for c, f in (((226, 214, 190), lambda x, y: x > -1), ((196, 88, 54), lambda x, y: (x - .9) ** 2 + (y - .36) ** 2 < .05),
                 ((60, 92, 110), lambda x, y: y > .62 + .07 * np.sin(5 * x)), ((38, 56, 70), lambda x, y: y > .78 + .05 * np.sin(7 * x + 2))):
        art[f(xx, yy)] = c
    fr_ = box('pict_fr', (.03, .70, .54), (X1 - .015, 1.72, 1.45), wood('2b1c12', '4a3322', .4, 1), 'clutter', .006)
    panel('pict', .62, .46, art.astype(np.uint8), (-.0158, 0, 0), (0, 0, -math.pi / 2), 'clutter', .4, parent=fr_, thick=0)
    so = box('socket', (.08, .012, .08), (2.9, Y0 + .006, .28), plain('f4f3ee', .35), 'clutter', .004)
    for x in (-.014, .014):
        cyl('hole', .0035, .004, (x, .0055, 0), plain('222222', .8), 'clutter', (math.pi / 2, 0, 0), parent=so, bevel=0)
    bn = cyl('bin', .11, .27, (4.75, -1.75, .135), plain('50585e', .45, .2), 'clutter', r2=.135, bevel=.004)
    cyl('bin_in', .125, .004, (0, 0, .1345), plain('15171a', .9), 'clutter', parent=bn, bevel=0)
    for i, (x, y, rz) in enumerate(((2.72, -.80, .5), (2.86, -.68, .15))):
        sl = cushion(f'slip{i}', (.24, .085, .035), (x, y, .02), fabric('7b6a58'), 'clutter', (0, 0, rz), puff=.6)
        cushion(f'slipt{i}', (.11, .09, .045), (.05, 0, .026), fabric('5e5147'), 'clutter', puff=.95, parent=sl)
    # toy blocks
    for i, (cname, p, rz) in enumerate((('c83a2f', (1.62, .92), .4), ('2f62b0', (1.70, .985), .9), ('e0b52d', (1.58, 1.02), .1),
                                        ('3f8f4c', (1.95, 1.12), .7))):
        b = box(f'block{i}', (.05, .05, .05), (*p, .025), plain(cname, .4, 0, .08, 25), 'toy', .004, (0, 0, rz))
        text3d('ABCD'[i], .036, (-.0256, 0, 0), (math.pi / 2, 0, -math.pi / 2), plain('f2ead8', .5), 'toy', parent=b)
    b = box('block4', (.05, .05, .05), (1.635, .965, .075), plain('e8dcc0', .5, 0, .08, 25), 'toy', .004, (0, 0, .55))
    text3d('R', .036, (-.0256, 0, 0), (math.pi / 2, 0, -math.pi / 2), plain('b03026', .5), 'toy', parent=b)


def marker_image():
    import cv2
    d = cv2.aruco.getPredefinedDictionary(cv2.aruco.DICT_4X4_50)
    m = cv2.aruco.generateImageMarker(d, 7, 480)
    m = cv2.copyMakeBorder(m, 80, 80, 80, 80, cv2.BORDER_CONSTANT, value=255)
    m = np.where(m > 128, 236, 18).astype(np.uint8)
    return np.repeat(m[..., None], 3, 2)


MARKER_SIDE = 0.25                                        # black square; the sheet has a white margin of 1/6 of it
POSES = {}


def build_signs():
    # marker on a stand against the back wall, and one sheet on the carton
    s = MARKER_SIDE * 640 / 480
    st = box('stand', (.02, s + .02, s + .02), (4.35, -.62, s / 2 + .06), plain('3a3a3c', .5), 'marker', .003, (0, -.10, .12))
    panel('marker', s, s, marker_image(), (-.0115, 0, 0), (0, 0, -math.pi / 2), 'marker', .7, parent=st, thick=0)
    for y in (-.06, .06):
        box('foot', (.14, .012, .06), (.04, y, -s / 2 - .01), plain('3a3a3c', .5), 'marker', .003, parent=st)
    # sign beside the door: built of text objects, so that it is sharp at any size
    sg = box('sign', (.006, .62, .30), (X1 - .003, -.29, .72), plain('f2efe6', .45, 0, .02), 'sign', .002)
    ink, red = plain('15171a', .5), plain('b3261e', .5)
    R = (math.pi / 2, 0, -math.pi / 2)
    text3d('KITCHEN', .115, (-.0036, 0, .065), R, ink, 'sign', parent=sg)
    text3d('ROOM 204', .062, (-.0036, 0, -.045), R, red, 'sign', parent=sg)
    text3d('Please keep the floor clear', .040, (-.0036, 0, -.112), R, ink, 'sign', parent=sg)


# ------------------------------------------------------------------ moving things
def build_person():
    root = link(bpy.data.objects.new('person', None))
    jeans, shirt, skin, shoe = fabric('2c3a57'), fabric('7e8f52'), plain('c98f6f', .55, 0, .08, 20), plain('dcdad4', .5)
    hip = link(bpy.data.objects.new('hip', None))
    hip.parent, hip.location = root, (0, 0, .92)
    parts = {}

    def limb(name, r0, r1, L, mat, parent, at):
        j = link(bpy.data.objects.new(name, None))
        j.parent, j.location = parent, at
        n, k = 24, 14
        v, f = [], []
        for i in range(k + 1):
            u = i / k
            r = r0 + (r1 - r0) * u + .006 * math.sin(9 * u + len(name))
            if u < .08 or u > .92:
                r *= .8 if mat is not None else .6
            v += [(r * math.cos(2 * math.pi * a / n), r * math.sin(2 * math.pi * a / n), -L * u) for a in range(n)]
        for i in range(k):
            f += [(i * n + a, i * n + (a + 1) % n, (i + 1) * n + (a + 1) % n, (i + 1) * n + a)[::-1] for a in range(n)]
        f += [tuple(range(n)), tuple(range(k * n, (k + 1) * n))[::-1]]
        o = mesh(name + '_m', v, f)
        finish(o, mat, 'person', smooth=True, parent=j)
        m = o.modifiers.new('s', 'SUBSURF')
        m.levels = m.render_levels = 1
        parts[name] = j
        return j
    for sd, y in (('L', .095), ('R', -.095)):
        th = limb('thigh' + sd, .088, .066, .45, jeans, hip, (0, y, 0))
        sn = limb('shin' + sd, .068, .06, .42, jeans, th, (0, 0, -.43))
        ft = link(bpy.data.objects.new('foot' + sd, None))
        ft.parent, ft.location = sn, (0, 0, -.42)
        parts['foot' + sd] = ft
        cushion('shoe' + sd, (.27, .095, .09), (.06, 0, -.025), shoe, 'person', puff=.6, parent=ft)
        box('sole' + sd, (.275, .1, .022), (.06, 0, -.062), plain('f4f2ee', .6), 'person', .01, parent=ft)
        ar = limb('arm' + sd, .052, .043, .30, shirt, hip, (0, y * 2.25, .50))
        fo = limb('fore' + sd, .04, .03, .26, skin, ar, (0, 0, -.28))
        ball('hand' + sd, .042, (0, 0, -.29), skin, 'person', parent=fo, scale=(1, .6, 1.25))
    cushion('torso', (.23, .40, .58), (0, 0, .27), shirt, 'person', puff=.75, parent=hip)
    cushion('pelvis', (.22, .34, .2), (0, 0, -.01), jeans, 'person', puff=.8, parent=hip)
    cyl('neck', .055, .12, (.005, 0, .58), skin, 'person', parent=hip)
    ball('head', .105, (.02, 0, .72), skin, 'person', parent=hip, scale=(.95, .82, 1.18))
    ball('hair', .108, (-.005, 0, .745), plain('2a1d15', .7, 0, .3, 60), 'person', parent=hip, scale=(1.0, .86, 1.08))
    # walks from the right wall along the back wall to the shelf, and stops there
    for f in range(-2, NFRAMES + 3):
        t = f / FPS
        u = min(1.0, max(0.0, (t + .4) / 6.5))
        dist = 2.35 * u * u * (3 - 2 * u)
        speed = 2.35 * 6 * u * (1 - u) / 6.5
        ph, amp = 2 * math.pi * dist / 1.05, min(1.0, speed / .45)
        root.location = (4.93, -1.72 + dist, 0)
        root.rotation_euler = (0, 0, math.pi / 2)
        root.keyframe_insert('location', frame=f)
        root.keyframe_insert('rotation_euler', frame=f)
        hip.location.z = .915 - amp * (.012 - .016 * math.cos(2 * ph))
        hip.keyframe_insert('location', frame=f)
        for sd, o in (('L', 0), ('R', math.pi)):
            a = ph + o
            for nm, ang in (('thigh', -.42 * math.sin(a)), ('shin', .18 + .55 * max(0, math.sin(a + 1.2)) ** 2),
                            ('foot', -.1 + .1 * math.sin(a)), ('arm', .36 * math.sin(a)), ('fore', -.35)):
                p = parts[nm + sd]
                p.rotation_euler = (0, ang * (amp if nm != 'fore' else 1), 0)
                p.keyframe_insert('rotation_euler', frame=f)
    return root


def build_toycar():
    root = link(bpy.data.objects.new('toycar', None))
    red, dark, gray = plain('d0391f', .25, 0, .05, 15), plain('1d1d1f', .6), plain('c9ccd0', .3, .6)
    cushion('body', (.22, .115, .055), (0, 0, .05), red, 'toy', puff=.55, parent=root)
    cushion('cab', (.115, .1, .05), (-.015, 0, .088), plain('e9e4d8', .25), 'toy', puff=.7, parent=root)
    box('glass', (.118, .085, .022), (-.015, 0, .09), plain('20303a', .1), 'toy', .006, parent=root)
    box('bump', (.012, .11, .016), (.112, 0, .035), gray, 'toy', .004, parent=root)
    wheels = []
    for x in (-.07, .07):
        for y in (-.058, .058):
            w = link(bpy.data.objects.new('wheel', None))
            w.parent, w.location = root, (x, y, .028)
            cyl('tyre', .028, .024, (0, 0, 0), dark, 'toy', (math.pi / 2, 0, 0), parent=w, bevel=.006)
            cyl('rim', .016, .026, (0, 0, 0), gray, 'toy', (math.pi / 2, 0, 0), parent=w)
            box('spoke', (.026, .0265, .004), (0, 0, 0), dark, 'toy', 0, parent=w)
            wheels.append(w)
    for f in range(-2, NFRAMES + 3):
        t = f / FPS
        # crosses from the right to the left in front of the robot, in a shallow curve
        x, y = 2.25 + .30 * math.sin(.45 * t), -1.35 + .30 * t
        vx, vy = .135 * math.cos(.45 * t), .30
        root.location, root.rotation_euler = (x, y, .012 if y > -.25 else 0), (0, 0, math.atan2(vy, vx))
        root.keyframe_insert('location', frame=f)
        root.keyframe_insert('rotation_euler', frame=f)
        for w in wheels:
            w.rotation_euler = (0, .33 * t / .028, 0)
            w.keyframe_insert('rotation_euler', frame=f)
    return root


def build_ball():
    r = .11
    o = ball('ball', r, (0, 0, r), material('ball', m_ball), 'ball')
    o.rotation_mode = 'QUATERNION'
    for f in range(-2, NFRAMES + 3):
        t = f / FPS
        d = .55 * (1 - math.exp(-t / 3.5)) * 1.6
        o.location = (2.45 + .45 * d, .78 - d, r + .012)
        ax = Vector((1.0, .45, 0)).normalized()
        o.rotation_quaternion = (Matrix.Rotation(d * 1.097 / r, 4, ax) @ Matrix.Rotation(.9, 4, 'X')).to_quaternion()
        o.keyframe_insert('location', frame=f)
        o.keyframe_insert('rotation_quaternion', frame=f)
    return o


def robot_pose(t):
    """The base's path: forward, a gentle S, small floor vibration. x, y, yaw, camera z, pitch."""
    x = .27 * t
    y = .16 * math.sin(.62 * t)
    yaw = math.atan2(.16 * .62 * math.cos(.62 * t), .27) * .55 - .06 + .05 * math.sin(.9 * t + 1)
    z = CAM_H + .0008 * math.sin(23 * t) + .0005 * math.sin(41 * t + 1)
    pitch = .0025 * math.sin(19 * t + .5) + .0015 * math.sin(37 * t)
    return x, y, yaw, z, pitch


def build_camera():
    cam = bpy.data.cameras.new('cam')
    ob = link(bpy.data.objects.new('cam', cam))
    txt = bpy.data.texts.new('plumb_bob.osl')
    txt.write(OSL_CAMERA)
    cam.type, cam.custom_mode, cam.custom_shader = 'CUSTOM', 'INTERNAL', txt
    from cycles import osl
    if not osl.update_custom_camera_shader(cam, lambda k, m: print(k, m)):
        sys.exit('camera shader did not compile')
    cam.clip_start = .01
    ob.rotation_mode = 'QUATERNION'
    for f in range(-2, NFRAMES + 3):
        for sub in (-.25, 0, .25, .5):
            x, y, yaw, z, pitch = robot_pose((f + sub) / FPS)
            # Blender camera: -Z forward, +Y up
            m = Matrix.Translation((x, y, z)) @ Matrix.Rotation(yaw, 4, 'Z') @ Matrix.Rotation(pitch, 4, 'Y') \
                @ Matrix(((0, 0, -1, 0), (-1, 0, 0, 0), (0, 1, 0, 0), (0, 0, 0, 1)))
            ob.location, ob.rotation_quaternion = m.to_translation(), m.to_quaternion()
            ob.keyframe_insert('location', frame=f + sub)
            ob.keyframe_insert('rotation_quaternion', frame=f + sub)
    bpy.context.scene.camera = ob
    return ob


def settings(spp, threads):
    s = bpy.context.scene
    s.render.engine = 'CYCLES'
    c = s.cycles
    c.device, c.samples, c.use_adaptive_sampling, c.adaptive_threshold = 'CPU', spp, True, .02
    c.adaptive_min_samples = 6
    c.use_denoising, c.denoiser, c.denoising_prefilter, c.denoising_quality = True, 'OPENIMAGEDENOISE', 'FAST', 'BALANCED'
    c.max_bounces, c.diffuse_bounces, c.glossy_bounces, c.transmission_bounces = 4, 3, 2, 0
    c.caustics_reflective = c.caustics_refractive = False
    c.sample_clamp_indirect, c.use_light_tree, c.seed = 4.0, True, 1
    c.blur_glossy = 1.0
    r = s.render
    r.threads_mode, r.threads, r.use_persistent_data = 'FIXED', threads, True
    r.resolution_x, r.resolution_y, r.resolution_percentage, r.fps = W, H, 100, FPS
    r.use_motion_blur, r.motion_blur_shutter = True, .20          # 20 ms at 10 Hz
    r.film_transparent = False
    s.view_settings.view_transform, s.view_settings.look = 'AgX', 'AgX - Medium High Contrast'
    s.view_settings.exposure = EXPOSURE
    s.world = bpy.data.worlds.new('w')
    s.world.color = (.05, .05, .05)
    s.frame_start, s.frame_end = 0, NFRAMES - 1


EXPOSURE = 1.0


def ground_truth(path):
    """Planar depth and label ids through the same lens, one centred ray a pixel, no blur."""
    import OpenEXR
    s = bpy.context.scene
    vl = s.view_layers[0]
    c, r = s.cycles, s.render
    keep = (c.samples, c.use_denoising, r.use_motion_blur, c.pixel_filter_type, c.filter_width, c.max_bounces, c.use_adaptive_sampling)
    c.samples, c.use_denoising, r.use_motion_blur, c.pixel_filter_type, c.filter_width, c.max_bounces, c.use_adaptive_sampling = \
        1, False, False, 'BOX', .01, 0, False
    vl.use_pass_position = vl.use_pass_object_index = vl.use_pass_z = True
    im = r.image_settings
    im.media_type, im.file_format, im.color_depth, im.exr_codec = 'MULTI_LAYER_IMAGE', 'OPEN_EXR_MULTILAYER', '32', 'ZIP'
    r.filepath = path + '.exr'
    bpy.ops.render.render(write_still=True)
    vl.use_pass_position = vl.use_pass_object_index = vl.use_pass_z = False
    im.media_type, im.file_format, im.color_mode, im.color_depth = 'IMAGE', 'PNG', 'RGB', '8'
    c.samples, c.use_denoising, r.use_motion_blur, c.pixel_filter_type, c.filter_width, c.max_bounces, c.use_adaptive_sampling = keep
    with OpenEXR.File(path + '.exr', separate_channels=True) as f:
        ch = {}
        for part in f.parts:
            for k, v in part.channels.items():
                ch['.'.join(k.split('.')[-2:])] = np.array(v.pixels, np.float32)
    if not any(k.startswith('Position') for k in ch):
        sys.exit(f'no position pass in {sorted(ch)}')
    os.remove(path + '.exr')
    P = np.stack([ch[f'Position.{a}'] for a in 'XYZ'], -1)
    ids = np.rint(ch[[k for k in ch if 'ndex' in k][0]]).astype(np.uint8)
    M = np.array(s.camera.matrix_world.inverted())
    z = -(P @ M[2, :3] + M[2, 3])
    return z.astype(np.float32), ids, ch


def pose_of(ob, optical=False):
    m = ob.matrix_world.copy()
    if optical:                                            # Blender camera -> ROS optical (x right, y down, z forward)
        m = m @ Matrix.Diagonal((1, -1, -1, 1))
    p, q, _ = m.decompose()
    return [*map(float, p), q.x, q.y, q.z, q.w]


def sensor(path_in, path_out, seed, full_well=1800, read_noise=5.0):
    """The defects of a small camera on a clean image: vignette, shot and read noise on a Bayer mosaic."""
    import cv2
    img = cv2.imread(path_in).astype(np.float32) / 255
    lin = np.where(img <= .04045, img / 12.92, ((img + .055) / 1.055) ** 2.4)
    h, w = img.shape[:2]
    y, x = np.mgrid[0:h, 0:w].astype(np.float32)
    r2 = ((x - CX) ** 2 + (y - CY) ** 2) / (CX ** 2 + CY ** 2)
    lin *= (1 - .30 * r2 + .06 * r2 * r2)[..., None]
    lin = cv2.GaussianBlur(lin, (0, 0), .55)
    g = np.random.default_rng(seed)
    raw = np.empty((h, w), np.float32)                    # RGGB; cv2 planes are B, G, R
    raw[0::2, 0::2], raw[0::2, 1::2] = lin[0::2, 0::2, 2], lin[0::2, 1::2, 1]
    raw[1::2, 0::2], raw[1::2, 1::2] = lin[1::2, 0::2, 1], lin[1::2, 1::2, 0]
    e = raw * full_well
    e += g.standard_normal(e.shape, np.float32) * np.sqrt(np.maximum(e, 0) + read_noise ** 2)
    raw16 = np.clip(e / full_well * 60000 + 2000, 0, 65535).astype(np.uint16)
    lin = (cv2.cvtColor(raw16, cv2.COLOR_BayerRGGB2BGR_EA).astype(np.float32) - 2000) / 60000
    lin = lin + .35 * (lin - cv2.GaussianBlur(lin, (0, 0), 1.0))
    lin = np.clip(lin, 0, 1)
    out = np.where(lin <= .0031308, lin * 12.92, 1.055 * lin ** (1 / 2.4) - .055)
    cv2.imwrite(path_out, np.rint(np.clip(out, 0, 1) * 255).astype(np.uint8))


def main():
    ap = argparse.ArgumentParser()
    ap.add_argument('--out', default='out')
    ap.add_argument('--frames', type=int, nargs='*', default=[0])
    ap.add_argument('--spp', type=int, default=12)
    ap.add_argument('--threads', type=int, default=2)
    ap.add_argument('--gt', action='store_true')
    ap.add_argument('--sensor', action='store_true')
    ap.add_argument('--norgb', action='store_true')
    ap.add_argument('--pct', type=int, default=100)
    a = ap.parse_args()
    bpy.ops.wm.read_factory_settings(use_empty=True)
    t0 = time.time()
    settings(a.spp, a.threads)
    build_room()
    build_furniture()
    build_signs()
    movers = {'person': build_person(), 'toycar': build_toycar(), 'ball': build_ball()}
    cam = build_camera()
    s = bpy.context.scene
    s.render.resolution_percentage = a.pct
    im = s.render.image_settings
    im.media_type, im.file_format, im.color_mode = 'IMAGE', 'PNG', 'RGB'
    print(f'built in {time.time() - t0:.1f} s, {len(bpy.data.objects)} objects', flush=True)
    for d in ('rgb', 'gt'):
        os.makedirs(os.path.join(a.out, d), exist_ok=True)
    truth = {'width': W, 'height': H, 'fps': FPS, 'distortion_model': 'plumb_bob', 'K': [FX, 0, CX, 0, FY, CY, 0, 0, 1],
             'D': [K1, K2, P1, P2, K3], 'labels': LABELS, 'marker': {'dictionary': 'DICT_4X4_50', 'id': 7, 'side': MARKER_SIDE},
             'frames': {}}
    for f in a.frames:
        s.frame_set(f)
        truth['frames'][f] = {'camera_optical': pose_of(cam, True), 'marker': pose_of(bpy.data.objects['marker']),
                              **{k: pose_of(o) for k, o in movers.items()}}
        if not a.norgb:
            t = time.time()
            s.render.filepath = os.path.abspath(os.path.join(a.out, 'rgb', f'{f:04d}.png'))
            s.cycles.seed = f
            bpy.ops.render.render(write_still=True)
            print(f'frame {f}: rgb {time.time() - t:.1f} s', flush=True)
            if a.sensor:
                os.makedirs(os.path.join(a.out, 'cam'), exist_ok=True)
                sensor(s.render.filepath, os.path.join(a.out, 'cam', f'{f:04d}.png'), f)
    if a.gt:
        # a kept session ignores a changed sample count: start afresh for the one-ray pass
        s.render.use_persistent_data = False
    for f in a.frames if a.gt else ():
        s.frame_set(f)
        if True:
            t = time.time()
            z, ids, ch = ground_truth(os.path.abspath(os.path.join(a.out, 'gt', f'{f:04d}')))
            np.savez_compressed(os.path.join(a.out, 'gt', f'{f:04d}.npz'), depth=z.astype(np.float16), ids=ids)
            print(f'frame {f}: gt {time.time() - t:.1f} s', sorted(ch), flush=True)
    json.dump(truth, open(os.path.join(a.out, 'truth.json'), 'w'), indent=1)


if __name__ == '__main__':
    main()
