#!/usr/bin/env python3
"""How many bytes textured models take in the compact profile, beside Draco's encoder.

    textured_bytes.py PSTRIPS [MODEL …]

Each model is made an OBJ file with normals and texture coordinates first, which both programs read;
so neither has images. Both use the bits that are Draco's default: 11 for positions, 10 for texture
coordinates, 8 for normals. Ours counts all bytes of the file but the chunks of the scene (names and
materials, which Draco's file does not have); Draco's is its whole file, at -cl 10, and beside it at its
default level. Draco's parts are differences between files with and without an attribute. Prints
Markdown. Without models: ten of the folder textured in $PSTRIPS_MODELS or ../shared/models beside the
source tree.
"""

import json
import math
import os
import pathlib
import subprocess
import sys
import tempfile

MODELS = [
    "Duck-glTF-Binary/Duck.glb", "blender-io/02_suzanne/02_suzanne.gltf",
    "CesiumMan-glTF-Binary/CesiumMan.glb", "babylon/shaderBall.glb", "deer/deer.gltf",
    "capsule/capsule.obj", "ClearCoatTest/ClearCoatTest.gltf", "ShapeCollection.glb",
    "babylon/frostAxe.glb", "CesiumMilkTruck-glTF-Binary/CesiumMilkTruck.glb",
]  # fmt: skip
OURS = ("--profile", "compact", "--position-bits", "11", "--normal-bits", "8", "--uv-bits", "10")
THEIRS = ("-qp", "11", "-qt", "10", "-qn", "8")
PARTS = {
    "names, connectivity": ("names", "connectivity"),
    "positions": ("positions", "tangential", "normal"),
    "wedges": ("wedges",),
    "attributes": ("attributes",),
    "base": ("base",),
    "container": ("container", "strips"),
}


def run(*command):
    done = subprocess.run([str(word) for word in command], capture_output=True, text=True)
    if done.returncode != 0:
        sys.exit(f"failed with status {done.returncode}: {done.args}\n{done.stderr}")
    return done.stdout


def models_folder():
    source = pathlib.Path(__file__).resolve().parents[2]
    return pathlib.Path(os.environ.get("PSTRIPS_MODELS", source.parent / "shared/models"))


def draco_bytes(obj, level, *skipped):
    out = obj.with_suffix(".drc")
    words = [word for attribute in skipped for word in ("--skip", attribute)]
    run("draco_encoder", "-i", obj, "-o", out, "-cl", level, *THEIRS, *words)
    return out.stat().st_size


def measure(pstrips, model, folder):
    obj, out = folder / "model.obj", folder / "model.pstrip"
    run(pstrips, "convert", "-q", "--force", model, obj)
    run(pstrips, "convert", "-q", "--force", *OURS, "--attributes", "NORMAL,TEXCOORD_0", obj, out)
    report = json.loads(run(pstrips, "inspect", "--format", "json", out))
    part = {name: report["parts"][name]["bytes"] for name in report["parts"]}
    row = {"model": pathlib.Path(model).stem, "number of wedges": report["wedges"],
           "ours": report["bytes"] - part["scene"], "-cl 10": draco_bytes(obj, 10),
           "-cl 7": draco_bytes(obj, 7)}  # fmt: skip
    for name, members in PARTS.items():
        row[name] = sum(part[member] for member in members)
    bare = draco_bytes(obj, 10, "NORMAL", "TEX_COORD")
    row["geometry"] = bare
    row["normals"] = row["-cl 10"] - draco_bytes(obj, 10, "NORMAL")
    row["texture"] = row["-cl 10"] - bare - row["normals"]
    return row


def print_table(rows):
    heads = ["number of wedges", "ours", "-cl 10", "-cl 7"]
    print("| model | " + " | ".join(heads) + " | ours / -cl 10 | ours / -cl 7 | "
          + " | ".join(PARTS) + " | Draco: geometry | normals | texture |")  # fmt: skip
    print("|---" + "|---:" * (len(heads) + len(PARTS) + 5) + "|")
    for row in rows:
        ratios = [f"{row['ours'] / row[level]:.2f}" for level in ("-cl 10", "-cl 7")]
        cells = [f"{row[head]:.0f}" for head in heads] + ratios
        cells += [f"{row[name]:.0f}" for name in (*PARTS, "geometry", "normals", "texture")]
        print(f"| {row['model']} | " + " | ".join(cells) + " |")
    for level in ("-cl 10", "-cl 7"):
        logs = [math.log(row["ours"] / row[level]) for row in rows]
        print(f"\nGeometric mean of ours over Draco's {level}: {math.exp(sum(logs) / len(logs)):.3f}")


def main():
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    models = sys.argv[2:] or [models_folder() / "textured" / model for model in MODELS]
    with tempfile.TemporaryDirectory() as folder:
        print_table([measure(sys.argv[1], model, pathlib.Path(folder)) for model in models])


if __name__ == "__main__":
    main()
