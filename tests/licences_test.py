"""Every file has a copyright and a licence (REUSE 3.0), and LICENSE is the text that is named."""

import pathlib
import shutil
import subprocess
import unittest

SOURCE = pathlib.Path(__file__).resolve().parents[1]


class Licences(unittest.TestCase):
    @unittest.skipUnless(shutil.which("reuse"), "reuse is not installed")
    def test_satisfy_reuse(self):
        lint = subprocess.run(["reuse", "--root", SOURCE, "lint"], capture_output=True, text=True)
        self.assertEqual(lint.returncode, 0, lint.stdout)

    def test_are_the_one_of_the_project(self):
        terms = lambda name: (SOURCE / name).read_text().split("\n\n", 2)[2]
        self.assertEqual(terms("LICENSE"), terms("LICENSES/BSD-2-Clause.txt"))
        self.assertIn("Copyright (c) the pstrips authors", (SOURCE / "LICENSE").read_text())


if __name__ == "__main__":
    unittest.main()
