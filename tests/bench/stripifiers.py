#!/usr/bin/env python3
"""Compares all stripifiers, ours, the literature's and other libraries', in one page.

    stripifiers.py PSTRIPS COMPARE_STRIPIFIERS POINTS_TABLES OUTPUT_FOLDER [SECTION …]

Writes stripifiers.md, stripifiers.csv (every run) and plots as SVG. Sections: thesis, models, both,
quads, progressive, scaling, points; without any, all of them. Models come from $PSTRIPS_MODELS or ../shared/models
beside the source tree; without that folder only what is generated is compared.
"""

import csv
import json
import math
import os
import pathlib
import subprocess
import sys
import tempfile
import time

import plot
import strip_meshes
from published_strips import (BARS, BOTH_BAR, FAST_TIME_BAR, FLIPS, LABELS, QUAD_BAR, QUADS,
                              REAL_MODELS, TORUS)

MODELS = {"cow": "cow.obj", "bunny": "bun_zipper.ply", "horse": "horse.ply", "igea": "igea.ply",
          "rocker-arm": "rocker-arm.obj", "nefertiti": "nefertiti.obj"}
PEERS = ("meshoptimizer", "OpenMesh", "VTK")
GRID_SIDES = (105, 209, 418, 837)  # 22 thousand to 1.4 million triangles, times four each
PRICES = (3, 6, 7, 10, 15, 20, 30, 60, 100)
TIME_LIMIT = 60  # seconds, when scaling
DIFFERENT = 1.25  # beyond it the page says why

CSV_COLUMNS = ["section", "model", "algorithm", "variant", "triangles", "strips", "singletons",
               "swaps", "entries", "indices_sent", "indices_per_triangle", "acmr16", "peak_bytes",
               "milliseconds", "cpu_milliseconds", "remark"]


def table(header, rows, text_columns=1):
    """Markdown whose columns align in the source, too: the first ones left, the others right."""
    cells = [header] + [[str(cell) for cell in row] for row in rows]
    widths = [max(3, *(len(row[i]) for row in cells)) for i in range(len(header))]
    left = [i < text_columns or name == "why" for i, name in enumerate(header)]

    def line(row):
        return "| " + " | ".join(cell.ljust(w) if is_left else cell.rjust(w) for cell, w, is_left
                                 in zip(row, widths, left)) + " |"

    rule = "|" + "|".join("-" * (w + 2) if is_left else "-" * (w + 1) + ":"
                          for w, is_left in zip(widths, left)) + "|"
    return "\n".join([line(cells[0]), rule, *map(line, cells[1:])]) + "\n\n"


def name_of(row):
    return f"{row['algorithm']}, {row['variant']}" if row["variant"] else row["algorithm"]


def colours_of(names):
    """Ours stands out, peers are black."""
    others = [n for n in names if not n.startswith("best") and n not in PEERS]
    out = {n: plot.COLOURS[i % len(plot.COLOURS)] for i, n in enumerate(others)}
    return {n: "#d62728" if n.startswith("best") else out.get(n, "#000000") for n in names}


class Bench:
    """Runs pstrips, tells what it does and keeps every figure."""

    def __init__(self, pstrips, comparer, output, folder):
        self.pstrips, self.comparer = pstrips, comparer
        self.output, self.folder = output, folder
        self.section, self.rows, self.page = "", [], []
        self.start = time.monotonic()

    def say(self, what):
        seconds = int(time.monotonic() - self.start)
        line = f"[{seconds // 60}:{seconds % 60:02}] {self.section}: {what}"
        print(f"\r{line[:99]:<99}", end="" if sys.stderr.isatty() else "\n", file=sys.stderr,
              flush=True)

    def write(self, words):
        self.page.append(words)

    def run(self, *arguments, program=None):
        command = [program or self.pstrips, *map(str, arguments)]
        done = subprocess.run(command, capture_output=True, text=True, check=False)
        if done.returncode != 0:
            sys.exit(f"\nfailed with status {done.returncode}: {' '.join(command)}\n{done.stderr}")
        return done.stdout

    def _keep(self, model, rows):
        for row in rows:
            row.update(section=self.section, model=model)
        self.rows += rows
        return rows

    def compare(self, model, path, *options, algorithms=()):
        """A row for each algorithm and variant; without `algorithms`, of all and the peers."""
        self.say(f"{model} {' '.join(map(str, options))}")
        chosen = ["--algorithm", ",".join(algorithms)] if algorithms else []
        out = self.run("--format", "json", *chosen, *options, path, program=self.comparer)
        return self._keep(model, json.loads(out)["models"][0]["algorithms"])

    def best(self, model, path, goal, effort, price=3):
        """One run, which --compare does not make: few strips at once, or at another price."""
        self.say(f"{model} best, {goal} {effort}, price {price}")
        out = self.run("stripify", "--format", "json", "--goal", goal, "--strip-effort", effort,
                        "--strip-price", price, path)
        row = json.loads(out)
        row["variant"] = effort + (", strips" if goal == "strips" else "")
        row["variant"] += f", price {price}" if price != 3 else ""
        row["indices_per_triangle"] = row["indices_sent"] / max(1, row["triangles"])
        return self._keep(model, [row])[0]

    def plain_mesh(self, path):
        plain = self.folder / "plain.obj"
        self.run("convert", "--quiet", "--attributes", "none", path, plain)
        return strip_meshes.read_obj(plain)

    def generated(self, name, mesh):
        path = self.folder / f"{name}.ply"
        strip_meshes.write_ply(path, mesh)
        return path

    def write_csv(self):
        with open(self.output / "stripifiers.csv", "w", newline="", encoding="utf-8") as file:
            out = csv.DictWriter(file, CSV_COLUMNS, restval="", extrasaction="ignore")
            out.writeheader()
            out.writerows(self.rows)


def remarks(rows):
    """What pstrips found wrong with a peer's strips, or cut: never left out silently."""
    out = sorted({f"- {row['model']}, {name_of(row)}: {row['remark']}\n"
                  for row in rows if row.get("remark")})
    return "Remarks:\n\n" + "".join(out) + "\n" if out else ""


# Section 1: beside the thesis


THESIS_ALGORITHMS = ["best"] + [algorithm for algorithm, _, _ in LABELS.values()]


def by_variant(rows):
    return {(row["algorithm"], row["variant"]): row for row in rows}


def differs(ours, published):
    return max(ours, published) > DIFFERENT * min(ours, published)


def real_model_rows(rows, published):
    found = by_variant(rows)
    for label, (algorithm, variant, reason) in LABELS.items():
        row = found[algorithm, variant]
        strips, vertices, acmr, seconds = published[label]
        far = differs(row["strips"], strips) or differs(row["acmr16"], acmr) or \
            abs(row["entries"] / 1000 - vertices) > 0.5 + (DIFFERENT - 1) * vertices
        yield [label, name_of(row), f"{strips:,}", f"{row['strips']:,}",
               f"{row['strips'] / strips:.2f}", f"{vertices}K", f"{row['entries'] / 1000:.1f}K",
               f"{acmr:.2f}", f"{row['acmr16']:.2f}", f"{seconds * 1000:.0f}",
               f"{row['cpu_milliseconds']:.1f}", reason if far else ""]
    for row in rows:
        if row["algorithm"] == "best":
            yield ["", name_of(row), "", f"{row['strips']:,}", "", "",
                   f"{row['entries'] / 1000:.1f}K", "", f"{row['acmr16']:.2f}", "",
                   f"{row['cpu_milliseconds']:.1f}", ""]


def strip_rows(columns, published):
    """`columns`: rows of a run each; `published`: strips by label for each. Cells: theirs / ours."""
    found = [by_variant(rows) for rows in columns]
    for i, (label, (algorithm, variant, reason)) in enumerate(LABELS.items()):
        pairs = [(theirs[i], ours[algorithm, variant]["strips"])
                 for theirs, ours in zip(published, found)]
        far = any(theirs is not None and differs(ours, theirs) for theirs, ours in pairs)
        cells = [f"{'–' if theirs is None else f'{theirs:,}'} / {ours:,}" for theirs, ours in pairs]
        name = name_of(found[0][algorithm, variant])
        yield [label, name, *cells, reason if far else ""]
    for row in columns[0]:
        if row["algorithm"] == "best":
            key = row["algorithm"], row["variant"]
            yield ["", name_of(row), *(f"{ours[key]['strips']:,}" for ours in found), ""]


def thesis(bench, models):
    bench.write("## Beside the thesis\n\nPublished [Vanecek05 tables 8.2, 8.3, 8.6, 8.7] and ours; "
                "vertices are entries in strips, without restarts; ms there on a Pentium 4 of "
                "2.8 GHz.\nWhere strips, vertices or ACMR differ by more than a quarter, the last "
                "column says why.\n\n")
    header = ["", "algorithm", "strips, there", "ours", "ratio", "vertices, there", "ours",
              "ACMR 16, there", "ours", "ms, there", "ours", "why"]
    for model, published in REAL_MODELS.items():
        if model in models:
            rows = bench.compare(model, models[model], algorithms=THESIS_ALGORITHMS)
            bench.write(f"### {model}, {rows[0]['triangles']:,} triangles\n\n")
            bench.write(table(header, real_model_rows(rows, published), 2))

    columns = [bench.compare(f"torus 20 x {n}",
                             bench.generated(f"torus-{n}", strip_meshes.torus(n)),
                             algorithms=THESIS_ALGORITHMS) for n in TORUS]
    bench.write("### Torus of 20 x N\n\nStrips, published / ours [Vanecek05 table 8.9].\n\n")
    bench.write(table(["", "algorithm", *(f"20 x {n}" for n in TORUS), "why"],
                      strip_rows(columns, list(TORUS.values())), 2))

    if "bunny" in models:
        vertices, triangles = bench.plain_mesh(models["bunny"])
        flips, done, columns = strip_meshes.EdgeFlips(triangles), 0, []
        for count in FLIPS:
            flips.flip(count - done)
            done = count
            path = bench.generated(f"bunny-{count}", (vertices, triangles))
            columns.append(bench.compare(f"bunny, {count} swaps", path,
                                         algorithms=THESIS_ALGORITHMS))
        bench.write("### Bunny with random edge swaps\n\nStrips, published / ours "
                    "[Vanecek05 table 8.12].\n\n")
        bench.write(table(["", "algorithm", *(f"{n // 1000}k swaps" for n in FLIPS), "why"],
                          strip_rows(columns, list(FLIPS.values())), 2))


# Section 2: every algorithm and peer


def figure_row(row):
    per_triangle = row["peak_bytes"] / max(1, row["triangles"])
    return [name_of(row), f"{row['strips']:,}", f"{row['swaps']:,}",
            f"{row['indices_per_triangle']:.3f}", f"{row['acmr16']:.3f}", f"{per_triangle:.0f}",
            f"{row['cpu_milliseconds']:.1f}"]


FIGURE_HEADER = ["algorithm", "strips", "swaps", "indices / T", "ACMR 16", "bytes / T", "ms"]


def best_runs(bench, model, path, rows):
    """Goal, effort and row of each; `rows` has some of them already, timed beside the peers."""
    found = by_variant(bench.compare(model, path, "--strip-effort", "max", algorithms=["best"]))
    found.update(by_variant(rows))
    fast_strips = bench.best(model, path, "strips", "fast")
    return [("indices", "fast", found["best", "fast"]), ("indices", "high", found["best", "high"]),
            ("indices", "max", found["best", "max"]), ("strips", "fast", fast_strips),
            ("strips", "high", found["best", "high, strips"]),
            ("strips", "max", found["best", "max, strips"])]


def bar_row(model, goal, effort, row, peer):
    figure = row["strips"] if goal == "strips" else round(row["indices_per_triangle"], 4)
    bar = BARS.get((goal, effort), {}).get(model)
    reached = "" if bar is None else "yes" if figure <= bar else "NO"
    of_peer = row["cpu_milliseconds"] / peer["cpu_milliseconds"] if peer else math.nan
    return [model, goal, effort, f"{row['strips']:,}", f"{row['indices_per_triangle']:.4f}",
            "" if bar is None else bar, reached, f"{row['cpu_milliseconds']:.1f}", f"{of_peer:.2f}"]


def every_model(bench, models):
    if not models:
        return
    bench.write("## All algorithms and peers\n\nIndices a triangle count restarts; bytes are the "
                "peak of the heap while stripifying.\n\n")
    bar_rows, kept, speeds = [], [], []
    for model, path in models.items():
        rows = bench.compare(model, path)
        kept += rows
        bench.write(f"### {model}, {rows[0]['triangles']:,} triangles\n\n")
        bench.write(table(FIGURE_HEADER, map(figure_row, rows)))
        found = by_variant(rows)
        peer = found.get(("meshoptimizer", ""))
        for goal, effort, row in best_runs(bench, model, path, rows):
            bar_rows.append(bar_row(model, goal, effort, row, peer))
        if ("OpenMesh", "") in found:
            ours, peers = (found[name, ""]["cpu_milliseconds"] for name in ("sgi-vertices",
                                                                           "OpenMesh"))
            speeds.append(f"{model} {ours / peers:.2f}")
    bench.write(remarks(kept))
    bench.write("### best, beside its bars\n\nBars are for strips or for indices a triangle, as is "
                f"the goal. At fast, indices should take at most {FAST_TIME_BAR} of meshoptimizer's "
                "time, see the last column.\n\n")
    bench.write(table(["model", "goal", "effort", "strips", "indices / T", "bar", "reached", "ms",
                       "of meshoptimizer's ms"], bar_rows, 3))
    if speeds:
        bench.write("`sgi-vertices` should take no longer than OpenMesh's stripifier. Its share of "
                    f"that time: {', '.join(speeds)}.\n\n")


# Section 3: both goals at once


def both_goals(bench, models):
    if "bunny" not in models:
        return
    path = models["bunny"]
    others = [row for row in bench.compare("bunny", path) if row["algorithm"] != "best"]
    curves = {}
    for effort in ("fast", "high", "max"):
        runs = [(f"price {p}", bench.best("bunny", path, "indices", effort, p)) for p in PRICES]
        curves[effort] = [*runs, ("goal strips", bench.best("bunny", path, "strips", effort))]
    strips, indices = BOTH_BAR
    bench.write(f"## Both goals at once: bunny\n\nThe bar is {strips} strips at {indices} indices a "
                "triangle: ")
    reached = [f"{name} at {effort}" for effort, runs in curves.items() for name, row in runs
               if row["strips"] <= strips and row["indices_per_triangle"] <= indices]
    bench.write(f"reached by {', '.join(reached)}.\n\n" if reached else "NOT reached.\n\n")
    bench.write(table(["best", "effort", "strips", "indices / T", "ms"],
                      [[name, effort, f"{row['strips']:,}", f"{row['indices_per_triangle']:.4f}",
                        f"{row['cpu_milliseconds']:.0f}"]
                       for effort, runs in curves.items() for name, row in runs], 2))
    bench.write("![strips and indices a triangle](both.svg)\n\n")
    draw_both(bench.output / "both.svg", curves, others)


def draw_both(path, curves, others):
    out = plot.Plot("Bunny: strips and indices a triangle; left and low is better", "strips",
                    "indices sent a triangle")
    for (effort, runs), colour in zip(curves.items(), ("#ff9896", "#e6550d", "#d62728")):
        places = [(row["strips"], row["indices_per_triangle"]) for _, row in runs]
        out.line(sorted(places), colour, width=2)
        for i, (place, (name, _)) in enumerate(zip(places, runs)):
            shown = f"best, {effort}, {name}" if i in (0, len(runs) - 1) else name.split()[-1]
            out.point(*place, colour, shown, radius=3)
    out.point(*BOTH_BAR, "#000000", "bar", radius=5, hollow=True)
    names = {}  # variants that make the same strips are one point
    for row in others:
        place = row["algorithm"], row["strips"], row["indices_per_triangle"]
        names[place] = row["algorithm"] if place in names else name_of(row)
    colours = colours_of(names.values())
    for (algorithm, strips, indices), name in names.items():
        out.point(strips, indices, colours[name], name, radius=5 if algorithm in PEERS else 4)
    out.write(path)


# Section 4: quads


def quads(bench, folder):
    paths = [p for p in sorted((folder / "quads").rglob("*.obj"))
             if strip_meshes.quad_share(p) > 0.5]
    if not paths:
        return
    bench.write("## Quads\n\nModels of which more than half of the faces are quads; each algorithm "
                "chooses the diagonals. Strips, and in brackets indices a triangle.\n"
                "*STRIPE / QStrip* is the fewer of STRIPE's strips over the fewer of QStrip's, "
                f"*STRIPE / best* likewise; the bar is {QUAD_BAR}. Published [Vanecek05 table 7.1], "
                "quads and ratio: "
                + ", ".join(f"{n:,} {stripe / qstrip:.1f}" for n, stripe, qstrip in QUADS)
                + ".\nWhere ours is below that: STRIPE as built here needs about half the strips that "
                "the thesis measured for it (stripe.h). Where all need the same number, seams and "
                "edges of more than two faces\nleave nothing to choose.\n\n")
    header, rows = [], []
    for path in paths:
        runs = [run for run in bench.compare(path.stem, path, algorithms=[
            "stripe-lookahead", "stripe-noswap", "qstrip", "best"]) if run["variant"] != "axis"]
        for run in runs:
            run["short"] = name_of(run).removesuffix(", topological")
        header = ["model", "T", *(run["short"] for run in runs), "STRIPE / QStrip",
                  "STRIPE / best"]
        fewest = {name: min(run["strips"] for run in runs if run["algorithm"].startswith(name))
                  for name in ("stripe", "qstrip", "best")}
        rows.append([path.stem, f"{runs[0]['triangles']:,}",
                     *(f"{run['strips']:,} ({run['indices_per_triangle']:.2f})" for run in runs),
                     f"{fewest['stripe'] / fewest['qstrip']:.1f}",
                     f"{fewest['stripe'] / fewest['best']:.1f}"])
    bench.write(table(header, rows))


# Section 5: progressive files


def progressive_row(bench, model, path, options):
    """What a file made with these options costs as a whole and at its levels."""
    bench.say(f"{model} {' '.join(options)}")
    file = bench.folder / "progressive.pstrip"
    bench.run("convert", "--quiet", *options, path, file)
    report = json.loads(bench.run("inspect", "--format", "json", file))
    levels = report["packets"]
    sent = [level["vertices_sent"] / max(1, level["triangles"]) for level in levels]
    return {"options": " ".join(option for option in options if option != "--stripifier"),
            "bytes": report["bytes"], "u": report["places_per_vsplit"],
            "base": sent[0], "mean": sum(sent) / len(sent), "full": sent[-1],
            "base strips": levels[0]["strips"], "full strips": levels[-1]["strips"]}


def progressive(bench, models):
    chosen = {name: path for name, path in models.items() if name in ("cow", "bunny", "horse")}
    if not chosen:
        return
    bench.write("## Progressive files\n\nFiles of `convert` with each stripifier, and with what `best` "
                "pays for steps that tear strips at coarser levels (--level-cost; 1 is the default).\n"
                "*u* is how many map entries a vsplit rewrites; then vertices sent a triangle by the "
                "degenerate-triangle-free filter: at the base (5 % of the triangles), the mean of all\n"
                "packets, and at the full mesh.\n\n")
    for model, path in chosen.items():
        names = [row["algorithm"] for row in bench.compare(model, path)
                 if row["algorithm"] not in PEERS]
        runs = [["--stripifier", name] for name in dict.fromkeys(names)]
        runs += [["--level-cost", str(cost), "--strip-effort", effort]
                 for effort in ("fast", "high") for cost in (0, 1, 2, 3)]
        rows = [progressive_row(bench, model, path, run) for run in runs]
        smallest = min(row["bytes"] for row in rows if row["options"] in names)
        bench.write(f"### {model}\n\n" + table(
            ["convert", "bytes", "of the least", "u", "base", "mean", "full", "strips, base", "full"],
            [[row["options"], f"{row['bytes']:,}", f"{row['bytes'] / smallest:.3f}",
              f"{row['u']:.2f}", f"{row['base']:.3f}", f"{row['mean']:.3f}", f"{row['full']:.3f}",
              f"{row['base strips']:,}", f"{row['full strips']:,}"] for row in rows]))


# Section 6: scaling


def scaling(bench):
    sizes = []
    for side in GRID_SIDES:
        bench.say(f"making a grid of {2 * side * side} triangles")
        path = bench.generated(f"grid-{side}", strip_meshes.noisy_grid(side))
        sizes.append(bench.compare(f"grid, {2 * side * side} triangles", path, "--time-limit",
                                   TIME_LIMIT))
        path.unlink()
    counts = [rows[0]["triangles"] for rows in sizes]
    series = list(zip(*sizes))  # pstrips lists the same runs for every model
    bench.write("## Scaling\n\nMicroseconds a triangle on square grids, a quarter of whose diagonals "
                "lie the other way. *growth* is the exponent from the first size to the last, "
                "what was cut left out: 1 is linear,\nn log n about 1.1; that the largest does not "
                f"fit the processor's caches adds to it. `--time-limit {TIME_LIMIT}`, wall-clock: "
                "what it cut is marked with *.\n\n")
    rows = [[name_of(runs[0]),
             *(f"{1e3 * run['cpu_milliseconds'] / n:.3f}{'*' if is_cut(run) else ' '}"
               for run, n in zip(runs, counts)),
             f"{growth(runs, counts):.2f}"] for runs in series]
    bench.write(table(["algorithm", *(f"{n:,} T" for n in counts), "growth"], rows))
    bench.write(remarks([run for rows in sizes for run in rows]))
    bench.write("![time over triangles](scaling.svg)\n\n")
    draw_scaling(bench.output / "scaling.svg", series, counts)


def is_cut(run):
    return "time limit" in run["remark"]


def growth(runs, counts):
    """Between the first and the last size that no limit cut."""
    whole = [(n, run["cpu_milliseconds"]) for n, run in zip(counts, runs) if not is_cut(run)]
    if len(whole) < 2:
        return math.nan
    return math.log(whole[-1][1] / whole[0][1]) / math.log(whole[-1][0] / whole[0][0])


def draw_scaling(path, series, counts):
    out = plot.Plot("Time over triangles; dashed: linear; hollow: cut by the time limit",
                    "triangles", "milliseconds of processor time", log_y=True, right=230)
    for microseconds in (0.1, 1, 10):
        out.line([(n, n * microseconds / 1e3) for n in (counts[0], counts[-1])], "#b0b0b0",
                 width=1, dash="4 4")
    colours = colours_of([name_of(runs[0]) for runs in series])
    for runs in series:
        name = name_of(runs[0])
        places = [(n, run["cpu_milliseconds"]) for n, run in zip(counts, runs)]
        stands_out = name.startswith("best") or runs[0]["algorithm"] in PEERS
        out.line(places, colours[name], name, width=2.5 if stands_out else 1.2, at_end=True)
        for place, run in zip(places, runs):
            out.point(*place, colours[name], radius=3, hollow=is_cut(run))
    out.write(path)


# Section 7: points and tetrahedra


def points(bench, program, folder):
    files = [folder / name for name in ("terrain/urban.xyz", "terrain/radar.xyz",
                                        "tets/bunny.mesh")]
    bench.say("points_tables")
    done = subprocess.run([program, *(f for f in files if f.is_file())], capture_output=True,
                          text=True, check=False)
    if done.returncode != 0:
        sys.exit(f"\n{program} failed with status {done.returncode}\n{done.stderr}")
    bench.write("## Points and tetrahedra\n\nWhat `points_tables` prints; README.md says what the "
                "columns are and what the thesis has.\n\n")
    for part in done.stdout.strip().split("\n\n"):
        header, _, *rows = [line.strip("| ").split(" | ") for line in part.splitlines()]
        bench.write(table(header, rows))


def models_folder():
    source = pathlib.Path(__file__).resolve().parents[2]
    return pathlib.Path(os.environ.get("PSTRIPS_MODELS", source.parent / "shared" / "models"))


def load():
    return ", ".join(f"{x:.1f}" for x in os.getloadavg())


def main():
    if len(sys.argv) < 5:
        sys.exit(__doc__.strip())
    pstrips, comparer, points_tables, output, *chosen = sys.argv[1:]
    folder, output = models_folder(), pathlib.Path(output)
    models = {name: folder / "classic" / file for name, file in MODELS.items()
              if (folder / "classic" / file).is_file()}
    with tempfile.TemporaryDirectory() as temporary:
        bench = Bench(pstrips, comparer, output, pathlib.Path(temporary))
        sections = {"thesis": lambda: thesis(bench, models),
                    "models": lambda: every_model(bench, models),
                    "both": lambda: both_goals(bench, models),
                    "quads": lambda: quads(bench, folder),
                    "progressive": lambda: progressive(bench, models),
                    "scaling": lambda: scaling(bench),
                    "points": lambda: points(bench, points_tables, folder)}
        unknown = set(chosen) - set(sections)
        if unknown:
            sys.exit(f"no such section: {', '.join(sorted(unknown))}")
        output.mkdir(parents=True, exist_ok=True)
        load_before = load()
        for name in chosen or sections:
            bench.section = name
            sections[name]()
        missing = ", ".join(sorted(set(MODELS) - set(models)))
        head = (f"# Stripifiers compared\n\nms and µs are processor time, the least of up to "
                f"five runs, on a machine of {os.cpu_count()} processors whose load averages were "
                f"{load_before} before and {load()} after: look at ratios.\nCounts are the same "
                "everywhere.\n"
                + (f"Left out, for want of the models: {missing}.\n" if missing else "") + "\n")
        (output / "stripifiers.md").write_text(head + "".join(bench.page), encoding="utf-8")
        bench.write_csv()
    print(f"\n{output / 'stripifiers.md'}", file=sys.stderr)


if __name__ == "__main__":
    main()
