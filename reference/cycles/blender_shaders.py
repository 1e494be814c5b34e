# Shaders that Blender has nodes for.

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

    def glow(self, radiance):
        """Cycles' emission of strength 1 is a radiance."""
        return self.node("ShaderNodeEmission", {"Color": radiance, "Strength": 1.0}).outputs[0]

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
