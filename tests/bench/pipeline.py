#!/usr/bin/env python3
"""Measures whole programs: `pstrips convert` to and from .pstrip beside Draco's encoder and decoder.

    pipeline.py MEASURE_PROCESS PSTRIPS [MODEL.ply …]

Each model is made a plain binary PLY first (positions and triangles), which all programs read. Their
runs take turns, so that what else the machine does meets all of them; times are wall-clock medians
of five, memory is the largest resident set (ru_maxrss). Prints Markdown. Without models: bunny, igea
and turbineblade of $PSTRIPS_MODELS or ../shared/models beside the source tree.
"""

import os
import pathlib
import re
import shutil
import statistics
import subprocess
import sys
import tempfile

RUNS = 5
MODELS = ["bun_zipper.ply", "igea.ply", "turbineblade.ply"]


def run(command):
    """Seconds and peak bytes of one run; ends the program when it fails."""
    done = subprocess.run([sys.argv[1], *map(str, command)], capture_output=True, text=True)
    if done.returncode != 0:
        sys.exit(f"failed with status {done.returncode}: {' '.join(map(str, command))}")
    seconds, peak = done.stdout.split()
    return float(seconds), int(peak)


class Peer:
    """A program with what it makes."""

    def __init__(self, name, command, output):
        self.name, self.command, self.output = name, command, output
        self.times, self.peaks = [], []

    def run(self):
        seconds, peak = run(self.command)
        self.times.append(seconds)
        self.peaks.append(peak)

    @property
    def seconds(self):
        return statistics.median(self.times)

    @property
    def peak(self):
        return statistics.median(self.peaks)

    @property
    def size(self):
        return self.output.stat().st_size


def take_turns(peers):
    for _ in range(RUNS):
        for peer in peers:
            peer.run()


def counts(model):
    """Vertices and faces, from the header."""
    header = model.read_bytes()[:65536].split(b"end_header")[0].decode("latin-1")
    return tuple(int(re.search(rf"element {e} (\d+)", header)[1]) for e in ("vertex", "face"))


def print_table(peers, yardstick, plain):
    """Each peer; the first is ours. Memory also in multiples of `yardstick` bytes."""
    ours = peers[0]
    print(f"| | ms | ours / it | output, bytes | of plain PLY | peak, MB | peak / {plain[0]} |")
    print("|---|---:|---:|---:|---:|---:|---:|")
    for peer in peers:
        print(f"| {peer.name} | {peer.seconds * 1e3:.0f} | {ours.seconds / peer.seconds:.2f} "
              f"| {peer.size} | {peer.size / plain[1]:.2f} | {peer.peak / 1e6:.1f} "
              f"| {peer.peak / yardstick(peer):.1f} |")
    print()


def measure(pstrips, model, folder):
    source = folder / "plain.ply"
    run([pstrips, "convert", "--quiet", "--attributes", "none", model, source])
    vertices, triangles = counts(source)
    plain = source.stat().st_size
    print(f"## {model.name}\n\n{vertices} vertices, {triangles} triangles, "
          f"{plain} bytes as plain binary PLY\n")
    strips = folder / "model.pstrip"
    coded = {level: folder / f"model-{level}.drc" for level in (7, 10)}
    encoders = [Peer("pstrips convert", [pstrips, "convert", "--quiet", source, strips], strips)]
    encoders += [Peer(f"draco_encoder -cl {level}",
                      ["draco_encoder", "-cl", level, "-i", source, "-o", path], path)
                 for level, path in coded.items()]
    take_turns(encoders)
    print("Encoding:\n")
    print_table(encoders, lambda _: plain, ("plain PLY", plain))

    back = folder / "back.ply"
    decoders = [Peer("pstrips convert", [pstrips, "convert", "--quiet", strips, back], back)]
    decoders += [Peer(f"draco_decoder (-cl {level})",
                      ["draco_decoder", "-i", path, "-o", folder / f"back-{level}.ply"],
                      folder / f"back-{level}.ply") for level, path in coded.items()]
    take_turns(decoders)
    print("Decoding to PLY:\n")
    print_table(decoders, lambda peer: peer.size, ("output", plain))


def default_models():
    source = pathlib.Path(__file__).resolve().parents[2]
    folder = pathlib.Path(os.environ.get("PSTRIPS_MODELS", source.parent / "shared" / "models"))
    return [folder / "classic" / name for name in MODELS]


def main():
    if len(sys.argv) < 3:
        sys.exit(__doc__.strip())
    pstrips = sys.argv[2]
    models = [pathlib.Path(m) for m in sys.argv[3:]] or default_models()
    for peer in ("draco_encoder", "draco_decoder"):
        if shutil.which(peer) is None:
            sys.exit(f"{peer} is not there: install the package draco")
    for model in models:
        if not model.is_file():
            sys.exit(f"no such model: {model}")
    print(f"# Whole programs, medians of {RUNS} runs that took turns\n")
    _, empty = run([pstrips, "--version"])
    print(f"A pstrips that only prints its version peaks at {empty / 1e6:.1f} MB.\n")
    with tempfile.TemporaryDirectory() as folder:
        for model in models:
            measure(pstrips, model, pathlib.Path(folder))


if __name__ == "__main__":
    main()
