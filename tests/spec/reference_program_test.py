"""The decoder from the text alone comes to the digests that the program writes into its files."""

import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

SOURCE = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(SOURCE / "spec/reference"))

import reference  # noqa: E402

PROGRAM = os.environ["PSTRIPS_PROGRAM"]
MODELS = [
    path
    for folder in ("points", "polygons", "scenes", "surfaces", "textured")
    for path in sorted((SOURCE / "tests/data/models" / folder).iterdir())
    if path.suffix in (".ply", ".obj", ".gltf", ".glb")
]
WAYS = {
    "plain": ("--profile", "plain"),
    "bit for bit": ("--profile", "compact", "--base", "8"),
    "moved vertices": ("--profile", "compact", "--base", "8", "--placement", "optimal"),
    "small, moved vertices": ("--profile", "compact", "--base", "8", "--effort", "small",
                              "--placement", "optimal"),
    "grid": ("--profile", "compact", "--base", "8", "--position-bits", "12"),
    "few bits": ("--profile", "compact", "--base", "8", "--position-bits", "9", "--normal-bits", "7",
                 "--uv-bits", "10", "--color-bits", "6", "--attribute-bits", "8"),
}


def convert(model, options, folder):
    """The bytes of the progressive file, or None where the options are not for such a model."""
    out = pathlib.Path(folder) / "model.pstrip"
    result = subprocess.run([PROGRAM, "convert", *options, "--force", str(model), str(out)],
                            capture_output=True, text=True, check=False)
    return out.read_bytes() if result.returncode == 0 else None


class ReferenceAndProgram(unittest.TestCase):
    def test_agree(self):
        for way, options in WAYS.items():
            meshes = 0
            with tempfile.TemporaryDirectory() as folder:
                for model in MODELS:
                    data = convert(model, options, folder)
                    if data is None:
                        continue
                    with self.subTest(model.name, way=way):
                        file = reference.File(data)
                        for number in range(len(file.meshes)):
                            self.assertEqual(reference.comparison(file, number), "agrees")
                            meshes += 1
            self.assertGreaterEqual(meshes, 10, way)


if __name__ == "__main__":
    unittest.main()
