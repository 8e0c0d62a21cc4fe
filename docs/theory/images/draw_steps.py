#!/usr/bin/env python3
"""Draws the pictures of integrators and convergence in this folder; standard library only.

python3 docs/theory/images/draw_steps.py
"""
import cmath
import math

from draw_bodies import COLOURS, arrow, circle, line, save, text


def bdf2(theta):
    a = 1.5 - 1j * theta
    root = cmath.sqrt(4 - 2 * a)
    return max(abs((2 + root) / (2 * a)), abs((2 - root) / (2 * a)))


def generalised_alpha(theta, rho=0.8):
    am, af = (2 * rho - 1) / (rho + 1), rho / (rho + 1)
    beta, gamma = (1 + af - am) ** 2 / 4, 0.5 + af - am
    x, v, a, sizes = 1.0, 0.0, -theta**2, []
    for _ in range(400):
        known = x + v + (0.5 - beta) * a
        new = (-theta**2 * (af * x + (1 - af) * known) - am * a) / (1 - am + theta**2 * (1 - af) * beta)
        x, v, a = known + beta * new, v + (1 - gamma) * a + gamma * new, new
        sizes.append(math.hypot(theta * x, v))
        x, v, a = (q / sizes[-1] for q in (x, v, a))
    return math.exp(sum(math.log(s) for s in sizes[100:]) / 300)


def tr_bdf2(theta):
    d = 1 - 1 / math.sqrt(2)
    return math.sqrt(1 + 2 * (d * theta) ** 2) / (1 + (d * theta) ** 2)


def integrators():
    left, top, width, height = 60, 20, 520, 300
    steps = [5 * 40 ** (i / 200) for i in range(201)]  # per period
    px = lambda n: left + math.log(n / 5) / math.log(40) * width
    py = lambda a: top + (1 - a) * height
    out = []
    for a in (0, 0.25, 0.5, 0.75, 1):
        out.append(f'<line class="g" x1="{left}" x2="{left + width}" y1="{py(a):.1f}" y2="{py(a):.1f}"/>' + text(left - 8, py(a) + 5, f"{a:g}", "end"))
    for n in (5, 10, 20, 50, 100, 200):
        out.append(f'<line class="g" y1="{top}" y2="{top + height}" x1="{px(n):.1f}" x2="{px(n):.1f}"/>' + text(px(n), top + height + 18, str(n), "middle"))
    out.append(text(left + width / 2, top + height + 38, "steps per period", "middle"))
    out.append(f'<text transform="translate(18 {top + height / 2}) rotate(-90)" text-anchor="middle">amplitude after one period</text>')
    factors = [("newmark", lambda t: 1.0), ("generalised_alpha", generalised_alpha), ("tr_bdf2, sdirk2", tr_bdf2), ("bdf2", bdf2),
               ("implicit_euler", lambda t: 1 / math.sqrt(1 + t * t))]
    colours = [*COLOURS, "#444444"]
    for k, (name, factor) in enumerate(factors):
        out.append(line([(px(n), py(factor(2 * math.pi / n) ** n)) for n in steps], colours[k], 2.2))
        y = top + 120 + 20 * k
        out.append(line([(left + 340, y), (left + 370, y)], colours[k], 2.2) + text(left + 378, y + 5, name))
    save("integrators_damping.svg", 600, 370, out)


def box(x, y, w, h, fill, stroke="#222", dash=""):
    return f'<rect x="{x}" y="{y}" width="{w}" height="{h}" fill="{fill}" stroke="{stroke}" stroke-width="1.4" stroke-dasharray="{dash}"/>'


def tunnelling():
    """A path of the minimiser around an obstacle, and the linear trajectory that is checked."""
    out = [box(40, 120, 60, 50, "#d7e5f5"), text(70, 190, "start", "middle", "s")]
    out += [box(480, 120, 60, 50, "#d7e5f5", COLOURS[0], "5 4"), text(510, 190, "end of the minimisation", "middle", "s")]
    out += [box(270, 90, 40, 130, "#e6ddd5"), text(290, 240, "obstacle", "middle", "s")]
    out.append(f'<path d="M 100 138 C 190 60, 230 45, 290 48 S 420 90, 476 136" fill="none" stroke="{COLOURS[2]}" stroke-width="2" stroke-dasharray="7 4"/>')
    out.append(text(290, 34, "iterates: free of intersections", "middle", "s"))
    out += [arrow((102, 150), (266, 150), COLOURS[1]), text(184, 142, "linear trajectory", "middle", "s")]
    out += [circle(268, 150, 5, COLOURS[1]), text(322, 205, "hit: more than ℓ / 2 to go", "start", "s")]
    out += [line([(40, 110), (40, 102), (100, 102), (100, 110)], "#222", 1.2), text(70, 94, "ℓ", "middle", "i")]
    save("integrators_tunnelling.svg", 600, 255, out)


def groups():
    """Body groups and contact groups of a scene."""
    out = [box(20, 40, 330, 210, "none", COLOURS[1], "6 4"), box(390, 40, 190, 210, "none", COLOURS[1], "6 4")]
    out += [text(185, 30, "contact group 1", "middle", "s"), text(485, 30, "contact group 2", "middle", "s")]
    out += [box(45, 150, 120, 60, "#d7e5f5"), box(205, 150, 120, 60, "#d7e5f5"), box(85, 75, 90, 60, "#e0ece0"), box(430, 130, 110, 60, "#eadff2")]
    out += [text(105, 185, "body A", "middle"), text(265, 185, "body B", "middle"), text(130, 110, "body C", "middle"), text(485, 165, "body D", "middle")]
    out += [line([(165, 180), (205, 180)], "#222", 3), text(185, 226, "attached: one body group", "middle", "s")]
    out += [line([(95, 142), (155, 142)], COLOURS[1], 5), text(240, 128, "contact that presses", "middle", "s")]
    out += [text(485, 215, "touches nothing", "middle", "s")]
    save("convergence_groups.svg", 600, 265, out)


if __name__ == "__main__":
    integrators()
    tunnelling()
    groups()
