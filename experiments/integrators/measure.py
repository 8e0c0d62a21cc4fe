#!/usr/bin/env python3
"""Measures all time integrators on the scenes of this folder: the table of docs/theory/integrators_measured.md and its pictures in docs/images.

    python3 experiments/integrators/measure.py [--tack build/release/bin/tack] [--results results/integrators] [--only NAME ...] [--scenes NAME ...] [--plugin LIBRARY ...]

Needs NumPy and gnuplot. Seconds are processor seconds of runs on one thread, the fewest of three, less those of a run of one step.
With --only (integrators, also those of plugins) the table is printed and pictures stay in the results; with --scenes it is printed.
"""
import argparse
import csv
import importlib.util
import math
import os
import pathlib
import subprocess

import numpy as np

here = pathlib.Path(__file__).resolve().parent
root = here.parent.parent
spec = importlib.util.spec_from_file_location("frames", root / "python/tack/frames.py")
frames = importlib.util.module_from_spec(spec)
spec.loader.exec_module(frames)

integrators = {  # name: colour
    "implicit_euler": "#888888",
    "bdf2": "#d95f02",
    "newmark": "#1b9e77",
    "generalised_alpha": "#7570b3",
    "sdirk2": "#e7298a",
    "tr_bdf2": "#1f78b4",
}
colours_of_plugins = ["#a6761d", "#000000", "#66a61e", "#e31a1c"]
beam_steps = [4e-3, 2e-3, 1e-3, 0.5e-3, 0.25e-3]
resting_steps = [1.2e-3, 0.6e-3, 0.3e-3, 0.15e-3]
impact_steps = [5e-3, 2e-3, 1e-3, 0.5e-3]
bounce_steps = [4e-3, 2e-3, 1e-3, 0.5e-3, 0.25e-3, 0.125e-3, 0.0625e-3]
beam_level = 1e-4  # error of the beam, over its length, at which seconds are compared
bounce_level = 0.02  # and of the height of the bouncing block, over its width


class Run:
    def __init__(self, scene, integrator, step, duration=None, turns=1):
        """turns: runs, of whose seconds the fewest count."""
        out = options.results / f"{scene}_{integrator}_{step:g}{'' if duration is None else f'_{duration:g}'}"
        command = [options.tack, "run", here / f"{scene}.yaml", "--threads", "1", "-q", "-o", out, "--set", f"time.integrator={integrator}",
                   "--set", f"time.step={step!r} s", "--set", "expect=[]"]
        if duration is not None:
            command += ["--set", f"time.duration={duration!r} s"]
        if options.plugin:
            command += ["--set", f"plugins=[{', '.join(options.plugin)}]"]
        self.out, self.seconds = out, math.inf
        for _ in range(turns):
            with open(f"{out}.log", "w") as log:
                child = subprocess.Popen([str(c) for c in command], stdout=log, stderr=log, cwd=root)
                _, status, usage = os.wait4(child.pid, 0)
                child.returncode = os.waitstatus_to_exitcode(status)
            if child.returncode != 0:
                raise SystemExit(f"{' '.join(map(str, command))}\n{open(f'{out}.log').read()}")
            self.seconds = min(self.seconds, usage.ru_utime)
        self.probes, self.steps = self.table("probes.csv"), self.table("steps.csv")

    def table(self, name):
        with open(self.out / name) as file:
            rows = list(csv.reader(file))
        columns = {}
        for i, head in enumerate(rows[0]):
            try:
                columns[head.split(" ")[0]] = np.array([float(r[i]) for r in rows[1:]])
            except ValueError:
                pass
        return columns

    def end(self):
        return frames.Frame(max((self.out / "frames").glob("*.vtu")))


def order(errors, steps):
    return np.polyfit(np.log(steps), np.log(errors), 1)[0]


def seconds_at(level, points):
    """Processor seconds at an error, between points (step, error, seconds) of falling error."""
    for (_, coarse, less), (step, fine, more) in zip(points, points[1:]):
        if fine <= level <= coarse:
            fraction = math.log(coarse / level) / math.log(coarse / fine)
            return f"{less * (more / less) ** fraction:.2f}"
    return f"none: {points[-1][1]:.0e} at {1e3 * points[-1][0]:g} ms"


def made(energy):
    """Largest increase from any time to a later one."""
    return (energy - np.minimum.accumulate(energy)).max()


def angular_momentum(frame):
    mass = frame["mass"].reshape(-1, 1)
    x = frame.x - (mass * frame.x).sum(0) / mass.sum()
    return (mass * np.cross(x, frame["velocity"])).sum(0)


def precession():
    """Angle about the vertical of the top after 0.2 s [degrees], by Euler's equations of the symmetric top, per mass."""
    width, height, spin, lean, duration, dt = 0.1, 0.06, 100.0, math.radians(20), 0.2, 1e-6
    arm, axial = height / 2, width**2 / 6
    across = (width**2 + height**2) / 12 + arm**2
    angle, rate, turned = lean, 0.0, 0.0
    for _ in range(round(duration / dt)):
        turn = axial * spin * (math.cos(lean) - math.cos(angle)) / (across * math.sin(angle) ** 2)
        rate += dt * (turn * turn * math.sin(angle) * math.cos(angle) - axial * spin * math.sin(angle) * turn / across + 9.81 * arm * math.sin(angle) / across)
        angle += dt * rate
        turned += dt * turn
    return math.degrees(abs(turned))


def measure_beam(rows):
    reference = Run("beam", "newmark", 0.0625e-3).end()
    curves = {}
    for name in integrators:
        base = Run("beam", name, 1e-3, 1e-3, turns=3).seconds
        points = []
        for step in beam_steps:
            run = Run("beam", name, step, turns=3)
            frame = run.end()
            error = math.sqrt(((frame.x - reference.x) ** 2).sum(1).mean()) / 0.2
            points.append((step, error, max(run.seconds - base, 1e-3), run, frame))
        curves[name] = [(p[0], p[1], p[2]) for p in points]
        errors = [p[1] for p in points]
        middle = points[beam_steps.index(2e-3)]
        start = angular_momentum(frames.Frame(min((middle[3].out / "frames").glob("*.vtu"))))
        rows[name] |= {
            "order": order(errors[1:], beam_steps[1:]),
            "energy": middle[3].probes["energy"][-1] / middle[3].probes["energy"][0],
            "angular": np.linalg.norm(angular_momentum(middle[4]) - start) / np.linalg.norm(start),
            "seconds": seconds_at(beam_level, curves[name]),
        }
    draw("beam", "error at the end, over the length of the beam", "processor seconds",
         {n: [(e, s) for _, e, s in c] for n, c in curves.items()}, "set logscale xy\nset format x '10^{%L}'\nset key bottom left\n", "linespoints pt 7 ps 0.6")


def measure_resting(rows):
    reference = Run("resting", "newmark", 0.015e-3).probes["height"][-1]
    for name in integrators:
        errors = [abs(Run("resting", name, step).probes["height"][-1] - reference) for step in resting_steps]
        rows[name]["contact_order"] = order(errors, resting_steps)


def measure_bounce(rows):
    reference, curves = Run("bounce", "newmark", 2e-3 / 256).probes, {}
    for name in integrators:
        base = Run("bounce", name, 1e-3, 1e-3, turns=3).seconds
        curves[name], gain = [], 0
        for step in bounce_steps:
            run = Run("bounce", name, step, turns=3)
            heights = np.interp(run.probes["time"], reference["time"], reference["height"])
            gain = max(gain, made(np.append(0, -np.cumsum(run.steps["dissipated_numerics"]))) / run.probes["energy"][0])
            error = math.sqrt(((run.probes["height"] - heights) ** 2).mean()) / 0.1
            curves[name].append((step, error, max(run.seconds - base, 1e-3)))
        rows[name] |= {"bounce_seconds": seconds_at(bounce_level, curves[name]), "bounce_gain": gain}
    draw("bounce", "error of the height, over the width of the block", "processor seconds",
         {n: [(e, s) for _, e, s in c] for n, c in curves.items()}, "set logscale xy\nset format x '10^{%L}'\nset key bottom left\n", "linespoints pt 7 ps 0.6")


def measure_impact(rows):
    curves = {}
    for name in integrators:
        rebounds, gain = [], 0
        for step in impact_steps:
            run = Run("impact", name, step)
            energy = run.probes["energy"]
            gain = max(gain, made(energy) / energy[0])
            rebounds.append(run.probes["speed"][-1])
            if step == 1e-3:
                curves[name] = list(zip(1e3 * run.probes["time"], energy))
        rows[name] |= {"rebound": rebounds, "gain": gain}
    draw("impact", "time [ms]", "energy [J]", curves, "set yrange [0:0.55]\nset key right center\n")


def measure_top(rows):
    exact, curves = precession(), {}
    for name in integrators:
        run = Run("top", name, 1e-3)
        energy = run.probes["energy"]
        angle = math.degrees(abs(math.atan2(run.probes["centre_z"][-1], -run.probes["centre_x"][-1])))
        rows[name] |= {"top_energy": energy[-1] / energy[0], "precession": angle / exact - 1, "top_steps": len(run.steps["time"])}
        curves[name] = list(zip(1e3 * run.probes["time"], energy / energy[0]))
    draw("top", "time [ms]", "energy over that at the start", curves, "set yrange [0:1.05]\nset key bottom left\n")


def measure_creep(rows):
    curves = {}
    for name in integrators:
        run = Run("creep", name, 4e-3)
        t, v = run.probes["time"], run.probes["velocity"]
        rows[name]["creep"] = v[t > 0.3].max()
        curves[name] = list(zip(1e3 * t, 1e3 * v))
    draw("creep", "time [ms]", "velocity down the slope [mm/s]", curves, "set key bottom right\n")


def draw(name, x, y, curves, settings, style="lines"):
    script = (f"set terminal svg size 640,420 font 'sans,13' background rgb 'white'\nset output '{pictures}/integrators_{name}.svg'\n"
              f"set xlabel '{x}'\nset ylabel '{y}'\nset grid lc rgb '#dddddd'\nset border lc rgb '#444444'\n{settings}")
    script += "plot " + ", ".join(f"'-' with {style} lw 2 lc rgb '{integrators[n]}' title '{n}' noenhanced" for n in curves) + "\n"
    for points in curves.values():
        script += "".join(f"{a:.9g} {b:.9g}\n" for a, b in points) + "e\n"
    subprocess.run(["gnuplot"], input=script, text=True, check=True)
    subprocess.run(["python3", root / "docs/theory/images/thin_svg.py", pictures / f"integrators_{name}.svg"], check=True)


columns = [  # head, scene that it needs, cell
    ("order, free", "beam", lambda r: f"{r['order']:.2f}"),
    ("order, in contact", "resting", lambda r: f"{r['contact_order']:.2f}"),
    ("beam: energy kept at 2 ms", "beam", lambda r: f"{r['energy']:.4f}"),
    ("angular momentum lost", "beam", lambda r: f"{r['angular']:.1e}"),
    (f"seconds at an error of {beam_level:g}", "beam", lambda r: r["seconds"]),
    (f"bouncing: seconds at an error of {bounce_level:g}", "bounce", lambda r: r["bounce_seconds"]),
    ("rebound speed at " + ", ".join(f"{1e3 * h:g}" for h in impact_steps) + " ms [m/s]", "impact", lambda r: ", ".join(f"{s:.2f}" for s in r["rebound"])),
    ("energy made by the impact, largest of these", "impact", lambda r: f"{r['gain']:.4f}"),
    ("energy made by bouncing, largest of all steps", "bounce", lambda r: f"{r['bounce_gain']:.4f}"),
    ("top: energy kept", "top", lambda r: f"{r['top_energy']:.3f}"),
    ("error of its precession", "top", lambda r: f"{100 * r['precession']:.1f}%"),
    ("its steps", "top", lambda r: str(r["top_steps"])),
    ("creep [mm/s]", "creep", lambda r: f"{1e3 * r['creep']:.2f}"),
]


def table(rows):
    measured = [(head, cell) for head, scene, cell in columns if scene in options.scenes]
    lines = ["| " + " | ".join(["integrator", *(head for head, _ in measured)]) + " |", "|" + " --- |" * (len(measured) + 1)]
    for name, r in rows.items():
        lines.append("| " + " | ".join([f"`{name}`", *(cell(r) for _, cell in measured)]) + " |")
    return "\n".join(lines)


scenes = {"beam": measure_beam, "resting": measure_resting, "bounce": measure_bounce, "impact": measure_impact, "top": measure_top, "creep": measure_creep}
parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
parser.add_argument("--tack", default=root / "build/release/bin/tack")
parser.add_argument("--results", type=pathlib.Path, default=root / "results/integrators")
parser.add_argument("--only", nargs="+", help="integrators")
parser.add_argument("--scenes", nargs="+", choices=list(scenes), default=list(scenes))
parser.add_argument("--plugin", nargs="+", default=[], type=lambda path: str(pathlib.Path(path).resolve()), help="shared libraries")
options = parser.parse_args()
options.tack = pathlib.Path(options.tack).resolve()
options.results = options.results.resolve()
options.results.mkdir(parents=True, exist_ok=True)
if options.only:
    spare = iter(colours_of_plugins)
    integrators = {n: integrators.get(n) or next(spare) for n in options.only}
pictures = options.results if options.only else root / "docs/images"
rows = {name: {} for name in integrators}
for scene in options.scenes:
    scenes[scene](rows)
text = table(rows)
print(text)
page = root / "docs/theory/integrators_measured.md"
begin, end = "<!-- table: measure.py -->", "<!-- end of the table -->"
if page.exists() and not options.only and len(options.scenes) == len(scenes):
    content = page.read_text()
    page.write_text(content[: content.index(begin) + len(begin)] + "\n" + text + "\n" + content[content.index(end):])
