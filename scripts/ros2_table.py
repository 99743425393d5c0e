#!/usr/bin/env python3
"""ros2_table.py DIR RUNS: the table of ros2_table.sh from its folder of runs."""
import json
import pathlib
import statistics
import sys

VELOCITY, ACCELERATION = 3.14159, 1.0  # of the UR5e's joints in robots/ur5e_trolley


def least_time(motion):
    """Of a path that stops at its waypoints; None of one with rounded corners."""
    if any(motion.get("deviations", [])):
        return None
    total = 0.0
    for a, b in zip(motion["waypoints"], motion["waypoints"][1:]):
        far = max(abs(x - y) for x, y in zip(a, b))
        if far == 0.0:
            continue
        v, acc = VELOCITY / far, ACCELERATION / far
        total += 1.0 / v + v / acc if v * v < acc else 2.0 * acc**-0.5
    return total


def read(folder):
    lines = [json.loads(line) for line in (folder / "record").read_text().splitlines()]
    events = [(kind, line[kind]) for line in lines for kind in ("view", "motion") if kind in line]
    summary = json.loads((folder / "summary.json").read_text())
    frame_ms, exposure_ms, motion_ms = [], [], []
    for (kind, before), (next_kind, after) in zip(events, events[1:]):
        if kind == "motion" and next_kind == "view":
            exposure_ms.append(1e3 * (after["t_s"] - before["start_s"] - before["duration_s"]))
        if kind == "view" and next_kind == "motion":
            frame_ms.append(1e3 * (after["start_s"] - before["t_s"]))
    for kind, motion in events:
        if kind == "motion" and motion["kind"] != "trolley" and "ended" not in motion:
            planned = least_time(motion)
            if planned:
                motion_ms.append(1e3 * (motion["duration_s"] - planned))
    return {"summary": summary, "frame": frame_ms, "exposure": exposure_ms, "motion": motion_ms}


def spread(values):
    return f"{statistics.mean(values):.1f} ({min(values):g} ... {max(values):g})"


def percentiles(values):
    if len(values) < 2:
        return "-"
    cuts = statistics.quantiles(values, n=20, method="inclusive")
    return f"{statistics.median(values):.0f} / {cuts[18]:.0f}"


def main():
    out, runs = pathlib.Path(sys.argv[1]), range(1, int(sys.argv[2]) + 1)
    kinds = {kind: [read(out / f"{kind}_{i}") for i in runs] for kind in ("wall", "ros2")}

    def row(name, text):
        print(f"{name:52}{text('wall'):>24}{text('ros2'):>24}")

    print(f"{'':52}{'wall clock':>24}{'over ROS 2':>24}")
    for name, key in (("fruits reported", "fruits_reported"), ("views", "views"), ("collisions", "collisions"),
                      ("ROI voxels", "roi_voxels"), ("arm under way, s", "motion_time_s")):
        row(name, lambda kind: spread([round(run["summary"][key], 2) for run in kinds[kind]]))
    for name, key in (("frame taken until next motion, ms, p50 / p95", "frame"),
                      ("motion's end until frame taken, ms, p50 / p95", "exposure"),
                      ("motion longer than planned, ms, p50 / p95", "motion")):
        row(name, lambda kind: percentiles([x for run in kinds[kind] for x in run[key]]))
    threads = [json.loads((out / f"threads_{i}.json").read_text()) for i in runs]
    robots = [float((out / f"robot_cpu_{i}.txt").read_text()) for i in runs]
    elapsed = sum(t["elapsed_s"] for t in threads)
    print(f"\nover ROS 2, share of a core: mission {100 * sum(t['all_s'] for t in threads) / elapsed:.1f} %, "
          f"of that receiving {100 * sum(t['network_s'] for t in threads) / elapsed:.1f} %; "
          f"simulated robot {100 * sum(robots) / elapsed:.1f} %")
    for i in runs:
        print(f"robot {i}: " + "; ".join((out / f"robot_{i}.txt").read_text().splitlines()[1:]))


main()
