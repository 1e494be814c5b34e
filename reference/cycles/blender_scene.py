# What the lines of a scene below are made of: Blender's objects, shaders and Cycles' settings. Each function states
# what it stands for in the scene's own terms; conversions of units and directions are nowhere else.
# Works with Blender 3.4 without numpy and without Open Shading Language.
import array
import math
import os
import sys

import bmesh
import bpy
from mathutils import Matrix, Vector

HERE = os.path.dirname(os.path.abspath(__file__))
SCENE = bpy.context.scene


def clear():
    """Nothing of Blender's default scene stays."""
    for data in (bpy.data.objects, bpy.data.meshes, bpy.data.lights, bpy.data.cameras, bpy.data.materials):
        for item in list(data):
            data.remove(item)
    SCENE.world = bpy.data.worlds.new("world")
    SCENE.world.use_nodes = True
    SCENE.world.node_tree.nodes.clear()


def settings(width, height, threads, bounces, filter_kind, filter_width):
    """An unbiased path tracer: nothing is clamped, cut, blurred, guided by thresholds or taken for dark."""
    render, cycles = SCENE.render, SCENE.cycles
    render.engine = "CYCLES"
    cycles.device = "CPU"
    render.resolution_x, render.resolution_y, render.resolution_percentage = width, height, 100
    render.threads_mode, render.threads = "FIXED", threads
    render.use_persistent_data = True
    render.use_compositing = render.use_sequencer = render.use_motion_blur = render.use_stamp = False
    render.film_transparent = False
    render.image_settings.file_format = "OPEN_EXR"
    render.image_settings.color_mode, render.image_settings.color_depth = "RGB", "32"
    render.image_settings.exr_codec = "ZIP"
    SCENE.view_settings.view_transform = "Raw"
    cycles.pixel_filter_type, cycles.filter_width = filter_kind, filter_width
    cycles.film_exposure = 1
    cycles.use_adaptive_sampling = cycles.use_denoising = False
    cycles.use_auto_tile = False
    cycles.sampling_pattern = "SOBOL"
    cycles.time_limit = 0
    for kind in ("max", "diffuse", "glossy", "transmission", "volume"):
        setattr(cycles, kind + "_bounces", bounces)
    cycles.transparent_max_bounces = 1024
    cycles.sample_clamp_direct = cycles.sample_clamp_indirect = 0
    cycles.blur_glossy = 0
    cycles.light_sampling_threshold = 0
    cycles.caustics_reflective = cycles.caustics_refractive = True
    cycles.use_fast_gi = False
    SCENE.render.use_simplify = False


def camera(kind, columns, near, far, tangents=(0, 0), middle=(0, 0), lens_radius=0, focus=1, angle=0):
    """columns: right, up, backward and place, world space. tangents: of half the image, or half its size; middle: of
    the image from the axis, in halves of it."""
    data = bpy.data.cameras.new("camera")
    data.clip_start, data.clip_end = near, far
    # Of a pixel's height and width, which Blender takes from 1 up.
    tall = tangents[1] * SCENE.render.resolution_x / (tangents[0] * SCENE.render.resolution_y) if angle == 0 else 1
    SCENE.render.pixel_aspect_x, SCENE.render.pixel_aspect_y = max(1, 1 / tall), max(1, tall)
    wide = SCENE.render.resolution_x >= SCENE.render.resolution_y
    larger = 0 if wide else 1
    data.sensor_fit = "HORIZONTAL" if wide else "VERTICAL"
    if kind == "fisheye":
        data.type, data.cycles.panorama_type, data.cycles.fisheye_fov = "PANO", "FISHEYE_EQUIDISTANT", angle
    elif kind == "orthographic":
        data.type, data.ortho_scale = "ORTHO", 2 * tangents[larger]
    else:
        # Blender keeps a focal length in mm; the sensor's size is what the tangent is told by.
        data.type, data.lens_unit, data.lens = "PERSP", "MILLIMETERS", 50
        setattr(data, "sensor_width" if wide else "sensor_height", 100 * tangents[larger])
        data.shift_x = middle[0] * tangents[0] / tangents[larger] / 2
        data.shift_y = middle[1] * tangents[1] / tangents[larger] / 2
    if lens_radius > 0:
        # Cycles' lens has the radius lens / 1000 / (2 fstop), a disc where there are no blades.
        data.dof.use_dof, data.dof.focus_distance = True, focus
        data.dof.aperture_fstop, data.dof.aperture_blades = data.lens / 2000 / lens_radius, 0
    add("camera", data, columns)
    SCENE.camera = bpy.data.objects["camera"]


def add(name, data, columns):
    """An object in its place: columns x, y, z and place of its matrix."""
    thing = bpy.data.objects.new(name, data)
    SCENE.collection.objects.link(thing)
    thing.matrix_world = Matrix([[c[i] for c in columns] for i in range(3)] + [[0, 0, 0, 1]])
    return thing


# Shapes

def polygons(name, positions, corners, size, uv=None, smooth=False, normals=None):
    """A mesh of polygons of `size` corners each: flat lists of coordinates, indices, and uv by vertex."""
    mesh = bpy.data.meshes.new(name)
    count = len(corners) // size
    mesh.vertices.add(len(positions) // 3)
    mesh.vertices.foreach_set("co", positions)
    mesh.loops.add(len(corners))
    mesh.loops.foreach_set("vertex_index", corners)
    mesh.polygons.add(count)
    mesh.polygons.foreach_set("loop_start", array.array("i", range(0, len(corners), size)))
    mesh.polygons.foreach_set("loop_total", array.array("i", [size]) * count)
    mesh.polygons.foreach_set("use_smooth", array.array("b", [smooth]) * count)
    if uv:
        layer = mesh.uv_layers.new(name="uv")
        by_corner = array.array("f", (uv[2 * v + i] for v in corners for i in (0, 1)))
        layer.data.foreach_set("uv", by_corner)
    mesh.update(calc_edges=True)
    if normals:
        mesh.use_auto_smooth = True
        mesh.auto_smooth_angle = math.pi
        mesh.normals_split_custom_set_from_vertices(list(zip(normals[0::3], normals[1::3], normals[2::3])))
    return mesh


def grid(name, point, columns, rows, radial=False):
    """point(u, v) over [0,1]^2, counter-clockwise seen from the front. A seam has vertices of its own, whose normals
    `radial` surfaces get by themselves."""
    positions, uv, corners, normals = array.array("f"), array.array("f"), array.array("i"), array.array("f")
    for j in range(rows + 1):
        for i in range(columns + 1):
            p, n = point(i / columns, j / rows)
            positions.extend(p)
            normals.extend(n)
            uv.extend((i / columns, j / rows))
    for j in range(rows):
        for i in range(columns):
            at = j * (columns + 1) + i
            corners.extend((at, at + 1, at + columns + 2, at + columns + 1))
    return polygons(name, positions, corners, 4, uv, radial, normals if radial else None)


def turned(name, mesh):
    """The same mesh seen from its other side."""
    other = mesh.copy()
    other.name = name
    other.flip_normals()
    return other


def as_large(mesh, area):
    """Scaled until its triangles' areas have this sum: what a lamp's power follows from."""
    mesh.calc_loop_triangles()
    mesh.transform(Matrix.Scale(math.sqrt(area / sum(t.area for t in mesh.loop_triangles)), 4))
    mesh.update()
    return mesh


def sphere_mesh(name, segments):
    """A ball of radius 1 by meridians and parallels, u the longitude from x to y, v the angle from +z."""
    rings = segments // 2
    positions, corners, uv = array.array("f", (0, 0, 1, 0, 0, -1)), array.array("i"), array.array("f")
    for j in range(1, rings):
        for i in range(segments):
            theta, phi = math.pi * j / rings, 2 * math.pi * i / segments
            positions.extend((math.sin(theta) * math.cos(phi), math.sin(theta) * math.sin(phi), math.cos(theta)))

    def at(i, j):
        return 0 if j == 0 else 1 if j == rings else 2 + (j - 1) * segments + i % segments
    for j in range(rings):
        for i in range(segments):
            # Poles have a corner for every segment, whose u is the segment's middle.
            u = [(i + 0.5) / segments if k in (0, rings) else m / segments
                 for m, k in ((i, j), (i, j + 1), (i + 1, j + 1), (i + 1, j))]
            face = [(at(i, j), u[0], j), (at(i, j + 1), u[1], j + 1), (at(i + 1, j + 1), u[2], j + 1),
                    (at(i + 1, j), u[3], j)]
            if j == 0:
                face.pop(3)
            elif j == rings - 1:
                face.pop(2)
            triangles = [face] if len(face) == 3 else [[face[0], face[1], face[2]], [face[0], face[2], face[3]]]
            for triangle in triangles:
                for vertex, u_of, k in triangle:
                    corners.append(vertex)
                    uv.extend((u_of, k / rings))
    mesh = polygons(name, positions, corners, 3, None, True)
    mesh.uv_layers.new(name="uv").data.foreach_set("uv", uv)
    return as_large(mesh, 4 * math.pi)


def icosphere_mesh(name, halvings):
    """A ball of radius 1 by 20 x 4^(halvings - 1) triangles, nearly as large as seen from every side, without uv."""
    ball = bmesh.new()
    bmesh.ops.create_icosphere(ball, subdivisions=halvings, radius=1)
    mesh = bpy.data.meshes.new(name)
    ball.to_mesh(mesh)
    mesh.polygons.foreach_set("use_smooth", array.array("b", [True]) * len(mesh.polygons))
    return as_large(mesh, 4 * math.pi)


def rectangle_mesh(name):
    return polygons(name, array.array("f", (-1, -1, 0, 1, -1, 0, 1, 1, 0, -1, 1, 0)), array.array("i", range(4)), 4,
                    array.array("f", (0, 0, 1, 0, 1, 1, 0, 1)))


def cube_mesh(name):
    """Every face has the whole square of uv: its normal, and where uv is (1,1). Seen from outside v is clockwise of u."""
    faces = (((1, 0, 0), (1, 1, -1)), ((-1, 0, 0), (-1, 1, 1)), ((0, 1, 0), (-1, 1, -1)),
             ((0, -1, 0), (1, -1, 1)), ((0, 0, 1), (1, 1, 1)), ((0, 0, -1), (1, -1, -1)))
    positions = array.array("f")
    for normal, corner in faces:
        n = Vector(normal)
        diagonal = (Vector(corner) - n) * 2
        u = (diagonal - diagonal.cross(n)) / 2
        start = n - diagonal / 2
        for p in (start, start + diagonal - u, start + diagonal, start + u):
            positions.extend(p)
    return polygons(name, positions, array.array("i", range(24)), 4, array.array("f", (0, 0, 0, 1, 1, 1, 1, 0)) * 6)


def disk_mesh(name, segments):
    """A disc of many sides, as large as its area is pi; u the distance from the middle, v the angle from x to y."""
    reach = math.sqrt(2 * math.pi / (segments * math.sin(2 * math.pi / segments)))
    positions, corners, uv = array.array("f", (0, 0, 0)), array.array("i"), array.array("f")
    for i in range(segments):
        phi = 2 * math.pi * i / segments
        positions.extend((reach * math.cos(phi), reach * math.sin(phi), 0))
        corners.extend((0, 1 + i, 1 + (i + 1) % segments))
        uv.extend((0, (i + 0.5) / segments, 1, i / segments, 1, (i + 1) / segments))
    mesh = polygons(name, positions, corners, 3)
    mesh.uv_layers.new(name="uv").data.foreach_set("uv", uv)
    return mesh


def cylinder_mesh(name, segments):
    """Around z from 0 to 1, as large as its area is 2 pi; u the longitude."""
    reach = math.pi / (segments * math.sin(math.pi / segments))

    def point(u, v):
        x, y = math.cos(2 * math.pi * u), math.sin(2 * math.pi * u)
        return (reach * x, reach * y, v), (x, y, 0)
    return grid(name, point, segments, 1, True)


def file_mesh(name, file, vertices, triangles, has_uv, has_normals, smooth):
    """From a file beside this one: single-precision positions, uv and normals by vertex, 32-bit indices."""
    with open(os.path.join(HERE, file), "rb") as data:
        def read(kind, count):
            values = array.array(kind)
            values.fromfile(data, count)
            return values
        positions, corners = read("f", 3 * vertices), read("i", 3 * triangles)
        uv = read("f", 2 * vertices) if has_uv else None
        normals = read("f", 3 * vertices) if has_normals else None
    return polygons(name, positions, corners, 3, uv, smooth, normals)


FORMS = {"rectangle": rectangle_mesh, "cube": cube_mesh, "disk": lambda name: disk_mesh(name, 1024),
         "cylinder": lambda name: cylinder_mesh(name, 1024)}


def form(kind, flip=False, *arguments):
    """A mesh of this kind, made once."""
    name = " ".join(str(word) for word in (kind, *arguments)) + (" turned" if flip else "")
    if name not in bpy.data.meshes:
        if flip:
            turned(name, form(kind, False, *arguments))
        elif kind == "sphere":
            sphere_mesh(name, *arguments)
        elif kind == "icosphere":
            icosphere_mesh(name, *arguments)
        elif kind == "file":
            file_mesh(name, *arguments)
        else:
            FORMS[kind](name)
    return bpy.data.meshes[name]


def shape(name, mesh, columns, shader):
    """A surface: a mesh, which others may share, in its place and with its own shader."""
    if not mesh.materials:
        mesh.materials.append(None)
    thing = add(name, mesh, columns)
    thing.material_slots[0].link = "OBJECT"
    thing.material_slots[0].material = shader
    # No softening of shadows where shading normals lean.
    thing.cycles.shadow_terminator_offset = thing.cycles.shadow_terminator_geometry_offset = 0
    return thing


# Shaders

def inner_share(index):
    """What a boundary to air reflects of diffuse light below it: the mean of Fresnel's share by the cosine."""
    steps, total = 20000, 0.0
    for i in range(steps):
        cosine = (i + 0.5) / steps
        outside = 1 - (1 - cosine * cosine) * index * index
        if outside <= 0:
            share = 1.0
        else:
            c = math.sqrt(outside)
            share = (((cosine - c / index) / (cosine + c / index)) ** 2 + ((cosine / index - c) / (cosine / index + c)) ** 2) / 2
        total += 2 * cosine * share / steps
    return total


class Graph:
    """Writes a node tree; what a method gives back is an output that others take as an input."""

    def __init__(self, tree):
        self.tree = tree
        self.place = None  # u and v that are not those of a surface

    def node(self, kind, inputs=(), **choices):
        node = self.tree.nodes.new(kind)
        for name, value in choices.items():
            setattr(node, name, value)
        for key, value in dict(inputs).items():
            self.put(node.inputs[key], value)
        return node

    def put(self, socket, value):
        if value is None:
            return
        if isinstance(value, bpy.types.NodeSocket):
            self.tree.links.new(value, socket)
        elif isinstance(value, (tuple, list)):
            socket.default_value = tuple(value) + (1,) if socket.type == "RGBA" else tuple(value)
        else:
            socket.default_value = value

    def math(self, operation, *values):
        return self.node("ShaderNodeMath", enumerate(values), operation=operation).outputs[0]

    def vector(self, operation, *values, output=0):
        return self.node("ShaderNodeVectorMath", enumerate(values), operation=operation).outputs[output]

    def combine(self, x, y, z=0.0):
        return self.node("ShaderNodeCombineXYZ", enumerate((x, y, z))).outputs[0]

    def parts(self, vector):
        return self.node("ShaderNodeSeparateXYZ", {0: vector}).outputs[:3]

    def geometry(self, name):
        return self.node("ShaderNodeNewGeometry").outputs[name]

    def dot(self, a, b):
        return self.vector("DOT_PRODUCT", a, b, output=1)

    # Colours

    def image(self, file, matrix, extension, interpolation):
        """uv, through two rows of a matrix; the image's first row is at v = 0, Blender's at v = 1."""
        u, v = self.uv(matrix)
        return self.look_up(file, self.combine(u, self.math("SUBTRACT", 1.0, v)), extension, interpolation)

    def look_up(self, file, place, extension, interpolation):
        picture = bpy.data.images.load(os.path.join(HERE, file), check_existing=True)
        picture.colorspace_settings.name = "Non-Color"
        return self.node("ShaderNodeTexImage", {0: place}, image=picture, extension=extension,
                         interpolation=interpolation).outputs[0]

    def uv(self, matrix):
        u, v = self.place or self.parts(self.node("ShaderNodeUVMap", uv_map="uv").outputs[0])[:2]
        return [self.math("MULTIPLY_ADD", u, row[0], self.math("MULTIPLY_ADD", v, row[1], row[2])) for row in matrix]

    def checkerboard(self, first, second, matrix):
        """`first` where both u and v are in the same half of their unit."""
        halves = [self.math("LESS_THAN", self.math("FRACT", x), 0.5) for x in self.uv(matrix)]
        other = self.math("ABSOLUTE", self.math("SUBTRACT", *halves))
        return self.between(first, second, other)

    def between(self, first, second, share):
        """A mean of two colours that may be brighter than 1."""
        keep = self.vector("SCALE", first)
        self.put(keep.node.inputs[3], self.math("SUBTRACT", 1.0, share))
        rest = self.vector("SCALE", second)
        self.put(rest.node.inputs[3], share)
        return self.vector("ADD", keep, rest)

    def luminance(self, colour):
        return self.dot(colour, (0.212671, 0.715160, 0.072169))

    # Surfaces

    def diffuse(self, colour):
        return self.node("ShaderNodeBsdfDiffuse", {"Color": colour, "Roughness": 0.0}).outputs[0]

    def mirror(self, colour):
        return self.node("ShaderNodeBsdfGlossy", {"Color": colour, "Roughness": 0.0}, distribution="SHARP").outputs[0]

    def metal(self, colour, distribution, alpha):
        """Cycles squares its roughness to get alpha."""
        return self.node("ShaderNodeBsdfGlossy", {"Color": colour, "Roughness": math.sqrt(alpha)},
                         distribution=distribution).outputs[0]

    def facing(self):
        """Of what is met and the way it is met from, the cosine, not negative."""
        return self.math("ABSOLUTE", self.dot(self.geometry("Normal"), self.geometry("Incoming")))

    def conductor_share(self, eta, k, cosine):
        """Unpolarised reflectance of a complex index (Born and Wolf), one channel."""
        m, times, plus, minus = self.math, "MULTIPLY", "ADD", "SUBTRACT"
        c2 = m(times, cosine, cosine)
        s2 = m(minus, 1.0, c2)
        t0 = m(minus, eta * eta - k * k, s2)
        root = m("SQRT", m(plus, m(times, t0, t0), 4 * eta * eta * k * k))
        a = m("SQRT", m("MAXIMUM", 0.0, m(times, 0.5, m(plus, root, t0))))
        t1, t2 = m(plus, root, c2), m(times, m(times, 2.0, a), cosine)
        across = m("DIVIDE", m(minus, t1, t2), m(plus, t1, t2))
        t3, t4 = m(plus, m(times, c2, root), m(times, s2, s2)), m(times, t2, s2)
        along = m(times, across, m("DIVIDE", m(minus, t3, t4), m(plus, t3, t4)))
        return m(times, 0.5, m(plus, across, along))

    def conductor(self, eta, k, colour):
        cosine = self.facing()
        shares = [self.conductor_share(eta[i], k[i], cosine) for i in range(3)]
        return self.mirror(self.vector("MULTIPLY", self.combine(*shares), colour))

    def fresnel(self, index):
        """Of a boundary to this index, seen from outside; from inside to 1 / index."""
        return self.node("ShaderNodeFresnel", {"IOR": index}).outputs[0]

    def glass(self, index, reflected, transmitted):
        """Radiance is divided by the square of the index on the way in and multiplied on the way out, which Cycles by
        itself does not do."""
        back = self.geometry("Backfacing")
        squeeze = self.math("MULTIPLY_ADD", back, index ** 2 - index ** -2, index ** -2)
        colour = self.vector("SCALE", transmitted)
        self.put(colour.node.inputs[3], squeeze)
        passed = self.node("ShaderNodeBsdfRefraction", {"Color": colour, "Roughness": 0.0, "IOR": index},
                           distribution="SHARP").outputs[0]
        return self.mix(passed, self.mirror(reflected), self.fresnel(index))

    def pane(self, index, reflected, transmitted):
        """Both boundaries at once: 2F / (1 + F), from both sides alike."""
        back = self.geometry("Backfacing")
        once = self.fresnel(self.math("MULTIPLY_ADD", back, 1 / index - index, index))
        both = self.math("DIVIDE", self.math("MULTIPLY", 2.0, once), self.math("ADD", 1.0, once))
        return self.mix(self.clear(transmitted), self.mirror(reflected), both)

    # Reflection and refraction that Cycles has no closure of: a direction is drawn here, and a mirror or a refracting
    # surface is turned so that light leaves that way, its colour being what the direction weighs. A hash of the point
    # that was met, which no two paths share, stands for random numbers. Lamps are found by chance alone.

    def draw(self):
        noise = self.node("ShaderNodeTexWhiteNoise", {"Vector": self.geometry("Position")}, noise_dimensions="3D")
        return self.parts(noise.outputs["Color"])[:2]

    def around(self, axis, cosine, turn):
        """The direction at this cosine from an axis, turned about it by a share of a full turn."""
        across = self.vector("NORMALIZE", self.vector("CROSS_PRODUCT", axis, (0.3712, 0.6143, 0.6964)))
        along = self.vector("CROSS_PRODUCT", axis, across)
        sine = self.math("SQRT", self.math("MAXIMUM", 0.0, self.math("SUBTRACT", 1.0, self.math("MULTIPLY", cosine, cosine))))
        angle = self.math("MULTIPLY", turn, 2 * math.pi)
        parts = [self.scaled(axis, cosine), self.scaled(across, self.math("MULTIPLY", sine, self.math("COSINE", angle))),
                 self.scaled(along, self.math("MULTIPLY", sine, self.math("SINE", angle)))]
        return self.vector("ADD", self.vector("ADD", parts[0], parts[1]), parts[2])

    def mirrored(self, normal):
        """Where a mirror of this normal sends light from the viewer."""
        incoming = self.geometry("Incoming")
        return self.vector("SUBTRACT", self.scaled(normal, self.math("MULTIPLY", 2.0, self.dot(normal, incoming))), incoming)

    def positive(self, value):
        return self.math("GREATER_THAN", value, 0.0)

    def product(self, *values):
        result = values[0]
        for value in values[1:]:
            result = self.math("MULTIPLY", result, value)
        return result

    def seen_share(self, distribution, alpha, cosine):
        """Smith's share of facets that are seen at this angle: GGX, and Beckmann's by Walter et al. 2007, eq. 27."""
        m = self.math
        c2 = m("MULTIPLY", cosine, cosine)
        tan2 = m("DIVIDE", m("MAXIMUM", 0.0, m("SUBTRACT", 1.0, c2)), m("MAXIMUM", 1e-12, c2))
        if distribution == "GGX":
            return m("DIVIDE", 2.0, m("ADD", 1.0, m("SQRT", m("MULTIPLY_ADD", tan2, alpha * alpha, 1.0))))
        a = m("MINIMUM", 1.6, m("DIVIDE", 1 / alpha, m("SQRT", m("MAXIMUM", 1e-12, tan2))))
        a2 = m("MULTIPLY", a, a)
        share = m("DIVIDE", m("MULTIPLY_ADD", a, 3.535, m("MULTIPLY", a2, 2.181)),
                  m("ADD", 1.0, m("MULTIPLY_ADD", a, 2.276, m("MULTIPLY", a2, 2.577))))
        smooth = m("GREATER_THAN", a, 1.5999)
        return m("ADD", m("MULTIPLY", share, m("SUBTRACT", 1.0, smooth)), smooth)

    def facet(self, distribution, alpha):
        """A facet's normal, drawn by D cos, and what is common to the weights of all that it does:
        G1(viewer) (viewer . facet) / (cos of the viewer x cos of the facet), 0 where it is seen from behind."""
        m = self.math
        u, turn = self.draw()
        rest = m("MAXIMUM", 1e-7, m("SUBTRACT", 1.0, u))
        if distribution == "GGX":
            tan2 = m("MULTIPLY", alpha * alpha, m("DIVIDE", u, rest))
        else:
            tan2 = m("MULTIPLY", -alpha * alpha, m("LOGARITHM", rest, math.e))
        cosine = m("DIVIDE", 1.0, m("SQRT", m("ADD", 1.0, tan2)))
        normal = self.around(self.geometry("Normal"), cosine, turn)
        seen, facing = self.dot(normal, self.geometry("Incoming")), self.facing()
        weight = m("DIVIDE", self.product(self.positive(seen), seen, self.seen_share(distribution, alpha, facing)),
                   m("MAXIMUM", 1e-6, m("MULTIPLY", facing, cosine)))
        return normal, seen, weight

    def turned_mirror(self, normal, colour):
        return self.node("ShaderNodeBsdfGlossy", {"Color": colour, "Roughness": 0.0, "Normal": normal},
                         distribution="SHARP").outputs[0]

    def leaves_at(self, direction, side=1):
        return self.math("MULTIPLY", side, self.dot(direction, self.geometry("Normal")))

    def rough_conductor(self, eta, k, colour, distribution, alpha):
        normal, seen, weight = self.facet(distribution, alpha)
        out = self.leaves_at(self.mirrored(normal))
        weight = self.product(weight, self.positive(out), self.seen_share(distribution, alpha, out))
        shares = [self.conductor_share(eta[i], k[i], seen) for i in range(3)]
        return self.turned_mirror(normal, self.scaled(self.vector("MULTIPLY", self.combine(*shares), colour), weight))

    def rough_glass(self, index, reflected, transmitted, distribution, alpha):
        m = self.math
        normal, seen, weight = self.facet(distribution, alpha)
        share = self.node("ShaderNodeFresnel", {"IOR": index, "Normal": normal}).outputs[0]
        out = self.leaves_at(self.mirrored(normal))
        mirror = self.product(weight, share, self.positive(out), self.seen_share(distribution, alpha, out))
        # The refracted direction, by Snell at the facet: (c / n - cos t) facet - viewer / n.
        back = self.geometry("Backfacing")
        inverse = m("MULTIPLY_ADD", back, index - 1 / index, 1 / index)  # 1 / n of the side that is entered
        sine2 = self.product(inverse, inverse, m("SUBTRACT", 1.0, m("MULTIPLY", seen, seen)))
        cosine = m("SQRT", m("MAXIMUM", 0.0, m("SUBTRACT", 1.0, sine2)))
        through = self.vector("SUBTRACT",
                              self.scaled(normal, m("SUBTRACT", m("MULTIPLY", inverse, seen), cosine)),
                              self.scaled(self.geometry("Incoming"), inverse))
        depth = self.leaves_at(through, -1)
        passed = self.product(weight, m("SUBTRACT", 1.0, share), self.positive(depth),
                              self.seen_share(distribution, alpha, depth), inverse, inverse)
        refraction = self.node("ShaderNodeBsdfRefraction", {
            "Color": self.scaled(transmitted, passed), "Roughness": 0.0, "IOR": index, "Normal": normal},
            distribution="SHARP").outputs[0]
        return self.sum(self.turned_mirror(normal, self.scaled(reflected, mirror)), refraction)

    def lobe(self, direction, colour):
        """Light to this direction alone."""
        half = self.vector("NORMALIZE", self.vector("ADD", direction, self.geometry("Incoming")))
        above = self.positive(self.leaves_at(direction))
        return self.turned_mirror(half, self.scaled(colour, above))

    def boundary(self, index, cosine):
        """Fresnel's share at this cosine outside, not negative."""
        m = self.math
        inside = m("SQRT", m("SUBTRACT", 1.0, m("MULTIPLY", 1 / index ** 2, m("SUBTRACT", 1.0, m("MULTIPLY", cosine, cosine)))))
        across = m("DIVIDE", m("SUBTRACT", cosine, m("MULTIPLY", index, inside)),
                   m("ADD", cosine, m("MULTIPLY", index, inside)))
        along = m("DIVIDE", m("SUBTRACT", m("MULTIPLY", index, cosine), inside),
                  m("ADD", m("MULTIPLY", index, cosine), inside))
        return m("MULTIPLY", 0.5, m("MULTIPLY_ADD", across, across, m("MULTIPLY", along, along)))

    def plastic(self, index, diffuse, reflected, nonlinear):
        """A mirror's share at the coat, and what passes it, is scattered below and passes it again: (1 - F)(1 - F')
        d / (n^2 (1 - d f)), f the share that the coat sends back of what is diffuse below; 1 - f unless nonlinear."""
        m = self.math
        u, turn = self.draw()
        back = inner_share(index)
        out = m("SQRT", m("SUBTRACT", 1.0, u))  # by the cosine
        share, facing = self.boundary(index, m("MAXIMUM", 1e-4, out)), self.facing()
        here = self.boundary(index, facing)
        weight = self.product(m("SUBTRACT", 1.0, share), m("SUBTRACT", 1.0, here), 1 / index ** 2)
        if nonlinear:
            kept = self.vector("SUBTRACT", (1, 1, 1), self.scaled(diffuse, back))
        else:
            kept = (1 - back, 1 - back, 1 - back)
        colour = self.scaled(self.vector("DIVIDE", diffuse, kept), weight)
        body = self.lobe(self.around(self.geometry("Normal"), out, turn), colour)
        return self.sum(self.mirror(self.scaled(reflected, here)), body)

    def phong(self, exponent, diffuse, reflected):
        """A Lambertian part, which Cycles has, and a lobe (n + 2) / 2 pi cos^n about the mirrored direction, drawn by
        cos^n."""
        m = self.math
        u, turn = self.draw()
        cosine = m("POWER", m("SUBTRACT", 1.0, u), 1 / (exponent + 1))
        direction = self.around(self.mirrored(self.geometry("Normal")), cosine, turn)
        weight = m("MULTIPLY", (exponent + 2) / (exponent + 1), self.leaves_at(direction))
        return self.sum(self.diffuse(diffuse), self.lobe(direction, self.scaled(reflected, weight)))

    def clear(self, colour=(1, 1, 1)):
        return self.node("ShaderNodeBsdfTransparent", {"Color": colour}).outputs[0]

    def black(self):
        return self.diffuse((0, 0, 0))

    def mix(self, first, second, share):
        return self.node("ShaderNodeMixShader", {0: share, 1: first, 2: second}).outputs[0]

    def sum(self, first, second):
        return self.node("ShaderNodeAddShader", {0: first, 1: second}).outputs[0]

    def sides(self, front, back):
        return self.mix(front, back, self.geometry("Backfacing"))

    def seen(self, surface):
        """Black where the shading normal is turned away from the viewer, for whom Cycles shades it all the same."""
        return self.mix(None, surface, self.positive(self.dot(self.geometry("Normal"), self.geometry("Incoming"))))

    def glow(self, radiance, hidden=False):
        """Cycles' emission of strength 1 is a radiance. Where it is hidden, the camera sees a dark surface."""
        seen = self.node("ShaderNodeLightPath").outputs["Is Camera Ray"] if hidden else 0.0
        strength = self.math("SUBTRACT", 1.0, seen) if hidden else 1.0
        return self.node("ShaderNodeEmission", {"Color": radiance, "Strength": strength}).outputs[0]

    def scaled(self, colour, factor):
        result = self.vector("SCALE", colour)
        self.put(result.node.inputs[3], factor)
        return result

    # Media

    def medium(self, scattering, absorption, g):
        """Coefficients a unit of length. Cycles multiplies a colour by a density, and absorbs 1 - colour."""
        most = max(scattering)
        parts = []
        if most > 0:
            parts.append(self.node("ShaderNodeVolumeScatter", {
                "Color": [s / most for s in scattering], "Density": most, "Anisotropy": g}).outputs[0])
        most = max(absorption)
        if most > 0:
            parts.append(self.node("ShaderNodeVolumeAbsorption", {
                "Color": [1 - a / most for a in absorption], "Density": most}).outputs[0])
        return None if not parts else parts[0] if len(parts) == 1 else self.sum(*parts)


def material(name, surface=None, medium=None, sampled=True):
    """surface and medium: functions of a Graph. sampled: whether a lamp is aimed at, and not only found by chance."""
    result = bpy.data.materials.new(name)
    result.use_nodes = True
    result.cycles.homogeneous_volume, result.cycles.sample_as_light = True, sampled
    graph = Graph(result.node_tree)
    graph.tree.nodes.clear()
    out = graph.node("ShaderNodeOutputMaterial")
    if surface:
        graph.put(out.inputs["Surface"], surface(graph))
    if medium:
        graph.put(out.inputs["Volume"], medium(graph))
    return result


# Lamps

def lamp(name, kind, columns, strength, shader=None):
    data = bpy.data.lights.new(name, kind)
    data.energy = 1
    data.color = (1, 1, 1)
    data.use_nodes = True
    graph = Graph(data.node_tree)
    graph.tree.nodes.clear()
    out = graph.node("ShaderNodeOutputLight")
    emission = graph.node("ShaderNodeEmission", {"Color": shader(graph) if shader else strength, "Strength": 1.0})
    graph.put(out.inputs["Surface"], emission.outputs[0])
    if kind == "POINT":
        data.shadow_soft_size = 0
        data.energy = POINT_POWER
    else:
        data.angle = 0
    return add(name, data, columns)


# Watts of a lamp of radius 0 whose emission of strength 1 is an intensity of 1 W / sr.
POINT_POWER = 4 * math.pi


def point_light(name, place, intensity):
    lamp(name, "POINT", ((1, 0, 0), (0, 1, 0), (0, 0, 1), place), intensity)


def sun(name, columns, irradiance):
    """Shines along -z of its columns; Cycles' strength 1 is an irradiance of 1 on what faces it."""
    lamp(name, "SUN", columns, irradiance)


def spot_light(name, columns, intensity, cutoff, beam, texture=None):
    """Along +z of its columns, in full within `beam`, falling with the angle to nothing at `cutoff` (radians). Cycles'
    own spot falls by another rule, so this is a point lamp whose emission depends on the direction. `texture`, a
    function of a Graph, fills the square about the cone."""
    def shader(graph):
        away = graph.node("ShaderNodeTexCoord").outputs["Normal"]
        cosine = graph.dot(away, (0, 0, 1))
        theta = graph.math("ARCCOSINE", graph.math("MINIMUM", 1.0, graph.math("MAXIMUM", -1.0, cosine)))
        fall = graph.math("DIVIDE", graph.math("SUBTRACT", cutoff, theta), max(cutoff - beam, 1e-7))
        share = graph.math("MINIMUM", 1.0, graph.math("MAXIMUM", 0.0, fall))
        if not texture:
            return graph.scaled(intensity, share)
        x, y, z = graph.parts(away)
        wide = graph.math("MULTIPLY", graph.math("MAXIMUM", 1e-6, z), 2 * math.tan(cutoff))
        graph.place = [graph.math("ADD", 0.5, graph.math("DIVIDE", part, wide)) for part in (x, y)]
        return graph.vector("MULTIPLY", graph.scaled(intensity, share), texture(graph))
    lamp(name, "POINT", columns, None, shader)


def ies_light(name, columns, intensity, file, width, height):
    """Candela by direction: the image's columns go once around z from x towards y, its rows from -z up to +z."""
    def shader(graph):
        x, y, z = graph.parts(graph.vector("NORMALIZE", graph.node("ShaderNodeTexCoord").outputs["Normal"]))
        u = graph.math("MULTIPLY_ADD", graph.math("ARCTAN2", y, x), 0.5 / math.pi, 0.5 / width)
        level = graph.math("ARCTAN2", z, graph.math("SQRT", graph.math("ADD", graph.math("MULTIPLY", x, x),
                                                                     graph.math("MULTIPLY", y, y))))
        v = graph.math("MULTIPLY_ADD", level, -(height - 1) / height / math.pi, 0.5)
        return graph.vector("MULTIPLY", graph.look_up(file, graph.combine(u, v), "REPEAT", "Linear"), intensity)
    lamp(name, "POINT", columns, None, shader)


# The world

def sky(radiance=None, file=None, rows=None, factor=1, height=0, resolution=0, hidden=False):
    """The same from all around, or an image of `height` rows, the first at the zenith and the last at the nadir, where
    Blender's environment texture has their edges. rows: in world space the left of the image's middle, the image's up,
    its middle."""
    graph = Graph(SCENE.world.node_tree)
    out = graph.node("ShaderNodeOutputWorld")
    colour = radiance
    if file:
        away = graph.vector("NORMALIZE", graph.node("ShaderNodeTexCoord").outputs["Generated"])
        left, up, middle = (graph.dot(away, row) for row in rows)
        u = graph.math("MULTIPLY_ADD", graph.math("ARCTAN2", left, middle), -0.5 / math.pi, 0.5)
        level = graph.math("ARCTAN2", up, graph.math("SQRT", graph.math("ADD", graph.math("MULTIPLY", left, left),
                                                                       graph.math("MULTIPLY", middle, middle))))
        v = graph.math("MULTIPLY_ADD", level, (height - 1) / height / math.pi, 0.5)
        colour = graph.scaled(graph.look_up(file, graph.combine(u, v), "REPEAT", "Linear"), factor)
        SCENE.world.cycles.sampling_method, SCENE.world.cycles.sample_map_resolution = "MANUAL", resolution
    background = graph.node("ShaderNodeBackground", {"Color": colour, "Strength": 1.0})
    graph.put(out.inputs["Surface"], background.outputs[0])
    SCENE.world.cycles_visibility.camera = not hidden


def fog(medium):
    """A medium wherever no other is."""
    graph = Graph(SCENE.world.node_tree)
    out = next((n for n in graph.tree.nodes if n.type == "OUTPUT_WORLD"), None) or graph.node("ShaderNodeOutputWorld")
    graph.put(out.inputs["Volume"], medium(graph))
    SCENE.world.cycles.homogeneous_volume = True


def render(batches):
    """(samples, seed) of each picture; picture i goes to batch_i.exr. Samples start behind the first of their sequence,
    which Cycles takes at the middle of its pixel whatever the seed."""
    for i, (samples, seed) in enumerate(batches):
        SCENE.cycles.samples, SCENE.cycles.sample_offset, SCENE.cycles.seed = samples, samples, seed
        SCENE.render.filepath = os.path.join(HERE, "batch_%d.exr" % i)
        bpy.ops.render.render(write_still=True)
        print("photonproof: %d" % (i + 1), file=sys.stderr, flush=True)
