"""What glTF forbids and other formats have: the output is valid, and what changed is said."""

import json
import math
import struct
import unittest

from assets import U8, U16, Asset, glb_parts, glb_rows, obj_rows
from gltf_validator import complaints, is_installed
from support import ProgramTest

TRIANGLE = "v 0 0 0\nv 1 0 0\nv 0 1 0\n"


class GltfValues(ProgramTest):
    def test_the_validator_looks_on(self):
        if not is_installed():
            self.skipTest("gltf-validator is not installed; web/build does that")
        self.write("broken.gltf", '{"asset": {}}')
        self.assertNotEqual(complaints(self.folder / "broken.gltf"), [])

    def glb_of(self, name, content, *options):
        """The attributes of the first primitive by name, as rows."""
        self.write(name, content)
        self.said = self.run_program("convert", name, "out.glb", "--force", *options).err
        self.assertEqual(complaints(self.folder / "out.glb"), [])
        self.glb = self.read("out.glb")
        self.root = glb_parts(self.glb)[0]
        primitive = self.root["meshes"][0]["primitives"][0]
        self.corners = [row[0] for row in glb_rows(self.glb, primitive["indices"])]
        return {name: glb_rows(self.glb, number) for name, number in primitive["attributes"].items()}

    def test_normals_of_another_length(self):
        rows = self.glb_of("a.obj", TRIANGLE + "vn 0 0 6.283185\nf 1//1 2//1 3//1\n")
        self.assertEqual(rows["NORMAL"], [[0, 0, 1]] * 3)
        self.assertIn("converted: 3 elements of NORMAL brought to unit length", self.said)

    def test_normals_that_some_faces_lack(self):
        rows = self.glb_of("a.obj", TRIANGLE + "v 1 1 0\nvn 0 0.6 0.8\nf 1//1 2//1 3//1\nf 3 2 4\n")
        normals = [rows["NORMAL"][c] for c in self.corners]
        for normal, right in zip(normals, [[0, 0.6, 0.8]] * 3 + [[0, 0, 1]] * 3):
            for x, y in zip(normal, right):
                self.assertAlmostEqual(x, y, 6)
        self.assertIn("converted: 3 elements of NORMAL of length 0, computed from the faces", self.said)

    def test_normals_of_no_length(self):
        rows = self.glb_of("a.obj", TRIANGLE + "vn 0 0 0\nf 1//1 2//1 3//1\n")
        self.assertEqual(sorted(rows), ["POSITION"])
        self.assertIn("left out: attribute NORMAL, all of length 0", self.said)

    def test_normal_of_a_vertex_without_faces(self):
        rows = self.glb_of("a.obj", TRIANGLE + "v 5 5 5\nvn 1 0 0\nf 1//1 2//1 3//1\n")
        self.assertEqual([rows["NORMAL"][c] for c in self.corners], [[1, 0, 0]] * 3)
        for normal in rows["NORMAL"]:
            self.assertAlmostEqual(math.hypot(*normal), 1)
        self.assertIn("1 elements of NORMAL of length 0 at vertices that no face shows", self.said)

    def test_coordinates_of_textures_that_are_no_numbers(self):
        rows = self.glb_of("a.obj", TRIANGLE + "vt nan nan\nf 1/1 2/1 3/1\n")
        self.assertEqual(sorted(rows), ["POSITION"])
        self.assertIn("left out: attribute TEXCOORD_0, which holds no numbers", self.said)
        rows = self.glb_of("a.obj", TRIANGLE + "vt 0.5 0.5\nvt inf 0.25\nf 1/1 2/1 3/2\n")
        self.assertEqual(rows["TEXCOORD_0"][self.corners[0]][0], 0.5)
        self.assertEqual(rows["TEXCOORD_0"][self.corners[2]][0], 0)
        self.assertIn("1 elements of TEXCOORD_0 that are no numbers, written as 0", self.said)

    def test_positions_that_are_no_numbers(self):
        head = "ply\nformat ascii 1.0\nelement vertex 5\nproperty double x\nproperty double y\nproperty double z\n" \
               "element face 2\nproperty list uchar int vertex_indices\nend_header\n"
        for bad in ("inf", "nan", "-inf", "1e39"):
            rows = self.glb_of("a.ply", f"{head}0 0 0\n{bad} 0 0\n1 0 0\n0 1 0\n1 1 0\n3 0 2 3\n3 1 2 4\n")
            self.assertEqual(rows["POSITION"], [[0, 0, 0], [1, 0, 0], [0, 1, 0], [1, 1, 0]])
            self.assertEqual(self.corners, [0, 1, 2])
            self.assertIn("left out: 1 vertices at NaN, infinity or beyond the range of f32", self.said)
            self.assertIn("left out: 1 faces at such vertices", self.said)

    def test_values_of_a_gltf_that_are_no_numbers(self):
        nan, inf = math.nan, math.inf
        asset = Asset()
        mesh = asset.mesh([[0, 0, 0], [1, 0, 0], [0, 1, 0], [1, 1, 0]], [0, 1, 2, 2, 1, 3],
                          NORMAL=asset.accessor([[0, 0, 1]] * 3 + [[nan, 0, 1]]),
                          COLOR_0=asset.accessor([[0.5, 0.5, 0.5]] * 3 + [[inf, 0, 0]]),
                          TEXCOORD_0=asset.accessor([[nan, nan]] * 4))
        rows = self.glb_of("a.gltf", asset.scene({"mesh": mesh}).text())
        self.assertEqual(rows["NORMAL"][3], [0, 0, 1])
        self.assertEqual(rows["COLOR_0"][3], [1, 0, 0])
        self.assertNotIn("TEXCOORD_0", rows)

    def test_what_is_wrong_in_a_gltf_returns_and_is_said(self):
        asset = Asset()
        mesh = asset.square(NORMAL=asset.accessor([[0, 0, 2]] * 4), TANGENT=asset.accessor([[3, 0, 0, 1]] * 4),
                            JOINTS_0=asset.accessor([[0, 0, 0, 0]] * 4, U8),
                            WEIGHTS_0=asset.accessor([[0.5, 0, 0, 0]] * 4))
        self.write("a.gltf", asset.scene({"mesh": mesh}).text())
        self.said = self.run_program("convert", "a.gltf", "out.glb").err
        self.assertIn("4 elements of NORMAL not of unit length, kept as they are", self.said)
        self.assertIn("4 elements of TANGENT not of unit length", self.said)
        self.assertIn("4 elements of WEIGHTS whose sum is not 1, kept as they are", self.said)
        self.assertEqual(self.equivalence("a.gltf", "out.glb"), "exact")

    def test_joints_without_weights(self):
        asset = Asset(skins=[{"joints": [1]}])
        mesh = asset.square(JOINTS_0=asset.accessor([[0, 0, 0, 0]] * 4, U8))
        rows = self.glb_of("a.gltf", asset.scene({"mesh": mesh, "skin": 0, "children": [1]}, {}).text())
        self.assertEqual(sorted(rows), ["POSITION"])
        self.assertNotIn("skin", self.root["nodes"][0])
        self.assertIn("left out: attribute JOINTS_0, since joints and weights need each other", self.said)
        self.assertIn("left out: skins of nodes whose meshes have no joints (1)", self.said)

    def skinned(self):
        """Skin, morph target that an animation moves, textures on two sets."""
        asset = Asset(images=[{"uri": "data:image/png;base64,iVBORw0KGgo="}], textures=[{"source": 0}])
        asset.root["materials"] = [{"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}},
                                    "emissiveTexture": {"index": 0, "texCoord": 1}}]
        mesh = asset.square(JOINTS_0=asset.accessor([[0, 0, 0, 0]] * 4, U8),
                            WEIGHTS_0=asset.accessor([[1, 0, 0, 0]] * 4),
                            TEXCOORD_0=asset.accessor([[0, 0], [1, 0], [0, 1], [1, 1]]),
                            TEXCOORD_1=asset.accessor([[0, 0], [0.5, 0], [0, 0.5], [0.5, 0.5]]))
        primitive = asset.root["meshes"][0]["primitives"][0]
        primitive.update(material=0, targets=[{"POSITION": asset.positions([[0, 0, 1]] * 4)}])
        asset.root["meshes"][0]["weights"] = [0.5]
        asset.root["skins"] = [{"joints": [1]}]
        times = asset.accessor([0, 1], min=[0], max=[1])
        asset.root["animations"] = [
            {"channels": [{"sampler": 0, "target": {"node": 0, "path": "weights"}}],
             "samplers": [{"input": times, "output": asset.accessor([0, 1])}]}]
        return asset.scene({"mesh": mesh, "skin": 0, "children": [1]}, {}).text()

    def test_what_needs_attributes_that_were_left_out_goes_with_them(self):
        self.write("a.gltf", self.skinned())
        for options in (["--attributes", "none"], ["--attributes", "WEIGHTS_0"]):
            self.said = self.run_program("convert", "a.gltf", "out.glb", "--force", *options).err
            root = glb_parts(self.read("out.glb"))[0]
            primitive = root["meshes"][0]["primitives"][0]
            self.assertEqual(sorted(primitive["attributes"]), ["POSITION"])
            self.assertNotIn("targets", primitive)
            self.assertNotIn("weights", root["meshes"][0])
            self.assertNotIn("skin", root["nodes"][0])
            self.assertNotIn("animations", root)
            self.assertNotIn("Texture", json.dumps(root["materials"][primitive["material"]]))
            for loss in ("skins of nodes whose meshes have no joints (1)", "weights of morph targets that are not there (1)",
                         "animation channels of morph targets that are not there (1)",
                         "where a mesh has no coordinates for them (2)"):
                self.assertIn(loss, self.said)
            left = [c for c in complaints(self.folder / "out.glb") if not c.startswith("IMAGE")]
            self.assertEqual(left, [])

    def test_sets_of_coordinates_move_up_with_their_textures(self):
        self.write("a.gltf", self.skinned())
        self.run_program("convert", "a.gltf", "out.glb", "--attributes", "TEXCOORD_1")
        root = glb_parts(self.read("out.glb"))[0]
        primitive = root["meshes"][0]["primitives"][0]
        self.assertEqual(sorted(primitive["attributes"]), ["POSITION", "TEXCOORD_0"])
        material = root["materials"][primitive["material"]]
        self.assertEqual(material["emissiveTexture"], {"index": 0, "texCoord": 0})
        self.assertNotIn("baseColorTexture", material["pbrMetallicRoughness"])

    def test_attributes_that_no_mesh_has_are_refused(self):
        self.write("a.gltf", self.skinned())
        run = self.run_program("convert", "a.gltf", "out.glb", "--attributes", "NORMALS", code=1)
        self.assertIn("no mesh has an attribute NORMALS", run.err)

    def test_map_coordinates_keep_their_shape(self):
        places = [(432156.127 + x, 5412345.381 + y, 101.5) for x, y in ((0, 0), (0.013, 0), (0, 0.017), (0.013, 0.017))]
        text = "".join(f"v {x!r} {y!r} {z!r}\n" for x, y, z in places) + "f 1 2 3\nf 3 2 4\n"
        rows = self.glb_of("a.obj", text)
        origin = self.root["nodes"][0]["translation"]
        self.assertEqual(origin, [struct.unpack("f", struct.pack("f", x))[0] for x in origin])
        for row, place in zip(rows["POSITION"], places):
            for x, o, right in zip(row, origin, place):
                self.assertLess(abs(o + x - right), 1e-7)
        self.assertIn("converted: large coordinates, counted from an origin", self.said)
        for steps in (["out.glb", "back.obj"], ["out.glb", "b.pstrip"], ["b.pstrip", "back.obj"],
                      ["a.obj", "c.pstrip"], ["c.pstrip", "c.glb"], ["c.glb", "back.obj"]):
            self.run_program("convert", "--force", *steps)
            if steps[1] == "back.obj":
                for row, place in zip(sorted(obj_rows(self.read("back.obj"), "v")), sorted(places)):
                    for x, right in zip(row, place):
                        self.assertLess(abs(x - right), 1e-7)

    def test_ordinary_doubles_need_no_origin(self):
        self.glb_of("a.obj", "v 0.1 0 0\nv 1 0.1 0\nv 0 1.1 0\nf 1 2 3\n")
        self.assertEqual(self.root["nodes"], [{"mesh": 0}])


if __name__ == "__main__":
    unittest.main()
