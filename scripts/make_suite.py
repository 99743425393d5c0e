#!/usr/bin/env python3
"""Makes the worlds of CanopeerBench anew: scripts/make_suite.py [PROGRAM [NAME...]]

The suite is stored in benchmark/ and is never made anew to run it: what lies there counts, whatever later versions grow.
This says how it came about. Generated worlds are recipes for `canopeer scene freeze`; the imported ones are plants of meshes
that scripts/suite_plants.py draws. Writes benchmark/worlds/, benchmark/suite.csv and benchmark/SHA256SUMS."""
import csv
import hashlib
import pathlib
import shutil
import subprocess
import sys
import tempfile

import suite_plants

ROOT = pathlib.Path(__file__).resolve().parent.parent
SUITE = ROOT / "benchmark"

# What the camera's faults are. "noisy" has labels that are right with 0.7 and a camera that is not where it is said to be.
NOISE = {
    "clean": "",
    "d435": "camera: {preset: d435}\nnoise: d435\n",
    "noisy": "camera: {preset: d435, hand_eye_error_m: 0.003, hand_eye_error_deg: 0.3}\nnoise: d435\nlabel_noise: 0.3\n"
             "detector: {kind: labels, majority_radius_px: 3}\n",
}

MIDDLE = -1.0  # of all rows along y: what the two stops look at lies around it

# Name, split, seed, and of generated rows: plants a row, spacing, numbered kinds (none: the preset's own).
WORLDS = [
    ("sparse_1_clean_a", "train", 4101, dict(count=5, spacing=0.5, kinds=[4, 7, 9, 5, 6])),
    ("sparse_1_clean_b", "test", 4102, dict(count=4, spacing=0.6, kinds=[3, 8, 6, 7])),
    ("sparse_1_d435_a", "test", 4103, dict(count=5, spacing=0.45, kinds=[9, 5, 3, 7, 6])),
    ("sparse_1_noisy_a", "train", 4104, dict(count=4, spacing=0.55, kinds=[5, 6, 3, 8])),
    ("sparse_1_noisy_b", "test", 4105, dict(count=5, spacing=0.5, kinds=[7, 4, 6, 9, 3])),
    ("sparse_2_clean_a", "validation", 4106, dict(count=3, spacing=0.6, kinds=[6, 7, 5], levels=[0, 1.25])),
    ("sparse_2_clean_b", "test", 4107, dict(count=4, spacing=0.5, kinds=[8, 3, 7, 9], levels=[0, 1.25])),
    ("sparse_2_d435_a", "train", 4108, dict(count=4, spacing=0.5, kinds=[3, 9, 6, 4], levels=[0, 1.25])),
    ("sparse_2_d435_b", "test", 4109, dict(count=3, spacing=0.55, kinds=[7, 5, 3], levels=[0, 1.25])),
    ("sparse_2_noisy_a", "train", 4110, dict(count=3, spacing=0.5, kinds=[4, 6, 7], levels=[0, 1.25])),
    ("dense_1_clean_a", "train", 4111, dict(count=3, spacing=0.5)),
    ("dense_1_clean_b", "test", 4112, dict(count=4, spacing=0.4)),
    ("dense_1_d435_a", "train", 4113, dict(count=4, spacing=0.45)),
    ("dense_1_d435_b", "test", 4114, dict(count=3, spacing=0.5)),
    ("dense_1_noisy_a", "validation", 4115, dict(count=3, spacing=0.45)),
    ("dense_1_noisy_b", "test", 4116, dict(count=3, spacing=0.5)),
    ("dense_2_clean_a", "train", 4117, dict(count=3, spacing=0.5)),
    ("dense_2_d435_a", "validation", 4118, dict(count=3, spacing=0.4)),
    ("dense_2_d435_b", "test", 4119, dict(count=4, spacing=0.45)),
    ("dense_2_noisy_a", "test", 4120, dict(count=3, spacing=0.5)),
    ("imported_1_clean_a", "train", 4121, dict(plants="pepper")),
    ("imported_1_d435_a", "validation", 4122, dict(plants="truss")),
    ("imported_1_noisy_a", "test", 4123, dict(plants="bush")),
    ("imported_2_d435_a", "test", 4124, dict(plants="string")),
]

IMPORT = """\
import: world/world.sdf
model_path: world/models
fruit: fruit_(red|orange|green)
counted: fruit_(red|orange)
leaf: leaf
"""


def recipe(name, seed, o):
    """A scene file that `canopeer scene freeze` takes."""
    dense = name.startswith("dense")
    z = 0.08 if dense else 0.0
    rows = ""
    first = MIDDLE - 0.5 * o["spacing"] * (o["count"] - 1)
    for x in (-0.75, 0.75):
        kinds = o.get("kinds", [])
        if x > 0:
            kinds = kinds[::-1]
        what = "preset: dense" if dense else f"kinds: {kinds}"
        levels = [z + level for level in o.get("levels", [0])]
        rows += f"  - {{x_m: {x}, y_from_m: {first:.3f}, spacing_m: {o['spacing']}, count: {o['count']}, levels_m: {levels}, {what}}}\n"
    ground = o["spacing"] * 1.5
    return (f"name: {name}\nseed: {seed}\npreset: {'dense_1' if dense else 'scenario_1'}\nrows:\n{rows}"
            f"along_y_m: [-4.5, 3.0]\ndistractors: 12\nground_per_plant_m2: {ground:.3f}\n")


def mission(name, seed):
    kind, levels, noise = name.split("_")[:3]
    lifts = "lifts_m: [0, 0.7]\n" if levels == "2" else ""
    return (f"# A world of CanopeerBench, see docs/benchmark.md. Frozen: change nothing here.\n"
            f"name: {name}\nrobot: ../../robot/robot_wide.yaml\ncompute_table: ../../compute_table.yaml\n"
            f"time_per_segment_s: 10\nclock: whole\nstops_travel_m: [0, 1]\n{lifts}sides: [1, 2]\nseed: {seed}\n"
            f"world: {{scene: {name}.cscene}}\n{NOISE[noise]}")


def make(program, name, seed, options):
    folder = SUITE / "worlds" / name
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    with tempfile.TemporaryDirectory() as temporary:
        source = pathlib.Path(temporary) / "recipe.yaml"
        if "plants" in options:
            suite_plants.write_world(source.parent / "world", options["plants"], seed,
                                     ROOT / "missions/own_world/models/pepper_tall/materials/textures/leaf.png")
            source.write_text(IMPORT + f"seed: {seed}\n")
        else:
            source.write_text(recipe(name, seed, options))
        subprocess.run([program, "scene", "freeze", source, "--out", folder / f"{name}.cscene"], check=True)
    (folder / f"{name}.yaml").write_text(mission(name, seed))


def counts(name):
    with open(SUITE / "worlds" / name / f"{name}.truth.csv") as file:
        rows = list(csv.DictReader(file))
    return len(rows), sum(row["counted"] == "1" for row in rows)


def list_worlds():
    with open(SUITE / "suite.csv", "w") as file:
        print("name,split,kind,levels,noise,seed,fruits_total,fruits_counted,bytes", file=file)
        for name, split, seed, _ in WORLDS:
            kind, levels, noise, _ = name.split("_")
            total, counted = counts(name)
            size = (SUITE / "worlds" / name / f"{name}.cscene").stat().st_size
            print(name, split, kind, levels, noise, seed, total, counted, size, sep=",", file=file)
    files = [SUITE / "VERSION", SUITE / "suite.csv", SUITE / "compute_table.yaml", *sorted((SUITE / "robot").iterdir()),
             *sorted(path for path in (SUITE / "worlds").rglob("*") if path.is_file())]
    with open(SUITE / "SHA256SUMS", "w") as file:
        for path in files:
            print(hashlib.sha256(path.read_bytes()).hexdigest(), path.relative_to(SUITE).as_posix(), sep="  ", file=file)


def main():
    program = sys.argv[1] if len(sys.argv) > 1 else ROOT / "build/release/bin/canopeer"
    for name, _, seed, options in WORLDS:
        if len(sys.argv) < 3 or name in sys.argv[2:]:
            make(program, name, seed, options)
    list_worlds()


if __name__ == "__main__":
    main()
