#!/usr/bin/env python3
"""The encoder in one page: levels, speed, scale, files, scenes and textures beside peers and bars.

    encoder.py PSTRIPS BENCH_FOLDER OUTPUT_FOLDER [SECTION …]

BENCH_FOLDER holds the programs of tests/bench. Writes encoder.md, encoder.csv (every figure that
has a bar), and what the sections make: their own CSV and plots as SVG. Sections: levels, speed,
scaling, files, scenes, textured; without any, all of them. Models come from $PSTRIPS_MODELS or
../shared/models beside the source tree.
"""

import csv
import pathlib
import re
import resource
import subprocess
import sys
import tempfile
import time

import levels
import plot
import strip_meshes
import textured
from stripifiers import table

HERE = pathlib.Path(__file__).resolve().parent
GRID_SIDES = (187, 418, 837, 1581)  # 70 thousand to 5 million triangles
LARGE = 1_000_000  # triangles beside which the program itself takes no memory to speak of
RUNS = 3
HALF_EDGE_PEERS = ("meshopt", "openmesh")
OURS = ("pstrips", "pstrips (all cores)")
REFERENCES = ("touching the mapped bytes", "writing the bytes")


class Page:
    """Sections of Markdown, and the figures that bars were set for."""

    def __init__(self, pstrips, programs, folder):
        self.pstrips, self.programs, self.folder = pstrips, programs, folder
        self.parts, self.figures = [], []

    def add(self, text):
        self.parts.append(text.rstrip() + "\n\n")

    def figure(self, section, what, value, bar, least=False):
        """A figure and its bar: at most, or at least."""
        met = value >= bar if least else value <= bar
        self.figures.append([section, what, f"{value:.3g}", ("at least " if least else "at most ")
                             + f"{bar:g}", "yes" if met else "no"])  # fmt: skip

    def run(self, program, *arguments):
        """What a program of tests/bench, or a script beside this one, prints; empty without it."""
        path = self.programs / program
        command = [path] if not program.endswith(".py") else [sys.executable, "-B", HERE / program]
        done = subprocess.run([*map(str, command), *map(str, arguments)], stdout=subprocess.PIPE,
                              text=True, check=False)  # fmt: skip
        if done.returncode != 0:
            self.add(f"{program} failed with status {done.returncode}.")
            return ""
        return done.stdout

    def write(self, sections):
        head = "# The encoder beside its peers\n\n"
        head += f"Sections: {', '.join(sections)}. Times are of one machine on one day and of one "
        head += "run: look at ratios. The plots stand beside this page.\n\n"
        if self.figures:
            head += "## Bars\n\n" + table(["section", "what", "here", "bar", "met"], self.figures, 2)
        (self.folder / "encoder.md").write_text(head + "".join(self.parts), encoding="utf-8")
        with open(self.folder / "encoder.csv", "w", newline="", encoding="utf-8") as out:
            csv.writer(out).writerows([["section", "what", "here", "bar", "met"], *self.figures])


def add_levels(page):
    """RMS at the bars' shares beside the best half-edge peer and beside Lindstrom-Turk."""
    folder = page.folder / "levels"
    page.add(page.run("levels.py", page.programs / "levels_bench", folder))
    if not (folder / "levels.csv").exists():
        return
    rows = levels.rows_of((folder / "levels.csv").read_text())
    for model in levels.ordered(r["model"] for r in rows):
        at = {(r["simplifier"], r["share"]): r for r in rows if r["model"] == model}
        for share in levels.TABLE_SHARES:
            def best(names):
                return min((at[n, share]["rms"] for n in names if (n, share) in at), default=0)

            peer, exact = best(HALF_EDGE_PEERS), best(["cgal-lt"])
            subset = best(["subset-memoryless"])  # the default metric
            optimal = best(["optimal-memoryless"])
            where = f"{model}, {share:.0%}"
            if peer > 0:
                page.figure("levels", f"{where}: subset's RMS / best half-edge peer's",
                            subset / peer, 1)  # fmt: skip
            if exact > 0:
                page.figure("levels", f"{where}: optimal's RMS / Lindstrom-Turk's",
                            optimal / exact, 1.05)  # fmt: skip
        if ("cgal-lt", 0.05) in at and at["cgal-lt", 0.05]["seconds"] > 0:
            ours = at["optimal-memoryless", 0.05]["seconds"]
            page.figure("levels", f"{model}: optimal's time / Lindstrom-Turk's",
                        ours / at["cgal-lt", 0.05]["seconds"], 0.1)  # fmt: skip


def add_speed(page):
    """The stages of convert as multiples of meshopt_simplify to 5 %."""
    text = page.run("convert_bench")
    page.add(re.sub("^## ", "### ", text, flags=re.MULTILINE))
    model = ""
    for line in text.splitlines():
        if line.startswith("## "):
            model = line[3:]
        ratios = re.match(r"simplify \+ record ([\d.]+), convert ([\d.]+)", line)
        if ratios:
            page.figure("speed", f"{model}: simplify + record / meshopt_simplify",
                        float(ratios[1]), 2.5)  # fmt: skip
            page.figure("speed", f"{model}: convert / meshopt_simplify", float(ratios[2]), 5)


def measure(page, command):
    """Processor seconds and peak bytes, the best of some runs."""
    seconds, peak = [], []
    for _ in range(RUNS):
        before = resource.getrusage(resource.RUSAGE_CHILDREN)
        printed = page.run("measure_process", *command)
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
        if not printed:
            return None
        seconds.append(after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime)
        peak.append(int(printed.split()[1]))
    return min(seconds), min(peak)


def add_scaling(page):
    """Time and memory a triangle of whole conversions, from small to large."""
    rows, places = [], []
    with tempfile.TemporaryDirectory() as scratch:
        source, target = pathlib.Path(scratch) / "grid.ply", pathlib.Path(scratch) / "grid.pstrip"
        for side in GRID_SIDES:
            strip_meshes.write_ply(source, strip_meshes.noisy_grid(side))
            measured = measure(page, [page.pstrips, "convert", "--quiet", source, target])
            if measured is None:
                return
            seconds, peak = measured
            triangles = 2 * side * side
            files = source.stat().st_size + target.stat().st_size
            rows.append([triangles, f"{seconds:.2f}", f"{1e6 * seconds / triangles:.3f}",
                         f"{peak / 1e6:.0f}", f"{(peak - files) / triangles:.0f}"])  # fmt: skip
            places.append((triangles, 1e6 * seconds / triangles))
            if triangles > LARGE:
                page.figure("scaling", f"{triangles} triangles: peak bytes a triangle beside the "
                            "files", (peak - files) / triangles, 150)  # fmt: skip
    page.add(table(["triangles", "processor s", "µs a triangle", "peak MB",
                    "bytes a triangle beside the files"], rows, 0))  # fmt: skip
    page.figure("scaling", "time a triangle, largest / smallest mesh", places[-1][1] / places[0][1],
                1.5)  # fmt: skip
    figure = plot.Plot("Converting noisy grids", "triangles", "processor time a triangle, µs",
                       log_x=True)  # fmt: skip
    figure.line(places, "#2f6db3", "pstrips convert", at_end=True)
    figure.write(page.folder / "scaling.svg")


def add_files(page):
    """MB/s of every reader and writer; ratios are of the same run."""
    text = page.run("files_bench")
    if not text:
        return
    (page.folder / "files.csv").write_text(text, encoding="utf-8")
    rows = list(csv.DictReader(text.splitlines()))
    programs = levels.ordered(r["program"] for r in rows)
    page.add("Megabytes a second by the clock, and in brackets by processor time; best of several "
             "runs that take turns. OpenMesh builds half-edges as it reads, tinygltf only copies "
             "buffers. A .gltf keeps its numbers in a file of its own, which is not touched "
             "where only the mapped bytes are.")  # fmt: skip
    for model in levels.ordered(r["model"] for r in rows):
        lines = []
        for kind, way in levels.ordered((r["format"], r["direction"]) for r in rows):
            at = {r["program"]: r for r in rows
                  if (r["model"], r["format"], r["direction"]) == (model, kind, way)}  # fmt: skip
            lines.append([kind, way, *(f"{float(at[p]['mb_per_s']):.0f} "
                                       f"({float(at[p]['mb_per_cpu_s']):.0f})" if p in at else ""
                                       for p in programs)])  # fmt: skip
            if "pstrips" in at:
                add_file_bars(page, f"{model}, {way} {kind}", kind, at)
        page.add(f"### {model}\n\n" + table(["format", "", *programs], lines, 2))


def add_file_bars(page, where, kind, at):
    ours = float(at["pstrips"]["mb_per_cpu_s"])
    if kind in ("ply ascii", "obj"):
        page.figure("files", f"{where}: MB/s", ours, 150, least=True)
    peers = [float(r["mb_per_cpu_s"]) for p, r in at.items()
             if p not in OURS + REFERENCES and p != "tinygltf"]  # fmt: skip
    if peers:
        page.figure("files", f"{where}: times the quickest peer", ours / max(peers), 1, least=True)


def add_scenes(page):
    """The error left of 100 meshes after a share of the packets' bytes, by order of packets."""
    text = page.run("scene_bench", page.folder / "scenes.svg")
    if not text:
        return
    (page.folder / "scenes.csv").write_text(text, encoding="utf-8")
    rows = list(csv.reader(text.splitlines()))
    page.add(table(rows[0], rows[1:]))


def add_textured(page):
    """Pictures of coarse levels beside the original's."""
    folder = page.folder / "textured"
    text = page.run("textured.py", page.programs / "textured_bench", folder)
    page.add(re.sub("^## ", "### ", text, flags=re.MULTILINE))
    if not (folder / "textured.csv").exists():
        return
    rows = textured.rows_of((folder / "textured.csv").read_text())
    at = {(r["model"], r["variant"]): r for r in rows if r["share"] == 0.05}
    for peer in textured.PEERS:
        pairs = []
        for model in levels.ordered(r["model"] for r in rows):
            mine = at.get((model, f"ours@{peer}")) or at.get((model, "ours"))
            if mine and (model, peer) in at:
                pairs.append((mine, at[model, peer]))
        for name, head, _ in textured.SHOWN if pairs else ():
            mean = textured.geometric_mean([max(mine[name], 1e-6) / max(theirs[name], 1e-6)
                                            for mine, theirs in pairs])  # fmt: skip
            page.figure("textured", f"{head} at 5 %: ours / {peer}'s, mean over the models", mean, 1)


SECTIONS = {"levels": add_levels, "speed": add_speed, "scaling": add_scaling, "files": add_files,
            "scenes": add_scenes, "textured": add_textured}  # fmt: skip


def main():
    if len(sys.argv) < 4 or any(s not in SECTIONS for s in sys.argv[4:]):
        sys.exit(__doc__.strip())
    folder = pathlib.Path(sys.argv[3])
    folder.mkdir(parents=True, exist_ok=True)
    page = Page(pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2]), folder)
    sections = sys.argv[4:] or list(SECTIONS)
    for section in sections:
        start = time.monotonic()
        page.add(f"## {section.capitalize()}\n\n{SECTIONS[section].__doc__ or ''}")
        SECTIONS[section](page)
        page.write(sections)  # what a run that is cut short has got
        print(f"{section}: {time.monotonic() - start:.0f} s", file=sys.stderr, flush=True)
    print(folder / "encoder.md")


if __name__ == "__main__":
    main()
