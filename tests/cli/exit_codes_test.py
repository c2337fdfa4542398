"""Exit codes and messages of every subcommand, as a script meets them."""

import os
import unittest

from support import CUBE, GOLDEN, GOLDEN_XML, ProgramTest

HUGE = ((["convert"], ["out.pstrip"]), (["stripify"], []), (["compare", "tube.obj"], []), (["inspect"], []))

# arguments, exit code, part of standard output, part of standard error
CASES = [
    # The command line.
    ([], 1, "", "subcommand is required"),
    (["--help"], 0, "Exit codes: 0 ok", ""),
    (["--version"], 0, "pstrips ", ""),
    *((["-V"], 0, f"{library} ", "")
      for library in ("pstrips", "zlib", "OpenSSL", "tinyxml2", "nlohmann-json", "fmt", "CLI11")),
    (["no-such-command"], 1, "", "--help"),
    (["convrt", "tube.obj", "out.ply"], 1, "", "there is no command convrt; did you mean convert?"),
    (["-q", "stripfiy", "tube.obj"], 1, "", "did you mean stripify?"),
    (["inspect", "tube.obj", "--formt", "json"], 1, "", "Instead of --formt did you mean --format?"),
    *(([command, "--help"], 0, "Exit codes: 0 ok", "")
      for command in ("convert", "validate", "inspect", "extract", "compare", "stripify")),
    (["convert"], 1, "", "input is required"),
    (["convert", "tube.obj"], 1, "", "output is required"),
    (["convert", "tube.obj", "-o"], 1, "", "--output"),
    (["convert", "tube.obj", "tube.obj"], 1, "", "is the input, too; --force replaces it (at tube.obj)"),
    (["convert", "tube.obj", "./hard.obj"], 1, "", "--force"),
    (["convert", "tube.obj", "-o", "soft.obj"], 1, "", "--force"),
    (["extract", "good.pstrip", "good.pstrip", "--cut"], 1, "", "--force"),
    (["stripify", "tube.obj", "-o", "tube.obj"], 1, "", "--force"),
    (["stripify", "cube.mesh", "-o", "cube.mesh"], 1, "", "--force"),
    (["convert", "tube.obj", "out.ply", "--no-such-option"], 1, "", "--no-such-option"),
    (["convert", "tube.obj", "out.unknown"], 1, "", "--to"),
    (["convert", "tube.obj", "out"], 1, "", "--to"),
    (["convert", "tube.obj", "-"], 1, "", "--to"),
    (["convert", "tube.obj", "out.ply", "--to", "stl"], 1, "", "--to"),
    (["convert", "tube.obj", "out.pstrip", "--strips", "both"], 1, "", "--strips"),
    (["convert", "tube.obj", "out.pstrip", "--stripifier", "none"], 1, "", "--stripifier"),
    (["convert", "tube.obj", "out.pstrip", "--profile", "fancy"], 1, "", "--profile"),
    *((["convert", "tube.obj", "out.pstrip", "--base", base], 1, "", "--base")
      for base in ("", "%", "-1", "101%", "1.5", "ten", "5%x", "nan", "inf%")),
    (["convert", "tube.obj", "out.pstrip", "--base", "9", "--base-error", "1"], 1, "", "--base"),
    *((["convert", "tube.obj", "out.pstrip", "--profile", "compact", "--position-bits", bits], 1, "",
       f"{bits} is not a whole number from 8 to 24") for bits in ("7", "25", "x")),
    *((["convert", "tube.obj", "out.pstrip", "--profile", "compact", option, bits], 1, "",
       f"{bits} is not a whole number from 4 to {most}")
      for option, most in (("--normal-bits", 16), ("--uv-bits", 23), ("--color-bits", 23),
                           ("--attribute-bits", 23))
      for bits in ("3", str(most + 1), "x")),
    *((["convert", "tube.obj", "out.pstrip", option, "9", "--lossless"], 1, "", "excludes")
      for option in ("--position-bits", "--normal-bits", "--uv-bits", "--color-bits",
                     "--attribute-bits")),
    *((["convert", "tube.obj", "out.pstrip", "--attribute-weight", weight], 1, "",
       "--attribute-weight") for weight in ("NORMAL", "=1", "A=", "A=x", "A=-1", "A=nan", "A=1e9")),
    (["convert", "tube.obj", "out.pstrip", "--placement", "free"], 1, "", "--placement"),
    (["convert", "tube.obj", "out.pstrip", "--base-error", "-1"], 1, "", "--base-error"),
    (["convert", "good.pstrip", "out.ply", "--level", "-1"], 1, "", "--level: -1 is not a whole number from 0"),
    # Options that do nothing.
    (["convert", "tube.obj", "out.ply", "--base", "5%"], 1, "", "--base does nothing for a ply file"),
    (["convert", "tube.obj", "out.glb", "--goal", "strips"], 1, "", "--goal does nothing for a glb file"),
    (["convert", "tube.obj", "out.obj", "--ascii"], 1, "", "--ascii does nothing for a obj file"),
    (["convert", "tube.obj", "out.ply", "--gltf-strips"], 1, "", "--gltf-strips does nothing for a ply file"),
    (["convert", "good.pstrip", "out.pstripx", "--strips", "naive"], 1, "", "--strips does nothing to progressive"),
    (["convert", "good.pstrip", "out.pstrip", "--profile", "plain"], 1, "", "--profile does nothing to progressive"),
    *((["convert", "tube.obj", "out.pstrip", *option], 1, "", f"{option[0]} does nothing for the plain profile")
      for option in (("--position-bits", "12"), ("--lossless",), ("--order", "bits"),
                     ("--effort", "small"))),
    *((["convert", "tube.obj", "out.pstrip", "--profile", "compact", *option], 1, "",
       f"{option[0]} does nothing for the compact profile")
      for option in (("--goal", "strips"), ("--strips", "naive"), ("--stripifier", "best"), ("--level-cost", "0"))),
    (["convert", "good.pstrip", "out.ply", "--level", "99"], 1, "", "--level 99: the file has levels 0 to "),
    (["extract", "good.pstrip", "out.ply", "--level", "99"], 1, "", "--level 99: the file has levels 0 to "),
    (["compare", "tube.obj", "tube.obj", "--triangles", "9"], 1, "", "a level does nothing: neither file has levels"),
    (["convert", "tube.obj", "out.ply", "--attributes", "COLOR_0"], 1, "",
     "--attributes: no mesh has an attribute COLOR_0; there are NORMAL, POSITION, TEXCOORD_0"),
    (["convert", "tube.obj", "out.pstrip", "--attribute-weight", "COLOR_0=1"], 1, "",
     "--attribute-weight: no mesh has an attribute COLOR_0; there are NORMAL, POSITION, TEXCOORD_0"),
    (["stripify", "tube.obj", "--join"], 1, "", "--join does nothing without -o"),
    (["stripify", "tube.obj", "-o", "out.obj", "--join"], 1, "", "--join does nothing for a obj file"),
    (["stripify", "tube.obj", "--color-strips"], 1, "", "--color-strips does nothing without -o"),
    # Numbers.
    (["compare", "tube.obj", "tube.obj", "--samples", "1k"], 0, "exact", ""),
    (["compare", "tube.obj", "tube.obj", "--samples", "1G"], 1, "", "1G is not a whole number from 1 to 100,000,000"),
    (["inspect", "tube.obj", "--max-memory", "1M", "--max-vertices", "1.5k"], 0, "tube.obj", ""),
    (["inspect", "tube.obj", "--max-memory", "1Ki"], 3, "", "more than the limit of 1024"),
    (["inspect", "tube.obj", "--max-memory", "-1"], 1, "", "-1 is not a whole number from 0, perhaps with k, M, G"),
    (["inspect", "tube.obj", "--max-depth", "5G"], 1, "", "5G is not a whole number from 0 to 4,294,967,295"),
    (["extract", "good.pstrip", "out.ply", "--triangles", "101%"], 1, "", "--triangles: 101% is neither"),
    (["extract", "good.pstrip", "out.ply", "--error", "-1%"], 1, "", "--error: -1% is neither"),
    (["convert", "good.pstrip", "out.ply", "--level", "1", "--triangles", "9"], 1, "", "excludes"),
    (["validate"], 1, "", "no file"),
    (["validate", "good.pstrip", "--format", "xml"], 1, "", "--format"),
    (["validate", "good.pstrip", "--ignore", "PS9999"], 1, "", "PS9999"),
    (["validate", "--explain", "PS9999"], 1, "", "PS9999"),
    (["inspect"], 1, "", "input is required"),
    (["inspect", "good.pstrip", "--format", "xml"], 1, "", "--format"),
    (["extract", "good.pstrip"], 1, "", "output is required"),
    (["extract", "good.pstrip", "out.ply", "--cut"], 1, "", "--cut"),
    (["extract", "good.pstrip", "out.ply", "--triangles", "few"], 1, "", "--triangles"),
    (["compare", "tube.obj"], 1, "", "b is required"),
    (["compare", "tube.obj", "tube.obj", "--samples", "0"], 1, "", "--samples"),
    (["stripify", "tube.obj", "-o", "out.pstrip"], 1, "", "convert"),
    (["stripify", "tube.obj", "--algorithm", "none"], 1, "", "--algorithm"),
    (["stripify", "tube.obj", "--algorithm", "best,sgi-strips"], 1, "", "--compare"),
    (["stripify", "tube.obj", "--algorithm", "none", "--compare"], 1, "", "there is no none"),
    (["stripify", "tube.obj", "sheets.ply"], 1, "", "several models are for --compare; an output that is there already is named by -o"),
    (["stripify", "tube.obj", "--compare", "-o", "out.ply"], 1, "", "--output does nothing with --compare"),
    (["stripify", "tube.obj", "--format", "csv"], 1, "", "--compare"),
    (["stripify", "tube.obj", "--time-limit", "-1"], 1, "", "--time-limit"),
    # Good runs.
    (["convert", "tube.obj", "out.pstrip"], 0, "", "tube.obj ("),
    (["validate", "good.pstrip"], 0, "good.pstrip: valid\n", ""),
    (["validate", "--ignore", "PS1006", "good.pstrip"], 0, "good.pstrip: valid (PS1006 ignored)\n", ""),
    (["validate", "--ignore", "PS1006,PS1001", "good.pstrip"], 0, "valid (PS1006, PS1001 ignored)\n", ""),
    (["convert", "tube.obj", "out.pstrip", "--attribute-weight", "TEXCOORD=0.1"], 0, "", ""),
    (["inspect", "good.pstrip"], 0, "plain profile", ""),
    (["convert", "tube.obj", "out.pstrip", "--profile", "compact"], 0, "", "-> out.pstrip ("),
    (["convert", "good.pstrip", "out.pstrip", "--profile", "compact"], 0, "", "-> out.pstrip ("),
    (["convert", "tube.obj", "out.pstrip", "--profile", "compact", "--order", "bits"], 0, "", "-> out.pstrip ("),
    (["convert", "tube.obj", "out.pstrip", "--profile", "compact", "--position-bits", "12"], 0, "",
     "positions moved by at most "),
    (["convert", "-o", "out.ply", "tube.obj"], 0, "", "-> out.ply ("),
    (["extract", "good.pstrip", "out.ply"], 0, "", "packet "),
    (["extract", "good.pstrip", "-o", "out.ply"], 0, "", "wrote out.ply ("),
    (["compare", "tube.obj", "tube.obj"], 0, "exact: ", ""),
    (["stripify", "tube.obj"], 0, "indices sent", ""),
    (["stripify", "tube.obj", "-o", "out.ply"], 0, "indices sent", "wrote out.ply ("),
    (["stripify", "cube.mesh", "--output", "out.ply"], 0, "vertices sent", "wrote out.ply ("),
    # The operating system refuses.
    (["convert", "missing.obj", "out.ply"], 2, "", "missing.obj: cannot open"),
    (["convert", ".", "out.ply"], 2, "", "is a folder"),
    # Found before the work: the huge file is not opened.
    (["convert", "tube.obj", "missing/out.ply"], 2, "", "missing/out.ply"),
    (["convert", "huge.ply", "missing/out.ply"], 2, "", "missing/out.ply"),
    (["convert", "tube.obj", "tube.obj/out.ply"], 2, "", "tube.obj/out.ply"),
    (["convert", "tube.obj", "folder.ply"], 2, "", "is a folder"),
    (["convert", "tube.obj", "/dev/full", "--to", "ply"], 2, "", "/dev/full"),
    (["validate", "missing.pstrip"], 2, "missing.pstrip: unreadable", "cannot open"),
    (["inspect", "missing.pstrip"], 2, "", "missing.pstrip: cannot open"),
    (["extract", "missing.pstrip", "out.ply"], 2, "", "missing.pstrip: cannot open"),
    (["extract", "good.pstrip", "missing/out.ply"], 2, "", "missing/out.ply"),
    (["compare", "tube.obj", "missing.obj"], 2, "", "missing.obj: cannot open"),
    (["stripify", "missing.obj"], 2, "", "missing.obj: cannot open"),
    (["stripify", "tube.obj", "-o", "missing/out.glb"], 2, "", "missing/out.glb"),
    # Broken files.
    *(([*command, "corrupt.ply", *rest], 3, "", "corrupt.ply: corrupt: ")
      for command, rest in ((["convert"], ["out.obj"]), (["inspect"], []), (["stripify"], []),
                            (["compare", "tube.obj"], []))),
    (["validate", "corrupt.pstrip"], 3, "corrupt.pstrip: invalid, ", ""),
    (["validate", "cut.pstrip"], 3, "cut.pstrip: truncated, ", ""),
    (["convert", "cut.pstrip", "out.ply"], 3, "", "cut.pstrip: truncated: "),
    (["convert", "corrupt.pstrip", "out.ply"], 3, "", "corrupt.pstrip: corrupt: "),
    (["extract", "corrupt.pstrip", "out.ply"], 3, "", "corrupt.pstrip: corrupt: "),
    (["convert", "empty.pstrip", "out.ply"], 3, "", "empty.pstrip: truncated: "),
    # Beyond the limits: refused at once, with the figure that did not fit.
    *(([*command, "tube.obj", *rest, "--max-vertices", "5"], 3, "",
       "over the limit: 192 vertices, more than the limit of 5")
      for command, rest in ((["convert"], ["out.ply"]), (["stripify"], []), (["compare", "tube.obj"], []))),
    (["stripify", "sheets.ply", "--max-memory", "9000"], 3, "", "bytes of memory to stripify, more than"),
    (["convert", "tube.obj", "out.pstrip", "--max-memory", "70000"], 3, "", "bytes of memory to encode, more than"),
    *(([*command, "huge.ply", *rest], 3, "", "huge.ply: over the limit: 65000000214 bytes, more than")
      for command, rest in HUGE),
    *(([*command, "huge.ply", *rest, "--max-memory", "99000000000"], 3, "",
       "over the limit: 5000000000 faces, more than the limit of 1073741824") for command, rest in HUGE),
    (["convert", "huge.ply", "out.pstrip", "--max-memory", "99000000000", "--max-corners", "99000000000"], 3, "",
     "over the limit: 5000000000 faces, more than the limit of 4294967040"),
    (["convert", "huge.gltf", "out.ply"], 3, "",
     "over the limit: 3000000000 face corners, more than the limit of 1073741824"),
    (["convert", "good.pstrip", "out.ply", "--max-vertices", "2"], 3, "", "vertices, more than the limit of 2"),
    (["convert", "good.pstripx", "out.ply", "--max-vertices", "2"], 3, "", "vertices, more than the limit of 2"),
    (["validate", "good.pstrip", "--max-vertices", "2"], 3, "over the limit", ""),
    # What the program does not know.
    (["convert", "noise.bin", "out.ply"], 5, "", "unsupported: "),
    (["inspect", "noise.bin"], 5, "", "unsupported: "),
    (["inspect", "solid.stl"], 5, "", "ply, obj, gltf, glb"),
    (["validate", "tube.obj"], 5, "tube.obj: not covered\n", "the validator covers pstrip and pstripx, not obj"),
    (["compare", "tube.obj", "noise.bin"], 5, "", "unsupported: "),
    (["stripify", "noise.bin"], 5, "", "unsupported: "),
    (["extract", "tube.obj", "out.ply"], 5, "", "has no levels"),
    (["convert", "tube.obj", "out.ply", "--level", "1"], 5, "", "has no levels"),
    (["convert", "needs.gltf", "out.ply"], 5, "", "unsupported: "),
    # Differences.
    (["compare", "tube.obj", "good.pstrip"], 7, "different\n", ""),
]

# A file with all bytes that its header asks for, none of which take room on the disk.
HUGE_PLY = """ply
format binary_little_endian 1.0
element vertex 3
property float x
property float y
property float z
element face 5000000000
property list uchar int vertex_indices
end_header
"""
HUGE_GLTF = """{"asset": {"version": "2.0"},
"buffers": [{"uri": "huge.bin", "byteLength": 12000000036}],
"bufferViews": [{"buffer": 0, "byteLength": 36}, {"buffer": 0, "byteOffset": 36, "byteLength": 12000000000}],
"accessors": [{"bufferView": 0, "componentType": 5126, "type": "VEC3", "count": 3},
{"bufferView": 1, "componentType": 5125, "type": "SCALAR", "count": 3000000000}],
"meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}]}"""

CORRUPT_PLY = """ply
format ascii 1.0
element vertex 3
property float x
property float y
property float z
element face 1
property list uchar int vertex_indices
end_header
0 0 0
1 0 0
0 1 0
3 0 1 7
"""

NEEDS_GLTF = '{"asset":{"version":"2.0"},"extensionsUsed":["X_y"],"extensionsRequired":["X_y"]}'


class ExitCodes(ProgramTest):
    def setUp(self):
        super().setUp()
        self.write_tube()
        golden = GOLDEN.read_bytes()
        self.write("good.pstrip", golden)
        self.write("cut.pstrip", golden[:-20])
        half = len(golden) // 2
        self.write("corrupt.pstrip", golden[:half] + bytes([golden[half] ^ 255]) + golden[half + 1:])
        self.write("empty.pstrip", b"")
        self.write("corrupt.ply", CORRUPT_PLY)
        self.write("sheets.ply", CORRUPT_PLY.replace("face 1", "face 100").replace("3 0 1 7\n", "3 0 1 2\n" * 100))
        self.write("noise.bin", bytes((i * 73 + 41) % 256 for i in range(1, 500)))
        self.write("needs.gltf", NEEDS_GLTF)
        self.write("good.pstripx", GOLDEN_XML.read_bytes())
        os.truncate(self.write("huge.ply", HUGE_PLY), len(HUGE_PLY) + 36 + 13 * 5_000_000_000)
        self.write("huge.gltf", HUGE_GLTF)
        os.truncate(self.write("huge.bin", b""), 12_000_000_036)
        (self.folder / "folder.ply").mkdir()
        self.write("cube.mesh", CUBE)
        self.write("solid.stl", "solid\nfacet normal 0 0 1\n")
        (self.folder / "hard.obj").hardlink_to(self.folder / "tube.obj")
        (self.folder / "soft.obj").symlink_to("tube.obj")

    def test_table(self):
        before = {path.name for path in self.folder.iterdir()}
        for arguments, code, out, err in CASES:
            with self.subTest(arguments=arguments):
                run = self.run_program(*arguments, code=code)
                self.assertIn(out, run.out.decode())
                self.assertIn(err, run.err)
                self.assertNotIn("18446744073709551615", run.err)
                new = {path.name for path in self.folder.iterdir()} - before
                if code in (0, 7):
                    self.assertLessEqual(new, {"out.pstrip", "out.ply"}, "only what was asked for")
                else:
                    self.assertEqual(new, set(), "a failed run leaves nothing")
                for name in new:
                    (self.folder / name).unlink()

    def test_worst_of_several_files_decides(self):
        run = self.run_program("validate", "good.pstrip", "cut.pstrip", "good.pstrip", code=3)
        verdicts = [line for line in run.out.decode().splitlines() if not line.startswith(" ")]
        self.assertEqual(verdicts, ["good.pstrip: valid", "cut.pstrip: truncated, 1 error, 0 warnings",
                                    "good.pstrip: valid"])


if __name__ == "__main__":
    unittest.main()
