"""Interfaces, smooth and rough, for bsdfs.py: Fresnel's reflectance by complex arithmetic, its mean over diffuse light,
distributions of facets by their slopes with Smith's shadowing. The papers are named there."""
import cmath
import math


def fresnel(cos_i, n):
    """Share of unpolarised light reflected; n = index beyond / index on this side, complex for a metal."""
    root = cmath.sqrt(n * n - (1 - cos_i * cos_i))  # n cos of the refracted angle
    r_s = (cos_i - root) / (cos_i + root)
    r_p = (n * n * cos_i - root) / (n * n * cos_i + root)
    return (abs(r_s) ** 2 + abs(r_p) ** 2) / 2


def simpson(f, a, b, steps):
    h = (b - a) / steps
    return h / 3 * sum((1 if k in (0, steps) else 4 if k % 2 else 2) * f(a + k * h) for k in range(steps + 1))


def diffuse_reflectance(n, depth=0.0):
    """2 x integral of F cos exp(-2 depth / cos) over cos, in the angle, where no piece has an infinite slope but at
    total reflection: cut there."""
    def f(angle):
        c = max(math.cos(angle), 1e-12)
        return 2 * fresnel(c, n) * math.exp(-2 * depth / c) * c * math.sin(angle)
    if n >= 1:
        return simpson(f, 0, math.pi / 2, 4000)
    critical = math.asin(n)
    # The slope at the critical angle is infinite from below: angle = critical (1 - t^2).
    below = simpson(lambda t: f(critical * (1 - t * t)) * 2 * critical * t, 0, 1, 4000)
    return below + simpson(f, critical + 1e-9, math.pi / 2, 4000)


assert abs(diffuse_reflectance(1.5) - 0.0918) < 5e-5 and abs(diffuse_reflectance(1 / 1.5) - 0.5963) < 5e-5  # Orchard


def direction(angles):
    theta, phi = (math.radians(a) for a in angles)
    return (math.sin(theta) * math.cos(phi), math.sin(theta) * math.sin(phi), math.cos(theta))


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def unit(v):
    length = math.sqrt(dot(v, v))
    return tuple(x / length for x in v)


def refracted(v, n):
    """v, above, as it goes on beyond an interface, still pointing up; None at total reflection."""
    s2 = (v[0] ** 2 + v[1] ** 2) / n ** 2
    return (v[0] / n, v[1] / n, math.sqrt(1 - s2)) if s2 < 1 else None


# --- facets ----------------------------------------------------------------------------------------------------------

class Facets:
    def __init__(self, distribution, alpha_u, alpha_v, visible=True):
        self.ggx, self.au, self.av, self.visible = distribution == "ggx", alpha_u, alpha_v, visible

    def density(self, m):
        """Slopes (x, y) are distributed like P22; D = P22 / cos^4 (Heitz 2014, equations 43, 44, 52)."""
        x, y = -m[0] / m[2], -m[1] / m[2]
        r2 = (x / self.au) ** 2 + (y / self.av) ** 2
        p22 = (1 / (1 + r2) ** 2 if self.ggx else math.exp(-r2)) / (math.pi * self.au * self.av)
        return p22 / m[2] ** 4

    def inverse_slope(self, v):
        """a = 1 / (alpha towards v x tan of its angle) (Heitz 2014, equations 53, 80)."""
        length = math.hypot(v[0], v[1])
        if length == 0:
            return math.inf
        alpha = math.sqrt((v[0] * self.au) ** 2 + (v[1] * self.av) ** 2) / length
        return abs(v[2]) / length / alpha

    def g1(self, v):
        """Smith's, Beckmann's by the rational approximation of Walter et al. (after their equation 26), which
        Mitsuba's images have. Mitsuba's G is the product of both directions', not the height-correlated one."""
        a = self.inverse_slope(v)
        if self.ggx:
            return 2 / (1 + math.sqrt(1 + 1 / (a * a)))
        return 1.0 if a >= 1.6 else (3.535 * a + 2.181 * a * a) / (1 + 2.276 * a + 2.577 * a * a)

    def g1_exact(self, v):
        a = self.inverse_slope(v)
        if self.ggx or a == math.inf:
            return self.g1(v)
        return 2 / (1 + math.erf(a) + math.exp(-a * a) / (a * math.sqrt(math.pi)))  # Walter et al., section 5.2

    def normals(self, rows, columns):
        """Normals that all stand for the same area: (m, weight)."""
        for j in range(rows):
            t = (j + 0.5) / rows
            u = 1 - (1 - t) ** 2
            radius = math.sqrt(u / (1 - u) if self.ggx else -math.log(1 - u))
            for k in range(columns):
                phi = 2 * math.pi * (k + 0.5) / columns
                yield (unit((self.au * radius * math.cos(phi), self.av * radius * math.sin(phi), 1.0)),
                       2 * (1 - t) / (rows * columns))

    def pdf(self, o, m):
        """Of normals drawn as o, above, sees them (Heitz 2014, equation 2), or by their area."""
        return self.density(m) * (self.g1_exact(o) * dot(o, m) / o[2] if self.visible else m[2])

    def mean_seen(self, o, value, rows=100, columns=96):
        """Mean of value(m) over the facets that o sees."""
        total = seen = 0
        for m, weight in self.normals(rows, columns):
            weight *= max(dot(o, m), 0) / m[2]
            seen += weight
            if weight > 0:
                total += weight * value(m)
        return total / seen


def check_facets():
    for kind in ("ggx", "beckmann"):
        f = Facets(kind, 0.3, 0.6)
        for theta in (0, 30, 60, 80):
            o = direction((theta, 25))
            seen = sum(w * max(dot(o, m), 0) / m[2] for m, w in f.normals(1000, 180))
            assert abs(seen * f.g1_exact(o) / o[2] - 1) < 3e-3, (kind, theta)  # the definition of G1
            assert abs(f.g1(o) / f.g1_exact(o) - 1) < 3.5e-3, (kind, theta)


def reflection_shape(f, o, i):
    """D G / (4 cos cos) (Walter et al., equation 20) and the facet."""
    m = unit(tuple(a + b for a, b in zip(o, i)))
    if m[2] < 0:
        m = tuple(-x for x in m)
    return f.density(m) * f.g1(o) * f.g1(i) / (4 * abs(o[2] * i[2])), m
