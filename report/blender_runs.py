"""Runs and views for blender.py: shapes of `tack export --to npy`, camera, samples, colours and looks.

Needs no Blender.
"""
import functools
import json
import math
import os
import re

import numpy as np

COLOURS = ["#0072B2", "#E69F00", "#009E73", "#CC79A7", "#56B4E9", "#D55E00", "#F0E442", "#999999"]


def linear(css):
    """Returns the linear colour of "#rrggbb". Raises SystemExit for other colours."""
    digits = css.lstrip("#")
    if not re.fullmatch(r"[0-9a-fA-F]{6}", digits):
        raise SystemExit(f"colour '{css}': Blender takes colours as #rrggbb")
    srgb = np.array([int(digits[i:i + 2], 16) / 255 for i in (0, 2, 4)])
    return np.where(srgb < 0.04045, srgb / 12.92, ((srgb + 0.055) / 1.055) ** 2.4)


def matches(pattern, name):
    return name.startswith(pattern[:-1]) if pattern.endswith("*") else pattern == name


# Radii of drawn rods and particles, in sizes of the box of all objects in all frames, as in report/src/studio.js: of those that have none in the scene, and the smallest, about a pixel.
DEFAULT_RADIUS, SMALLEST_RADIUS = 3e-3, 8e-4


def numbered_picture(pattern, number):
    """Returns the path of a picture of a film: the last %0Nd of the file's name is replaced by the number, as in report/render.mjs. Folders keep their %."""
    return re.sub(r"%0(\d+)d(?=[^/]*$)(?![^/]*%0\d+d)", lambda found: str(number).zfill(int(found[1])), pattern)


class Run:
    """Positions and elements of a run, turned so that z points up."""

    def __init__(self, folder):
        with open(os.path.join(folder, "shapes.json")) as file:
            data = json.load(file)
        self.times, self.objects = np.array(data["times"]), data["objects"]
        self.turn = rotation_to_z(np.array(data["up"]))
        for o in self.objects:
            o["x"] = np.load(os.path.join(folder, o["positions"]), mmap_mode="r")

    def positions(self, o, sample):
        return np.asarray(o["x"][sample]) @ self.turn.T

    @functools.cached_property
    def size(self):
        """The diagonal of the box of all objects in all samples, also of hidden ones [m]; 1 m if it is a point."""
        x = [self.positions(o, s) for s in range(len(self.times)) for o in self.objects if o["vertices"]]
        low, high = np.min([one.min(0) for one in x], axis=0), np.max([one.max(0) for one in x], axis=0)
        return np.linalg.norm(high - low) or 1

    def box(self, samples):
        """Returns the corners of the bounding box of what is drawn [m]."""
        shown = [(self.positions(o, s), drawn_offset(o, self.size)) for s in samples for o in self.objects if not o["look"].get("hide") and o["vertices"]]
        return np.min([x.min(0) - offset for x, offset in shown], axis=0), np.max([x.max(0) + offset for x, offset in shown], axis=0)


def drawn_offset(o, size):
    """Returns how far an object is drawn beyond its vertices [m]: its radius and the look's `offset`. size: of the box of all objects [m]."""
    offset = o["look"].get("offset", 0)
    radius = o["radius"] or DEFAULT_RADIUS * size  # 0: the scene gives none
    return offset if o["face_sizes"] else max(radius + offset, SMALLEST_RADIUS * size)


def axis_to_z(up):
    """Returns the rotation that takes the axis nearest to `up` to z; y up as Blender's importers do it."""
    axis = int(np.argmax(np.abs(up)))
    if axis == 2 and up[2] > 0:
        return np.eye(3)
    if axis == 1 and up[1] > 0:
        return np.array([[1, 0, 0], [0, 0, -1], [0, 1, 0]])
    if axis == 0 and up[0] > 0:
        return np.array([[0, 1, 0], [0, 0, 1], [1, 0, 0]])
    return np.diag([1, -1, -1]) @ axis_to_z(-up)


def rotation_to_z(up):
    """Returns the rotation that takes the direction `up` to z: that of its nearest axis, and the smallest that remains."""
    turn = axis_to_z(up)
    x, y, z = turn @ (up / np.linalg.norm(up))
    cross = np.array([[0, 0, -x], [0, 0, -y], [x, y, 0]])  # about up x z, by the angle between them
    return (np.eye(3) + cross + cross @ cross / (1 + z)) @ turn


def camera_of(view, run, low, high, aspect):
    """Returns position and target [m, z up], as report/src/studio.js places them."""
    turn = run.turn
    target = turn @ np.array(view["to"]) if view["to"] else (low + high) / 2
    if view["from"]:
        return turn @ np.array(view["from"]), target
    axes = {"x": [1, 0, 0], "y": [0, 1, 0], "z": [0, 0, 1]}
    z = np.array([0.0, 0.0, 1.0])
    if view["look"] in axes:
        direction = turn @ np.array(axes[view["look"]], float)
    else:
        up = turn.T @ z
        corner = [0.55, 0, 1] if abs(up[1]) > 0.5 else [0.55, -1, 0] if abs(up[2]) > 0.5 else [0, 0.55, 1]
        direction = turn @ np.array(corner, float) + 0.5 * z
    direction /= np.linalg.norm(direction)
    if abs(direction @ z) > 0.99:
        z = turn @ (np.array([0.0, 1, 0]) if abs((turn.T @ z)[2]) > 0.5 else np.array([0.0, 0, -1]))
    direction = turned(direction, z, math.radians(view["turn"]))
    side = np.cross(direction, z)
    direction = turned(direction, side / np.linalg.norm(side), math.radians(view["lift"]))
    extent = np.linalg.norm(high - low) or 1
    away = 0.54 * extent / math.tan(math.radians(view["angle"]) / 2) / min(1, aspect) / view["zoom"]
    return target + away * direction, target


def turned(v, axis, angle):
    """Rotates a vector about a unit axis (Rodrigues)."""
    return v * math.cos(angle) + np.cross(axis, v) * math.sin(angle) + axis * (axis @ v) * (1 - math.cos(angle))


def is_closed(faces):
    """Returns True for a surface without boundary: each edge has two faces."""
    count = {}
    for face in faces:
        for a, b in zip(face, [*face[1:], face[0]]):
            edge = (a, b) if a < b else (b, a)
            count[edge] = count.get(edge, 0) + 1
    return all(n == 2 for n in count.values())


def set_looks(runs, looks):
    """Gives each object its look, of all patterns that fit its name. Raises SystemExit for one that fits none."""
    names = [o["name"] for run in runs for o in run.objects]
    for pattern in looks:
        if not any(matches(pattern, name) for name in names):
            raise SystemExit(f"objects: no run has an object '{pattern}'; there are {', '.join(names[:12])}")
    for run in runs:
        for o in run.objects:
            o["look"] = {}
            for pattern, look in looks.items():
                if matches(pattern, o["name"]):
                    o["look"].update(look)
        if all(o["look"].get("hide") for o in run.objects):
            raise SystemExit("all objects are hidden")
