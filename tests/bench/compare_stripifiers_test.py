"""compare_stripifiers prints the tables of `pstrips stripify --compare`, with memory and peers."""

import json
import os
import pathlib
import subprocess
import sys
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "cli"))
from support import SOURCE, ProgramTest  # noqa: E402

import jsonschema  # noqa: E402

PROGRAM = os.environ["COMPARE_STRIPIFIERS"]
OURS = ("best", "sgi-strips", "sgi-vertices", "mstrip", "dstrips-greedy")
PEERS = ("meshoptimizer", "OpenMesh", "VTK")  # those that are installed


class CompareStripifiers(ProgramTest):
    def compare(self, kind, *options):
        self.write_tube()
        done = subprocess.run([PROGRAM, "tube.obj", "--format", kind, *options], cwd=self.folder,
                              capture_output=True, text=True, timeout=120)
        self.assertEqual(done.returncode, 0, done.stderr)
        return done.stdout

    def test_every_row_has_its_memory(self):
        report = json.loads(self.compare("json"))
        rules = json.loads((SOURCE / "spec/schemas/stripify-compare.schema.json").read_text())
        jsonschema.Draft202012Validator(rules).validate(report)
        rows = report["models"][0]["algorithms"]
        self.assertLessEqual(set(OURS), {row["algorithm"] for row in rows})
        for row in rows:
            self.assertGreater(row["peak_bytes"], 4 * row["indices_sent"])
            if row["algorithm"] not in PEERS:
                self.assertEqual((row["remark"], row["triangles"]), ("", 352), row)

    def test_columns_of_memory(self):
        chosen = ("--algorithm", "sgi-strips")
        self.assertIn(",acmr16,peak_bytes,milliseconds,", self.compare("csv", *chosen))
        self.assertIn("| ms | peak | B/T | remark |", self.compare("md", *chosen))
        self.assertRegex(self.compare("text", *chosen).splitlines()[1], r"ms +peak$")


if __name__ == "__main__":
    unittest.main()
