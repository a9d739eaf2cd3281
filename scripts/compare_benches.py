#!/usr/bin/env python3
"""Says what got slower, larger or worse between two JSON files of the same bench.

usage: compare_benches.py BASELINE.json NEW.json [--limit 1.1] [--no-times]

Takes what `redmap bench ... --json` and scripts/measure_guards.py write. Rows are matched by what names them (object,
shader, method, minification and the like), and their figures compared by ratio; less is better in all that are
compared. Prints one line for each that grew beyond the limit, and for each row that is gone. Exits with 1 if there is
any. Seconds only mean something on the same, otherwise idle machine: --no-times leaves them out."""

import argparse
import json
import re
import sys
from pathlib import Path

# What names a row, beside all texts in it.
LABELS = {"minification", "spp", "frames", "triangles"}
# Figures of which less is better. Anything else says nothing about better and worse.
WORSE_IF_LARGER = re.compile(
    r"seconds|rms|rmse|error|flip|flicker|bytes|calls|lookups|rays_per|residual|instructions|bound$|^basis$|^value$"
)
TIMES = re.compile(r"seconds")
# Below it, errors are nothing but noise of references.
NEGLIGIBLE = 1e-5


def is_figure(value):
    return isinstance(value, (int, float)) and not isinstance(value, bool)


def name_of(row):
    return " ".join(f"{row[key]}" for key in sorted(row) if isinstance(row[key], str) or (key in LABELS and row[key]))


def figures_of(path, with_times):
    """(row, figure) -> number, of all rows in the file."""
    rows = json.loads(Path(path).read_text(encoding="utf-8"))["rows"]
    figures = {}
    for row in rows:
        for key, value in row.items():
            wanted = WORSE_IF_LARGER.search(key) and key not in LABELS and (with_times or not TIMES.search(key))
            if wanted and is_figure(value):
                figures[name_of(row), key] = value
    return figures


def complaints(before, after, limit):
    lines = []
    for key, old in sorted(before.items()):
        label = " ".join(part for part in key if part != "value")
        if key not in after:
            lines.append(f"{label}: was {old:g}, is gone")
        elif after[key] > limit * max(old, NEGLIGIBLE):
            lines.append(f"{label}: was {old:g}, is {after[key]:g}: {after[key] / max(old, NEGLIGIBLE):.2f} times")
    return lines


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("baseline")
    parser.add_argument("new")
    parser.add_argument("--limit", type=float, default=1.1)
    parser.add_argument("--no-times", action="store_true")
    options = parser.parse_args()
    before = figures_of(options.baseline, not options.no_times)
    after = figures_of(options.new, not options.no_times)
    if not before:
        sys.exit(f"{options.baseline}: expected rows with figures, found none")
    lines = complaints(before, after, options.limit)
    print("\n".join(lines + [f"{len(before)} figures, {len(lines)} beyond {options.limit:g} times"]))
    return 1 if lines else 0


if __name__ == "__main__":
    sys.exit(main())
