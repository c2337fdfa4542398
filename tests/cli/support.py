"""What the tests of the program share: running it, its schemas, small models."""

import json
import math
import os
import pathlib
import shutil
import subprocess
import tempfile
import unittest

import jsonschema

PROGRAM = os.environ["PSTRIPS_PROGRAM"]
SOURCE = pathlib.Path(__file__).resolve().parents[2]
GOLDEN = SOURCE / "tests/data/golden/example.pstrip"
GOLDEN_XML = SOURCE / "tests/data/golden/example.pstripx"

MESH_FORMATS = ("ply", "obj", "gltf", "glb")
STRIP_FORMATS = ("pstrip", "pstripx", "pm")
FORMATS = MESH_FORMATS + STRIP_FORMATS

# A MEDIT file of six tetrahedra.
CUBE = """MeshVersionFormatted 2
Dimension 3
Vertices
8
0 0 0 1
1 0 0 1
0 1 0 1
1 1 0 1
0 0 1 1
1 0 1 1
0 1 1 1
1 1 1 1
Tetrahedra
6
1 2 4 8 0
1 4 3 8 0
1 3 7 8 0
1 7 5 8 0
1 5 6 8 0
1 6 2 8 0
End
"""


class Run:
    """A finished run: exit code, standard output (bytes) and standard error (text)."""

    def __init__(self, arguments, folder, stdin=b""):
        done = subprocess.run([PROGRAM, *(os.fsencode(str(a)) for a in arguments)], cwd=folder, input=stdin,
                              capture_output=True, timeout=120)
        self.arguments = arguments
        self.code = done.returncode
        self.out = done.stdout
        self.err = done.stderr.decode("utf-8", "surrogateescape")

    def __str__(self):
        return f"pstrips {' '.join(map(str, self.arguments))} -> {self.code}\n{self.out!r}\n{self.err}"


class ProgramTest(unittest.TestCase):
    """A test with a folder of its own, in which the program runs."""

    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="pstrips-cli-"))
        self.addCleanup(shutil.rmtree, self.folder)

    def run_program(self, *arguments, code=0, stdin=b""):
        run = Run(arguments, self.folder, stdin)
        self.assertEqual(run.code, code, run)
        return run

    def write(self, name, content):
        path = self.folder / name
        path.write_bytes(content if isinstance(content, bytes) else content.encode())
        return path

    def read(self, name):
        return (self.folder / name).read_bytes()

    def write_tube(self, rings=12, around=16):
        """tube.obj and tube.mtl: a UV seam along the tube, two materials, normals."""
        self.write("tube.obj", tube(rings, around))
        self.write("tube.mtl", "newmtl clay\nKd 0.8 0.4 0.2\nnewmtl glaze\nKd 0.1 0.2 0.9\n")

    def equivalence(self, a, b):
        """What compare says of two models: the first word."""
        return Run(("compare", a, b), self.folder).out.split(b":")[0].strip().decode()

    def report(self, command, *arguments, code=0, schema=None):
        """A report in JSON, checked against its schema and against what standard JSON allows."""
        run = self.run_program(command, "--format", "json", *arguments, code=code)

        def refuse(constant):
            self.fail(f"{constant} is not JSON: {run}")

        report = json.loads(run.out, parse_constant=refuse)
        rules = json.loads((SOURCE / f"spec/schemas/{schema or command}.schema.json").read_text())
        jsonschema.Draft202012Validator.check_schema(rules)
        jsonschema.Draft202012Validator(rules).validate(report)
        return report


def tube(rings, around):
    lines = ["mtllib tube.mtl"]
    angles = [2 * math.pi * a / around for a in range(around)]
    for r in range(rings):
        lines += [f"v {math.cos(t):.6g} {math.sin(t):.6g} {r / 4:.6g}" for t in angles]
    for r in range(rings):
        lines += [f"vt {a / around:.6g} {r / (rings - 1):.6g}" for a in range(around + 1)]
    lines += [f"vn {math.cos(t):.6g} {math.sin(t):.6g} 0" for t in angles]

    def corner(r, a):  # column `around` is column 0 again, with a UV of its own
        return f"{r * around + a % around + 1}/{r * (around + 1) + a + 1}/{a % around + 1}"

    for r in range(rings - 1):
        if r == 0:
            lines.append("usemtl clay")
        if r == rings // 2:
            lines.append("usemtl glaze")
        for a in range(around):
            quad = corner(r, a), corner(r, a + 1), corner(r + 1, a + 1), corner(r + 1, a)
            lines.append(f"f {quad[0]} {quad[1]} {quad[2]}")
            lines.append(f"f {quad[0]} {quad[2]} {quad[3]}")
    return "\n".join(lines) + "\n"


def bumpy_grid(side):
    """An OBJ of 2 * side * side triangles, positions only."""
    lines = [f"v {x} {y} {(x * 7 + y * 13) % 11}" for y in range(side + 1) for x in range(side + 1)]
    for y in range(side):
        for x in range(side):
            a = y * (side + 1) + x + 1
            b = a + side + 1
            lines.append(f"f {a} {a + 1} {b + 1}\nf {a} {b + 1} {b}")
    return "\n".join(lines) + "\n"
