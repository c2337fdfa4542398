"""What a conversion says of what it kept, converted and left out; --strict; what compare looks at."""

import json
import unittest

import jsonschema
from assets import Asset
from support import SOURCE, ProgramTest

SCHEMA = json.loads((SOURCE / "spec/schemas/convert.schema.json").read_text())


def moving_square(angle=0.5, color=(1, 0, 0, 1)):
    """A square with a material, a camera on a node, a light and an animation."""
    asset = Asset(extensionsUsed=["KHR_lights_punctual"], cameras=[{"type": "perspective", "perspective": {"yfov": 1, "znear": 1}}],
                  extensions={"KHR_lights_punctual": {"lights": [{"type": "point"}, {"type": "point"}]}},
                  materials=[{"name": "paint", "pbrMetallicRoughness": {"baseColorFactor": list(color)}}])
    mesh = asset.square(NORMAL=asset.accessor([[0, 0, 1]] * 4))
    asset.root["meshes"][mesh]["primitives"][0]["material"] = 0
    times = asset.accessor([0, 1], min=[0], max=[1])
    asset.root["animations"] = [
        {"channels": [{"sampler": 0, "target": {"node": 0, "path": "translation"}}],
         "samplers": [{"input": times, "output": asset.accessor([[0, 0, 0], [angle, 0, 0]])}]}]
    return asset.scene({"mesh": mesh}, {"camera": 0}).text()


class Losses(ProgramTest):
    def setUp(self):
        super().setUp()
        self.write("in.gltf", moving_square())

    def report_of(self, *arguments, code=0):
        report = json.loads(self.run_program("convert", "--report", "json", *arguments, code=code).out)
        jsonschema.Draft202012Validator(SCHEMA).validate(report)
        return report

    def test_every_kind_is_said_with_its_count(self):
        run = self.run_program("convert", "in.gltf", "out.obj")
        for loss in ("animations (1)", "cameras (1)", "lights (2)"):
            self.assertIn(f"out.obj: left out: {loss}\n", run.err)
        self.assertIn("faces (2)", run.err.split("kept:")[1].split("\n")[0])
        report = self.report_of("--force", "in.gltf", "out.obj")
        kept = {row["kind"]: row["count"] for row in report["kept"]}
        self.assertEqual([kept[kind] for kind in ("faces", "vertices", "meshes", "materials")], [2, 4, 1, 1])
        for loss in ("animations (1)", "cameras (1)", "lights (2)"):
            self.assertIn(loss, report["dropped"])
        self.assertEqual(report["files"][0]["path"], "out.obj")

    def test_nothing_is_lost_where_all_has_its_place(self):
        for target in ("out.glb", "out.pstrip", "out.pstripx"):
            report = self.report_of("in.gltf", target)
            self.assertEqual(report["dropped"], [])
            kept = {row["kind"]: row["count"] for row in report["kept"]}
            self.assertEqual([kept[kind] for kind in ("animations", "cameras", "lights", "nodes")], [1, 1, 2, 2])

    def test_strict_writes_nothing_when_anything_is_lost(self):
        for target in ("out.obj", "out.ply", "out.pm"):
            run = self.run_program("convert", "--strict", "in.gltf", target, code=7)
            self.assertIn("left out: animations (1)", run.err)
            self.assertIn(f"{target}: not written, since something would be left out", run.err)
            self.assertFalse((self.folder / target).exists())
        self.assertEqual(sorted(p.name for p in self.folder.iterdir()), ["in.gltf"])
        self.assertEqual(self.report_of("--strict", "in.gltf", "out.obj", code=7)["files"], [])
        self.run_program("convert", "--strict", "in.gltf", "out.glb")
        self.run_program("convert", "--strict", "in.gltf", "out.pstrip")

    def test_strict_counts_what_a_reader_leaves_out(self):
        text = json.loads(moving_square())
        text["meshes"][0]["primitives"][0]["extensions"] = {"VENDOR_edges": {"visible": 1}}
        text["extensionsUsed"].append("VENDOR_edges")
        self.write("vendor.gltf", json.dumps(text))
        run = self.run_program("convert", "--strict", "vendor.gltf", "out.glb", code=7)
        self.assertIn("left out: extension VENDOR_edges", run.err)
        self.assertFalse((self.folder / "out.glb").exists())

    def test_compare_names_what_differs(self):
        self.write("red.gltf", moving_square())
        self.write("blue.gltf", moving_square(color=(0, 0, 1, 1)))
        self.write("farther.gltf", moving_square(angle=0.75))
        self.assertEqual(self.equivalence("in.gltf", "red.gltf"), "exact")
        run = self.run_program("compare", "in.gltf", "blue.gltf", code=7)
        self.assertIn(b"material paint: base color", run.out)
        run = self.run_program("compare", "in.gltf", "farther.gltf", code=7)
        self.assertIn(b"values of animations or skins", run.out)

    def test_compare_looks_at_textures(self):
        def textured(uri):
            asset = Asset(images=[{"uri": uri}], textures=[{"source": 0}],
                          materials=[{"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}}])
            mesh = asset.square(TEXCOORD_0=asset.accessor([[0, 0], [1, 0], [0, 1], [1, 1]]))
            asset.root["meshes"][mesh]["primitives"][0]["material"] = 0
            return asset.scene({"mesh": mesh}).text()

        self.write("a.gltf", textured("data:image/png;base64,iVBORw0KGgoB"))
        self.write("b.gltf", textured("data:image/png;base64,iVBORw0KGgoC"))
        self.assertEqual(self.equivalence("a.gltf", "a.gltf"), "exact")
        run = self.run_program("compare", "a.gltf", "b.gltf", code=7)
        self.assertIn(b"material 0: texture", run.out)


if __name__ == "__main__":
    unittest.main()
