"""stripify of points and of tetrahedra."""

import random
import unittest

from support import CUBE, ProgramTest


def tetrahedra_of(text):
    """What the text of spec/tetra.md shows, each as its sorted vertices and its orientation."""
    lines = text.splitlines()
    assert lines[0] == "TetraStrips 1"
    for line in lines[1:]:
        words = line.split(" ")
        window = [int(word) for word in words[:4]]
        turned = False
        yield oriented(window)
        for word in words[4:]:
            place, vertex = (int(part) for part in word.split(":"))
            del window[place - 1]
            window.append(int(vertex))
            turned ^= place % 2 == 0
            yield oriented([window[1], window[0], *window[2:]] if turned else window)


def oriented(vertices):
    swaps = sum(a > b for i, a in enumerate(vertices) for b in vertices[i + 1:])
    return tuple(sorted(vertices)), swaps % 2


class Points(ProgramTest):
    def write_points(self, count=200):
        pick = random.Random(1)
        lines = [f"{pick.random()} {pick.random()} {pick.random()} 255 0 0" for _ in range(count)]
        self.write("points.xyz", "\n".join(lines) + "\n")

    def test_points_become_triangles_of_any_format(self):
        self.write_points()
        figures = self.report("stripify", "points.xyz", "--algorithm", "delaunay")
        self.assertEqual(figures["algorithm"], "delaunay")
        self.assertGreater(figures["triangles"], 2 * 200 - 2 - 40)
        for name in ("out.ply", "out.obj", "out.glb"):
            self.run_program("stripify", "points.xyz", "-o", name)
            again = self.report("stripify", name, "--algorithm", "sgi-strips")
            self.assertEqual(again["triangles"], figures["triangles"], name)

    def test_points_are_triangulated_by_whatever_stripifies_them(self):
        self.write_points()
        self.run_program("convert", "points.xyz", "points.ply")
        for name in ("points.xyz", "points.ply"):
            best = self.report("stripify", name)
            delaunay = self.report("stripify", name, "--algorithm", "delaunay")
            self.assertEqual((best["algorithm"], delaunay["algorithm"]), ("best", "delaunay"))
            self.assertEqual(best["triangles"], delaunay["triangles"])
            self.assertLess(best["indices_sent"], delaunay["indices_sent"])
        self.write_tube()
        self.assertEqual(self.report("stripify", "tube.obj")["algorithm"], "best")

    def test_same_points_same_bytes(self):
        self.write_points()
        for name in ("a.glb", "b.glb"):
            self.run_program("stripify", "points.xyz", "-o", name)
        self.assertEqual(self.read("a.glb"), self.read("b.glb"))

    def test_broken_points(self):
        self.write("cut.xyz", "1 2 3\n4 5")
        self.assertIn("line 2", self.run_program("stripify", "cut.xyz", code=3).err)
        self.write_points()
        run = self.run_program("stripify", "points.xyz", "--algorithm", "tetra-multi-path", code=5)
        self.assertIn("no tetrahedra", run.err)
        self.assertIn("not written", self.run_program("convert", "points.xyz", "out.xyz", code=1).err)


class Tetrahedra(ProgramTest):
    def test_strips_show_each_tetrahedron_once(self):
        self.write("cube.mesh", CUBE)
        figures = self.report("stripify", "cube.mesh", "-o", "strips.txt", "--algorithm",
                              "tetra-multi-path", schema="stripify-tetra")
        self.assertEqual((figures["tetrahedra"], figures["strips"], figures["entries"]), (6, 1, 9))
        rows = CUBE.split("Tetrahedra\n6\n")[1].splitlines()[:6]
        expected = [oriented([int(word) for word in row.split()[:4]]) for row in rows]
        self.assertEqual(sorted(tetrahedra_of(self.read("strips.txt").decode())), sorted(expected))

    def test_known_by_its_first_word(self):
        self.write("cube", CUBE)
        self.assertIn(b"tetrahedra a strip", self.run_program("stripify", "cube").out)
        run = self.run_program("stripify", "-", "-o", "-", stdin=CUBE.encode())
        self.assertTrue(run.out.startswith(b"TetraStrips 1\n"), run)

    def test_broken_tetrahedra(self):
        for text, code, words in ((CUBE[:-40], 3, "ends within"), (CUBE.replace("1 6 2 8", "1 6 2 9"), 3, "not there"),
                                  ("no mesh at all\n", 3, "MEDIT"), (CUBE.replace("Dimension 3", "Dimension 2"), 5, "two")):
            self.write("broken.mesh", text)
            self.assertIn(words, self.run_program("stripify", "broken.mesh", "-o", "out.txt", code=code).err)
            self.assertFalse((self.folder / "out.txt").exists())
            report = self.report("stripify", "broken.mesh", code=code, schema="stripify-tetra")
            self.assertIn(words, report["error"]["message"])
        self.write("cube.mesh", CUBE)
        run = self.run_program("stripify", "cube.mesh", "--algorithm", "sgi-strips", code=1)
        self.assertIn("tetra-multi-path", run.err)


if __name__ == "__main__":
    unittest.main()
