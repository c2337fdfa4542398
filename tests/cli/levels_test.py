"""How far a progressive file is refined, where its base is, and files that end early."""

import csv
import io
import re
import unittest

from support import GOLDEN, ProgramTest, bumpy_grid


class Levels(ProgramTest):
    def setUp(self):
        super().setUp()
        self.write("grid.obj", bumpy_grid(40))  # 3,200 triangles
        self.run_program("convert", "-q", "grid.obj", "grid.pstrip", "--keep-order")
        self.packets = self.report("inspect", "grid.pstrip")["packets"]
        self.assertGreater(len(self.packets), 3)

    def triangles_of(self, name):
        return self.report("inspect", name)["triangles"]

    def test_base(self):
        for base, most in (("10%", 320), ("50", 50), ("0", 3200), ("0%", 3200), ("100%", 3200)):
            self.run_program("convert", "-q", "grid.obj", "out.pstrip", "--base", base)
            packets = self.report("inspect", "out.pstrip")["packets"]
            self.assertLessEqual(packets[0]["triangles"], most)
            self.assertEqual(packets[-1]["triangles"], 3200)
            if base == "100%":
                self.assertEqual(packets[0]["triangles"], 3200)
            if base in ("10%", "50"):
                self.assertGreater(packets[0]["triangles"], 0.8 * most)

    def test_base_error(self):
        first = []
        for error in ("0.5", "2"):
            self.run_program("convert", "-q", "grid.obj", "out.pstrip", "--base-error", error)
            base = self.report("inspect", "out.pstrip")["packets"][0]
            self.assertLessEqual(base["error"], float(error))
            first.append(base["triangles"])
        self.assertGreater(first[0], first[1])

    def test_placement_and_metric(self):
        for placement in ("subset", "optimal"):
            for metric in ("qem", "memoryless"):
                done = self.run_program("convert", "-v", "grid.obj", "out.pstrip", "--keep-order",
                                        "--placement", placement, "--metric", metric)
                self.assertRegex(done.err, r"3,200 -> 1\d\d triangles, as wanted")
                self.assertRegex(done.err, r"put off: [\d,]+ by border, [\d,]+ by topology,\n    "
                                           r"[\d,]+ by flipped faces, [\d,]+ by flipped texture")
                self.assertEqual(self.equivalence("grid.obj", "out.pstrip"), "exact")
                self.run_program("validate", "-q", "out.pstrip")

    def test_profiles(self):
        for placement in ("subset", "optimal"):
            self.run_program("convert", "-q", "grid.obj", "small.pstrip", "--keep-order", "--profile",
                             "compact", "--placement", placement)
            self.assertEqual(self.report("inspect", "small.pstrip")["profile"], "compact")
            self.assertEqual(self.equivalence("grid.obj", "small.pstrip"), "exact")
            self.run_program("validate", "-q", "small.pstrip")
            self.assertLess(len(self.read("small.pstrip")), len(self.read("grid.pstrip")) / 2)
        # From one profile to the other and back.
        self.run_program("convert", "-q", "grid.pstrip", "small.pstrip", "--profile", "compact",
                         "--keep-order", "--force")
        self.run_program("convert", "-q", "small.pstrip", "back.pstrip", "--profile", "plain",
                         "--keep-order")
        self.assertEqual(self.report("inspect", "back.pstrip")["profile"], "plain")
        self.assertEqual(self.equivalence("grid.obj", "back.pstrip"), "exact")
        # Whatever keeps the records keeps the profile.
        self.run_program("convert", "-q", "small.pstrip", "small.pstripx")
        self.assertEqual(self.report("inspect", "small.pstripx")["profile"], "compact")

    def test_position_bits(self):
        sizes = []
        for bits in (8, 12, 24):
            done = self.run_program("convert", "grid.obj", "out.pstrip", "--profile", "compact",
                                    "--position-bits", bits)
            moved = float(re.search(r"moved by at most (\S+) to a grid", done.err)[1])
            self.assertLess(moved, 40 * (2.0 ** -bits + 2.0 ** -23))
            self.run_program("validate", "-q", "out.pstrip")
            sizes.append(len(self.read("out.pstrip")))
        self.assertEqual(sizes, sorted(sizes))

    def test_attribute_bits(self):
        lines = []
        for i in range(144):
            x, y = i % 12, i // 12
            lines += [f"v {x * 0.7:.6f} {y * 0.7:.6f} {(i * i % 13) * 0.123457:.6f}",
                      f"vt {x / 11.3:.6f} {y / 12.7:.6f}", f"vn {x - 5.3} {y - 4.1} 4"]
        lines += [f"f {a}/{a}/{a} {b}/{b}/{b} {c}/{c}/{c}"
                  for a in (12 * y + x + 1 for y in range(11) for x in range(11))
                  for b, c in ((a + 1, a + 13), (a + 13, a + 12))]
        self.write("dressed.obj", "\n".join(lines))
        sizes = []
        for bits in (None, 12, 6):
            options = () if bits is None else ("--normal-bits", bits, "--uv-bits", bits)
            done = self.run_program("convert", "dressed.obj", "dressed.pstrip", "--profile", "compact",
                                    *options, "--force")
            self.run_program("validate", "-q", "dressed.pstrip")
            sizes.append(len(self.read("dressed.pstrip")))
            if bits is None:
                below, all_bytes = re.search(r"lossless: (\S+) of (\S+) bytes", done.err).groups()
                self.assertEqual(int(all_bytes.replace(",", "")), sizes[0])
                self.assertLess(int(below.replace(",", "")), sizes[0])
                continue
            turned = float(re.search(r"NORMAL turned by at most (\S+) degrees", done.err)[1])
            self.assertLess(turned, 90 / (2 ** (bits - 1) - 1))
            changed = float(re.search(r"TEXCOORD_0 changed by at most (\S+) for", done.err)[1])
            self.assertLess(changed, 0.51 * 2.0 ** -bits)
        self.assertEqual(sizes, sorted(sizes, reverse=True))

    def test_level(self):
        for command in ("extract", "convert"):
            for option in ("--level", "--packet"):
                for packet in self.packets:
                    self.run_program(command, "-q", "grid.pstrip", "out.ply", option,
                                     packet["packet"])
                    self.assertEqual(self.triangles_of("out.ply"), packet["triangles"])
        last = len(self.packets) - 1
        for command in ("extract", "convert"):
            run = self.run_program(command, "grid.pstrip", "out.ply", "--level", last + 1, code=1)
            self.assertIn(f"--level {last + 1}: the file has levels 0 to {last}", run.err)
        self.run_program("extract", "-q", "grid.pstrip", "out.ply")
        self.assertEqual(self.equivalence("grid.obj", "out.ply"), "exact")

    def assert_met(self, triangles, most):
        """Of the mesh that an extract gave; a split brings a few triangles."""
        self.assertLessEqual(triangles, most)
        self.assertGreaterEqual(triangles, most - 4)

    def test_triangles_and_error(self):
        for packet, after in zip(self.packets, self.packets[1:]):
            between = (packet["triangles"] + after["triangles"]) // 2
            for most in (packet["triangles"], between):
                self.run_program("extract", "-q", "grid.pstrip", "out.glb", "--triangles", most)
                self.assert_met(self.triangles_of("out.glb"), most)
            # The first packet that is as good as asked for.
            wanted = next(p for p in self.packets if p["error"] <= after["error"])
            self.run_program("extract", "-q", "grid.pstrip", "out.obj", "--error",
                             repr(after["error"]))
            self.assertEqual(self.triangles_of("out.obj"), wanted["triangles"])
        # Shares are of the full model's triangles and of its diagonal.
        self.run_program("extract", "-q", "grid.pstrip", "out.ply", "--triangles", "50%")
        self.assert_met(self.triangles_of("out.ply"), 1600)
        # A shorter file ends with a packet.
        self.run_program("extract", "-q", "grid.pstrip", "out.pstrip", "--cut", "--triangles", "50%")
        most = max(p["triangles"] for p in self.packets if p["triangles"] <= 1600)
        self.assertEqual(self.report("inspect", "out.pstrip")["packets"][-1]["triangles"], most)
        diagonal = self.report("inspect", "grid.obj")["bounding_box"]["diagonal"]
        self.assertAlmostEqual(diagonal, (40**2 + 40**2 + 10**2) ** 0.5)
        self.run_program("extract", "-q", "grid.pstrip", "out.ply", "--error", "5%")
        wanted = next(p for p in self.packets if p["error"] <= 0.05 * diagonal)
        self.assertEqual(self.triangles_of("out.ply"), wanted["triangles"])
        # Coarser than the base is the base.
        self.run_program("extract", "-q", "grid.pstrip", "out.ply", "--triangles", "0")
        self.assertEqual(self.triangles_of("out.ply"), self.packets[0]["triangles"])

    def test_compare_at_a_level(self):
        self.run_program("extract", "-q", "grid.pstrip", "out.ply", "--level", "1")
        run = self.run_program("compare", "grid.pstrip", "out.ply", "--level", "1")
        self.assertTrue(run.out.startswith(b"exact: "))
        report = self.report("compare", "grid.pstrip", "out.ply", "--level", "2", code=7)
        self.assertGreater(report["hausdorff"], report["rms"])
        self.assertGreater(report["rms"], 0)

    def test_cut_is_valid_and_shorter(self):
        self.run_program("convert", "-q", "grid.pstrip", "grid.pstripx")
        for source in ("grid.pstrip", "grid.pstripx"):
            for packet in self.packets[:-1]:
                for target in ("cut.pstrip", "cut.pstripx"):
                    self.run_program("extract", "-q", "--cut", source, target, "--level",
                                     packet["packet"])
                    self.run_program("validate", "--warnings-as-errors", target)
                    report = self.report("inspect", target)
                    self.assertEqual(report["triangles"], packet["triangles"])
                    self.assertEqual(len(report["packets"]), packet["packet"] + 1)
                self.run_program("extract", "-q", source, "level.ply", "--level", packet["packet"])
                self.assertEqual(self.equivalence("cut.pstrip", "level.ply"), "exact")
                self.assertEqual(self.equivalence("cut.pstripx", "level.ply"), "exact")
        # Nothing cut off is the file itself.
        self.run_program("extract", "-q", "--cut", "grid.pstrip", "whole.pstrip")
        self.assertEqual(self.read("whole.pstrip"), self.read("grid.pstrip"))

    def test_csv_has_the_levels(self):
        run = self.run_program("inspect", "grid.pstrip", "--format", "csv")
        rows = list(csv.DictReader(io.StringIO(run.out.decode())))
        self.assertEqual(len(rows), len(self.packets))
        for row, packet in zip(rows, self.packets):
            del packet["bits"]  # an object: what each part takes
            self.assertEqual(sorted(row), sorted(packet))
            for key, value in packet.items():
                self.assertAlmostEqual(float(row[key]), value, delta=1e-6 * abs(value))
        # A level for a client: its bytes are the prefix to fetch.
        sizes = [int(row["bytes_so_far"]) for row in rows]
        self.assertEqual(sizes, sorted(set(sizes)))

    def test_prefix_shows_the_last_whole_packet(self):
        whole = self.read("grid.pstrip")
        for packet, after in zip(self.packets, self.packets[1:]):
            for size in (packet["bytes_so_far"], after["bytes_so_far"] - 1):
                self.write("prefix.pstrip", whole[:size])
                run = self.run_program("validate", "prefix.pstrip", code=3)
                self.assertTrue(run.out.startswith(b"prefix.pstrip: truncated"))
                self.run_program("convert", "-q", "prefix.pstrip", "out.ply", code=3)
                self.assertFalse((self.folder / "out.ply").exists())
                report = self.report("inspect", "prefix.pstrip")
                self.assertFalse(report["complete"])
                self.assertEqual(report["packets"][-1]["triangles"], packet["triangles"])
                for command in (["extract"], ["convert", "--allow-prefix"]):
                    self.run_program(*command, "-q", "prefix.pstrip", "out.ply")
                    self.assertEqual(self.triangles_of("out.ply"), packet["triangles"])
                    (self.folder / "out.ply").unlink()
        run = self.run_program("extract", "prefix.pstrip", "out.ply")
        self.assertIn("ends early", run.err)

    def test_a_prefix_can_be_made_a_file_of_its_own(self):
        whole = self.read("grid.pstrip")
        for size in (self.packets[0]["bytes_so_far"], self.packets[2]["bytes_so_far"] + 1,
                     self.packets[-1]["bytes_so_far"], len(whole) - 1):
            self.write("prefix.pstrip", whole[:size])
            self.run_program("extract", "-q", "prefix.pstrip", "level.ply")
            for command in (["extract", "--cut"], ["convert", "--allow-prefix"]):
                for target in ("own.pstrip", "own.pstripx"):
                    self.run_program(*command, "-q", "prefix.pstrip", target)
                    self.run_program("validate", "--warnings-as-errors", target)
                    self.assertEqual(self.equivalence(target, "level.ply"), "exact")

    def test_every_prefix_of_the_golden_file_is_truncated(self):
        golden = GOLDEN.read_bytes()
        sizes = range(0, len(golden), 7)
        names = [self.write(f"{size}.pstrip", golden[:size]).name for size in sizes]
        run = self.run_program("validate", *names, code=3)
        verdicts = [line for line in run.out.decode().splitlines() if not line.startswith(" ")]
        self.assertEqual(verdicts, [f"{n}: truncated, 1 error, 0 warnings" for n in names])


if __name__ == "__main__":
    unittest.main()
