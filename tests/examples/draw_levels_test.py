"""The example draws every level, and the README shows what is compiled."""

import os
import pathlib
import re
import struct
import subprocess
import tempfile
import unittest
import zlib

SOURCE = pathlib.Path(__file__).resolve().parents[2]
PROGRAM = os.environ["PSTRIPS_DRAW_LEVELS"]
SIDE = 320
PAPER = b"\xfa\xfa\xfa"


def panels(png):
    """The pixels of each panel of a picture, rows of three bytes a pixel."""
    width, height = struct.unpack(">II", png[16:24])
    start = png.index(b"IDAT")
    (size,) = struct.unpack(">I", png[start - 4 : start])
    rows = zlib.decompress(png[start + 4 : start + 4 + size])
    stride = 1 + 3 * width
    lines = [rows[stride * y + 1 : stride * (y + 1)] for y in range(height)]
    return [
        b"".join(line[3 * SIDE * i : 3 * SIDE * (i + 1)] for line in lines)
        for i in range(width // SIDE)
    ]


def drawn(panel):
    """How many pixels are not paper."""
    return sum(panel[i : i + 3] != PAPER for i in range(0, len(panel), 3))


def without_indentation(text):
    return [line.strip() for line in text.splitlines()]


class DrawLevels(unittest.TestCase):
    def draw(self, file):
        with tempfile.TemporaryDirectory() as folder:
            out = pathlib.Path(folder) / "out.png"
            done = subprocess.run([PROGRAM, file, out], capture_output=True, text=True, check=False)
            return done, out.read_bytes()

    def test_draws_each_level(self):
        done, png = self.draw(SOURCE / "tests/data/golden/example.pstrip")
        self.assertEqual(done.returncode, 0, done.stderr)
        levels = panels(png)
        self.assertEqual(len(levels), len(done.stdout.splitlines()))
        self.assertGreaterEqual(len(levels), 2)
        for level in levels:
            self.assertGreater(drawn(level), 100)

    def test_draws_the_base_of_a_file_without_packets(self):
        done, png = self.draw(SOURCE / "tests/data/valid/faces.pstrip")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertGreater(drawn(panels(png)[0]), 100)

    def test_says_what_is_wrong(self):
        done, _ = self.draw(SOURCE / "README.md")
        self.assertEqual(done.returncode, 1)
        self.assertIn("signature", done.stderr)


class Readme(unittest.TestCase):
    def test_shows_what_is_compiled(self):
        blocks = re.findall(r"```cpp\n(.*?)```", (SOURCE / "README.md").read_text(), re.DOTALL)
        self.assertGreaterEqual(len(blocks), 1)
        example = without_indentation((SOURCE / "examples/draw_levels.cpp").read_text())
        for block in blocks:
            lines = without_indentation(block)
            found = any(
                example[i : i + len(lines)] == lines for i in range(len(example) - len(lines) + 1)
            )
            self.assertTrue(found, block)


if __name__ == "__main__":
    unittest.main()
