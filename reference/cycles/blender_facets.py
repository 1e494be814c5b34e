# Reflection and refraction models that Cycles has no closure for. The code samples a direction and turns a mirror or a
# refracting surface so that light leaves that way; its colour is the direction's weight. The random numbers are a hash
# of the hit point, which no two paths share. Only rays that hit lights by chance find them.

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


class Facets(Graph):
    """A graph that draws."""

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
