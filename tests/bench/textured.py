#!/usr/bin/env python3
"""What textured models look like at coarse levels: runs textured_bench, prints Markdown, writes CSV
and a sheet of pictures for each model.

    textured.py TEXTURED_BENCH FOLDER [ARGUMENT …]   arguments go to textured_bench

FOLDER gets textured.csv and MODEL.png.
"""

import csv
import math
import pathlib
import struct
import sys
import zlib

from levels import ordered, run

PEERS = ("meshopt", "meshopt-welded")
OURS = ("ours", "ours-qem", "ours-optimal", "ours-optimal-qem")
# column, its head, how a value is shown
SHOWN = (
    ("silhouette", "outline %", lambda x: f"{100 * x:.2f}"),
    ("depth", "depth", lambda x: f"{x:.0f}"),
    ("face_normal", "face normal °", lambda x: f"{x:.1f}"),
    ("vertex_normal", "vertex normal °", lambda x: f"{x:.1f}"),
    ("unlit", "unlit %", lambda x: f"{100 * x:.2f}"),
    ("face_lit", "face-lit %", lambda x: f"{100 * x:.2f}"),
    ("vertex_lit", "lit %", lambda x: f"{100 * x:.2f}"),
    ("structure", "1 - SSIM", lambda x: f"{x:.3f}"),
    ("uv", "UV %", lambda x: f"{100 * x:.2f}"),
    ("stretch", "stretch", lambda x: f"{x:.2f}"),
)
RATIOS = tuple(name for name, _, _ in SHOWN)


def rows_of(text):
    rows = list(csv.DictReader(text.splitlines()))
    for row in rows:
        for name in row:
            if name not in ("model", "variant", "stop"):
                row[name] = float(row[name])
    return rows


def print_share(rows, share):
    print(f"\n## {share:.0%} of the triangles\n")
    print("| | | triangles | " + " | ".join(head for _, head, _ in SHOWN) + " | PSNR | L2 | max |")
    print("|---|---" + "|---:" * (len(SHOWN) + 4) + "|")
    for row in (r for r in rows if r["share"] == share):
        cells = [show(row[name]) for name, _, show in SHOWN]
        psnr = -20 * math.log10(max(row["vertex_lit"], 1e-6))
        stuck = f" ({row['stop']})" if row["stop"] else ""
        print(f"| {row['model']} | {row['variant']} | {row['triangles']:.0f}{stuck} | "
              + " | ".join(cells)
              + f" | {psnr:.1f} | {row['stretch_l2']:.3g} | {row['stretch_max']:.3g} |")  # fmt: skip


def geometric_mean(values):
    return math.exp(sum(math.log(v) for v in values) / len(values))


def print_ratios(rows, share):
    """Ours over each peer's where both have the same number of triangles; of variants the means."""
    at = {(r["model"], r["variant"]): r for r in rows if r["share"] == share}
    models = ordered(r["model"] for r in rows)
    print(f"\n## Ours as a multiple of theirs at {share:.0%}\n")
    print("Where a peer stopped early, at the number of triangles it reached.\n")
    print("| | | model | " + " | ".join(head for _, head, _ in SHOWN) + " |")
    print("|---|---|---" + "|---:" * len(SHOWN) + "|")
    for peer in PEERS:
        for ours in OURS:
            kept = {}
            for model in models:
                theirs = at.get((model, peer))
                mine = at.get((model, f"{ours}@{peer}")) or at.get((model, ours))
                if theirs and mine:
                    kept[model] = [max(mine[n], 1e-6) / max(theirs[n], 1e-6) for n in RATIOS]
            if not kept:
                continue
            for model, ratios in kept.items() if ours == OURS[0] else ():
                print(f"| {ours} | {peer} | {model} | " + " | ".join(f"{r:.2f}" for r in ratios) + " |")
            means = [geometric_mean(column) for column in zip(*kept.values())]
            print(f"| {ours} | {peer} | **mean** | " + " | ".join(f"**{m:.2f}**" for m in means) + " |")


def write_png(ppm, path):
    size, _, pixels = ppm.split(b"\n", 3)[1:]
    width, height = map(int, size.split())
    rows = b"".join(b"\0" + pixels[3 * width * y : 3 * width * (y + 1)] for y in range(height))

    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    path.write_bytes(b"\x89PNG\r\n\x1a\n"
                     + chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0))
                     + chunk(b"IDAT", zlib.compress(rows)) + chunk(b"IEND", b""))  # fmt: skip


def main():
    if len(sys.argv) < 3:
        sys.exit(__doc__)
    folder = pathlib.Path(sys.argv[2])
    folder.mkdir(parents=True, exist_ok=True)
    text = run(sys.argv[1], ["--sheets", str(folder), *sys.argv[3:]])
    (folder / "textured.csv").write_text(text)
    for sheet in sorted(folder.glob("*.ppm")):
        write_png(sheet.read_bytes(), sheet.with_suffix(".png"))
        sheet.unlink()
    rows = rows_of(text)
    for share in ordered(r["share"] for r in rows):
        print_share(rows, share)
    print_ratios(rows, 0.05)


if __name__ == "__main__":
    main()
