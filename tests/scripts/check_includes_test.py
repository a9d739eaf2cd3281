#!/usr/bin/env python3
"""A tree against the dependency direction must be rejected, by file and line; one along it must pass."""

import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]


def check(files):
    """Runs the script on a tree of {path: text}; returns (exit status, lines of its output)."""
    with tempfile.TemporaryDirectory() as folder:
        for name, text in files.items():
            path = Path(folder) / name
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(text)
        done = subprocess.run([sys.executable, ROOT / "scripts/check_includes.py", folder], capture_output=True,
                              text=True, check=False)
        return done.returncode, done.stdout.splitlines()


class CheckIncludes(unittest.TestCase):
    def assert_rejected(self, name, included):
        status, lines = check({name: f"// first line\n#include \"{included}\"\n"})
        self.assertEqual(status, 1, f"{name} may not include {included}")
        self.assertTrue(lines[0].startswith(f"{name}:2: includes {included}"), lines)

    def assert_accepted(self, name, included):
        self.assertEqual(check({name: f"#include \"{included}\"\n"}), (0, []))

    def test_includes_against_the_direction_are_rejected(self):
        self.assert_rejected("src/base/image.h", "map/pyramid.h")
        self.assert_rejected("src/map/pyramid.cpp", "shader/shader.h")
        self.assert_rejected("src/shader/library/noise.cpp", "surface/mesh.h")
        self.assert_rejected("src/analysis/basis.cpp", "surface/mesh.h")
        self.assert_rejected("src/scene/scene.h", "bake/bake.h")
        self.assert_rejected("src/render/shade.cpp", "gpu/device.h")
        self.assert_rejected("src/gpu/device.cpp", "render/shade.h")
        self.assert_rejected("src/device/device.cpp", "shader/shader.h")
        self.assert_rejected("src/metrics/flip.cpp", "scene/scene.h")

    def test_includes_from_outside_the_library_are_rejected(self):
        self.assert_rejected("src/render/shade.cpp", "apps/cli/common.h")
        self.assert_rejected("src/base/image.cpp", "redmap.h")
        self.assert_rejected("src/base/image.cpp", "../map/pyramid.h")

    def test_includes_along_the_direction_are_accepted(self):
        self.assert_accepted("src/base/image.cpp", "base/image.h")
        self.assert_accepted("src/render/shade.cpp", "base/image.h")
        self.assert_accepted("src/bake/bake.cpp", "shader/shader.h")
        self.assert_accepted("src/base/image.cpp", "OpenEXR/ImfHeader.h")
        self.assert_accepted("src/shader/library.cpp", "library_table.h")
        self.assert_accepted("src/redmap.h", "render/renderer.h")
        self.assert_accepted("apps/cli/bake.cpp", "render/renderer.h")

    def test_every_bad_line_is_reported(self):
        status, lines = check({"src/base/a.h": '#include "map/a.h"\n\n#include <scene/b.h>\n', "src/lost/c.h": "\n"})
        self.assertEqual(status, 1)
        self.assertEqual([line.split(": ")[0] for line in lines], ["src/base/a.h:1", "src/base/a.h:3", "src/lost/c.h"])

    def test_this_repository_is_accepted(self):
        done = subprocess.run([sys.executable, ROOT / "scripts/check_includes.py", ROOT], capture_output=True, text=True,
                              check=False)
        self.assertEqual((done.returncode, done.stdout), (0, ""))


if __name__ == "__main__":
    unittest.main()
