"""Compares what Blender has read with three frames of the run. Arguments: the folder of the caches that docs/exporting.md has played, and the source tree."""
import importlib.util
import pathlib
import sys

import bpy
import numpy as np

caches, source = (pathlib.Path(argument) for argument in sys.argv[sys.argv.index("--") + 1:])
exports, run = caches.parent, caches.parent.parent
specification = importlib.util.spec_from_file_location("frames", source / "python/tack/frames.py")
frames = importlib.util.module_from_spec(specification)
specification.loader.exec_module(frames)

names = ["floor", "sheet", "a_ball", "rod", "grains"]
tolerance = 3e-7  # m: single precision of coordinates up to 3 m
chosen = (1, 4, 9)


def expected(name, number):
    """Outer vertices of an object in a frame."""
    frame = frames.Frame(run / f"frames/frame_{number:06}.vtu")
    of = frame.of_cells["object"]
    tets, triangles = frame.cells["tets"], frame.cells["triangles"]
    mine = {kind: corners.reshape(len(cells), -1)[of[cells] == names.index(name)] for kind, (cells, corners) in frame.cells.items()}
    assert len(tets[0]) and len(triangles[0])
    faces = np.sort(np.concatenate([mine["tets"][:, np.delete(np.arange(4), k)] for k in range(4)]), axis=1)
    faces, counts = np.unique(faces, axis=0, return_counts=True)
    outer = [faces[counts == 1].ravel()] + [mine[kind].ravel() for kind in ("triangles", "edges", "points")]
    return frame.x[np.unique(np.concatenate(outer)).astype(int)]


def points(thing, world=False):
    mesh = thing.evaluated_get(bpy.context.evaluated_depsgraph_get()).data
    x = np.empty(3 * len(mesh.vertices))
    mesh.vertices.foreach_get("co", x)
    x = x.reshape(-1, 3)
    if world:  # in the axes of the scene: y is up
        matrix = np.array(thing.matrix_world)
        x = x @ matrix[:3, :3].T + matrix[:3, 3]
        x = np.stack([x[:, 0], x[:, 2], -x[:, 1]], axis=1)
    return x


def compare(what, name, number, x):
    wanted = expected(name, number)
    assert x.shape == wanted.shape, f"{what}: {name} has {len(x)} vertices, expected {len(wanted)}"
    error = abs(x - wanted).max()
    assert error < tolerance, f"{what}: {name} is off by {error} m in frame {number}"


def agrees(what):
    print(f"agrees: {what}, {len(names)} objects, frames {chosen}, within {tolerance} m")


def new_objects(read):
    before = set(bpy.data.objects)
    read()
    return [thing for thing in bpy.data.objects if thing not in before]


# Caches, on the objects that the script of the page has made, then as mdd.
played = {name: bpy.data.objects[name] for name in names}
for what in ("pc2", "mdd"):
    for name, thing in played.items():
        cache = thing.modifiers["tack"]
        cache.cache_format = what.upper()
        cache.filepath = str((exports / what / f"{name}.{what}").resolve())
    for number in chosen:
        bpy.context.scene.frame_set(number)
        for name, thing in played.items():
            compare(what, name, number, points(thing))
            compare(what, name, number, points(thing, world=True))
    agrees(what)

sheet = played["sheet"].data
assert [len(p.vertices) for p in sheet.polygons] == [4, 4], "the sheet is not of quads"
lines = [line.split() for line in (source / "tests/blender/quads.mtl").read_text(encoding="utf-8").splitlines()]
colours = {name[1]: [float(x) for x in colour[1:]] for name, colour in zip(lines[::2], lines[1::2])}  # newmtl, Kd
assert [m.name for m in sheet.materials] == list(colours) == ["red", "plain"], [m.name for m in sheet.materials]
for m in sheet.materials:
    assert np.allclose(m.diffuse_color[:3], colours[m.name], atol=1e-6), f"{m.name}: {tuple(m.diffuse_color)}"
assert len(sheet.uv_layers) == 1
for loop, uv in zip(sheet.loops, sheet.uv_layers[0].data):
    rest = [(0, 0), (0.5, 0), (1, 0), (0, 1), (0.5, 1), (1, 1)][loop.vertex_index]
    assert tuple(uv.uv) == rest, f"texture coordinates {tuple(uv.uv)} at vertex {loop.vertex_index}"

for name in names:
    for number in chosen:
        thing, = new_objects(lambda: bpy.ops.wm.obj_import(filepath=str(exports / f"obj/{name}_{number:06}.obj")))
        compare("obj", name, number, points(thing))
agrees("obj")

bpy.ops.preferences.addon_enable(module="io_mesh_ply")
for name in names:
    for number in chosen:
        thing, = new_objects(lambda: bpy.ops.import_mesh.ply(filepath=str(exports / f"ply/{name}_{number:06}.ply")))
        compare("ply", name, number, points(thing))
        if name == "sheet":
            assert [len(p.vertices) for p in thing.data.polygons] == [4, 4], "ply: the sheet is not of quads"
agrees("ply")

# Blender plays a glTF animation at its own frame rate: 10 samples in 0.1 s.
bpy.context.scene.render.fps = 100
np.bool = bool  # which the importer of Debian's Blender 3.4.1 uses and its NumPy 1.24 lacks
things = {thing.name: thing for thing in new_objects(lambda: bpy.ops.import_scene.gltf(filepath=str(exports / "mixed.glb"))) if thing.type == "MESH"}
by_name = {name: next(thing for key, thing in things.items() if key.replace(" ", "_").split(".")[0] == name) for name in names}
for number in chosen:
    bpy.context.scene.frame_set(number)
    for name, thing in by_name.items():
        x, wanted = points(thing, world=True), expected(name, number)
        if name != "sheet":
            compare("gltf", name, number, x)
        else:  # a vertex for each pair of texture coordinates and material
            assert max(abs(wanted - p).max(axis=1).min() for p in x) < tolerance, f"gltf: the sheet is off in frame {number}"
agrees("gltf")

print("all formats agree")
