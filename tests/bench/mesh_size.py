#!/usr/bin/env python3
"""Measures how the cost of a run grows with the size of its mesh: the tables of docs/performance.md, "Mesh size".

    python3 tests/bench/mesh_size.py [SCENE ...] [--sizes N ...] [--tack PROGRAM] [--results FOLDER] [--threads N] [--steps N] [--set KEY=VALUE ...]

Scenes are box (cells of an edge), cloth (triangles) and grains (number). Each runs as a process of its own for ten steps, with a frame for each
step and a checkpoint after five, so that reading, building and output are in the figures. It needs GNU/Linux and Python 3.9.
"""
import argparse
import csv
import json
import math
import os
import pathlib
import resource
import subprocess
import time

root = pathlib.Path(__file__).resolve().parents[2]


def box(n):
    """A cube of 1 MPa and 0.2 m that falls on an edge."""
    text = f"""
name: box
time: {{step: {step[box]} ms, duration: 1 s}}
gravity: [0, -9.81, 0]
objects:
  - {{name: floor, shape: {{type: box, size: [1, 0.05, 1]}}, place: {{translate: [0, -0.025, 0]}}, motion: [fixed]}}
  - name: box
    shape: {{type: box, size: [0.2, 0.2, 0.2], cells: [{n}, {n}, {n}]}}
    place: {{axis: [0, 0, 1], angle: 40 deg, translate: [0, 0.145, 0]}}
    velocity: [0, -1, 0]
    energies: [{{type: neo_hookean, young: 1 MPa, poisson: 0.4, density: 1000}}]
contact: {{distance: 1 mm, friction: {{mu: 0.5, eps_v: 1 cm/s}}}}
solver: {{type: projected_newton, tolerance: 1 mm/s}}
"""
    return text, 6 * n**3


def cloth(triangles):
    """A square cloth of 1 m that falls over a ball."""
    n = round(math.sqrt(triangles / 2))
    text = f"""
name: cloth
time: {{step: {step[cloth]} ms, duration: 1 s}}
gravity: [0, -9.81, 0]
objects:
  - {{name: ball, shape: {{type: sphere, radius: 0.2, cells: 10, surface: true}}, motion: [fixed]}}
  - name: cloth
    shape: {{type: grid, size: [1, 1], cells: [{n}, {n}]}}
    shell: {{thickness: 1 mm}}
    place: {{translate: [0, 0.202, 0], axis: [0, 1, 0], angle: 10 deg}}
    velocity: [0, -1, 0]
    energies:
      - {{type: stvk_membrane, young: 100 kPa, poisson: 0.3, density: 300}}
      - {{type: hinge_bending, young: 100 kPa, poisson: 0.3}}
contact: {{distance: 0.5 mm, friction: {{mu: 0.4, eps_v: 1 cm/s}}}}
solver: {{type: projected_newton, tolerance: 1 mm/s}}
"""
    return text, 2 * n * n


def grains(number):
    """Affine grains of 128 triangles, a heap 14 cm high, whose area grows with their number, that falls on a floor."""
    width = 0.025 * math.sqrt(number / 5)
    text = f"""
name: grains
time: {{step: {step[grains]} ms, duration: 1 s}}
gravity: [0, -9.81, 0]
objects:
  - {{name: floor, shape: {{type: box, size: [{width + 0.4}, 0.05, {width + 0.4}]}}, place: {{translate: [0, -0.025, 0]}}, motion: [fixed]}}
  - name: grain
    shape: {{type: revolve, profile_x: 0.016 * sqrt(s * (1 - s)), profile_y: 0.01 * (2 * s - 1), cells_profile: 9, cells_around: 8}}
    body: {{type: affine, density: 1000}}
    velocity: [0, -1, 0]
    fill: {{region: {{type: box, size: [{width}, 0.14, {width}], place: {{translate: [0, 0.072, 0]}}}}, count: {number}, clearance: 1.1 mm}}
contact: {{distance: 1 mm, friction: {{mu: 0.4, eps_v: 1 cm/s}}}}
solver: {{type: projected_newton, tolerance: 1 cm/s}}
"""
    return text, number


scenes = {box: [16, 32, 48, 64, 80], cloth: [100_000, 250_000, 1_000_000], grains: [200, 2000, 10_000]}
unit = {box: "tet", cloth: "triangle", grains: "grain"}
step = {box: 10, cloth: 5, grains: 2}  # ms
groups = {  # of the phases of summary.json
    "assembly": ["assembly", "projection"], "factorize": ["factorize"], "solve": ["solve"], "contact": ["broad_phase", "narrow_phase", "ccd"],
    "check": ["check"], "io": ["io"], "other": ["other", "line_search"]}


def measure(scene, size):
    """Runs a scene and returns its figures by name."""
    text, items = scene(size)
    name = f"{scene.__name__}_{size}"
    options.results.mkdir(parents=True, exist_ok=True)
    path, out = options.results / f"{name}.yaml", options.results / name
    path.write_text(text + f"output: {{checkpoint_interval: {5 * step[scene]} ms}}\n")  # a frame after each step
    command = [options.tack, "run", path, "-q", "-o", out, "--steps", options.steps, "--threads", options.threads]
    command += [word for entry in options.set for word in ("--set", entry)]
    began = time.monotonic()
    with open(f"{out}.log", "w") as log:
        child = subprocess.Popen([str(word) for word in command], stdout=log, stderr=log)
        _, status, usage = os.wait4(child.pid, 0)
        child.returncode = os.waitstatus_to_exitcode(status)
    seconds = time.monotonic() - began
    if child.returncode != 0:
        raise SystemExit(f"{' '.join(map(str, command))}\n{pathlib.Path(f'{out}.log').read_text()}")
    with open(out / "steps.csv") as table:
        steps = list(csv.DictReader(table))
    summary = json.loads((out / "summary.json").read_text())
    phases = {name: sum(summary["phases"][phase] for phase in of) for name, of in groups.items()}
    total = lambda column: sum(float(step[column]) for step in steps)
    frames = sum(file.stat().st_size for file in (out / "frames").iterdir())
    checkpoints = sum(file.stat().st_size for file in (out / "checkpoints").iterdir())
    iterations = total("newton_iterations")
    return {"size": size, "items": items, "wall": seconds, "user": usage.ru_utime, "system": usage.ru_stime, "kib": usage.ru_maxrss,
            "iterations": iterations / len(steps), "products": total("linear_iterations") / max(1, total("linear_solves")),
            "steps": total("wall_seconds"), "set_up": seconds - total("wall_seconds") - phases["io"], "frames": frames / len(os.listdir(out / "frames")),
            "checkpoints": checkpoints, **{f"s {name}": value for name, value in phases.items()}}


def exponent(first, last, value):
    """Returns p of value ~ items^p."""
    if value(first) <= 0 or value(last) <= 0 or first["items"] == last["items"]:
        return math.nan
    return math.log(value(last) / value(first)) / math.log(last["items"] / first["items"])


def print_table(scene, rows):
    phases = [name for name in rows[0] if name.startswith("s ")]
    columns = {"wall s": lambda r: r["wall"], "user s": lambda r: r["user"], "us/" + unit[scene]: lambda r: 1e6 * r["user"] / r["items"],
               "kB/" + unit[scene]: lambda r: 1.024 * r["kib"] / r["items"], "its/step": lambda r: r["iterations"],
               "products/system": lambda r: r["products"], "set-up s": lambda r: r["set_up"], "MB/frame": lambda r: r["frames"] / 1e6, "MB/checkpoint": lambda r: r["checkpoints"] / 1e6}
    columns |= {name[2:] + " s": lambda r, name=name: r[name] for name in phases}
    print(f"\n| {scene.__name__} | {unit[scene]}s | " + " | ".join(columns) + " |")
    print("| " + " | ".join(["---"] * (len(columns) + 2)) + " |")
    for row in rows:
        print(f"| {row['size']} | {row['items']} | " + " | ".join(f"{value(row):.3g}" for value in columns.values()) + " |")
    if len(rows) > 1:
        print("| exponent | | " + " | ".join(f"{exponent(rows[0], rows[-1], value):.2f}" for value in columns.values()) + " |")


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("scenes", nargs="*", choices=[[], *(scene.__name__ for scene in scenes)], help="default: all")
    parser.add_argument("--sizes", type=int, nargs="+", help="of one scene")
    parser.add_argument("--tack", type=pathlib.Path, default=root / "build/release/bin/tack")
    parser.add_argument("--results", type=pathlib.Path, default=root / "results/mesh_size")
    parser.add_argument("--threads", type=int, default=1)
    parser.add_argument("--steps", type=int, default=10)
    parser.add_argument("--set", action="append", default=[], metavar="KEY=VALUE", help="overrides a key of the scenes")
    options = parser.parse_args()
    for scene, sizes in scenes.items():
        if options.scenes and scene.__name__ not in options.scenes:
            continue
        rows = []
        for size in options.sizes or sizes:
            rows.append(measure(scene, size))
            print(f"{scene.__name__} {size}: {rows[-1]['wall']:.1f} s", flush=True)
        print_table(scene, rows)
