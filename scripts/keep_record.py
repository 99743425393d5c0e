#!/usr/bin/env python3
"""Puts what `canopeer bound` found into records/: scripts/keep_record.py BOUND_DIR RECORD.json

RECORD.json is e.g. records/suite/WORLD/tight10.json or records/dense_1/seed_1/tight10.json; plans are copied beside it. Where a
record of the same world is there already, the better of both best results stays. Check it: canopeer bench --verify-records."""
import json
import pathlib
import shutil
import sys

BEST = {"best_found": lambda r: (r["detected"], r["auc"]), "best_auc": lambda r: r["auc"]}


def main():
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    bound, target = map(pathlib.Path, sys.argv[1:])
    try:
        found = json.loads((bound / "yardstick.json").read_text())
    except (OSError, ValueError) as error:
        sys.exit(f"{bound / 'yardstick.json'}: {error}; canopeer bound MISSION --out {bound} makes it")
    old = json.loads(target.read_text()) if target.exists() else None
    if old and old["world_hash"] != found["world_hash"]:
        sys.exit(f"{target} is of another world ({old['world_hash']}, not {found['world_hash']}); remove it first")
    plans = {result["plan"]: bound / result["plan"] for result in results(found)}
    if old:
        for key, value in BEST.items():
            if value(old[key]) > value(found[key]):
                found[key] = old[key]
                plans[old[key]["plan"]] = None  # it lies there already
    kept = {name for name, source in plans.items() if source is None}
    target.parent.mkdir(parents=True, exist_ok=True)
    for result in results(found):
        source = plans.get(result["plan"])
        if source is None:
            continue
        name = f"{target.stem}.{result['plan'].removeprefix('clairvoyant_').removesuffix('.json')}.plan.json"
        while name in kept:
            name = name.replace(".plan.json", "_b.plan.json")
        shutil.copyfile(source, target.parent / name)
        result["plan"] = name
    target.write_text(json.dumps(found, indent=2) + "\n")
    for plan in target.parent.glob(f"{target.stem}.*plan.json"):
        if plan.name not in {result["plan"] for result in results(found)}:
            plan.unlink()
    print(f"{target}: {found['best_found']['detected']} of {found['fruits_total']} fruits, AUC {found['best_auc']['auc']:.3f}")


def results(yardstick):
    return [yardstick[key] for key in ("clairvoyant", *BEST) if yardstick[key].get("plan")]


if __name__ == "__main__":
    main()
