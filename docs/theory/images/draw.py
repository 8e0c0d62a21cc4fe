#!/usr/bin/env python3
"""Draws the diagrams of docs/theory that are no plots of a law (those: laws.sh): docs/theory/images/draw.py

Formulas are those of the files named beside them; the geometry of sketches is made up.
"""
import math
import os

BLUE, ORANGE, GREEN, PINK, GREY, INK = "#0072b2", "#d55e00", "#009e73", "#cc79a7", "#8a8a8a", "#222222"
SHADE_BLUE, SHADE_ORANGE = "#d6e6f2", "#f8e2d3"


class Picture:
    def __init__(self, name, width, height):
        self.name, self.size, self.parts = name, (width, height), []
        self.add(f'<rect width="{width}" height="{height}" fill="#ffffff"/>')

    def add(self, text):
        self.parts.append(text)

    def line(self, points, colour=INK, width=1.5, dash="", arrow=False, fill="none"):
        path = "M" + " L".join(f"{x:.1f},{y:.1f}" for x, y in points)
        end = ' marker-end="url(#arrow)"' if arrow else ""
        self.add(f'<path d="{path}" fill="{fill}" stroke="{colour}" stroke-width="{width}" stroke-dasharray="{dash}"{end}/>')

    def area(self, points, fill, colour="none", width=1):
        path = "M" + " L".join(f"{x:.1f},{y:.1f}" for x, y in points) + " Z"
        self.add(f'<path d="{path}" fill="{fill}" stroke="{colour}" stroke-width="{width}"/>')

    def dot(self, x, y, colour=INK, radius=4, hollow=False):
        self.add(f'<circle cx="{x:.1f}" cy="{y:.1f}" r="{radius}" fill="{"#ffffff" if hollow else colour}" stroke="{colour}" stroke-width="1.5"/>')

    def text(self, x, y, text, colour=INK, size=13, anchor="start", style=""):
        self.add(f'<text x="{x:.1f}" y="{y:.1f}" font-family="DejaVu Sans, Arial, sans-serif" font-size="{size}" fill="{colour}" text-anchor="{anchor}"{style}>{text}</text>')

    def box(self, x, y, width, height, lines, fill=SHADE_BLUE):
        self.add(f'<rect x="{x}" y="{y}" width="{width}" height="{height}" rx="5" fill="{fill}" stroke="{GREY}"/>')
        first = y + height / 2 + 5 - 8 * (len(lines) - 1)
        for i, line in enumerate(lines):
            self.text(x + width / 2, first + 16 * i, line, size=12, anchor="middle")

    def save(self):
        width, height = self.size
        marker = ('<defs><marker id="arrow" viewBox="0 0 8 8" refX="7" refY="4" markerWidth="7" markerHeight="7" orient="auto-start-reverse">'
                  f'<path d="M0,0 L8,4 L0,8 Z" fill="context-stroke"/></marker></defs>')
        here = os.path.dirname(os.path.abspath(__file__))
        with open(os.path.join(here, self.name + ".svg"), "w", encoding="utf-8") as file:
            file.write(f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width} {height}" width="{width}" height="{height}">\n')
            file.write(marker + "\n" + "\n".join(self.parts) + "\n</svg>\n")


class Axes:
    """A plot within a picture."""

    def __init__(self, picture, left, top, width, height, x, y, x_label, y_label):
        self.picture, self.frame, self.x, self.y = picture, (left, top, width, height), x, y
        picture.line([(left, top), (left, top + height), (left + width, top + height)], GREY)
        picture.text(left + width / 2, top + height + 34, x_label, anchor="middle")
        picture.text(left - 36, top + height / 2, y_label, anchor="middle",
                     style=f' transform="rotate(-90 {left - 36} {top + height / 2})"')

    def at(self, x, y):
        left, top, width, height = self.frame
        return (left + width * (x - self.x[0]) / (self.x[1] - self.x[0]), top + height * (1 - (y - self.y[0]) / (self.y[1] - self.y[0])))

    def ticks(self, xs, ys):
        for x in xs:
            px, py = self.at(x, self.y[0])
            self.picture.text(px, py + 16, f"{x:g}", GREY, 11, "middle")
        for y in ys:
            px, py = self.at(self.x[0], y)
            self.picture.text(px - 6, py + 4, f"{y:g}", GREY, 11, "end")
            self.picture.line([(px, py), self.at(self.x[1], y)], "#eeeeee", 1)

    def curve(self, function, first, last, colour, dash="", count=300):
        points = [(first + (last - first) * i / count, 0) for i in range(count + 1)]
        self.picture.line([self.at(x, function(x)) for x, _ in points if self.y[0] <= function(x) <= self.y[1]], colour, 2, dash)


def plain_pressure(r):
    """-b'(d) / kappa at r = d / dhat (energies/barrier/clamped_log.cpp)."""
    return 2 * (r - 1) * math.log(r) + (r - 1) ** 2 / r


def barrier():
    picture = Picture("barrier", 760, 300)
    left = Axes(picture, 60, 20, 290, 220, (0, 1.1), (0, 3), "gap d / d̂", "energy b / (κ d̂)")
    left.ticks([0, 0.25, 0.5, 0.75, 1], [0, 1, 2, 3])
    left.curve(lambda r: -((r - 1) ** 2) * math.log(r) if r < 1 else 0, 0.01, 1.1, BLUE)
    right = Axes(picture, 450, 20, 290, 220, (0, 1.1), (0, 3), "gap d / d̂", "pressure −b′ / κ")
    right.ticks([0, 0.25, 0.5, 0.75, 1], [0, 1, 2, 3])
    squared = plain_pressure(0.5) / plain_pressure(0.25)
    right.curve(lambda r: plain_pressure(r) if r < 1 else 0, 0.05, 1.1, BLUE)
    right.curve(lambda r: 2 * squared * r * plain_pressure(r * r) if r < 1 else 0, 0.05, 1.1, ORANGE, "6 4")
    picture.line([(610, 60), (640, 60)], BLUE, 2)
    picture.text(648, 64, "plain")
    picture.line([(610, 82), (640, 82)], ORANGE, 2, "6 4")
    picture.text(648, 86, "squared")
    picture.save()


def rest_distance():
    picture = Picture("rest_distance", 560, 290)
    axes = Axes(picture, 60, 20, 470, 210, (0, 1.1), (0, 3), "distance δ / d̂, offset 0", "pressure / κ")
    axes.ticks([0, 0.2, 0.4, 0.6, 0.8, 1], [0, 1, 2, 3])
    axes.curve(lambda r: plain_pressure(r) if r < 1 else 0, 0.05, 1.1, BLUE)
    rest = 0.4
    axes.curve(lambda r: plain_pressure(r / rest) if r < rest else 0, 0.02, 1.1, ORANGE, "6 4")
    picture.line([axes.at(rest, 0), axes.at(rest, 2.6)], GREY, 1, "2 3")
    picture.text(axes.at(rest, 2.6)[0] + 8, axes.at(rest, 2.6)[1], "δ₀: distance at rest", GREY, 12)
    picture.text(axes.at(0.52, 1.25)[0], axes.at(0.52, 1.25)[1], "whole law", BLUE)
    picture.text(axes.at(0.1, 0.2)[0], axes.at(0.1, 0.2)[1], "cut down", ORANGE)
    picture.save()


def friction():
    picture = Picture("friction", 760, 300)
    start = lambda y: 2 * y - y * y
    left = Axes(picture, 60, 20, 290, 220, (0, 3), (0, 1.2), "slip y / (ε h)", "force / limit")
    left.ticks([0, 1, 2, 3], [0, 0.5, 1])
    left.curve(lambda y: start(y) if y < 1 else 1, 0, 3, BLUE)
    left.curve(lambda y: start(y) if y < 2 else 0, 0, 3, ORANGE, "6 4")
    right = Axes(picture, 450, 20, 290, 220, (0, 3), (0, 2.8), "slip y / (ε h)", "potential / (limit · ε h)")
    right.ticks([0, 1, 2, 3], [0, 1, 2])
    energy = lambda y: y * y * (1 - y / 3)
    right.curve(lambda y: energy(y) if y < 1 else y - 1 / 3, 0, 3, BLUE)
    right.curve(lambda y: energy(y) if y < 2 else 4 / 3, 0, 3, ORANGE, "6 4")
    for i, (colour, dash, text) in enumerate([(BLUE, "", "friction f₁, f₀"), (ORANGE, "6 4", "tangential adhesion")]):
        picture.line([(480, 40 + 22 * i), (510, 40 + 22 * i)], colour, 2, dash)
        picture.text(518, 44 + 22 * i, text)
    picture.save()


def features():
    picture = Picture("features", 760, 300)
    picture.text(190, 24, "above an edge of a flat surface", anchor="middle")
    a, b, c, d = (40, 210), (190, 120), (190, 270), (340, 180)
    picture.area([a, b, c], SHADE_BLUE, GREY)
    picture.area([b, c, d], SHADE_BLUE, GREY)
    picture.line([b, c], ORANGE, 3)
    point = (215, 62)
    picture.dot(*point, INK, 5)
    picture.text(228, 60, "p")
    picture.line([point, (215, 192)], BLUE, 1.5, "4 3", True)
    picture.line([point, (193, 196)], ORANGE, 1.5, "4 3", True)
    picture.text(88, 200, "edge: +1", BLUE)
    picture.text(232, 172, "face: +1", BLUE)
    picture.text(205, 262, "shared edge: −1", ORANGE)
    picture.text(190, 292, "left triangle, nearest on its edge: +1 − 1 = 0; the face is left", GREY, 10.5, "middle")
    picture.text(570, 24, "in a corner between floor and wall", anchor="middle")
    picture.line([(420, 230), (680, 230)], BLUE, 4)
    picture.line([(420, 230), (420, 60)], BLUE, 4)
    corner = (500, 160)
    picture.dot(*corner, INK, 5)
    picture.text(512, 158, "p")
    picture.line([corner, (500, 226)], BLUE, 1.5, "4 3", True)
    picture.line([corner, (424, 160)], BLUE, 1.5, "4 3", True)
    picture.text(512, 200, "patch 1: A₁, n₁")
    picture.text(430, 148, "patch 2: A₂, n₂")
    picture.text(570, 262, "two patches, each with its own tributary area of p", GREY, 10.5, "middle")
    picture.save()


def overlap():
    """A mesh of the integration side, seen from above, beside the overlap boundary."""
    picture = Picture("overlap", 760, 340)
    size, left, top, cells, rows = 62, 30, 30, 6, 4
    boundary = left + 3.6 * size
    picture.area([(left - 15, top - 15), (boundary, top - 15), (boundary, top + rows * size + 15), (left - 15, top + rows * size + 15)], SHADE_ORANGE)
    inside = lambda p: p[0] <= boundary
    at = lambda i, j: (left + size * i, top + size * j)
    for i in range(cells):
        for j in range(rows):
            for triangle in ([at(i, j), at(i + 1, j), at(i + 1, j + 1)], [at(i, j), at(i + 1, j + 1), at(i, j + 1)]):
                whole = all(inside(p) for p in triangle)
                picture.area(triangle, SHADE_BLUE if whole else "none", GREY)
                if whole or not any(inside(p) for p in triangle):
                    continue
                middles = [((p[0] + q[0]) / 2, (p[1] + q[1]) / 2) for p, q in zip(triangle, triangle[1:] + triangle[:1])]
                picture.line(middles + middles[:1], GREY, 0.8, "2 2")
                children = [[triangle[0], middles[0], middles[2]], [middles[0], triangle[1], middles[1]], [middles[2], middles[1], triangle[2]], middles]
                for child in children:
                    cut = clip(child, boundary)
                    if area_of(cut) > 40:
                        picture.area(cut, SHADE_BLUE)
                        picture.dot(*centroid(cut), GREEN, 3)
    for i in range(cells + 1):
        for j in range(rows + 1):
            count = sum(all(inside(p) for p in t) for t in around(at, i, j, cells, rows))
            if count:
                picture.dot(*at(i, j), BLUE, 2 + 0.5 * count)
    picture.line([(boundary, top - 15), (boundary, top + rows * size + 15)], ORANGE, 2.5)
    for j in range(rows):
        y = top + size * (j + 0.5)
        picture.line([(boundary + 4, y), (boundary - 28, y)], PINK, 2, "", True)
    x = 450
    legend = [(SHADE_ORANGE, "the other surface, below"), (SHADE_BLUE, "overlap"), (BLUE, "vertex: a third of each fully"), (None, "overlapped triangle around it"),
              (GREEN, "interior quadrature point of a"), (None, "subtriangle, cut along the boundary"), (ORANGE, "overlap boundary"),
              (PINK, "overlap-boundary force on"), (None, "the integration side, if it adheres")]
    y = 50
    for colour, text in legend:
        if colour in (BLUE, GREEN):
            picture.dot(x + 10, y - 4, colour)
        elif colour == PINK:
            picture.line([(x + 22, y - 4), (x, y - 4)], PINK, 2, "", True)
        elif colour == ORANGE:
            picture.line([(x, y - 4), (x + 22, y - 4)], ORANGE, 2.5)
        elif colour:
            picture.area([(x, y - 12), (x + 20, y - 12), (x + 20, y + 2), (x, y + 2)], colour, GREY)
        picture.text(x + 32, y, text)
        y += 20 if colour is None or text.startswith(("vertex", "interior", "overlap-")) else 28
    picture.save()


def around(at, i, j, cells, rows):
    found = []
    for u in range(max(0, i - 1), min(cells, i + 1)):
        for v in range(max(0, j - 1), min(rows, j + 1)):
            for t in ([at(u, v), at(u + 1, v), at(u + 1, v + 1)], [at(u, v), at(u + 1, v + 1), at(u, v + 1)]):
                if at(i, j) in t:
                    found.append(t)
    return found


def clip(polygon, x):
    kept = []
    for p, q in zip(polygon, polygon[1:] + polygon[:1]):
        if p[0] <= x:
            kept.append(p)
        if (p[0] <= x) != (q[0] <= x):
            s = (x - p[0]) / (q[0] - p[0])
            kept.append((x, p[1] + s * (q[1] - p[1])))
    return kept


def area_of(polygon):
    return abs(sum(p[0] * q[1] - q[0] * p[1] for p, q in zip(polygon, polygon[1:] + polygon[:1]))) / 2


def centroid(polygon):
    return (sum(p[0] for p in polygon) / len(polygon), sum(p[1] for p in polygon) / len(polygon))


def levers():
    picture = Picture("bond_levers", 760, 330)
    picture.text(190, 24, "as bonded: r = 0", anchor="middle")
    picture.text(570, 24, "opened by d, slipped by u", anchor="middle")
    for x0, open_, slip in ((190, 0, 0), (540, 36, 56)):
        low, high = 280, 110 - open_
        picture.line([(x0 - 130, low), (x0 + 150, low)], BLUE, 4)
        picture.line([(x0 - 130 + slip, high), (x0 + 130 + slip, high)], ORANGE, 4)
        anchor, place = (x0, low), (x0 + slip, high)
        a_point, p_point = (x0, 195), (x0 + slip, 195 - open_)
        picture.line([anchor, a_point], BLUE, 2, "5 3", True)
        picture.line([place, p_point], ORANGE, 2, "5 3", True)
        picture.dot(*anchor, BLUE)
        picture.dot(*place, ORANGE)
        picture.dot(*a_point, BLUE, 3)
        picture.dot(*p_point, ORANGE, 3)
        picture.text(x0 - 118, low + 22, "surface of the anchor", BLUE, 12)
        picture.text(x0 - 118 + slip, high - 10, "surface of the bond site", ORANGE, 12)
        picture.text(x0 - 10, 245, "l₂", BLUE, anchor="end")
        picture.text(x0 + slip + 10, (high + 195 - open_) / 2 + 4, "l₁", ORANGE)
        if open_:
            picture.line([a_point, p_point], GREEN, 2, "", True)
            picture.text((a_point[0] + p_point[0]) / 2 - 10, (a_point[1] + p_point[1]) / 2 - 8, "r", GREEN, anchor="end")
            picture.line([a_point, (p_point[0], a_point[1])], GREY, 1, "3 3")
            picture.line([(p_point[0], a_point[1]), p_point], GREY, 1, "3 3")
            picture.text((a_point[0] + p_point[0]) / 2, a_point[1] + 18, "u", anchor="middle")
            picture.text(p_point[0] + 8, (a_point[1] + p_point[1]) / 2 + 6, "d")
        else:
            picture.line([(x0 - 130, 195), (x0 + 130, 195)], GREY, 1, "2 4")
            picture.text(x0 + 16, 190, "middle of the gap", GREY, 12)
    picture.save()


def step():
    picture = Picture("step", 760, 250)
    boxes = [(10, ["state: x, v,", "history variables"]), (165, ["start of the step", "lag surfaces,", "frames, friction"]), (335, ["prescribed vertices", "to their positions"]),
             (505, ["minimise E(q)", "CCD bounds", "every step"]), (650, ["validate"])]
    widths = [125, 140, 140, 120, 100]
    for (x, lines), width in zip(boxes, widths):
        picture.box(x, 70, width, 66, lines)
    for (x, _), width, (after, _) in zip(boxes, widths, boxes[1:]):
        picture.line([(x + width + 2, 103), (after - 3, 103)], INK, 1.5, "", True)
    picture.line([(565, 70), (565, 40), (235, 40), (235, 67)], ORANGE, 1.5, "5 3", True)
    picture.text(400, 32, "solve again with the latest solution (contact.lagging, start-up)", ORANGE, 12, "middle")
    picture.line([(690, 138), (690, 175), (235, 175), (235, 139)], PINK, 1.5, "5 3", True)
    picture.text(460, 193, "rejected: substeps of half the size, or the fallback integrator", PINK, 12, "middle")
    picture.line([(720, 138), (720, 215), (72, 215), (72, 139)], GREEN, 1.5, "", True)
    picture.text(400, 233, "accepted: advance the history variables, book energies", GREEN, 12, "middle")
    picture.save()


if __name__ == "__main__":
    for draw in (barrier, rest_distance, friction, features, overlap, levers, step):
        draw()
