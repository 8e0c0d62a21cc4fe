"""Makes a mesh in Blender, in millimetres and turned, writes it for a scene, and keeps the Blender file: `make`. Or plays the cache of the run on it: `play`."""
import importlib.util
import pathlib
import sys

import bpy
import numpy as np

what, source = sys.argv[sys.argv.index("--") + 1:]

if what == "make":
    bpy.ops.wm.read_factory_settings(use_empty=True)
    bpy.ops.mesh.primitive_torus_add(major_segments=24, minor_segments=12, major_radius=100, minor_radius=30, location=(0, 0, 300), rotation=(0.3, 0.2, 0))
    bpy.context.object.name = "ring"
    bpy.ops.wm.obj_export(filepath="ring.obj")
    bpy.ops.wm.save_as_mainfile(filepath=str(pathlib.Path("ring.blend").resolve()))
else:
    specification = importlib.util.spec_from_file_location("frames", pathlib.Path(source) / "python/tack/frames.py")
    frames = importlib.util.module_from_spec(specification)
    specification.loader.exec_module(frames)
    ring = bpy.data.objects["ring"]
    assert len(ring.data.polygons) == 288 and len(ring.data.polygons[0].vertices) == 4
    cache = ring.modifiers.new("tack", "MESH_CACHE")
    cache.cache_format = "PC2"
    cache.filepath = str(pathlib.Path("ring/export/pc2/ring.pc2").resolve())
    ring.location, ring.rotation_euler, ring.scale = (0, 0, 0), (np.pi / 2, 0, 0), (1, 1, 1)
    for number in (1, 5, 10):
        bpy.context.scene.frame_set(number)
        mesh = ring.evaluated_get(bpy.context.evaluated_depsgraph_get()).data
        x = np.array([ring.matrix_world @ v.co for v in mesh.vertices]) / 1000
        wanted = frames.Frame(f"ring/frames/frame_{number:06}.vtu").x
        error = abs(np.stack([x[:, 0], x[:, 2], -x[:, 1]], axis=1) - wanted).max()
        assert error < 1e-7, f"the ring is off by {error} m in frame {number}"
    print("agrees: pc2 on the mesh that Blender exported, within 1e-07 m")
