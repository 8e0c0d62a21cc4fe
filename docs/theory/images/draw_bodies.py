#!/usr/bin/env python3
"""Draws the pictures of materials, shells, rods and collision detection in this folder; standard library only.

python3 docs/theory/images/draw_bodies.py
"""
import math
from pathlib import Path

HERE = Path(__file__).parent
COLOURS = ["#1f5fa8", "#c2571a", "#2b8a3e", "#7b3fa0"]
STYLE = ('<style>text{font:14px sans-serif;fill:#222}.s{font-size:12px}.i{font-style:italic}'
         '.a{stroke:#222;stroke-width:1.2;fill:none}.g{stroke:#ccc;stroke-width:1}</style>')


def save(name, width, height, body):
    text = (f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width} {height}" width="{width}" height="{height}">'
            f'{STYLE}<rect width="{width}" height="{height}" fill="white"/>\n' + "\n".join(body) + "\n</svg>\n")
    (HERE / name).write_text(text)


def text(x, y, s, anchor="start", cls=""):
    return f'<text x="{x:.1f}" y="{y:.1f}" text-anchor="{anchor}" class="{cls}">{s}</text>'


def line(points, colour="#222", width=1.5, extra=""):
    at = " ".join(f"{x:.1f},{y:.1f}" for x, y in points)
    return f'<polyline points="{at}" fill="none" stroke="{colour}" stroke-width="{width}" {extra}/>'


def polygon(points, fill, stroke="#222", extra=""):
    at = " ".join(f"{x:.1f},{y:.1f}" for x, y in points)
    return f'<polygon points="{at}" fill="{fill}" stroke="{stroke}" stroke-width="1.2" {extra}/>'


def circle(x, y, r, fill):
    return f'<circle cx="{x:.1f}" cy="{y:.1f}" r="{r}" fill="{fill}"/>'


def arrow(a, b, colour="#222", width=1.8):
    d = math.hypot(b[0] - a[0], b[1] - a[1])
    ux, uy = (b[0] - a[0]) / d, (b[1] - a[1]) / d
    base = (b[0] - 9 * ux, b[1] - 9 * uy)
    head = [b, (base[0] - 4 * uy, base[1] + 4 * ux), (base[0] + 4 * uy, base[1] - 4 * ux)]
    return line([a, base], colour, width) + polygon(head, colour, colour)


def root(f, low, high):
    for _ in range(80):
        middle = (low + high) / 2
        low, high = (middle, high) if f(middle) < 0 else (low, middle)
    return (low + high) / 2


def materials():
    """Nominal stress over Young's modulus of a bar with free sides, nu = 0.3, over its stretch."""
    nu = 0.3
    mu, lam = 1 / (2 * (1 + nu)), nu / ((1 + nu) * (1 - 2 * nu))

    def neo_hookean(a, b, c):  # psi_1 at the stretches a, b, c
        return mu * a + (lam * math.log(a * b * c) - mu) / a

    def corotated(a, b, c):
        j = a * b * c
        r = j / 0.1
        crush = (lam + 2 * mu) * (2 * (1 - r) * math.log(r) - (1 - r) ** 2 / r) if r < 1 else 0
        return 2 * mu * (a - 1) + (lam * (j - 1) + crush) * j / a

    def nominal(psi, s):
        side = root(lambda t: psi(t, t, s), 0.05, 5)
        return psi(s, side, side)

    left, top, width, height = 60, 20, 520, 320
    low, high, least, most = 0.25, 3.0, -2.0, 2.0
    px = lambda s: left + (s - low) / (high - low) * width
    py = lambda f: top + (most - f) / (most - least) * height
    out = []
    for k in range(-2, 3):
        out.append(f'<line class="g" x1="{left}" x2="{left + width}" y1="{py(k):.1f}" y2="{py(k):.1f}"/>' + text(left - 8, py(k) + 5, str(k), "end"))
    for s in (0.5, 1, 1.5, 2, 2.5, 3):
        out.append(f'<line class="g" y1="{top}" y2="{top + height}" x1="{px(s):.1f}" x2="{px(s):.1f}"/>' + text(px(s), top + height + 18, f"{s:g}", "middle"))
    out.append(text(left + width / 2, top + height + 38, "stretch of the bar", "middle"))
    out.append(f'<text transform="translate(18 {top + height / 2}) rotate(-90)" text-anchor="middle">nominal stress / E</text>')
    samples = [low + (high - low) * i / 300 for i in range(301)]
    curves = [("neo_hookean", lambda s: nominal(neo_hookean, s)), ("fixed_corotated", lambda s: nominal(corotated, s)),
              ("stvk_hencky", lambda s: math.log(s) / s),
              ("von_mises, σ_y = 0.2 E", lambda s: max(-0.2, min(0.2, math.log(s))) / s)]
    for k, (name, f) in enumerate(curves):
        points = [(px(s), py(f(s))) for s in samples if least <= f(s) <= most]
        out.append(line(points, COLOURS[k], 2.2))
        y = top + height - 84 + 20 * k
        out.append(line([(left + 300, y), (left + 330, y)], COLOURS[k], 2.2) + text(left + 338, y + 5, name))
    save("materials_uniaxial.svg", 600, 390, out)


def hinges():
    """A dihedral edge, and the fan of hinges about a vertex."""
    out = []
    a, b, left, right = (60, 200), (230, 120), (90, 60), (250, 235)
    out += [polygon([a, b, left], "#d7e5f5"), polygon([a, b, right], "#f5e3d3"), line([a, b], "#222", 3)]
    for p, name, dx, dy in ((a, "vertex", -8, 20), (b, "tip", 6, -8), (left, "left apex", -20, -10), (right, "right apex", -30, 20)):
        out.append(circle(*p, 3.5, "#222") + text(p[0] + dx, p[1] + dy, name, cls="s"))
    out.append(arrow((128, 128), (108, 62), COLOURS[0]) + text(84, 88, "n₁"))
    out.append(arrow((168, 186), (186, 142), COLOURS[1]) + text(192, 158, "n₂"))
    out.append(text(128, 182, "e", cls="i") + text(150, 275, "angle a: between n₁ and n₂", "middle"))
    centre, ring = (450, 145), []
    for k in range(6):
        angle = math.radians(60 * k + 10)
        ring.append((centre[0] + 115 * math.cos(angle), centre[1] - 105 * math.sin(angle)))
    for k in range(6):
        out.append(polygon([centre, ring[k], ring[(k + 1) % 6]], "#eef4ee" if k % 2 else "#e0ece0"))
    for k in range(6):
        out.append(line([centre, ring[k]], COLOURS[2], 3))
        x, y = (2 * centre[0] + 3 * ring[k][0]) / 5, (2 * centre[1] + 3 * ring[k][1]) / 5
        out.append(f'<circle cx="{x:.1f}" cy="{y:.1f}" r="11" fill="white" stroke="{COLOURS[2]}"/>' + text(x, y + 4, f"a{'₁₂₃₄₅₆'[k]}", "middle", "s"))
    out.append(circle(*centre, 4, "#222") + text(450, 275, "fan: energy ½ aᵀ C a", "middle"))
    save("shells_hinges.svg", 600, 290, out)


def rod_frames():
    """A frame of an edge, carried along in time."""
    out = []

    def edge(origin, angle, twist, colour, label):
        t = (math.cos(angle), -math.sin(angle))
        n = (-t[1], t[0])
        end = (origin[0] + 170 * t[0], origin[1] + 170 * t[1])
        middle = (origin[0] + 85 * t[0], origin[1] + 85 * t[1])
        out.append(line([origin, end], "#888", 7, 'stroke-linecap="round"') + arrow(end, (end[0] + 48 * t[0], end[1] + 48 * t[1]), "#222"))
        out.append(circle(*origin, 4, "#222") + circle(*end, 4, "#222"))
        up = (middle[0] - 75 * n[0], middle[1] - 75 * n[1])
        out.append(arrow(middle, up, COLOURS[0]) + text(up[0] - 4, up[1] - 8, label[0], "middle" if not twist else "end"))
        if twist:
            side = (middle[0] - 62 * n[0] * math.cos(twist) + 40 * t[0] * math.sin(twist), middle[1] - 62 * n[1] * math.cos(twist) + 40 * t[1] * math.sin(twist))
            out.append(arrow(middle, side, colour) + text(side[0] - 30, side[1] - 10, label[1]))
        out.append(text(end[0] + 52 * t[0] - 4, end[1] + 52 * t[1] - 8, label[2], cls="i"))

    edge((40, 200), 0.10, 0, COLOURS[1], ("reference", "", "t̄"))
    edge((330, 215), 0.62, 0.75, COLOURS[1], ("carried along", "first director", "t"))
    out.append(text(640, 205, "θ = u / r: angle between the two arrows", "end", "s"))
    out.append(text(130, 265, "committed at the end of the last step", "middle", "s"))
    out.append(text(470, 265, "within the step: smallest rotation from t̄ to t, then θ about t", "middle", "s"))
    save("rods_frames.svg", 650, 285, out)


def fat_boxes():
    """A vertex in its fat AABB, and a pair of primitives that becomes a candidate."""
    out = []

    def box(x, y, w, h, colour, dash=""):
        return f'<rect x="{x}" y="{y}" width="{w}" height="{h}" fill="none" stroke="{colour}" stroke-width="1.6" stroke-dasharray="{dash}"/>'

    out += [box(40, 60, 200, 130, COLOURS[0]), box(70, 90, 140, 70, "#888", "5 4")]
    out += [circle(70, 160, 4, "#222"), arrow((70, 160), (208, 92)), text(52, 178, "x"), text(214, 88, "x + p")]
    out += [text(140, 52, "fat AABB of a vertex", "middle"), text(140, 212, "margin: skin / 2 on every side", "middle", "s")]
    out += [polygon([(330, 170), (400, 80), (430, 165)], "#d7e5f5"), box(318, 68, 124, 114, COLOURS[0]), box(300, 50, 160, 150, COLOURS[0], "5 4")]
    out += [line([(500, 90), (590, 150)], "#c2571a", 4), circle(500, 90, 4, "#222"), circle(590, 150, 4, "#222"), box(488, 78, 114, 84, COLOURS[1]), box(452, 42, 186, 156, COLOURS[1], "5 4")]
    out += [text(362, 222, "triangle: union of three boxes,", "middle", "s"), text(362, 238, "enlarged by radius(a)", "middle", "s")]
    out += [text(560, 222, "edge: union of two boxes,", "middle", "s"), text(560, 238, "enlarged by radius(b)", "middle", "s")]
    out.append(text(470, 28, "overlap: the pair is a candidate", "middle"))
    save("collision_fat_boxes.svg", 660, 250, out)


if __name__ == "__main__":
    materials()
    hinges()
    rod_frames()
    fat_boxes()
