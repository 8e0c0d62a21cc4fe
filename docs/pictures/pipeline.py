#!/usr/bin/env python3
"""Draws docs/images/pipeline.svg: the path of a simulation through the folders. Run: docs/pictures/pipeline.py"""
import pathlib

WIDTH, HEIGHT = 980, 640
INK = "#334155"
COLOURS = {  # fill, edge
    "input": ("#e0f2fe", "#0369a1"),
    "loop": ("#fef3c7", "#b45309"),
    "potential": ("#ede9fe", "#6d28d9"),
    "contact": ("#dcfce7", "#15803d"),
    "results": ("#fee2e2", "#b91c1c"),
}
MONO = 'font-family="DejaVu Sans Mono, monospace"'

out = [
    f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH} {HEIGHT}" width="{WIDTH}" height="{HEIGHT}" font-family="DejaVu Sans, Helvetica, Arial, sans-serif"'
    ' role="img" aria-label="The path of a simulation: scene, world, step, minimiser, contact, results">',
    f'<defs><marker id="a" viewBox="0 0 10 10" refX="9" refY="5" markerWidth="7" markerHeight="7" orient="auto-start-reverse"><path d="M0 0L10 5L0 10z" fill="{INK}"/></marker></defs>',
    f'<rect width="{WIDTH}" height="{HEIGHT}" fill="#ffffff"/>',
]


def text(x, y, size, words, colour, more='text-anchor="middle"'):
    out.append(f'<text x="{x}" y="{y}" font-size="{size}" fill="{colour}" {more}>{words}</text>')


def box(x, y, w, h, kind, title, lines, folder=None):
    fill, edge = COLOURS[kind]
    middle = x + w / 2
    out.append(f'<rect x="{x}" y="{y}" width="{w}" height="{h}" rx="7" fill="{fill}" stroke="{edge}" stroke-width="1.5"/>')
    text(middle, y + 22, 15, title, "#0f172a", 'text-anchor="middle" font-weight="bold"')
    for i, line in enumerate(lines):
        text(middle, y + 41 + 17 * i, 12.5, line, "#1e293b")
    if folder:
        text(middle, y + h - 9, 11.5, folder, edge, f'text-anchor="middle" {MONO}')


def arrow(*points, both=False):
    path = "M" + " L".join(f"{x} {y}" for x, y in points)
    start = ' marker-start="url(#a)"' if both else ""
    out.append(f'<path d="{path}" fill="none" stroke="{INK}" stroke-width="1.7" marker-end="url(#a)"{start}/>')


def label(x, y, words, anchor="start"):
    text(x, y, 12, words, INK, f'text-anchor="{anchor}"')


# From the file to the world.
box(20, 20, 200, 92, "input", "Scene file", ["YAML, meshes, tables"], "experiments/")
box(300, 20, 220, 92, "input", "Specification", ["typed, checked, SI units"], "config, scene, experiment")
box(600, 20, 360, 92, "input", "World", ["bodies, unknowns, terms, contact, motions"], "setup, world, body, motion")
arrow((220, 66), (298, 66))
label(259, 58, "parse", "middle")
arrow((520, 66), (598, 66))
label(559, 58, "build", "middle")

# The time loop.
out.append('<rect x="20" y="150" width="940" height="150" rx="9" fill="#fffbeb" stroke="#b45309" stroke-dasharray="6 4"/>')
text(150, 171, 13, "Time loop: one step of size h", "#b45309", 'font-weight="bold"')
text(946, 171, 11.5, "framework/stepping", "#b45309", f'text-anchor="end" {MONO}')
arrow((780, 112), (780, 128), (130, 128), (130, 181))
box(40, 183, 180, 82, "loop", "Open", ["predict x~, move", "prescribed vertices"])
box(280, 183, 180, 82, "loop", "Minimise", ["Newton direction,", "step bound, line search"])
box(520, 183, 180, 82, "loop", "Verify", ["intersection, inversion,", "tunnelling, energy"])
box(760, 183, 180, 82, "loop", "Commit", ["x, v, history of terms", "become the state"])
arrow((220, 224), (278, 224))
arrow((460, 224), (518, 224))
arrow((700, 224), (758, 224))
label(729, 216, "accepted", "middle")
arrow((610, 265), (610, 285), (130, 285), (130, 267))
label(480, 280, "rejected: smaller steps, no trace left", "middle")

# What a minimiser asks for.
box(40, 350, 200, 104, "contact", "Step bound", ["CCD: no pair passes", "volume: no tet inverts"], "solvers/filters")
box(280, 350, 220, 104, "potential", "Incremental potential", ["E(q), gradient,", "projected Hessian"], "framework/assembly")
box(540, 350, 180, 104, "potential", "Terms", ["elasticity, loads, joints,", "damping, your own"], "energies")
arrow((345, 265), (345, 348), both=True)
label(352, 332, "evaluate at q")
arrow((300, 265), (300, 310), (140, 310), (140, 348), both=True)
label(150, 328, "largest feasible step")
arrow((540, 402), (502, 402))

# Contact.
box(40, 500, 200, 110, "contact", "Broad phase", ["fat boxes: pairs that may", "come close"], "geometry/broad_phase")
box(280, 500, 220, 110, "contact", "Narrow phase", ["quadrature points, areas,", "stencils closer than the range"], "framework/contact")
box(540, 500, 180, 110, "contact", "Contact terms", ["barrier + adhesion,", "friction, bonds"], "contact, bond")
arrow((240, 555), (278, 555))
arrow((500, 555), (538, 555))
arrow((630, 500), (630, 478), (420, 478), (420, 456))
arrow((140, 500), (140, 456))
label(148, 482, "candidates")

# Results.
box(760, 350, 200, 260, "results", "Results",
    ["steps.csv, probes.csv", "frames (VTK)", "summary.json", "checkpoints", "", "report, view, plot,", "batch, calibrate, compare"], "output, run, app")
arrow((850, 265), (850, 348))
label(858, 332, "record")

out.append("</svg>")
(pathlib.Path(__file__).resolve().parent.parent / "images/pipeline.svg").write_text("\n".join(out) + "\n", encoding="utf-8")
