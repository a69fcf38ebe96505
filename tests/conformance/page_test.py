"""The tables of the page: which channel a row shows, and that only the text between the marks changes."""

import os
import tempfile
import unittest

import lifted
import page
from renderers import RENDERERS

HERE = os.path.dirname(os.path.abspath(__file__))
PAGE = os.path.join(HERE, "..", "..", "docs", "results", "conformance.md")


def channel(ratio, low, high):
    return {"ratio": ratio, "low": low, "high": high}


JUDGED = {"scene": "a_room", "pictures": 32, "samples": 64, "integrator": "", "verdict": "PASS",
          "detectable": [0.001, 0.003, 0.002],
          "whole": [channel(1.0001, 1.0, 1.1), channel(0.998, 0.997, 0.999), channel(1.001, 1.0, 1.2)]}
REFUSED = {"scene": "a_spot", "verdict": "not exported", "reason": "no such light"}


class Rows(unittest.TestCase):
    def test_shows_the_channel_farthest_from_one_and_the_worst_detectable_error(self):
        self.assertEqual(page.row(JUDGED), "| `a_room` | 32 of 64 | PASS | 0.9980 | 0.9970 to 0.9990 | 0.30% |")

    def test_names_another_integrator(self):
        self.assertIn("| 32 of 64, `ptracer` |", page.row({**JUDGED, "integrator": "ptracer"}))

    def test_an_error_that_is_not_detectable_in_one_channel_is_unknown(self):
        self.assertTrue(page.row({**JUDGED, "detectable": [0.001, None, 0.002]}).endswith("| unknown |"))

    def test_a_scene_that_is_not_exported_has_its_reason(self):
        table = page.scenes({"version": "V", "scenes": [JUDGED, REFUSED]}, {"date": "D", "processor": "P"})
        self.assertIn("| `a_spot` | - | not exported | | | no such light |", table)


class Lifted(unittest.TestCase):
    def test_moves_all_three_lights_of_the_scene(self):
        with open(os.path.join(HERE, "..", "..", "scenes", "flush_lights.dae"), encoding="utf-8") as file:
            text = lifted.lifted(file.read(), 0.5)
        for node in ("-0.1 0.025 0.5", "-1 0.3 0.5", "0.1 0.05 1.0"):
            self.assertIn(f"<translate>{node}</translate>", text)


class Marks(unittest.TestCase):
    def test_only_the_text_between_the_marks_changes(self):
        text = "a\n<!-- conformance: begin x -->\nold\n<!-- conformance: end x -->\nb\n"
        self.assertEqual(page.between(text, "x", "new"), text.replace("old", "new"))

    def test_a_page_without_marks_is_an_error(self):
        with self.assertRaises(ValueError):
            page.between("a", "x", "new")

    def test_the_page_has_all_marks_once(self):
        explained = {"ball": [{"edges": 2, "predicted": 0.0, "measured": 1e-4, "error": 1e-4}],
                     "lamp": {"segments": 1, "unblocked": 2, "blocked_too_late": 3, "rows_below": 4, "pixels": 5, "lit": 6,
                              "share": 0.5},
                     "pixel": {"x": 7, "y": 8, "share": 0.1, "hits": 9.0, "predicted": 0.5,
                               "direct": {"mean": 0.25, "error": 0.125}, "all": {"mean": 1, "error": 2}},
                     "lifted": [{**JUDGED, "renderer": "one", "distance": 0.5}],
                     "roulette": [{"depth": None, "mean": 0.5, "error": 0.25}, {"depth": 3, "mean": 0.75, "error": 0.25}]}
        found = {"version": "V", "scenes": [JUDGED]}
        results = {"date": "D", "processor": "P", "renderers": {name: found for name in RENDERERS}, "explained": explained}
        with open(PAGE, encoding="utf-8") as file:
            text = file.read()
        with tempfile.NamedTemporaryFile("w+", encoding="utf-8", suffix=".md") as copy:
            copy.write(text)
            copy.flush()
            page.write_page(copy.name, results)
            with open(copy.name, encoding="utf-8") as file:
                written = file.read()
        self.assertIn("`a_room`", written)
        self.assertIn("+0.010% ± 0.010%", written)
        self.assertIn("6 of the 5 pixels", written)
        self.assertIn("| none | 0.5000 ± 0.2500 |\n| 3 | 0.7500 ± 0.2500 |", written)
        self.assertIn("| `one` | 0.5 | 32 of 64 | PASS | 0.9980 |", written)
        self.assertIn("of pixel (7, 8): 9.00 of 4096", written)
        self.assertIn("0.250000 ± 0.125000 at 2 edges, and 1.00000 ± 2.00000 at 6.", written)


if __name__ == "__main__":
    unittest.main()
