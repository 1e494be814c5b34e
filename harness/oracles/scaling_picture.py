"""Draws the plots of scaling.py as SVG: a row of time and a row of memory, a column each sweep, log-log."""
import math

PANEL, GAP, LEFT, TOP = 190, 62, 62, 34
STYLES = {"path": ("#1f6fb4", ""), "photonmapper": ("#c2410c", "6 3")}
SWEEPS = ("triangles", "photons", "lights", "pixels")


def decades(values):
    return math.floor(math.log10(min(values))), max(math.ceil(math.log10(max(values))), math.floor(math.log10(min(values))) + 1)


def power(exponent):
    if exponent in (0, 1):
        return ("1", "10")[exponent]
    return f'10<tspan dy="-4" font-size="8">{exponent}</tspan>'


def axes(x, y, across, up):
    """A panel's frame with a line and a label each decade; `across` and `up` are pairs of exponents."""
    parts = [f'<rect x="{x}" y="{y}" width="{PANEL}" height="{PANEL}" fill="none" stroke="#888"/>']
    for e in range(across[0], across[1] + 1):
        at = x + PANEL * (e - across[0]) / (across[1] - across[0])
        parts.append(f'<line x1="{at:.1f}" y1="{y}" x2="{at:.1f}" y2="{y + PANEL}" stroke="#ddd"/>')
        parts.append(f'<text x="{at:.1f}" y="{y + PANEL + 16}" text-anchor="middle">{power(e)}</text>')
    for e in range(up[0], up[1] + 1):
        at = y + PANEL * (up[1] - e) / (up[1] - up[0])
        parts.append(f'<line x1="{x}" y1="{at:.1f}" x2="{x + PANEL}" y2="{at:.1f}" stroke="#ddd"/>')
        parts.append(f'<text x="{x - 6}" y="{at + 4:.1f}" text-anchor="end">{power(e)}</text>')
    return parts


def curve(x, y, across, up, engine, sizes, values):
    colour, dashes = STYLES[engine]
    spots = [(x + PANEL * (math.log10(s) - across[0]) / (across[1] - across[0]),
              y + PANEL * (up[1] - math.log10(v)) / (up[1] - up[0])) for s, v in zip(sizes, values)]
    line = " ".join(f"{a:.1f},{b:.1f}" for a, b in spots)
    parts = [f'<polyline points="{line}" fill="none" stroke="{colour}" stroke-width="2" stroke-dasharray="{dashes}"/>']
    return parts + [f'<circle cx="{a:.1f}" cy="{b:.1f}" r="3" fill="{colour}"/>' for a, b in spots]


def drawn(series, points):
    """SVG text; `series` and `points` are those of scaling.py."""
    width, height = LEFT + len(SWEEPS) * (PANEL + GAP), TOP + 2 * (PANEL + GAP) + 10
    parts = [f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width} {height}" font-family="sans-serif" '
             f'font-size="12" fill="#222"><rect width="{width}" height="{height}" fill="#fff"/>']
    for row, (title, value) in enumerate((("processor seconds", lambda p: p.seconds),
                                          ("peak memory, MB", lambda p: p.bytes / 1e6))):
        up = decades([value(p) for p in points.values()])
        y = TOP + row * (PANEL + GAP)
        for column, sweep in enumerate(SWEEPS):
            x = LEFT + column * (PANEL + GAP)
            rows = [r for r in series if r.sweep == sweep]
            across = decades([s for r in rows for s in r.sizes])
            parts += axes(x, y, across, up)
            parts.append(f'<text x="{x}" y="{y - 8}">{title}</text>')
            parts.append(f'<text x="{x + PANEL / 2}" y="{y + PANEL + 32}" text-anchor="middle">{sweep}</text>')
            for r in rows:
                parts += curve(x, y, across, up, r.engine, r.sizes, [value(points[sweep, r.engine, s]) for s in r.sizes])
    for i, (engine, (colour, dashes)) in enumerate(STYLES.items()):
        at = LEFT + i * 150
        parts.append(f'<line x1="{at}" y1="10" x2="{at + 30}" y2="10" stroke="{colour}" stroke-width="2" '
                     f'stroke-dasharray="{dashes}"/><text x="{at + 36}" y="14">{engine}</text>')
    return "\n".join(parts) + "\n</svg>\n"
