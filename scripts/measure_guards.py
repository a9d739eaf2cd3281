#!/usr/bin/env python3
"""Measures what guards compare: instructions, sizes and errors of a few small runs of the program, all the same from run
to run, so that a noisy machine does not matter.

usage: measure_guards.py REDMAP OUTPUT.json

Instructions are counted by valgrind (cachegrind without its caches), on one thread."""

import json
import re
import subprocess
import sys
import tempfile
from pathlib import Path

SCENE = """
[camera]
position = [0, 0, 4]
fov = 40
width = 32
height = 32
[light.key]
type = "point"
position = [4, 5, 6]
intensity = 60
[object.ball]
surface = "sphere"
shader = "{shader}"
map_size = 32
"""
# A basis of many reflectances, and bumps: all that bakes and frames do.
SHADERS = ["marble", "hammered_metal"]
METHODS = ["original", "map"]


def run(command):
    result = subprocess.run(command, capture_output=True, text=True, check=False)
    if result.returncode != 0:
        sys.exit(f"{' '.join(map(str, command))}: {result.stderr.strip().splitlines()[-1:]}")
    return result.stderr


def count_instructions(command):
    output = run(["valgrind", "--tool=cachegrind", "--cache-sim=no", "--cachegrind-out-file=/dev/null", *command])
    return int(re.search(r"I\s+refs:\s+([\d,]+)", output).group(1).replace(",", ""))


def read(path):
    return json.loads(Path(path).read_text(encoding="utf-8"))


def measure(redmap, shader, folder):
    """Rows of one shader: what was measured, and how much it is. Less is better everywhere."""
    scene = folder / f"{shader}.toml"
    scene.write_text(SCENE.format(shader=shader), encoding="utf-8")
    report = folder / "report.json"

    def redmap_once(*arguments):
        return [redmap, *map(str, arguments), "--threads", "1"]

    bake = redmap_once("bake", scene, "--json", report)
    rows = [(f"bake {shader}", "instructions", count_instructions(bake))]
    baked = read(report)["maps"][0]
    rows += [(f"bake {shader}", key, baked[key]) for key in ("basis", "bytes_in_memory", "residual")]
    for method in METHODS:
        picture = folder / f"{shader}_{method}.exr"
        render = redmap_once("render", scene, "-o", picture, "--method", method)
        rows.append((f"render {shader} {method}", "instructions", count_instructions(render)))
    run(redmap_once("verify", scene, "--spp", 256, "--json", report))
    rows.append((f"verify {shader}", "rms_error", read(report)["objects"][0]["all"]["rms_error"]))
    return [{"name": name, "figure": figure, "value": value} for name, figure, value in rows]


def main():
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    redmap = Path(sys.argv[1]).resolve()
    with tempfile.TemporaryDirectory() as folder:
        rows = [row for shader in SHADERS for row in measure(redmap, shader, Path(folder))]
    compiler = subprocess.run(["g++", "-dumpfullversion"], capture_output=True, text=True, check=False).stdout.strip()
    results = {"compiler": f"g++ {compiler}", "rows": rows}
    Path(sys.argv[2]).write_text(json.dumps(results, indent=1) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
