"""pstrips render: pictures of models and levels."""

import struct
import unittest
import zlib

from support import SOURCE, ProgramTest

TEXTURED = SOURCE / "tests/data/models/textured/charts.glb"


def pixels(png):
    """Rows of (r, g, b, a), of a PNG of eight bits and four channels."""
    assert png[:8] == b"\x89PNG\r\n\x1a\n"
    at, data = 8, b""
    while at < len(png):
        size, kind = struct.unpack(">I4s", png[at:at + 8])
        body = png[at + 8:at + 8 + size]
        if kind == b"IHDR":
            width, height, bits, colour = struct.unpack(">IIBB", body[:10])
            assert (bits, colour) == (8, 6)
        data += body if kind == b"IDAT" else b""
        at += size + 12
    raw, rows, before = zlib.decompress(data), [], bytes(4 * width)
    for y in range(height):
        method, line = raw[y * (4 * width + 1)], bytearray(raw[y * (4 * width + 1) + 1:(y + 1) * (4 * width + 1)])
        for i in range(len(line)):
            left = line[i - 4] if i >= 4 else 0
            above, corner = before[i], before[i - 4] if i >= 4 else 0
            estimate = left + above - corner
            paeth = min((abs(estimate - left), 0, left), (abs(estimate - above), 1, above), (abs(estimate - corner), 2, corner))[2]
            line[i] = (line[i] + (0, left, above, (left + above) // 2, paeth)[method]) & 255
        before = bytes(line)
        rows.append([tuple(before[i:i + 4]) for i in range(0, len(before), 4)])
    return rows


class Render(ProgramTest):
    def picture(self, *arguments):
        return pixels(self.run_program("render", *arguments, "-").out)

    def test_draws_colours_where_they_are(self):
        # A red square to the left of a green one, seen from the front.
        self.write("two.mtl", "newmtl red\nKd 1 0 0\nnewmtl green\nKd 0 1 0\n")
        model = self.write("two.obj", "mtllib two.mtl\n" + "".join(f"v {x} {y} 0\n" for x in (-1, 0, 1) for y in (-1, 1))
                           + "usemtl red\nf 1 3 4 2\nusemtl green\nf 3 5 6 4\n")
        rows = self.picture(model, "--turn", 0, "--tilt", 0, "--size", 64)
        self.assertEqual(len(rows), 64)
        left, right = rows[32][20], rows[32][44]
        self.assertTrue(left[0] > 200 and left[1] == 0 and left[3] == 255, left)
        self.assertTrue(right[1] > 200 and right[0] == 0 and right[3] == 255, right)
        self.assertEqual(rows[0][0][3], 0)
        # From behind they change sides; from above one sees their edge only.
        behind = self.picture(model, "--turn", 180, "--tilt", 0, "--size", 64)
        self.assertTrue(behind[32][20][1] > 200 and behind[32][44][0] > 200)

    def test_shows_textures(self):
        colours = {pixel[:3] for row in self.picture(TEXTURED, "--size", 128) for pixel in row if pixel[3] == 255}
        self.assertGreater(len(colours), 50)
        self.assertTrue(any(max(c) - min(c) > 100 for c in colours), "something is not grey")

    def test_frames_levels_as_the_full_model(self):
        strips = self.folder / "ball.pstrip"
        self.run_program("convert", TEXTURED, strips)
        covered = [sum(pixel[3] > 0 for row in self.picture(strips, *level, "--size", 128) for pixel in row)
                   for level in (("--level", 0), ())]
        self.assertAlmostEqual(covered[0] / covered[1], 1, delta=0.1)
        self.assertNotEqual(self.run_program("render", strips, "-", "--level", 0).out, self.run_program("render", strips, "-").out)

    def test_says_what_it_cannot_draw(self):
        points = self.write("points.obj", "v 0 0 0\nv 1 0 0\np 1 2\n")
        run = self.run_program("render", points, "-", code=5)
        self.assertIn("no triangles", run.err)
        run = self.run_program("render", TEXTURED, "-", "--level", 0, code=1)
        run = self.run_program("render", TEXTURED, "-", "--size", 0, code=1)


if __name__ == "__main__":
    unittest.main()
