"""What compare_benches.py finds between two files."""

import json
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

SCRIPT = Path(__file__).parents[2] / "scripts" / "compare_benches.py"


def compare(before, after, *options):
    with tempfile.TemporaryDirectory() as folder:
        paths = [Path(folder) / name for name in ("before.json", "after.json")]
        for path, rows in zip(paths, (before, after)):
            path.write_text(json.dumps({"rows": rows}), encoding="utf-8")
        return subprocess.run(
            [sys.executable, SCRIPT, *paths, *options], capture_output=True, text=True, check=False
        )


ROW = {"object": "sphere", "shader": "noise", "minification": 4, "method": "map", "rmse_interior": 0.01, "pixels": 900}


class CompareBenches(unittest.TestCase):
    def test_the_same_file_has_nothing_to_say(self):
        result = compare([ROW], [ROW])
        self.assertEqual(result.returncode, 0)
        self.assertIn("1 figures, 0 beyond", result.stdout)

    def test_what_grew_beyond_the_limit_is_named(self):
        result = compare([ROW], [ROW | {"rmse_interior": 0.0112}])
        self.assertEqual(result.returncode, 1)
        self.assertIn("noise", result.stdout)
        self.assertIn("1.12 times", result.stdout)

    def test_what_grew_less_or_shrank_is_not(self):
        self.assertEqual(compare([ROW], [ROW | {"rmse_interior": 0.0109}]).returncode, 0)
        self.assertEqual(compare([ROW], [ROW | {"rmse_interior": 0.001}]).returncode, 0)
        self.assertEqual(compare([ROW], [ROW | {"rmse_interior": 0.015}], "--limit", "2").returncode, 0)

    def test_rows_are_matched_by_their_names_not_their_order(self):
        other = ROW | {"minification": 8, "rmse_interior": 0.1}
        self.assertEqual(compare([ROW, other], [other, ROW]).returncode, 0)

    def test_a_row_that_is_gone_is_a_complaint(self):
        other = ROW | {"minification": 8}
        result = compare([ROW, other], [ROW])
        self.assertEqual(result.returncode, 1)
        self.assertIn("is gone", result.stdout)

    def test_times_can_be_left_out(self):
        slow = [{"name": "a", "seconds_per_frame": 1, "bytes": 5}], [{"name": "a", "seconds_per_frame": 9, "bytes": 5}]
        self.assertEqual(compare(*slow).returncode, 1)
        self.assertEqual(compare(*slow, "--no-times").returncode, 0)

    def test_a_file_without_figures_is_refused(self):
        self.assertNotEqual(compare([], [ROW]).returncode, 0)


if __name__ == "__main__":
    unittest.main()
