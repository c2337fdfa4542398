"""Every format into every other, and what is left of the model."""

import shutil
import unittest

from support import FORMATS, GOLDEN, GOLDEN_XML, MESH_FORMATS, STRIP_FORMATS, ProgramTest

LOSSLESS = ("obj", "gltf", "glb", "pstrip", "pstripx")  # of what the tube has


def usable(source, target, options):
    """Options of encoding, where something is encoded: others are refused."""
    return options if target in STRIP_FORMATS and not source.endswith((".pstrip", ".pstripx")) else ()


class Formats(ProgramTest):
    def convert_all(self, source, *options):
        for target in FORMATS:
            self.run_program("convert", "-q", "--force", source, f"first.{target}",
                             *usable(source, target, options))

    def check_pairs(self, formats, wanted, *options):
        for source in formats:
            for target in formats:
                with self.subTest(source=source, target=target, options=options):
                    self.run_program("convert", "-q", "--force", f"first.{source}", f"second.{target}",
                                     *usable(f"first.{source}", target, options))
                    # A text record stands in the order of its collapses.
                    allowed = [*wanted, "reordered"] if target == "pm" else wanted
                    self.assertIn(self.equivalence(f"first.{source}", f"second.{target}"), allowed)

    def test_tube_in_its_order(self):
        self.write_tube()
        for strips in ("naive", "offset"):
            options = ("--keep-order", "--strips", strips)
            self.convert_all("tube.obj", *options)
            for target in LOSSLESS:
                self.assertEqual(self.equivalence("tube.obj", f"first.{target}"), "exact", target)
            self.check_pairs(LOSSLESS, ["exact"], *options)

    def test_tube_in_another_order(self):
        self.write_tube()
        for strips in ("naive", "offset"):
            options = ("--strips", strips)
            self.convert_all("tube.obj", *options)
            for target in ("pstrip", "pstripx"):
                self.assertEqual(self.equivalence("tube.obj", f"first.{target}"), "reordered", target)
            self.check_pairs(LOSSLESS, ["exact", "reordered"], *options)

    # PLY holds wedges but no materials, the text record one UV set and nothing else.
    def test_what_ply_and_text_cannot_hold_is_said(self):
        self.write_tube()
        for target, lost in (("ply", "materials"), ("pm", "attribute NORMAL")):
            run = self.run_program("convert", "tube.obj", f"poor.{target}",
                                   *usable("tube.obj", target, ["--keep-order"]))
            self.assertIn(f"poor.{target}: left out: {lost}", run.err)
            self.convert_all(f"poor.{target}", "--keep-order")
            for again in FORMATS if target == "pm" else LOSSLESS + ("ply",):
                wanted = "reordered" if again == "pm" else "exact"
                self.assertEqual(self.equivalence(f"poor.{target}", f"first.{again}"), wanted, again)

    def test_golden_file_in_every_format(self):
        for golden in (GOLDEN, GOLDEN_XML):
            shutil.copy(golden, self.folder)
            self.convert_all(golden.name, "--keep-order")
            for target in FORMATS:
                wanted = "reordered" if target == "pm" else "exact"
                self.assertEqual(self.equivalence(golden.name, f"first.{target}"), wanted, target)
            self.check_pairs(FORMATS, ["exact"], "--keep-order")
        self.run_program("convert", "-q", GOLDEN_XML.name, "from-xml.pstrip")
        self.assertEqual(self.read("from-xml.pstrip"), GOLDEN.read_bytes())
        self.run_program("convert", "-q", GOLDEN.name, "from-binary.pstripx")
        self.assertEqual(self.read("from-binary.pstripx"), GOLDEN_XML.read_bytes())

    def test_xml_and_binary_are_interchangeable(self):
        self.write_tube()
        for strips in ("naive", "offset"):
            for order in ((), ("--keep-order",)):
                self.run_program("convert", "-q", "tube.obj", "a.pstrip", "--strips", strips, *order)
                self.run_program("convert", "-q", "a.pstrip", "b.pstripx")
                self.run_program("convert", "-q", "b.pstripx", "c.pstrip")
                self.run_program("convert", "-q", "c.pstrip", "d.pstripx")
                self.assertEqual(self.read("a.pstrip"), self.read("c.pstrip"))
                self.assertEqual(self.read("b.pstripx"), self.read("d.pstripx"))
                # The validator decodes both and compares with the digest they carry.
                self.run_program("validate", "--warnings-as-errors", "a.pstrip", "b.pstripx")
                digest = self.digest_in_xml("b.pstripx")
                self.assertIn(bytes.fromhex(digest), self.read("a.pstrip"))

    def digest_in_xml(self, name):
        text = self.read(name).decode()
        start = text.index(">", text.index("<digest")) + 1
        return text[start:text.index("<", start)].strip()

    def test_standard_streams(self):
        self.write_tube()
        self.run_program("convert", "-q", "tube.obj", "tube.glb")
        for target in FORMATS:
            with self.subTest(target=target):
                to_pipe = self.run_program("convert", "tube.glb", "-", "--to", target)
                self.assertFalse((self.folder / "-").exists())
                self.run_program("convert", "-q", "-", f"model.{target}", stdin=to_pipe.out)
                through_pipe = self.run_program("convert", "-q", "-", "-", "--to", target,
                                                stdin=to_pipe.out)
                self.run_program("convert", "-q", "-", "third.glb", stdin=through_pipe.out)
                wanted = ["exact"] if target in MESH_FORMATS else ["exact", "reordered"]
                self.assertIn(self.equivalence(f"model.{target}", "third.glb"), wanted)
                self.run_program("inspect", "-", stdin=to_pipe.out)
                self.run_program("stripify", "-", stdin=to_pipe.out)
                self.run_program("compare", "-", f"model.{target}", stdin=to_pipe.out)
                if target in STRIP_FORMATS:
                    self.run_program("extract", "-", "base.ply", "--level", "0", stdin=to_pipe.out)
                if target in ("pstrip", "pstripx"):
                    run = self.run_program("validate", "-", stdin=to_pipe.out)
                    self.assertEqual(run.out, b"-: valid\n")

    def test_names_that_companions_cannot_have(self):
        self.write_tube()
        for name in ("my model", " lead", "trail ", "100%25 é", "a#b?c", "a:b", "back\\slash",
                     "new\nline", 'q"uote', "semi;colon", "bad\udcff", "-dash", "~home", ".hidden"):
            for target in ("obj", "gltf"):
                output = f"./{name}.{target}"
                self.run_program("convert", "-q", "tube.obj", output)
                self.assertEqual(self.equivalence("tube.obj", output), "exact", output)

    def test_two_runs_give_the_same_bytes(self):
        self.write_tube(rings=30, around=40)
        for target in FORMATS:
            runs = [self.run_program("convert", "tube.obj", "-", "--to", target).out
                    for _ in range(2)]
            self.assertEqual(runs[0], runs[1], target)
            self.assertGreater(len(runs[0]), 1000)

    def test_attributes_can_be_left_out(self):
        self.write_tube()
        for attributes, wanted in (("all", ["NORMAL", "POSITION", "TEXCOORD_0"]),
                                   ("NORMAL", ["NORMAL", "POSITION"]), ("none", ["POSITION"])):
            self.run_program("convert", "-q", "tube.obj", "out.pstrip", "--attributes", attributes)
            report = self.report("inspect", "out.pstrip")
            self.assertEqual(sorted(a.split()[0] for a in report["attributes"]), wanted)
        self.assertEqual(report["wedges"], report["vertices"])

    def test_name_of_target_decides_or_option(self):
        self.write_tube()
        self.run_program("convert", "-q", "tube.obj", "A.PLY", "--ascii")
        self.assertTrue(self.read("A.PLY").startswith(b"ply\nformat ascii 1.0\n"))
        self.run_program("convert", "-q", "tube.obj", "b.obj", "--to", "glb")
        self.assertTrue(self.read("b.obj").startswith(b"glTF"))
        # What the file is decides on the way in.
        self.run_program("convert", "-q", "b.obj", "c.obj")
        self.assertEqual(self.equivalence("tube.obj", "c.obj"), "exact")


if __name__ == "__main__":
    unittest.main()
