#!/usr/bin/env python3
"""What the chart scenes of the library must show, by a ray caster of its own: cameras, filters, uv and bitmaps as the
documentation of Mitsuba 3 has them (plugins perspective, thinlens, orthographic, gaussian, tent, bitmap, and the meaning of
lookat and of nested transforms), the equidistant projection for the fisheye. Nothing of photonproof is read, the scenes' numbers are
written again. Prints for each chart the image's mean and its first moments along x and y, a channel each, and some
pixels: the constants of renderer/integrators/chart_scenes_test.cpp. Standard library only; two minutes.

  harness/oracles/charts.py
"""
import math

WIDTH, HEIGHT = 24, 16
SAMPLES, SAMPLES_OF_SHOWN = 4000, 40000
SHOWN = ((5, 3), (11, 7), (12, 8), (17, 4), (8, 12), (18, 11))


# --- vectors and transforms: 4 x 4, row major; `then(a, b)` applies a first, as a file's later lines do
def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def unit(a):
    n = math.sqrt(dot(a, a))
    return tuple(x / n for x in a)


def product(a, b):
    return [[sum(a[i][k] * b[k][j] for k in range(4)) for j in range(4)] for i in range(4)]


def then(*steps):
    m = [[float(i == j) for j in range(4)] for i in range(4)]
    for s in steps:
        m = product(s, m)
    return m


def scale(x, y, z):
    return [[x, 0, 0, 0], [0, y, 0, 0], [0, 0, z, 0], [0, 0, 0, 1]]


def translate(x, y, z):
    return [[1, 0, 0, x], [0, 1, 0, y], [0, 0, 1, z], [0, 0, 0, 1]]


def rotate(axis, degrees):
    c, s = math.cos(math.radians(degrees)), math.sin(math.radians(degrees))
    return {
        "x": [[1, 0, 0, 0], [0, c, -s, 0], [0, s, c, 0], [0, 0, 0, 1]],
        "y": [[c, 0, s, 0], [0, 1, 0, 0], [-s, 0, c, 0], [0, 0, 0, 1]],
        "z": [[c, -s, 0, 0], [s, c, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]],
    }[axis]


def lookat(origin, target, up):
    d = unit(tuple(t - o for t, o in zip(target, origin)))
    left = unit(cross(up, d))
    new_up = cross(d, left)
    return [[left[i], new_up[i], d[i], origin[i]] for i in range(3)] + [[0, 0, 0, 1]]


def inverse(m):
    """Gauss-Jordan."""
    a = [list(map(float, row)) + [float(i == j) for j in range(4)] for i, row in enumerate(m)]
    for c in range(4):
        p = max(range(c, 4), key=lambda r: abs(a[r][c]))
        a[c], a[p] = a[p], a[c]
        a[c] = [v / a[c][c] for v in a[c]]
        for r in range(4):
            if r != c:
                a[r] = [v - a[r][c] * w for v, w in zip(a[r], a[c])]
    return [row[4:] for row in a]


def point(m, p):
    return tuple(m[i][0] * p[0] + m[i][1] * p[1] + m[i][2] * p[2] + m[i][3] for i in range(3))


def vector(m, v):
    return tuple(m[i][0] * v[0] + m[i][1] * v[1] + m[i][2] * v[2] for i in range(3))


# --- textures
def decoded(byte):
    v = byte / 255
    return v / 12.92 if v <= 0.04045 else ((v + 0.055) / 1.055) ** 2.4


def chart_texel(x, y):
    values = ((7 * x + 13 * y + 5 * x * y) % 11 / 10, (x + 1) / 24, (y + 1) / 16)
    return tuple(decoded(math.floor(255 * v + 0.5)) for v in values)


CHART = [[chart_texel(x, y) for x in range(24)] for y in range(16)]


def nearest(u, v):
    return CHART[math.floor(v * 16) % 16][math.floor(u * 24) % 24]


def bilinear(u, v):
    x, y = u * 24 - 0.5, v * 16 - 0.5
    i, j = math.floor(x), math.floor(y)
    fx, fy = x - i, y - j
    t = lambda a, b: CHART[b % 16][a % 24]
    return tuple(
        (t(i, j)[c] * (1 - fx) + t(i + 1, j)[c] * fx) * (1 - fy) + (t(i, j + 1)[c] * (1 - fx) + t(i + 1, j + 1)[c] * fx) * fy
        for c in range(3)
    )


def turned(u, v):
    """The chart under the second card's to_uv: scaled by (2, 1.5), turned by 20 degrees, moved by (0.3, 0.1)."""
    m = then(scale(2, 1.5, 1), rotate("z", 20), translate(0.3, 0.1, 0))
    p = point(m, (u, v, 0))
    return bilinear(p[0], p[1])


def squares(u, v):
    """Mitsuba's checkerboard, 3 x 2 periods: color0 where both halves are alike."""
    x, y = (3 * u) % 1 > 0.5, (2 * v) % 1 > 0.5
    return (1.2, 0.9, 0.3) if x == y else (0.05, 0.1, 0.3)


# --- shapes: each gives (distance, radiance); the back of a light is black
class Card:
    def __init__(self, to_world, texture, disk=False):
        self.back, self.texture, self.disk = inverse(to_world), texture, disk

    def hit(self, o, d):
        lo, ld = point(self.back, o), vector(self.back, d)
        if ld[2] == 0:
            return None
        t = -lo[2] / ld[2]
        x, y = lo[0] + t * ld[0], lo[1] + t * ld[1]
        if self.disk:
            r = math.hypot(x, y)
            if r > 1:
                return None
            uv = (r, math.atan2(y, x) / (2 * math.pi) % 1)
        else:
            if abs(x) > 1 or abs(y) > 1:
                return None
            uv = ((x + 1) / 2, (y + 1) / 2)
        return t, (self.texture(*uv) if ld[2] < 0 else (0, 0, 0))


class Ball:
    def __init__(self, radius, to_world):
        self.radius, self.back = radius, inverse(to_world)

    def hit(self, o, d):
        lo, ld = point(self.back, o), vector(self.back, d)
        a, b, c = dot(ld, ld), dot(lo, ld), dot(lo, lo) - self.radius**2
        if b * b < a * c:
            return None
        t = (-b - math.sqrt(b * b - a * c)) / a
        x, y, z = (lo[i] + t * ld[i] for i in range(3))
        return t, bilinear(math.atan2(y, x) / (2 * math.pi) % 1, math.acos(max(-1, min(1, z / self.radius))) / math.pi)


class Tube:
    """Open, between p0 and p1. Mitsuba takes its angle from any perpendicular: here its frame of the axis."""

    def __init__(self, p0, p1, radius):
        axis = tuple(b - a for a, b in zip(p0, p1))
        self.length, self.radius, self.p0, self.n = math.sqrt(dot(axis, axis)), radius, p0, unit(axis)
        n = self.n  # Duff et al. 2017
        sign = math.copysign(1, n[2])
        a = -1 / (sign + n[2])
        b = n[0] * n[1] * a
        self.s = (1 + sign * n[0] * n[0] * a, sign * b, -sign * n[0])
        self.t = (b, sign + n[1] * n[1] * a, -n[1])

    def hit(self, o, d):
        q = tuple(a - b for a, b in zip(o, self.p0))
        ox, oy, oz = dot(q, self.s), dot(q, self.t), dot(q, self.n)
        dx, dy, dz = dot(d, self.s), dot(d, self.t), dot(d, self.n)
        a, b, c = dx * dx + dy * dy, ox * dx + oy * dy, ox * ox + oy * oy - self.radius**2
        if b * b < a * c:
            return None
        for side in (-1, 1):
            t = (-b + side * math.sqrt(b * b - a * c)) / a
            z = oz + t * dz
            if t > 0 and 0 <= z <= self.length:
                if side > 0:
                    return t, (0, 0, 0)
                turn = math.atan2(oy + t * dy, ox + t * dx) / (2 * math.pi) % 1
                return t, bilinear(turn, z / self.length)
        return None


CUBE = [  # the corners of each face in the order of Mitsuba's cube, whose uvs are (0,1) (1,1) (1,0) (0,0)
    ((1, -1, -1), (1, -1, 1), (-1, -1, 1), (-1, -1, -1)),
    ((1, 1, -1), (-1, 1, -1), (-1, 1, 1), (1, 1, 1)),
    ((1, -1, -1), (1, 1, -1), (1, 1, 1), (1, -1, 1)),
    ((1, -1, 1), (1, 1, 1), (-1, 1, 1), (-1, -1, 1)),
    ((-1, -1, 1), (-1, 1, 1), (-1, 1, -1), (-1, -1, -1)),
    ((1, 1, -1), (1, -1, -1), (-1, -1, -1), (-1, 1, -1)),
]


class Room:
    """The inside of a cube scaled by `half`."""

    def __init__(self, half):
        self.half = half

    def hit(self, o, d):
        o = tuple(a / h for a, h in zip(o, self.half))
        d = tuple(a / h for a, h in zip(d, self.half))
        t, axis, side = min(((math.copysign(1, d[k]) - o[k]) / d[k], k, math.copysign(1, d[k])) for k in range(3) if d[k])
        p = tuple(o[k] + t * d[k] for k in range(3))
        face = next(f for f in CUBE if all(c[axis] == side for c in f))
        a, b, c, corner = face  # uv (0,1), (1,1), (1,0), (0,0)
        u = dot([p[k] - corner[k] for k in range(3)], [c[k] - corner[k] for k in range(3)]) / 4
        v = dot([p[k] - corner[k] for k in range(3)], [a[k] - corner[k] for k in range(3)]) / 4
        return t, bilinear(u, v)


SKY = (0.1, 0.12, 0.15)


def seen(shapes, o, d, near, far, sky=SKY):
    best, radiance = far, sky
    for shape in shapes:
        found = shape.hit(o, d)
        if found and near < found[0] < best:
            best, radiance = found
    return radiance


# --- cameras: a raster point in [0,1]^2 (x right, y down) and a lens point to a ray; local x points left in the image
def perspective(to_world, half_width, offset=(0, 0)):
    half_height = half_width * HEIGHT / WIDTH

    def ray(x, y, lens):
        d = ((1 - 2 * (x + offset[0])) * half_width, (1 - 2 * (y + offset[1])) * half_height, 1)
        return point(to_world, (0, 0, 0)), vector(to_world, d)  # distances along it are depths

    return ray


def thin_lens(to_world, half_width, radius, focus):
    half_height = half_width * HEIGHT / WIDTH

    def ray(x, y, lens):
        d = ((1 - 2 * x) * half_width * focus, (1 - 2 * y) * half_height * focus, focus)
        r, phi = radius * math.sqrt(lens[0]), 2 * math.pi * lens[1]
        o = (r * math.cos(phi), r * math.sin(phi), 0)
        return point(to_world, o), vector(to_world, tuple((a - b) / focus for a, b in zip(d, o)))

    return ray


def orthographic(to_world):
    def ray(x, y, lens):
        return point(to_world, (1 - 2 * x, (1 - 2 * y) * HEIGHT / WIDTH, 0)), vector(to_world, (0, 0, 1))

    return ray


def fisheye(to_world, fov):
    def ray(x, y, lens):
        short = min(WIDTH, HEIGHT)
        px, py = (1 - 2 * x) * WIDTH / short, (1 - 2 * y) * HEIGHT / short
        r = math.hypot(px, py)
        angle = r * math.radians(fov) / 2
        if r > 1:
            return None
        s = math.sin(angle) / r if r else 0
        return point(to_world, (0, 0, 0)), vector(to_world, (px * s, py * s, math.cos(angle)))

    return ray


# --- filters, sampled by inversion of a table of the cumulative distribution
def drawn(weight, radius, cells=4096):
    x = [(i + 0.5) / cells * 2 * radius - radius for i in range(cells)]
    total, cumulative = 0.0, []
    for v in x:
        total += weight(v)
        cumulative.append(total)

    def draw(u):
        low, high = 0, cells - 1
        while low < high:
            middle = (low + high) // 2
            low, high = (low, middle) if cumulative[middle] >= u * total else (middle + 1, high)
        return x[low]

    def below(v):
        return sum(1 for t in table if t < v) / len(table)

    table = [draw((i + 0.5) / 8192) for i in range(8192)]
    shares = {}  # of the filter below each end

    def within(u, low, high):
        """Drawn between two ends."""
        for v in (low, high):
            if v not in shares:
                shares[v] = below(v)
        u = shares[low] + u * (shares[high] - shares[low])
        return table[min(8191, int(u * 8192))]

    return within


def gaussian(stddev):
    end = math.exp(-8)  # cut at four deviations, where it is lowered to 0
    return drawn(lambda v: max(0.0, math.exp(-v * v / (2 * stddev * stddev)) - end), 4 * stddev)


def tent(radius):
    return drawn(lambda v: max(0.0, 1 - abs(v) / radius), radius)


def box():
    return lambda u, low, high: u - 0.5


# --- points: Halton's, shifted by new offsets in every pixel
def halton(i, base):
    f, r = 1.0, 0.0
    while i:
        f /= base
        r += f * (i % base)
        i //= base
    return r


POINTS = [tuple(halton(i + 1, b) for b in (2, 3, 5, 7)) for i in range(SAMPLES_OF_SHOWN)]


def image(ray, shapes, filtered, near=0.0, far=1e9, sky=SKY, border=False):
    """border: a filter that reaches beyond the image's border sees what is there; else only what is within it."""
    pixels = []

    def place(u, at, size):
        return at + 0.5 + (filtered(u, -1e9, 1e9) if border else filtered(u, -at - 0.5, size - at - 0.5))

    for y in range(HEIGHT):
        for x in range(WIDTH):
            shift = [math.modf((x * 0.7548776662 + y * 0.5698402910 + 1) * k)[0] for k in (1.0, 7.3, 3.1, 5.7)]
            total = [0.0, 0.0, 0.0]
            count = SAMPLES_OF_SHOWN if (x, y) in SHOWN else SAMPLES
            for p in POINTS[:count]:
                q = [(a + b) % 1 for a, b in zip(p, shift)]
                r = ray(place(q[0], x, WIDTH) / WIDTH, place(q[1], y, HEIGHT) / HEIGHT, q[2:])
                if r:
                    c = seen(shapes, *r, near, far, sky)
                    total = [a + b for a, b in zip(total, c)]
            pixels.append([a / count for a in total])
    return pixels


def numbers(name, pixels):
    n = WIDTH * HEIGHT
    row = lambda values: "{" + ", ".join(f"{v:.5f}" for v in values) + "}"
    at = lambda i: ((i % WIDTH + 0.5) / WIDTH, (i // WIDTH + 0.5) / HEIGHT)
    print(name)
    print("  mean", row(sum(p[c] for p in pixels) / n for c in range(3)))
    print("  along x", row(sum(p[c] * at(i)[0] for i, p in enumerate(pixels)) / n for c in range(3)))
    print("  along y", row(sum(p[c] * at(i)[1] for i, p in enumerate(pixels)) / n for c in range(3)))
    for x, y in SHOWN:
        print(f"  pixel {x}, {y}", row(pixels[y * WIDTH + x]))


def main():
    cards = [
        Card(scale(1.5, 1, 1), nearest),
        Card(then(scale(0.45, 0.45, 0.45), rotate("y", 35), translate(1.1, -0.6, 0.8)), turned),
        Card(then(scale(0.5, 0.3, 1), rotate("x", 60), translate(-0.3, -0.35, 2.5)), squares),
        Card(then(scale(1.5, 2, 1), rotate("x", -70), translate(-0.6, 1.4, -1.8)), squares),
    ]
    view = lookat((0.4, 0.3, 4), (0, 0, 0), (0.1, 1, 0))
    half_width = math.tan(math.radians(38 / 2)) * WIDTH / HEIGHT  # 38 degrees from top to bottom
    numbers("chart", image(perspective(view, half_width, (0.06, -0.04)), cards, gaussian(0.7), 1.5, 6.5,
                           border=True))

    cards = [
        Card(then(scale(0.6, 0.9, 1), rotate("z", 10)), nearest),
        Card(then(scale(0.35, 0.4, 1), translate(0.75, -0.1, 1.6)), squares),
        Card(then(scale(1.2, 1.3, 1), translate(-1.9, 0.1, -2)), bilinear),
    ]
    view = lookat((0, 0.2, 4), (0, 0, 0), (0, 1, 0))
    half_width = math.tan(math.radians(46 / 2)) * WIDTH / math.hypot(WIDTH, HEIGHT)  # 46 degrees from corner to corner
    numbers("chart-lens", image(thin_lens(view, half_width, 0.15, 4), cards, tent(1.3)))

    view = lookat((0.2, -0.1, 0.3), (0.5, 0.2, -1), (0, 1, 0))
    numbers("chart-fisheye", image(fisheye(view, 160), [Room((1.2, 0.9, 1))], box(), sky=(0, 0, 0)))

    shapes = [
        Ball(0.5, then(rotate("x", -70), translate(-0.75, 0.35, 0))),
        Card(then(scale(0.45, 0.45, 1), rotate("y", 20), translate(0.6, 0.45, 0)), bilinear, disk=True),
        Tube((-1.1, -0.7, 0), (-0.1, -0.4, 0.3), 0.3),
        Card(then(scale(0.5, 0.35, 1), rotate("x", 30), translate(0.7, -0.5, 0)), nearest),
    ]
    view = then(scale(1.6, 1.9, 1), lookat((0.5, 1, 4), (0, 0, 0), (0, 1, 0)))
    numbers("chart-orthographic", image(orthographic(view), shapes, gaussian(0.5), border=True))


main()
