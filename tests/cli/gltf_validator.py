"""The Khronos validator, where web/build has installed it."""

import json
import pathlib
import subprocess

FOLDER = pathlib.Path(__file__).resolve().parents[2] / "build/web/node_modules/gltf-validator"

SCRIPT = """
const fs = require("fs"), path = require("path"), validator = require(process.argv[1]), file = process.argv[2];
const read = uri => new Promise(done => done(new Uint8Array(
  fs.readFileSync(path.join(path.dirname(file), decodeURIComponent(uri))))));
validator.validateBytes(new Uint8Array(fs.readFileSync(file)), { externalResourceFunction: read, maxIssues: 1000 })
  .then(report => console.log(JSON.stringify(report.issues.messages)));
"""


def is_installed():
    return FOLDER.is_dir()


def complaints(path):
    """Errors and warnings as "CODE pointer"; nothing where there is no validator."""
    if not is_installed():
        return []
    done = subprocess.run(["node", "-e", SCRIPT, str(FOLDER), str(path)], capture_output=True, timeout=60, check=True)
    return [f"{m['code']} {m.get('pointer', '')}" for m in json.loads(done.stdout) if m["severity"] <= 1]
