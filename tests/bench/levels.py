#!/usr/bin/env python3
"""How good coarse levels are: runs levels_bench, prints Markdown, writes CSV and an SVG plot.

    levels.py LEVELS_BENCH FOLDER [ARGUMENT …]   arguments go to levels_bench
    levels.py --plot CSV FOLDER                  tables and plot of an earlier run

FOLDER gets levels.csv and levels.svg.
"""

import csv
import html
import math
import pathlib
import subprocess
import sys

TABLE_SHARES = (0.2, 0.05, 0.01)
# The one that times are compared with, then those whose times are the bar for ours.
YARDSTICK = "meshopt"
COLOURS = {
    "meshopt": "#999999", "openmesh": "#555555", "cgal-gh": "#c58b2a", "cgal-lt": "#8a4b08",
    "subset-qem": "#7aa6d8", "subset-memoryless": "#2f6db3", "optimal-qem": "#7fbf7b",
    "optimal-memoryless": "#1b7837",
}  # fmt: skip
OURS = ("subset", "optimal")


def run(program, arguments):
    lines = []
    with subprocess.Popen([program, *arguments], stdout=subprocess.PIPE, text=True) as process:
        for line in process.stdout:
            lines.append(line)
            print(line, end="", file=sys.stderr, flush=True)
    if process.returncode != 0:
        sys.exit(f"{program} failed with status {process.returncode}")
    return "".join(lines)


def rows_of(text):
    rows = list(csv.DictReader(text.splitlines()))
    for row in rows:
        for name in ("share", "seconds", "rms", "hausdorff"):
            row[name] = float(row[name])
        row["triangles"] = int(row["triangles"])
    return rows


def ordered(values):
    return list(dict.fromkeys(values))


def print_tables(rows):
    for model in ordered(r["model"] for r in rows):
        at = {(r["simplifier"], r["share"]): r for r in rows if r["model"] == model}
        print(f"\n### {model}\n")
        print("RMS / Hausdorff distance in 1e-4 of the diagonal; time to 5 % as a multiple of "
              f"{YARDSTICK}'s.\n")
        print("| | " + " | ".join(f"{share:.0%}" for share in TABLE_SHARES) + " | ms to 5 % | times |")
        print("|---" + "|---:" * (len(TABLE_SHARES) + 2) + "|")
        base = at.get((YARDSTICK, 0.05))
        for name in ordered(s for s, _ in at):
            cells = [f"{at[name, s]['rms'] * 1e4:.4g} / {at[name, s]['hausdorff'] * 1e4:.3g}"
                     for s in TABLE_SHARES]  # fmt: skip
            seconds = at[name, 0.05]["seconds"]
            ratio = f"{seconds / base['seconds']:.1f}" if base and base["seconds"] > 0 else "-"
            print(f"| {name} | " + " | ".join(cells) + f" | {seconds * 1e3:.0f} | {ratio} |")


class Panel:
    """One model: RMS over triangles, both logarithmic."""

    WIDTH, HEIGHT, LEFT, TOP = 330, 240, 52, 26

    def __init__(self, rows, x, y):
        self.rows, self.x, self.y = rows, x, y
        self.triangles = self.bounds([r["triangles"] for r in rows])
        self.errors = self.bounds([max(r["rms"], 1e-9) for r in rows])

    @staticmethod
    def bounds(values):
        low, high = math.log10(min(values)), math.log10(max(values))
        margin = 0.04 * (high - low or 1)
        return low - margin, high + margin

    def place(self, triangles, error):
        def along(value, bounds):
            return (math.log10(value) - bounds[0]) / (bounds[1] - bounds[0])

        across = along(triangles, self.triangles) * self.WIDTH
        up = along(max(error, 1e-9), self.errors) * self.HEIGHT
        return self.x + self.LEFT + across, self.y + self.TOP + self.HEIGHT - up

    @staticmethod
    def ticks(bounds, factors):
        for power in range(math.floor(bounds[0]), math.ceil(bounds[1]) + 1):
            for factor in factors:
                value = factor * 10.0**power
                if bounds[0] <= math.log10(value) <= bounds[1]:
                    yield value

    def draw(self, title, out):
        left, top = self.x + self.LEFT, self.y + self.TOP
        out.append(f'<text x="{left}" y="{top - 8}" class="title">{html.escape(title)}</text>')
        out.append(f'<rect x="{left}" y="{top}" width="{self.WIDTH}" height="{self.HEIGHT}" '
                   'class="frame"/>')  # fmt: skip
        for value in self.ticks(self.triangles, (1, 3)):
            x, _ = self.place(value, 10 ** self.errors[0])
            out.append(f'<line x1="{x:.1f}" y1="{top}" x2="{x:.1f}" y2="{top + self.HEIGHT}"/>')
            out.append(f'<text x="{x:.1f}" y="{top + self.HEIGHT + 14}" '
                       f'text-anchor="middle">{value:,.0f}</text>')  # fmt: skip
        span = self.errors[1] - self.errors[0]
        for value in self.ticks(self.errors, (1, 3) if span < 4 else (1,)):
            _, y = self.place(10 ** self.triangles[0], value)
            out.append(f'<line x1="{left}" y1="{y:.1f}" x2="{left + self.WIDTH}" y2="{y:.1f}"/>')
            out.append(f'<text x="{left - 5}" y="{y + 4:.1f}" '
                       f'text-anchor="end">{value:.0e}</text>')  # fmt: skip
        for name, colour in COLOURS.items():
            points = [self.place(r["triangles"], r["rms"]) for r in self.rows
                      if r["simplifier"] == name]  # fmt: skip
            if not points:
                continue
            line = " ".join(f"{x:.1f},{y:.1f}" for x, y in points)
            width = 2.2 if name.startswith(OURS) else 1.4
            out.append(f'<polyline points="{line}" stroke="{colour}" stroke-width="{width}"/>')
            out += [f'<circle cx="{x:.1f}" cy="{y:.1f}" r="2.4" fill="{colour}"/>'
                    for x, y in points]  # fmt: skip


def svg(rows):
    models = ordered(r["model"] for r in rows)
    columns = min(3, len(models))
    cell = (Panel.WIDTH + 80, Panel.HEIGHT + 66)
    width, height = columns * cell[0], -(-len(models) // columns) * cell[1] + 46
    out = [f'<svg xmlns="http://www.w3.org/2000/svg" width="{width}" height="{height}" '
           f'viewBox="0 0 {width} {height}">',
           "<style>text{font:11px sans-serif;fill:#333}.title{font-weight:bold;font-size:13px}"
           "line{stroke:#e4e4e4}.frame{fill:none;stroke:#999}polyline{fill:none}</style>",
           f'<rect width="{width}" height="{height}" fill="white"/>',
           '<text x="12" y="18" class="title">RMS distance to the original (of the diagonal) '
           "over triangles left</text>"]  # fmt: skip
    x = 12
    for name, colour in COLOURS.items():
        if any(r["simplifier"] == name for r in rows):
            out.append(f'<rect x="{x}" y="28" width="14" height="4" fill="{colour}"/>')
            out.append(f'<text x="{x + 18}" y="34">{name}</text>')
            x += 34 + 7 * len(name)
    for i, model in enumerate(models):
        panel = Panel([r for r in rows if r["model"] == model], i % columns * cell[0],
                      46 + i // columns * cell[1])  # fmt: skip
        panel.draw(model, out)
    return "\n".join([*out, "</svg>\n"])


def main():
    if len(sys.argv) < 3:
        sys.exit(__doc__)
    if sys.argv[1] == "--plot":
        text = pathlib.Path(sys.argv[2]).read_text()
        folder = pathlib.Path(sys.argv[3])
    else:
        folder = pathlib.Path(sys.argv[2])
        text = run(sys.argv[1], sys.argv[3:])
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "levels.csv").write_text(text)
    rows = rows_of(text)
    print_tables(rows)
    (folder / "levels.svg").write_text(svg(rows))


if __name__ == "__main__":
    main()
