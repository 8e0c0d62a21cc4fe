#!/usr/bin/env python3
"""Draws the amplitude that integrators leave of a vibration after one period; standard library only.

python3 docs/theory/images/draw_integrators.py
"""
import cmath
import math

from draw_bodies import COLOURS, line, save, text


def bdf2(theta):
    a = 1.5 - 1j * theta
    root = cmath.sqrt(4 - 2 * a)
    return max(abs((2 + root) / (2 * a)), abs((2 - root) / (2 * a)))


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
    factors = [("newmark", lambda t: 1.0), ("bdf2", bdf2), ("implicit_euler", lambda t: 1 / math.sqrt(1 + t * t))]
    for k, (name, factor) in enumerate(factors):
        out.append(line([(px(n), py(factor(2 * math.pi / n) ** n)) for n in steps], COLOURS[k], 2.2))
        y = top + 120 + 20 * k
        out.append(line([(left + 370, y), (left + 400, y)], COLOURS[k], 2.2) + text(left + 408, y + 5, name))
    save("integrators_damping.svg", 600, 370, out)


if __name__ == "__main__":
    integrators()
