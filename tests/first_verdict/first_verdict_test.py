"""What ./run firstverdict prints: the lines that are counted, and the sums of the minutes."""

import os
import tempfile
import unittest
from types import SimpleNamespace

import first_verdict

MINUTES = {"clone": 0.1, "demo": 5.0, "builder": 1.0, "scene": 0.5, "renderer": 4.0}


class FirstVerdict(unittest.TestCase):
    def test_counts_lines_without_descriptions_comments_and_empty_lines(self):
        with tempfile.TemporaryDirectory() as folder:
            for name, text in (("a.py", '"""What\n\nit is."""\n\nimport os\n# why\nos.x()\n'), ("a.sh", "#!/bin/sh\n# why\nexec x\n")):
                with open(os.path.join(folder, name), "w", encoding="utf-8") as file:
                    file.write(text)
            self.assertEqual(first_verdict.lines_of(os.path.join(folder, "a.py")), 2)
            self.assertEqual(first_verdict.lines_of(os.path.join(folder, "a.sh")), 1)

    def test_sums_the_minutes_up_to_the_first_verdict(self):
        given = SimpleNamespace(ccache=False, largest=7, scenes=None)
        text = first_verdict.paragraph(given, MINUTES, {"load": [0, 0, 0], "busy": 0})
        self.assertIn("| **from clone to verdict** | **6.1** | **5.6** |", text)
        self.assertIn("| `check-renderer`, all scenes | | 4.0 |", text)

    def test_the_page_has_its_marks(self):
        with open(os.path.join(first_verdict.ROOT, "docs", "own-code.md"), encoding="utf-8") as file:
            page = file.read()
        self.assertEqual((page.count(first_verdict.BEGIN), page.count(first_verdict.END)), (1, 1))


if __name__ == "__main__":
    unittest.main()
