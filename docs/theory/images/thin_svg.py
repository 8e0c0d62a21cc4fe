#!/usr/bin/env python3
"""Leaves out the points of polylines of an SVG picture of gnuplot that lie within TOLERANCE of the line through their neighbours."""
import re
import sys

TOLERANCE = 0.05  # of a unit of the picture


def distance(p, a, b):
    dx, dy = b[0] - a[0], b[1] - a[1]
    length = (dx * dx + dy * dy) ** 0.5
    if length == 0:
        return ((p[0] - a[0]) ** 2 + (p[1] - a[1]) ** 2) ** 0.5
    return abs(dx * (p[1] - a[1]) - dy * (p[0] - a[0])) / length


def thinned(points):
    """Douglas and Peucker 1973."""
    keep, open_ = {0, len(points) - 1}, [(0, len(points) - 1)]
    while open_:
        first, last = open_.pop()
        if last - first < 2:
            continue
        far = max(range(first + 1, last), key=lambda i: distance(points[i], points[first], points[last]))
        if distance(points[far], points[first], points[last]) > TOLERANCE:
            keep.add(far)
            open_ += [(first, far), (far, last)]
    return [points[i] for i in sorted(keep)]


def path(match):
    pieces = []
    for piece in re.split(r"(?=M)", match.group(1)):
        points = [tuple(map(float, p.split(","))) for p in re.findall(r"-?[\d.]+,-?[\d.]+", piece)]
        if len(points) < 3 or "Z" in piece:
            pieces.append(" ".join(piece.split()))
            continue
        pieces.append("M" + " L".join(f"{x:g},{y:g}" for x, y in thinned(points)))
    return 'd="' + " ".join(p for p in pieces if p) + '"'


for name in sys.argv[1:]:
    with open(name, encoding="utf-8") as file:
        text = file.read()
    with open(name, "w", encoding="utf-8") as file:
        file.write(re.sub(r"\bd='([^']*)'", path, text, flags=re.DOTALL))
