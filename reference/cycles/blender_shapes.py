# Shapes: each mesh is made once, however many objects share it.

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
            # A pole has one corner per segment; its u is the segment's middle.
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


def rectangle_mesh(name, cells=1):
    """Of cells x cells squares."""
    if cells > 1:
        return grid(name, lambda u, v: ((2 * u - 1, 2 * v - 1, 0), (0, 0, 1)), cells, cells)
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
            FORMS[kind](name, *arguments)
    return bpy.data.meshes[name]


def shape(name, mesh, columns, shader, hidden=False):
    """A surface: a mesh, which others may share, in its place and with its own shader. hidden: camera rays pass it."""
    if not mesh.materials:
        mesh.materials.append(None)
    thing = add(name, mesh, columns)
    thing.material_slots[0].link = "OBJECT"
    thing.material_slots[0].material = shader
    thing.visible_camera = not hidden
    # No softening of shadows where shading normals lean.
    thing.cycles.shadow_terminator_offset = thing.cycles.shadow_terminator_geometry_offset = 0
    return thing
