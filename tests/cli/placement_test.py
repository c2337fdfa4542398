"""Nodes of a glTF where the output has none: meshes arrive where a viewer shows them."""

import math
import unittest

from assets import SQUARE, Asset, obj_lines, obj_rows, obj_triangles
from support import ProgramTest

HALF = math.sqrt(0.5)


def cross(a, b, c):
    u, v = [x - y for x, y in zip(b, a)], [x - y for x, y in zip(c, a)]
    return [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]]


class Placement(ProgramTest):
    def obj_of(self, asset, *options):
        self.write("in.gltf", asset.text())
        self.said = self.run_program("convert", "in.gltf", "out.obj", *options).err
        return self.read("out.obj")

    def assert_rows(self, rows, wanted):
        self.assertEqual(len(rows), len(wanted), rows)
        def rounded(table):
            return sorted([round(x, 6) + 0.0 for x in row] for row in table)
        self.assertEqual(rounded(rows), rounded(wanted))

    def test_instances_become_copies(self):
        asset = Asset()
        mesh = asset.square()
        asset.scene({"mesh": mesh, "name": "left", "translation": [-5, 0, 0]},
                    {"mesh": mesh, "name": "right", "translation": [5, 0, 0], "scale": [2, 2, 2]},
                    {"mesh": mesh, "name": "left", "translation": [0, 0, 9]})
        obj = self.obj_of(asset)
        wanted = [[x - 5, y, z] for x, y, z in SQUARE] + [[2 * x + 5, 2 * y, z] for x, y, z in SQUARE]
        self.assert_rows(obj_rows(obj, "v"), wanted + [[x, y, 9] for x, y, _ in SQUARE])
        self.assertEqual([line[0] for line in obj_lines(obj, "o")], ["left", "right", "left_2"])
        self.assertIn("converted: node transforms, applied to meshes (3)", self.said)
        self.assertIn("converted: node instances, made copies (2)", self.said)
        self.assertIn(self.equivalence("in.gltf", "out.obj"), ("exact", "reordered"))
        self.run_program("convert", "in.gltf", "out.ply", "--ascii")
        self.assertIn(self.equivalence("in.gltf", "out.ply"), ("exact", "reordered"))
        self.assertIn(b"\n5 2 0\n", self.read("out.ply"))

    def test_matrices_of_ancestors_count(self):
        turn = {"rotation": [0, 0, HALF, HALF], "translation": [10, 0, 0], "children": [1]}
        matrix = {"matrix": [0, 1, 0, 0, -1, 0, 0, 0, 0, 0, 1, 0, 10, 0, 0, 1], "children": [1]}
        for parent in (turn, matrix):
            asset = Asset()
            mesh = asset.square()
            asset.scene(parent, {"mesh": mesh, "translation": [0, 3, 0]})
            self.assert_rows(obj_rows(self.obj_of(asset, "--force"), "v"),
                             [[10 - (y + 3), x, 0] for x, y, _ in SQUARE])

    def test_positions_are_placed_in_double(self):
        asset = Asset()
        asset.scene({"mesh": asset.mesh([[0.5, 0, 0], [0.75, 0, 0], [0.5, 0.25, 0]], [0, 1, 2]),
                     "translation": [432156.125, 5412345, 0]})
        self.assert_rows(obj_rows(self.obj_of(asset), "v"), [
            [432156.625, 5412345, 0], [432156.875, 5412345, 0], [432156.625, 5412345.25, 0]])

    def test_mirrored_faces_turn_over(self):
        asset = Asset()
        mesh = asset.square(NORMAL=asset.accessor([[HALF, 0, HALF]] * 4))
        asset.scene({"mesh": mesh, "scale": [-1, 1, 1]}, {"mesh": mesh, "scale": [1, -2, -1]},
                    {"mesh": mesh, "scale": [-1, -1, -1]})
        obj = self.obj_of(asset)
        normals = [cross(*face) for face in obj_triangles(obj)]
        self.assertEqual([n[2] > 0 for n in normals], [True, True, False, False, False, False])
        self.assert_rows([obj_rows(obj, "vn")[int(f[0].split("/")[2]) - 1] for f in obj_lines(obj, "f")[::2]],
                         [[-HALF, 0, HALF],
                          [HALF, 0, -HALF],
                          [-HALF, 0, -HALF]])

    def test_normals_go_by_the_inverse_transpose(self):
        asset = Asset()
        slope = asset.mesh([[0, 1, 0], [1, 0, 0], [0, 1, 1]], [0, 2, 1], NORMAL=asset.accessor([[HALF, HALF, 0]] * 3))
        asset.scene({"mesh": slope, "scale": [2, 1, 1]})
        obj = self.obj_of(asset)
        for normal in obj_rows(obj, "vn"):
            self.assertAlmostEqual(normal[0], 1 / math.sqrt(5), 6)
            self.assertAlmostEqual(normal[1], 2 / math.sqrt(5), 6)

    def test_tangents_go_along(self):
        asset = Asset()
        mesh = asset.square(NORMAL=asset.accessor([[0, 0, 1]] * 4), TANGENT=asset.accessor([[1, 0, 0, 1]] * 4))
        asset.scene({"mesh": mesh, "matrix": [0, 3, 0, 0, 3, 0, 0, 0, 0, 0, 3, 0, 0, 0, 0, 1]})
        self.write("in.gltf", asset.text())
        self.run_program("convert", "in.gltf", "out.ply", "--ascii")
        rows = self.read("out.ply").decode().split("end_header\n")[1].split("\n")[:4]
        names = [line.split()[2] for line in self.read("out.ply").decode().split("\n")
                 if line.startswith("property") and "list" not in line]
        for row in rows:
            value = dict(zip(names, map(float, row.split())))
            tangent = [value[name] for name in names if name.lower().startswith("tangent")]
            self.assertEqual(tangent, [0, 1, 0, -1], names)

    def test_only_the_default_scene_is_shown(self):
        asset = Asset()
        mesh, other = asset.square(), asset.mesh([[0, 0, 7], [1, 0, 7], [0, 1, 7]], [0, 1, 2])
        asset.scene({"mesh": mesh}, {"children": [2]}, {"mesh": mesh, "translation": [0, 0, 3]}, {"mesh": other})
        asset.root.update(scene=1, scenes=[{"nodes": [0, 3]}, {"nodes": [1]}])
        obj = self.obj_of(asset)
        self.assert_rows(obj_rows(obj, "v"), [[x, y, 3] for x, y, _ in SQUARE])
        self.assertIn("left out: places of meshes in other scenes than the default (2)", self.said)
        self.assertIn("left out: meshes that the scene does not show (1)", self.said)

    def test_instances_of_an_extension(self):
        asset = Asset(extensionsUsed=["EXT_mesh_gpu_instancing"])
        mesh = asset.square()
        attributes = {"TRANSLATION": asset.accessor([[0, 0, 1], [0, 0, 2]]), "SCALE": asset.accessor([[1, 1, 1], [3, 1, 1]])}
        asset.scene({"mesh": mesh, "translation": [100, 0, 0],
                     "extensions": {"EXT_mesh_gpu_instancing": {"attributes": attributes}}})
        wanted = [[100 + x, y, 1] for x, y, _ in SQUARE] + [[100 + 3 * x, y, 2] for x, y, _ in SQUARE]
        self.assert_rows(obj_rows(self.obj_of(asset), "v"), wanted)
        self.run_program("convert", "in.gltf", "in.pstrip")
        self.run_program("convert", "in.pstrip", "again.obj")
        self.assert_rows(obj_rows(self.read("again.obj"), "v"), wanted)

    def test_no_transforms_keeps_them_where_they_stand(self):
        asset = Asset()
        asset.scene({"mesh": asset.square(), "translation": [5, 0, 0]})
        self.assert_rows(obj_rows(self.obj_of(asset, "--no-transforms"), "v"), SQUARE)
        self.assertIn("left out: node transforms", self.said)
        run = self.run_program("convert", "in.gltf", "out.glb", "--no-transforms", code=1)
        self.assertIn("--no-transforms does nothing for a glb file", run.err)

    def test_levels_are_placed(self):
        asset = Asset()
        asset.scene({"mesh": asset.square(), "translation": [5, 0, 0]})
        self.write("in.gltf", asset.text())
        self.run_program("convert", "in.gltf", "in.pstrip")
        self.run_program("extract", "in.pstrip", "out.obj")
        self.run_program("convert", "in.pstrip", "out.pm", "--keep-order")
        self.run_program("convert", "out.pm", "again.obj")
        for name in ("out.obj", "again.obj"):
            self.assert_rows(obj_rows(self.read(name), "v"), [[x + 5, y, z] for x, y, z in SQUARE])

    def test_a_moved_node_is_a_difference(self):
        asset = Asset()
        mesh = asset.square()
        self.write("a.gltf", asset.scene({"mesh": mesh, "name": "panel"}).text())
        self.write("b.gltf", asset.scene({"mesh": mesh, "name": "panel", "translation": [0, 0, 1]}).text())
        run = self.run_program("compare", "a.gltf", "b.gltf", code=7)
        self.assertIn(b"node 0 (panel): moved", run.out)

    def test_too_many_instances_are_refused(self):
        asset = Asset()
        mesh = asset.mesh([[i, 0, 0] for i in range(3000)], [0, 1, 2] * 1000)
        asset.scene(*({"mesh": mesh, "translation": [i, 0, 0]} for i in range(2000)))
        self.write("in.gltf", asset.text())
        run = self.run_program("convert", "in.gltf", "out.obj", "--max-memory", "100000000", code=3)
        self.assertIn("the instances of the scene exceed the memory limit", run.err)
        self.assertFalse((self.folder / "out.obj").exists())


if __name__ == "__main__":
    unittest.main()
