"""Draws runs with Cycles: blender -b -P blender.py -- VIEW.json OUTPUT SHAPES...

VIEW.json: the view of `tack render`. SHAPES: folders of `tack export --to npy`, drawn side by side.
OUTPUT: a file that ends in .png, or the pattern of numbered pictures ("film_%04d.png"). Prints
"frame 3 of 120".

Scenes of tack have any axis upwards and any size; the picture is drawn with z upwards and with the
run's longest extent as the unit of length, for which Blender's defaults are made.
"""
import json
import math
import os
import sys
import tempfile

import numpy as np

# Blender does not look for modules beside its script, and an installation is not to be written into.
sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
sys.dont_write_bytecode = True
from blender_runs import COLOURS, Run, camera_of, drawn_offset, is_closed, linear, numbered_picture, set_looks  # noqa: E402


class Drawing:
    """The Blender scene of one of the runs that are drawn side by side."""

    def __init__(self, run, runs, view, label=""):
        import bpy

        self.bpy, self.run, self.runs, self.view, self.label = bpy, run, runs, view, label
        bpy.ops.wm.read_factory_settings(use_empty=True)
        self.scene = bpy.context.scene
        low, high = run.box(range(len(run.times)))
        self.unit = 1 / (np.linalg.norm(high - low) or 1)  # Blender units per metre
        self.middle = (low + high) / 2
        self.settings()
        self.shapes = [self.shape(i, o) for i, o in enumerate(run.objects) if not o["look"].get("hide")]
        if view["ground"]:
            self.ground(low[2])
        self.light()
        self.camera = self.add("camera", bpy.data.cameras.new("camera"))
        self.scene.camera = self.camera

    def size(self):
        width, height = self.view["size"]
        return width // len(self.runs), height

    def add(self, name, data):
        made = self.bpy.data.objects.new(name, data)
        self.scene.collection.objects.link(made)
        return made

    def placed(self, x):
        return (x - self.middle) * self.unit

    def settings(self):
        s, view = self.scene, self.view
        s.render.engine = "CYCLES"
        s.cycles.device = "CPU"
        s.cycles.samples = view["samples"]
        s.cycles.seed = 0
        s.cycles.use_denoising = False  # Debian's Blender has no denoiser that takes the processor
        s.render.resolution_x, s.render.resolution_y = self.size()
        s.view_settings.view_transform = "Standard"  # exposure and tone: compose()
        s.render.film_transparent = True
        s.render.image_settings.file_format = "PNG"
        s.render.image_settings.color_mode = "RGBA"
        s.render.image_settings.compression = 100
        s.render.dither_intensity = 0  # noise, which makes a PNG several times as large
        s.render.use_persistent_data = True

    def material(self, name, look, colour):
        m = self.bpy.data.materials.new(name)
        m.use_nodes = True
        shader = m.node_tree.nodes["Principled BSDF"].inputs
        shader["Base Color"].default_value = (*colour, 1)
        shader["Roughness"].default_value = look.get("roughness", 0.7)
        shader["Metallic"].default_value = look.get("metalness", 0)
        shader["Alpha"].default_value = look.get("opacity", 1)
        shader["Transmission"].default_value = look.get("transmission", 0)
        if look.get("translucency"):
            shader["Subsurface"].default_value = look["translucency"]
            shader["Subsurface Color"].default_value = (*colour, 1)
            shader["Subsurface Radius"].default_value = (0.02, 0.02, 0.02)
        return m

    def shape(self, i, o):
        bpy, look, name = self.bpy, o["look"], o["name"]
        given = look.get("colour")
        colour = linear(given or COLOURS[i % len(COLOURS)])
        mesh = bpy.data.meshes.new(name)
        starts = np.concatenate([[0], np.cumsum(o["face_sizes"])]).astype(int)
        faces = [o["corners"][a:b] for a, b in zip(starts[:-1], starts[1:])]
        mesh.from_pydata(self.placed(self.run.positions(o, 0)).tolist(), [] if faces else o["edges"], faces)
        made = self.add(name, mesh)
        if faces and not given and len(o["materials"]) > 1:  # the materials of the object's own file
            for m in o["materials"]:
                mesh.materials.append(self.material(m["name"], look, m["colour"]))
            mesh.polygons.foreach_set("material_index", o["face_material"])
        else:
            mesh.materials.append(self.material(name, look, colour))
        if faces:
            mesh.polygons.foreach_set("use_smooth", [True] * len(faces))
            mesh.use_auto_smooth = True
            mesh.auto_smooth_angle = math.radians(look.get("smooth", 40))
            if look.get("subdivide"):
                s = made.modifiers.new("subdivide", "SUBSURF")
                s.levels = s.render_levels = look["subdivide"]
            if look.get("offset"):
                self.offset(made, look["offset"] * self.unit, is_closed(faces))
        elif o["edges"] or o["points"]:
            self.thicken(made, drawn_offset(o, self.run.size) * self.unit, bool(o["edges"]))
        if look.get("opacity", 1) <= 0.5:
            made.visible_shadow = False
        return o, made

    def offset(self, made, distance, closed):
        """Moves a closed surface outwards; gives a sheet a thickness of twice the distance."""
        if closed:
            m = made.modifiers.new("offset", "DISPLACE")
            m.strength, m.mid_level = distance, 0
        else:
            m = made.modifiers.new("offset", "SOLIDIFY")
            m.thickness, m.offset = 2 * distance, 0

    def cut(self, made):
        """Returns a copy of an object without what lies beyond the section, closed by faces in its plane."""
        import bmesh
        from mathutils import Vector

        section, turn = self.view["section"], self.run.turn
        name = made.name + " cut"
        old = self.bpy.data.objects.get(name)
        if old:
            self.bpy.data.meshes.remove(old.data)
        evaluated = made.evaluated_get(self.bpy.context.evaluated_depsgraph_get())
        b = bmesh.new()
        b.from_mesh(evaluated.to_mesh())
        evaluated.to_mesh_clear()
        point, normal = Vector(self.placed(turn @ np.array(section["through"]))), Vector(turn @ np.array(section["normal"]))
        found = bmesh.ops.bisect_plane(b, geom=[*b.verts, *b.edges, *b.faces], dist=1e-7, plane_co=point, plane_no=normal, clear_outer=True)
        edges = [e for e in found["geom_cut"] if isinstance(e, bmesh.types.BMEdge)]
        if edges:
            bmesh.ops.triangle_fill(b, use_beauty=True, edges=edges, normal=normal)
        mesh = self.bpy.data.meshes.new(name)
        b.to_mesh(mesh)
        b.free()
        for m in made.data.materials:
            mesh.materials.append(m)
        mesh.use_auto_smooth, mesh.auto_smooth_angle = made.data.use_auto_smooth, made.data.auto_smooth_angle
        return self.add(name, mesh)

    def thicken(self, made, radius, rod):
        """Gives edges or points a radius, by geometry nodes."""
        bpy = self.bpy
        tree = bpy.data.node_groups.new("thick", "GeometryNodeTree")
        tree.inputs.new("NodeSocketGeometry", "Geometry")
        tree.outputs.new("NodeSocketGeometry", "Geometry")
        new, link = tree.nodes.new, tree.links.new
        start, end = new("NodeGroupInput"), new("NodeGroupOutput")
        material = new("GeometryNodeSetMaterial")
        material.inputs["Material"].default_value = made.data.materials[0]
        smooth = new("GeometryNodeSetShadeSmooth")
        if rod:
            curve, circle, thick = new("GeometryNodeMeshToCurve"), new("GeometryNodeCurvePrimitiveCircle"), new("GeometryNodeCurveToMesh")
            circle.inputs["Resolution"].default_value = 12
            circle.inputs["Radius"].default_value = radius
            thick.inputs["Fill Caps"].default_value = True
            link(start.outputs[0], curve.inputs["Mesh"])
            link(curve.outputs[0], thick.inputs["Curve"])
            link(circle.outputs["Curve"], thick.inputs["Profile Curve"])
        else:
            ball, thick, real = new("GeometryNodeMeshIcoSphere"), new("GeometryNodeInstanceOnPoints"), new("GeometryNodeRealizeInstances")
            ball.inputs["Radius"].default_value = radius
            ball.inputs["Subdivisions"].default_value = 3
            link(start.outputs[0], thick.inputs["Points"])
            link(ball.outputs["Mesh"], thick.inputs["Instance"])
            link(thick.outputs[0], real.inputs[0])
            thick = real
        link(thick.outputs[0], smooth.inputs["Geometry"])
        link(smooth.outputs[0], material.inputs["Geometry"])
        link(material.outputs[0], end.inputs[0])
        made.modifiers.new("thick", "NODES").node_group = tree

    def ground(self, lowest):
        given = self.view["ground"]
        height = lowest if given["at"] is None else given["at"]
        mesh = self.bpy.data.meshes.new("ground")
        z = (height - self.middle[2]) * self.unit - 1e-4
        mesh.from_pydata([(-50, -50, z), (50, -50, z), (50, 50, z), (-50, 50, z)], [], [(0, 1, 2, 3)])
        made = self.add("ground", mesh)
        if given["colour"] is None:
            made.is_shadow_catcher = True
            # It shows shadows, but is no floor: as in the browser's picture, objects are lit by the sky below them.
            made.visible_diffuse = made.visible_glossy = made.visible_transmission = False
        else:
            mesh.materials.append(self.material("ground", {"roughness": 0.8}, linear(given["colour"])))

    def light(self):
        """Lights the scene as report/src/sky.js and studio.js do."""
        bpy, light = self.bpy, self.view["light"]
        world = bpy.data.worlds.new("sky")
        self.scene.world = world
        world.use_nodes = True
        nodes, link = world.node_tree.nodes, world.node_tree.links.new
        # The radiance grows with the z of the direction, from the horizon's.
        direction, parts, above, radiance = nodes.new("ShaderNodeTexCoord"), nodes.new("ShaderNodeSeparateXYZ"), nodes.new("ShaderNodeMath"), nodes.new("ShaderNodeMath")
        above.operation, radiance.operation = "MAXIMUM", "MULTIPLY_ADD"
        above.inputs[1].default_value = 0
        radiance.inputs[1].default_value = light["zenith"] - light["horizon"]
        radiance.inputs[2].default_value = light["horizon"]
        link(direction.outputs["Generated"], parts.inputs[0])
        link(parts.outputs["Z"], above.inputs[0])
        link(above.outputs[0], radiance.inputs[0])
        link(radiance.outputs[0], nodes["Background"].inputs["Strength"])
        nodes["Background"].inputs["Color"].default_value = (1, 1, 1, 1)
        sun = bpy.data.lights.new("sun", "SUN")
        sun.energy, sun.angle = light["sun"], math.radians(light["sun_angle"])
        self.sun = self.add("sun", sun)

    def set(self, sample):
        """Places objects, camera and sun of a sample."""
        from mathutils import Vector

        for o, made in self.shapes:
            x = self.placed(self.run.positions(o, sample)).astype(np.float32).ravel()
            made.data.vertices.foreach_set("co", x)
            made.data.update()
        if self.view["section"]:
            for o, made in self.shapes:
                if o["face_sizes"]:
                    made.hide_render = False
                    self.bpy.context.view_layer.update()
                    self.cut(made).visible_shadow = made.visible_shadow
                    made.hide_render = True
        view = self.view["camera"]
        boxes = []
        for run in self.runs:
            own = int(np.argmin(np.abs(run.times - self.run.times[sample])))
            boxes.append(run.box({"run": range(len(run.times)), "first": [0], "last": [len(run.times) - 1]}.get(view["fit"], [own])))
        low, high = np.min([b[0] for b in boxes], 0), np.max([b[1] for b in boxes], 0)
        width, height = self.size()
        position, target = (self.placed(p) for p in camera_of(view, self.run, low, high, width / height))
        back = Vector(position - target)
        lens = self.camera.data
        lens.sensor_fit = "VERTICAL"
        lens.angle = math.radians(view["angle"])
        lens.clip_start, lens.clip_end = 1e-3 * back.length, 100 + back.length
        self.camera.location = position
        self.camera.rotation_euler = back.to_track_quat("Z", "Y").to_euler()
        back.normalize()
        side = Vector((0, 0, 1)).cross(back)
        side = side.normalized() if side.length > 1e-3 else Vector((1, 0, 0))
        self.sun.rotation_euler = (1.1 * Vector((0, 0, 1)) + 0.8 * back - 0.55 * side).to_track_quat("Z", "Y").to_euler()

    def draw(self, sample, path):
        """Renders a sample, lays it over the background and writes the time on it."""
        bpy, s = self.bpy, self.scene
        self.set(sample)
        time = f"t = {self.run.times[sample]:.4g} s" if self.view["time"] else ""
        s.render.use_stamp = bool(time or self.label)
        for part in ("camera", "date", "filename", "frame", "hostname", "lens", "marker", "memory", "render_time", "scene", "sequencer_strip", "time", "frame_range"):
            if hasattr(s.render, "use_stamp_" + part):
                setattr(s.render, "use_stamp_" + part, False)
        s.render.use_stamp_note = True
        s.render.use_stamp_labels = False
        s.render.stamp_note_text = ", ".join(text for text in (self.label, time) if text)
        s.render.stamp_font_size = max(12, round(20 * self.view["size"][1] / 720))
        s.render.stamp_background = (0, 0, 0, 0)
        dark = self.view["background"] != "transparent" and linear(self.view["background"]) @ [0.3, 0.6, 0.1] < 0.3
        s.render.stamp_foreground = (0.95, 0.95, 0.95, 1) if dark else (0.1, 0.1, 0.1, 1)
        s.render.filepath = path
        bpy.ops.render.render(write_still=True)

    def compose(self):
        """Applies exposure and tone to what is drawn and lays it over the background, which keeps its colour."""
        view, s = self.view, self.scene
        s.use_nodes = True
        tree = s.node_tree
        tree.nodes.clear()
        new, link = tree.nodes.new, tree.links.new
        drawn = new("CompositorNodeRLayers").outputs["Image"]

        def append(kind, **settings):
            nonlocal drawn
            node = new(kind)
            for key, value in settings.items():
                setattr(node, key, value)
            link(drawn, node.inputs["Image"])
            drawn = node.outputs["Image"]
            return node

        if view["exposure"] != 1:
            append("CompositorNodeExposure").inputs["Exposure"].default_value = math.log2(view["exposure"])
        if view["tone"] == "filmic":  # of colours that are not multiplied by their alpha; the view transform Standard inverts the last step
            append("CompositorNodePremulKey", mapping="PREMUL_TO_STRAIGHT")
            append("CompositorNodeConvertColorSpace", from_color_space="Linear", to_color_space="Filmic sRGB")
            append("CompositorNodeConvertColorSpace", from_color_space="sRGB", to_color_space="Linear")
            append("CompositorNodePremulKey", mapping="STRAIGHT_TO_PREMUL")
        if view["background"] != "transparent":
            over = new("CompositorNodeAlphaOver")
            over.inputs[1].default_value = (*linear(view["background"]), 1)
            link(drawn, over.inputs[2])
            drawn = over.outputs["Image"]
        link(drawn, new("CompositorNodeComposite").inputs["Image"])


def join_side_by_side(parts, path):
    """Writes pictures of the same height as one."""
    import bpy

    pixels = []
    for part in parts:
        image = bpy.data.images.load(part)
        width, height = image.size
        values = np.empty(width * height * 4, np.float32)
        image.pixels.foreach_get(values)
        pixels.append(values.reshape(height, width, 4))
        bpy.data.images.remove(image)
    joined = np.concatenate(pixels, 1)
    image = bpy.data.images.new("joined", joined.shape[1], joined.shape[0], alpha=True)
    image.pixels.foreach_set(joined.ravel())
    image.file_format, image.filepath_raw = "PNG", path
    image.save()
    bpy.data.images.remove(image)


def main():
    view_file, output, *folders = sys.argv[sys.argv.index("--") + 1:]
    with open(view_file) as file:
        view = json.load(file)
    runs = [Run(folder) for folder in folders]
    set_looks(runs, view["objects"])
    labels = view["labels"] or [""] * len(runs)
    numbered = "times" in view  # those of a film
    if numbered:
        times = view["times"]
    else:
        times = [runs[0].times[-1] if view["at"] is None else view["at"]]
    with tempfile.TemporaryDirectory() as scratch:
        def part(i, k):
            if len(runs) == 1:
                return numbered_picture(output, i) if numbered else output
            return os.path.join(scratch, f"{i}_{k}.png")

        for k, run in enumerate(runs):  # Blender has one scene at a time
            drawing = Drawing(run, runs, view, labels[k])
            drawing.compose()
            for i, time in enumerate(times):
                last = not numbered and view["at"] is None
                drawing.draw(len(run.times) - 1 if last else int(np.argmin(np.abs(run.times - time))), part(i, k))
                if numbered:
                    print(f"frame {i + 1} of {len(times)}", flush=True)
        if len(runs) > 1:
            for i in range(len(times)):
                join_side_by_side([part(i, k) for k in range(len(runs))], numbered_picture(output, i) if numbered else output)


try:
    main()
except SystemExit as error:
    # Blender ends with 0 unless it is told otherwise.
    print(error, file=sys.stderr)
    sys.stdout.flush()
    os._exit(2)
except Exception:
    import traceback

    traceback.print_exc()
    sys.stdout.flush()
    os._exit(3)
