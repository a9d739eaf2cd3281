#!/usr/bin/env python3
"""Rejects includes against the dependency direction of the folders of src (the diagram in CONTRIBUTING.md).

usage: check_includes.py [ROOT]

Prints one line for each bad include, and exits with 1 if there is any."""

import re
import sys
from pathlib import Path

# Folder of src -> the folders whose headers it may include, besides its own and whatever those may include.
DIRECT = {
    "base": [],
    "device": ["base"],
    "surface": ["base"],
    "shader": ["base"],
    "map": ["lobes"],
    "metrics": ["base"],
    "user_shader": ["shader", "device"],
    "lobes": ["base"],
    "analysis": ["shader", "lobes"],
    "bake": ["surface", "analysis", "map"],
    "scene": ["surface", "user_shader", "map"],
    "render": ["scene"],
    "verify": ["render", "bake", "metrics"],
    "gpu": ["device", "scene", "bake"],
    "export": ["gpu"],
}
SOURCES = {".h", ".cpp", ".in"}
# The contents page of the library may include everything; nothing inside the library may include it.
CONTENTS_PAGE = "redmap.h"
INCLUDE = re.compile(r'^\s*#\s*include\s*["<]([^">]+)[">]')


def allowed_folders(folder):
    """`folder` and all it depends on."""
    found = {folder}
    for dependency in DIRECT[folder]:
        found |= allowed_folders(dependency)
    return found


def complaint(folder, included):
    """Why a file of src/`folder` may not include `included`, or None."""
    if included == CONTENTS_PAGE:
        return "nothing inside the library may include its contents page"
    if ".." in Path(included).parts:
        return "expected a path from src, found one with '..'"
    target = Path(included).parts[0] if len(Path(included).parts) > 1 else folder
    if target in ("apps", "bindings", "tests", "bench"):
        return f"src may not know {target}"
    if target in DIRECT and target not in allowed_folders(folder):
        return f"{folder} may only know {', '.join(sorted(allowed_folders(folder)))}"
    return None


def bad_includes(root):
    """One line for each bad include below `root`/src, in order of files and lines."""
    lines = []
    for path in sorted((root / "src").rglob("*")):
        inside = path.relative_to(root / "src")
        if path.suffix not in SOURCES or str(inside) == CONTENTS_PAGE:
            continue
        folder = inside.parts[0]
        if folder not in DIRECT:
            lines.append(f"{path.relative_to(root)}: the folder has no place in the diagram of check_includes.py")
            continue
        for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), 1):
            match = INCLUDE.match(line)
            reason = complaint(folder, match.group(1)) if match else None
            if reason:
                lines.append(f"{path.relative_to(root)}:{number}: includes {match.group(1)}, but {reason}")
    return lines


if __name__ == "__main__":
    complaints = bad_includes(Path(sys.argv[1] if len(sys.argv) > 1 else "."))
    print("\n".join(complaints), end="\n" if complaints else "")
    sys.exit(1 if complaints else 0)
