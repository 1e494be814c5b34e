# Materials, lights, the world, and their images.

def material(name, surface=None, medium=None, sampled=True):
    """surface and medium: functions of a Graph. sampled: whether a lamp is aimed at, and not only found by chance."""
    result = bpy.data.materials.new(name)
    result.use_nodes = True
    result.cycles.homogeneous_volume, result.cycles.sample_as_light = True, sampled
    graph = Facets(result.node_tree)
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


# Watts of a light of radius 0 whose emission of strength 1 is an intensity of 1 W / sr.
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
