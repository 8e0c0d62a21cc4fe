#!/usr/bin/env python3
"""What a feature costs the bodies that do not name it.

    python3 tests/bench/bystanders.py [--tack build/release/bin/tack] [--pairs 5] [--only NAME ...] [--scenes NAME ...]

Two boxes, 3 m beside a scene, name one feature after another; the scene does not. Each run is paired with one in which the same boxes name
nothing: processor seconds of the steps after the first, on one thread, in turns. The table has the median of the ratios and Newton
iterations; its first rows have what the boxes alone cost, and the same run twice, which shows how exact a ratio is.
"""
import argparse
import csv
import os
import pathlib
import statistics
import subprocess
import tempfile

root = pathlib.Path(__file__).resolve().parent.parent.parent

fine = "shape: {type: box, size: [0.2, 0.2, 0.2], cells: [19, 19, 19]}"
scenes = {  # scene: steps, and what the scene has in place of its own, so that the boxes are small beside it
    "stack/two_blocks": (16, f"objects: [{{name: lower, {fine}}}, {{name: upper, {fine}}}]\n"),
    "twist/cloth": (16, ""),
    "stack/pile": (4, ""),
}

plain = """
objects:
  - name: seat
    shape: {type: box, size: [0.04, 0.01, 0.04], cells: [4, 1, 4]}
    place: {translate: [3, -0.005, 0]}
    motion: [fixed]
  - name: rider
    shape: {type: box, size: [0.02, 0.02, 0.02], cells: [2, 2, 2]}
    place: {translate: [3, 0.011, 0]}
    energies: [{type: neo_hookean, young: 0.1 MPa, poisson: 0.4, density: 1000}]
    loads: [{type: body_force, value: [0, -9.81, 0]}]
"""


def rider(text):
    """The boxes, with these keys of the one above in place of its own."""
    return plain.replace("    energies: [{type: neo_hookean, young: 0.1 MPa, poisson: 0.4, density: 1000}]\n", text)


def pair(text):
    return plain + "contact: {pairs: [{between: [seat, rider], " + text + "}]}\n"


features = {  # feature: what the two boxes name
    "the same again": plain,
    "friction": pair("friction: {mu: 0.5, eps_v: 1 cm/s}"),
    "adhesion": pair("adhesion: {type: fang, peak_traction: 1 kPa}"),
    "tangential adhesion": pair("adhesion: {type: fang, peak_traction: 1 kPa}, tangential_adhesion: {mu: 0.5, eps_a: 1 mm/s}"),
    "bonds": pair("bond_distance: 1.5 mm, adhesion: {type: rcc, normal_stiffness: 1e6 Pa/m, tangential_stiffness: 5e5 Pa/m, work_of_adhesion: 1 J/m^2}"),
    "no contact of the pair": pair("contact: false"),
    "another material": rider("    energies: [{type: stvk_hencky, young: 0.1 MPa, poisson: 0.4, density: 1000}]\n"),
    "plasticity": rider("    energies: [{type: von_mises, young: 0.1 MPa, poisson: 0.4, density: 1000, yield_stress: 10 kPa}]\n"),
    "damping": rider("    energies: [{type: neo_hookean, young: 0.1 MPa, poisson: 0.4, density: 1000}]\n    damping: {mass: 5, stiffness: 1 ms}\n"),
    "composite elements": rider("    energies: [{type: neo_hookean, young: 0.1 MPa, poisson: 0.4, density: 1000}]\n    elements: composite\n"),
    "affine body": rider("    body: {type: affine, density: 1000}\n"),
    "pressure": plain.replace("loads: [", "loads: [{type: pressure, value: 100 Pa}, "),
    "spring": plain + """interactions:
  - {name: link, type: spring, from: {object: seat}, to: {object: rider}, stiffness: 10}
""",
    "prescribed motion": plain.replace("motion: [fixed]", "motion: [{type: translate, velocity: [0.01, 0, 0]}]"),
    "rod": plain + """  - name: rod
    shape: {type: segment, length: 0.2, edges: 10}
    place: {translate: [5, 1, 0]}
    rod: {radius: 5 mm}
    energies: [{type: elastic_rod, young: 1 MPa, poisson: 0.3, density: 1000}]
""",
    "probe": plain + "probes: [{name: rider_height, type: centre_of_mass, object: rider, direction: [0, 1, 0]}]\n",
}


def seconds(scene, text, steps, folder):
    """Processor seconds and Newton iterations of so many steps of a scene with this text added."""
    file = folder / "scene.yaml"
    base = folder / "base.yaml"
    base.write_text(f"include: {root / 'experiments' / scene}.yaml\n{scenes[scene][1]}")
    file.write_text(f"include: {base}\nname: bystander\n{text}")
    out = folder / "results"
    command = [options.tack, "run", file, "--threads", "1", "-q", "-o", out, "--steps", steps, "--set", "output.frames=false", "expect=[]"]
    with open(folder / "log", "w") as log:
        child = subprocess.Popen([str(c) for c in command], stdout=log, stderr=log, cwd=root)
        _, status, usage = os.wait4(child.pid, 0)
        child.returncode = os.waitstatus_to_exitcode(status)
    if child.returncode != 0:
        raise SystemExit(f"{' '.join(map(str, command))}\n{file.read_text()}\n{(folder / 'log').read_text()}")
    with open(out / "steps.csv") as rows:
        iterations = sum(int(row["newton_iterations"]) for row in csv.DictReader(rows))
    return usage.ru_utime, iterations


def compare(scene, steps, text, reference, folder):
    """Medians over pairs of the ratio of seconds, and iterations of both."""
    start = [statistics.median(seconds(scene, t, 1, folder)[0] for _ in range(3)) for t in (text, reference)]
    ratios = []
    for turn in range(options.pairs):
        runs = [None, None]
        for i in (0, 1) if turn % 2 == 0 else (1, 0):
            spent, iterations = seconds(scene, steps=steps, text=(text, reference)[i], folder=folder)
            runs[i] = spent - start[i], iterations
        ratios.append(runs[0][0] / runs[1][0])
    return ratios, runs[0][1], runs[1][1]


def row(scene, name, found):
    ratios, with_it, without = found
    ratio = statistics.median(ratios)
    print(f"| `{scene}` | {name} | {ratio:.3f} [{min(ratios):.2f}-{max(ratios):.2f}] | {without} -> {with_it} | {ratio * without / with_it:.3f} |", flush=True)


parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
parser.add_argument("--tack", type=pathlib.Path, default=root / "build/release/bin/tack")
parser.add_argument("--pairs", type=int, default=5)
parser.add_argument("--only", nargs="+", choices=list(features), default=list(features), metavar="NAME")
parser.add_argument("--scenes", nargs="+", choices=list(scenes), default=list(scenes), metavar="NAME")
options = parser.parse_args()

print("| scene | feature of the two boxes | time with / without | Newton iterations | time an iteration |\n| --- | --- | --- | --- | --- |")
with tempfile.TemporaryDirectory() as name:
    folder = pathlib.Path(name)
    for scene in options.scenes:
        row(scene, "the boxes themselves", compare(scene, scenes[scene][0], plain, "", folder))
        for feature in options.only:
            row(scene, feature, compare(scene, scenes[scene][0], "\n" + features[feature], plain, folder))
