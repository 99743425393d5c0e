#!/usr/bin/env python3
"""Runs of "frames on the way" (BENCHMARKS.md), into bench/campaigns/frames_on_the_way.csv.

frames_campaign.py [--seeds A-B] [--rows TEXT] [--jobs N] [--table]
  --seeds   which, e.g. 1-10 (default); runs whose line is in the file already are left out, so the same command
            goes on after a kill and another session adds seeds
  --rows    only rows whose name contains TEXT
  --jobs    runs at a time, of one thread each (default: 2)
  --table   run nothing; print the tables of what is there, as Markdown: rows, then pairs of rows seed by seed
"""

import argparse
import concurrent.futures
import csv
import json
import math
import os
import pathlib
import statistics
import subprocess
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent
FILE = ROOT / "bench" / "campaigns" / "frames_on_the_way.csv"
PROGRAM = os.environ.get("CANOPEER", str(ROOT / "build" / "release" / "bin" / "canopeer"))
FIGURES = ["fruits_total", "detected", "auc", "surface_f1", "false_positives", "volume_error_half_seen",
           "centre_error_half_seen_m", "frames_fused", "frames_late", "frames_blurred", "frames_alike", "views",
           "collisions", "plant_contacts", "time_offset_s", "time_offset_se_s", "mission_time_s", "sim_time_s", "wall_time_s"]
KEYS = ["row", "seed"]


def row(mission, planner, hz, what="", seeds=10, **extra):
    """`extra`: further settings, with __ for the dots in their keys; `what` says them in the row's name."""
    settings = {"planner": planner, "time_per_segment_s": 10, "clock": "whole", "frames.on_the_way_hz": hz,
                "camera.motion_model.exposure_ms": 5, **{key.replace("__", "."): extra[key] for key in extra}}
    return {"name": f"{mission} {planner} {hz} Hz {what}".strip(), "mission": mission, "settings": settings, "seeds": seeds}


ROWS = [row("dense_1", planner, hz) for hz in (0, 5, 15) for planner in ("vmp", "random")]
ROWS += [row("dense_1", planner, 5) for planner in ("rvp", "coverage", "sweep", "drive_by")]
ROWS += [row("dense_1", "vmp", 5, f"{ms} ms", 3, camera__motion_model__exposure_ms=ms) for ms in (2, 10)]
ROWS += [row("dense_1", "vmp", 5, "any blur", 3, frames__max_blur_px=0)]
ROWS += [row("scenario_1", planner, hz) for hz in (0, 5) for planner in ("vmp", "random", "drive_by")]
ROWS += [row("scenario_1", "vmp", hz, "d435", 5, noise="d435") for hz in (0, 5)]
ROWS += [row("scenario_1", "vmp", 5, "d435, stamps 30 ms late", 5, noise="d435", camera__motion_model__stamp_offset_ms=30)]


def done():
    if not FILE.exists():
        return []
    with open(FILE, newline="") as file:
        return list(csv.DictReader(file))


def run(one, seed):
    with tempfile.TemporaryDirectory() as out:
        command = [PROGRAM, "run", one["mission"], "--quiet", "--no-replay", "--threads", "1", "--out", out,
                   "--set", f"seed={seed}"]
        for key, value in one["settings"].items():
            command += ["--set", f"{key}={value}"]
        subprocess.run(command, check=True, cwd=ROOT, stdout=subprocess.DEVNULL)
        summary = json.loads(pathlib.Path(out, "summary.json").read_text())
    return {"row": one["name"], "seed": seed, **{key: summary.get(key) for key in FIGURES}}


def write(lines):
    lines.sort(key=lambda line: ([r["name"] for r in ROWS].index(line["row"]), int(line["seed"])))
    FILE.parent.mkdir(exist_ok=True)
    temporary = FILE.with_suffix(".new")
    with open(temporary, "w", newline="") as file:
        writer = csv.DictWriter(file, KEYS + FIGURES, lineterminator="\n")
        writer.writeheader()
        writer.writerows(lines)
    temporary.replace(FILE)


def campaign(arguments):
    first, last = (int(part) for part in arguments.seeds.split("-"))
    lines = done()
    there = {(line["row"], int(line["seed"])) for line in lines}
    todo = [(one, seed) for seed in range(first, last + 1) for one in ROWS
            if seed <= one["seeds"] and arguments.rows in one["name"] and (one["name"], seed) not in there]
    with concurrent.futures.ThreadPoolExecutor(arguments.jobs) as pool:
        runs = {pool.submit(run, one, seed): one["name"] for one, seed in todo}
        for number, finished in enumerate(concurrent.futures.as_completed(runs), 1):
            try:
                lines.append(finished.result())
            except (subprocess.CalledProcessError, OSError, ValueError) as error:  # the others go on
                print(f"{number} of {len(todo)}: {runs[finished]}: {error}", flush=True)
                continue
            write(lines)
            print(f"{number} of {len(todo)}: {runs[finished]}", flush=True)


def average(values):
    return statistics.mean(values) if values else math.nan


def mean(values):
    """With half the width of the 95 % interval of Student's t."""
    if len(values) < 2:
        return (values[0] if values else math.nan), math.nan
    t = {2: 12.7, 3: 4.30, 4: 3.18, 5: 2.78, 6: 2.57, 7: 2.45, 8: 2.36, 9: 2.31, 10: 2.26}.get(len(values), 2.1)
    return average(values), t * statistics.stdev(values) / math.sqrt(len(values))


ROW_LENGTH_M = {"dense_1": 3.0, "scenario_1": 3.0}  # between the first stop and the last, both sides looked at


def table():
    lines = done()
    print("| world, planner, frames | seeds | found | of | AUC | surface F1 | false | volume error | centre error / mm | "
          "fused / late / blurred | row m/h |")
    print("|---|---|---|---|---|---|---|---|---|---|---|")
    for one in ROWS:
        mine = [line for line in lines if line["row"] == one["name"]]
        if not mine:
            continue

        def of(key):
            return [float(line[key]) for line in mine if line[key] not in ("", "None")]

        def text(key, digits):
            centre, half = mean(of(key))
            return f"{centre:.{digits}f} ± {half:.{digits}f}"

        frames = [of(f"frames_{what}") for what in ("fused", "late", "blurred")]
        counts = " / ".join(f"{average(f):.0f}" for f in frames) if frames[0] else "–"
        speed = 3600 * ROW_LENGTH_M[one["mission"]] / average(of("mission_time_s"))
        print(f"| {one['name']} | {len(mine)} | {text('detected', 1)} | {average(of('fruits_total')):.0f} | "
              f"{text('auc', 3)} | {text('surface_f1', 3)} | {average(of('false_positives')):.1f} | {average(of('volume_error_half_seen')):.3f} | "
              f"{1e3 * average(of('centre_error_half_seen_m')):.1f} | {counts} | "
              f"{speed:.0f} |")


PAIRS = [("dense_1 vmp 0 Hz", "dense_1 vmp 5 Hz"), ("dense_1 random 0 Hz", "dense_1 random 5 Hz"),
         ("dense_1 vmp 5 Hz", "dense_1 vmp 15 Hz"), ("dense_1 random 5 Hz", "dense_1 random 15 Hz"),
         ("dense_1 vmp 5 Hz", "dense_1 random 5 Hz"), ("dense_1 vmp 5 Hz", "dense_1 rvp 5 Hz"),
         ("dense_1 vmp 5 Hz", "dense_1 drive_by 5 Hz"), ("dense_1 vmp 5 Hz", "dense_1 sweep 5 Hz"),
         ("dense_1 vmp 5 Hz", "dense_1 vmp 5 Hz 2 ms"), ("dense_1 vmp 5 Hz", "dense_1 vmp 5 Hz 10 ms"),
         ("scenario_1 vmp 0 Hz", "scenario_1 vmp 5 Hz"), ("scenario_1 random 0 Hz", "scenario_1 random 5 Hz"),
         ("scenario_1 vmp 5 Hz", "scenario_1 random 5 Hz"), ("scenario_1 vmp 5 Hz", "scenario_1 drive_by 5 Hz"),
         ("scenario_1 vmp 0 Hz d435", "scenario_1 vmp 5 Hz d435"),
         ("scenario_1 vmp 5 Hz d435", "scenario_1 vmp 5 Hz d435, stamps 30 ms late")]


def signed_rank_p(differences):
    """Wilcoxon's signed ranks, two-sided, exact: over all signs. Zeros are left out, equal sizes share their ranks."""
    sizes = sorted(abs(d) for d in differences if d != 0)
    ranks = [statistics.mean(i + 1 for i, size in enumerate(sizes) if size == abs(d)) for d in differences if d != 0]
    found = sum(rank for rank, d in zip(ranks, (d for d in differences if d != 0)) if d > 0)
    sums = [0.0]
    for rank in ranks:
        sums += [s + rank for s in sums]
    least = min(found, sum(ranks) - found)
    return min(1.0, 2.0 * sum(s <= least + 1e-9 for s in sums) / len(sums))


def pairs():
    lines = {(line["row"], int(line["seed"])): line for line in done()}
    print("| from → to | seeds | found | AUC | surface F1 |")
    print("|---|---|---|---|---|")
    for first, second in PAIRS:
        seeds = [seed for row, seed in lines if row == first and (second, seed) in lines]
        cells = []
        for key, digits in (("detected", 1), ("auc", 3), ("surface_f1", 3)):
            differences = [float(lines[second, seed][key]) - float(lines[first, seed][key]) for seed in seeds]
            centre, half = mean(differences)
            cells.append(f"{centre:+.{digits}f} ± {half:.{digits}f}, {signed_rank_p(differences):.3f}")
        print(f"| {first} → {second} | {len(seeds)} | {' | '.join(cells)} |")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--seeds", default="1-10")
    parser.add_argument("--rows", default="")
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--table", action="store_true")
    arguments = parser.parse_args()
    if not arguments.table:
        return campaign(arguments)
    table()
    print()
    pairs()


main()
