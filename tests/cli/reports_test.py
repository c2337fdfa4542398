"""Reports: JSON that keeps to its schema whatever the file is, and the options of validate."""

import csv
import io
import json
import random
import struct
import unittest
import zlib

from support import GOLDEN, GOLDEN_XML, ProgramTest, Run

COMMANDS = ("validate", "inspect", "stripify", "compare")
# Overlong, a surrogate, beyond Unicode, and never a byte of UTF-8.
BROKEN_NAME = b"b\xe0\x80\x80\xed\xa0\x80\xf4\x90\x80\x80\xff.obj".decode(errors="surrogateescape")


def with_latin_name(golden):
    """The golden file with a mesh name that is not UTF-8, its checksum mended."""
    chunk = golden.index(b"MESH")
    size = struct.unpack_from("<I", golden, chunk + 4)[0]
    end = chunk + 8 + (size + 3) // 4 * 4
    changed = golden[chunk:end].replace(b"roof", b"r\xf6of")
    return golden[:chunk] + changed + struct.pack("<I", zlib.crc32(changed)) + golden[end + 4:]


def with_wrong_counts(golden):
    """The golden XML file with five errors: counts of both levels, and an error that rises."""
    text = golden.decode()
    text = text.replace('triangles="2" strips="1" error="0.25"', 'triangles="1" strips="2" error="0.25"')
    return text.replace('triangles="4" strips="2" error="0"', 'triangles="3" strips="1" error="1"')


class Reports(ProgramTest):
    def setUp(self):
        super().setUp()
        self.write_tube()
        self.golden = self.write("good.pstrip", GOLDEN.read_bytes()).read_bytes()
        self.write("good.pstripx", GOLDEN_XML.read_bytes())

    def all_reports(self, name):
        """Every command's report on a file, as far as its exit code promises one."""
        found = {}
        for command in COMMANDS:
            others = ["tube.obj"] if command == "compare" else []
            found[command] = self.any_report(command, name, *others)
        return found

    def any_report(self, command, *arguments):
        code = Run((command, "--format", "json", *arguments), self.folder).code
        self.assertIn(code, (0, 2, 3, 5, 7), (command, arguments))
        return code, self.report(command, *arguments, code=code)

    def test_good_files(self):
        for name in ("good.pstrip", "good.pstripx"):
            reports = self.all_reports(name)
            self.assertEqual([code for code, _ in reports.values()], [0, 0, 0, 7])
            inspection = reports["inspect"][1]
            self.assertEqual(inspection["format"], name.split(".")[1])
            self.assertEqual(inspection["profile"], "plain")
            self.assertIsNone(inspection["error"])
            self.assertEqual(reports["validate"][1]["issues"], [])
            self.assertTrue(reports["validate"][1]["valid"])
        parts = self.report("inspect", "good.pstrip")["parts"]
        self.assertEqual(sum(p["bits"] for p in parts.values()), 8 * len(self.golden))
        self.assertEqual(self.report("compare", "tube.obj", "tube.obj")["result"], "exact")
        self.assertEqual(self.report("compare", "good.pstrip", "good.pstripx")["result"], "exact")

    def test_models(self):
        for target in ("ply", "obj", "gltf", "glb", "pm"):
            self.run_program("convert", "-q", "tube.obj", f"out.{target}")
            reports = self.all_reports(f"out.{target}")
            self.assertEqual(reports["inspect"][1]["triangles"], 352)
            self.assertEqual(reports["stripify"][1]["triangles"], 352)
            self.assertFalse(reports["validate"][1]["valid"])

    def test_csv_of_a_model(self):
        run = self.run_program("inspect", "tube.obj", "--format", "csv")
        (row,) = csv.DictReader(io.StringIO(run.out.decode()))
        self.assertEqual((row["file"], row["format"], row["triangles"]), ("tube.obj", "obj", "352"))
        self.assertEqual([float(row[key]) for key in ("min_x", "min_z", "max_y", "max_z")],
                         [-1, 0, 1, 2.75])

    def test_bounding_box_is_where_nodes_place_the_meshes(self):
        self.run_program("convert", "-q", "tube.obj", "tube.gltf")
        asset = json.loads(self.read("tube.gltf"))
        asset["nodes"] = [{"translation": [10, 0, 0], "children": [1]}, {"mesh": 0, "scale": [2, 1, 1]}]
        asset["scenes"] = [{"nodes": [0]}]
        self.write("placed.gltf", json.dumps(asset))
        box = self.report("inspect", "placed.gltf")["bounding_box"]
        self.assertEqual((box["min"], box["max"]), ([8, -1, 0], [12, 1, 2.75]))
        self.run_program("convert", "-q", "placed.gltf", "placed.pstrip")
        self.assertEqual(self.report("inspect", "placed.pstrip")["bounding_box"], box)
        text = self.run_program("inspect", "placed.pstrip").out.decode()
        self.assertIn("x from 8 to 12\n", text)
        self.assertIn("in model units", " ".join(text.split()))

    def test_broken_files(self):
        noise = random.Random(7)
        self.run_program("convert", "-q", "tube.obj", "out.ply")
        self.run_program("convert", "-q", "tube.obj", "out.glb")
        ply, glb, xml = self.read("out.ply"), self.read("out.glb"), GOLDEN_XML.read_bytes()
        flipped = bytearray(self.golden)
        flipped[len(flipped) // 2] ^= 0x55
        files = {"random.pstrip": noise.randbytes(3000), "random": noise.randbytes(3000),
                 "empty": b"", "empty.ply": b"", "flipped.pstrip": bytes(flipped),
                 "cut.pstrip": self.golden[:-9], "short.pstrip": self.golden[:40],
                 "longer.pstrip": self.golden + b"more", "cut.pstripx": xml[:-9],
                 "odd.pstripx": xml.replace(b"<base", b"<b\x01se"), "cut.glb": glb[:-9],
                 "cut.ply": ply[:-9], "corrupt.ply": ply.replace(b"float x", b"flout x"),
                 "corrupt.obj": b"v 0 0 0\nf 1 2 3\n", "cut.gltf": b'{"asset":{"version":"2',
                 "control.obj": b"v \x1b[2J\xff\xfe 0\n", BROKEN_NAME: b"v 0 0 x\n"}
        for name, content in files.items():
            self.write(name, content)
            with self.subTest(name=name):
                reports = self.all_reports(name)
                self.assertFalse(reports["validate"][1]["valid"])
                self.assertIn(reports["validate"][0], (3, 5))
                for command in ("inspect", "stripify", "compare"):
                    code, report = reports[command]
                    if (command, name) == ("inspect", "cut.pstrip"):
                        self.assertEqual((code, report["complete"]), (0, False))
                        continue
                    self.assertIn(code, (3, 5))
                    self.assertNotEqual(report["error"]["message"], "")
                self.assertIsNone(reports["compare"][1]["result"])
        for command in COMMANDS:
            names = ["missing"] * (2 if command == "compare" else 1)
            self.assertEqual(self.any_report(command, *names)[0], 2)

    def test_flipped_bytes(self):
        noise = random.Random(11)
        for _ in range(25):
            changed = bytearray(self.golden)
            for _ in range(noise.randrange(1, 4)):
                changed[noise.randrange(len(changed))] ^= 1 << noise.randrange(8)
            self.write("changed.pstrip", bytes(changed))
            code, report = self.any_report("validate", "changed.pstrip")
            self.assertIn(code, (3, 5))
            self.assertTrue(report["issues"])

    def test_several_files_in_one_report(self):
        self.write("cut.pstrip", self.golden[:-9])
        report = self.report("validate", "good.pstrip", "cut.pstrip", "missing.pstrip", code=3)
        self.assertEqual([f["verdict"] for f in report["files"]],
                         ["valid", "truncated", "unreadable"])
        self.assertEqual({i["file"] for i in report["issues"]}, {"cut.pstrip"})
        self.assertFalse(report["valid"])


class Validate(ProgramTest):
    def setUp(self):
        super().setUp()
        golden = GOLDEN.read_bytes()
        self.write("good.pstrip", golden)
        # One fault the checksum finds, and what follows from it.
        half = len(golden) // 2
        self.write("bad.pstrip", golden[:half] + bytes([golden[half] ^ 255]) + golden[half + 1:])
        self.write("cut.pstrip", golden[:-9])

    def test_explain(self):
        for code in sorted({i["code"] for name in ("bad.pstrip", "cut.pstrip")
                            for i in self.report("validate", name, code=3)["issues"]}):
            lines = self.run_program("validate", "--explain", code).out.decode().splitlines()
            self.assertTrue(lines[0].startswith(f"{code} (error): "))
            self.assertTrue(any("spec/" in line for line in lines), lines)

    def test_ignore(self):
        codes = sorted({i["code"] for i in self.report("validate", "bad.pstrip", code=3)["issues"]})
        self.assertIn("PS1006", codes)
        for arguments in (["--ignore", ",".join(codes)], [a for c in codes for a in ("--ignore", c)]):
            report = self.report("validate", "bad.pstrip", *arguments)
            self.assertEqual(report["issues"], [])
            self.assertEqual(report["ignored"], codes)
            self.assertTrue(report["valid"])
        self.report("validate", "cut.pstrip", "--ignore", "PS1006", code=3)

    def test_max_issues(self):
        self.write("many.pstripx", with_wrong_counts(GOLDEN_XML.read_bytes()))
        every = self.report("validate", "many.pstripx", "--max-issues", "1000", code=3)
        count = len(every["issues"])
        self.assertEqual(count, 5)
        for most in range(count + 1):
            report = self.report("validate", "many.pstripx", "--max-issues", str(most), code=3)
            self.assertEqual(report["issues"], every["issues"][:most])
            self.assertEqual(report["files"][0]["dropped"], count - most)
        text = self.run_program("validate", "many.pstripx", "--max-issues", "1", code=3).out.decode()
        self.assertIn(f"  and {count - 1} more\n", text)
        self.assertEqual(text.count(" error ["), 1)

    def test_warnings_as_errors(self):
        self.write("latin.pstrip", with_latin_name(GOLDEN.read_bytes()))
        report = self.report("validate", "latin.pstrip")
        self.assertEqual([i["severity"] for i in report["issues"]], ["warning"])
        self.assertTrue(report["valid"])
        report = self.report("validate", "latin.pstrip", "--warnings-as-errors", code=3)
        self.assertFalse(report["valid"])


class Stripify(ProgramTest):
    def test_figures(self):
        self.write_tube()
        for algorithm in ("sgi-strips", "sgi-vertices"):
            figures = self.report("stripify", "tube.obj", "--algorithm", algorithm)
            self.assertEqual(figures["algorithm"], algorithm)
            self.assertEqual(figures["triangles"], 352)
            # Two indices a strip beside one a triangle, one more a swap, restarts between.
            self.assertEqual(figures["indices_sent"], figures["triangles"] + 2 * figures["strips"] +
                             figures["swaps"] + figures["strips"] - 1)
            self.assertLessEqual(figures["singletons"], figures["strips"])
            self.assertGreater(figures["acmr16"], 0.5)
            self.assertLess(figures["acmr16"], 3)
            self.assertGreaterEqual(figures["milliseconds"], 0)
            text = self.run_program("stripify", "tube.obj", "--algorithm", algorithm).out.decode()
            self.assertIn(f"tube.obj: {algorithm}\n", text)

    def test_comparison(self):
        self.write_tube()
        self.run_program("convert", "-q", "tube.obj", "tube.ply")
        models = ("tube.obj", "tube.ply")
        report = self.report("stripify", "--compare", *models, schema="stripify-compare")
        self.assertEqual([m["file"] for m in report["models"]], list(models))
        for model in report["models"]:
            rows = {(r["algorithm"], r["variant"]): r for r in model["algorithms"]}
            self.assertEqual(len(rows), len(model["algorithms"]))
            self.assertLessEqual(rows["best", "high, strips"]["strips"], rows["best", "fast"]["strips"])
            self.assertLess(rows["best", "high"]["indices_sent"], rows["sgi-strips", ""]["indices_sent"])
            for row in rows.values():
                self.assertNotIn("peak_bytes", row)
                self.assertEqual((row["remark"], row["triangles"]), ("", 352), row)

    def test_comparison_formats(self):
        self.write_tube()
        chosen = ("--algorithm", "sgi-strips,best", "--strip-effort", "3")
        csv_rows = list(csv.DictReader(io.StringIO(
            self.run_program("stripify", "tube.obj", "--compare", "--format", "csv", *chosen).out.decode())))
        self.assertEqual([(r["algorithm"], r["variant"]) for r in csv_rows],
                         [("best", "fast"), ("best", "effort 3"), ("best", "effort 3, strips"),
                          ("sgi-strips", "")])
        for kind in ("text", "md"):
            lines = self.run_program("stripify", "tube.obj", "--compare", "--format", kind,
                                     *chosen).out.decode().splitlines()
            self.assertIn("tube.obj: 352 triangles", lines[0])
            for row in csv_rows:
                name = row["algorithm"] if kind == "md" else row["variant"] or row["algorithm"]
                self.assertTrue(any(name in line and row["strips"] in line for line in lines))

    def test_comparison_goes_on_after_a_broken_file(self):
        self.write_tube()
        self.write("cut.glb", b"glTF")
        run = self.run_program("stripify", "--compare", "cut.glb", "tube.obj", "missing.ply",
                               "--algorithm", "sgi-strips", code=3)
        self.assertIn("tube.obj: 352 triangles", run.out.decode())
        self.assertIn("missing.ply", run.err)

    def test_time_limit(self):
        self.write_tube()
        limit = ("--strip-effort", "4000000000", "--time-limit", "0.05")
        run = self.run_program("stripify", "tube.obj", *limit)
        self.assertIn("the time limit of 0.05 s cut", run.err)
        self.assertIn("352", run.out.decode())
        run = self.run_program("convert", "tube.obj", "out.pstrip", *limit)
        self.assertIn("the time limit of 0.05 s cut", run.err)
        self.assertEqual(self.equivalence("tube.obj", "out.pstrip"), "reordered")
        text = self.run_program("stripify", "tube.obj", "--time-limit", "600")
        self.assertNotIn("time limit", text.err)

    def test_output_is_the_model_in_strip_order(self):
        self.write_tube()
        for target in ("out.obj", "out.gltf", "out.glb"):
            self.run_program("stripify", "tube.obj", "-o", target)
            self.assertEqual(self.equivalence("tube.obj", target), "reordered", target)
            colored = target.replace("out", "colored")
            self.run_program("stripify", "tube.obj", "-o", colored, "--color-strips")
            report = self.report("inspect", colored)
            self.assertEqual((report["triangles"], report["materials"]), (352, 12))
        self.run_program("stripify", "tube.obj", "-o", "colored.ply", "--color-strips")
        self.assertIn("COLOR_0 3xu8 normalized", self.report("inspect", "colored.ply")["attributes"])
        run = self.run_program("stripify", "tube.obj", "-o", "-", "--to", "glb")
        self.assertTrue(run.out.startswith(b"glTF"))
        self.assertIn("indices sent", run.err)

    def test_gltf_has_a_primitive_a_strip(self):
        self.write_tube()
        groups = 2  # the tube's materials
        for algorithm in ("best", "sgi-strips", "qstrip", "mstrip", "multi-path"):
            metrics = self.report("stripify", "tube.obj", "-o", "out.gltf", "--algorithm", algorithm,
                                  "--force")
            self.assertEqual(self.primitives("out.gltf"), [5] * metrics["strips"], algorithm)
            self.assertEqual(self.equivalence("tube.obj", "out.gltf"), "reordered")
            self.run_program("stripify", "tube.obj", "-o", "joined.gltf", "--algorithm", algorithm,
                             "--join", "--force")
            self.assertEqual(self.primitives("joined.gltf"), [5] * groups, algorithm)
            self.assertEqual(self.equivalence("tube.obj", "joined.gltf"), "reordered")

    def primitives(self, name):
        """The mode of each primitive; 5 is a strip."""
        meshes = json.loads(self.read(name))["meshes"]
        return [primitive["mode"] for mesh in meshes for primitive in mesh["primitives"]]


if __name__ == "__main__":
    unittest.main()
