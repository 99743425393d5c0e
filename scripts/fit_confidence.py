#!/usr/bin/env python3
"""Fits the weights of a fruit's confidence to what fruit_replay has written, and shows what they are worth on other runs.

    scripts/fit_confidence.py --fit DIR… --hold DIR…

Each DIR holds a candidates.csv of bench/fruit_replay. The weights are those of a logistic regression (maximum likelihood with a
weak pull to zero, by Newton's method); evidence may only count the way it can: the sign of each weight is given, a weight that
would have the other sign is zero. Every look at a candidate counts, but each candidate of a run at most as much as five looks,
since looks at one thing are not independent. Green fruits (neither right nor wrong) are left out.
Prints the weights as src/canopeer/fruit/confidence/confidence.cpp has them, and how many of the candidates held back are real by confidence.
"""
import argparse
import collections
import csv
import math
import os

# Name, sign that the weight may have (0: any), value from a row. As ConfidenceModel::features().
FEATURES = [
    ("1", 0, lambda r: 1.0),
    ("log area", 1, lambda r: math.log(max(r["area_cm2"], 0.1) / 10.0)),
    ("share seen", 1, lambda r: r["seen_share"]),
    ("misfit", -1, lambda r: min(r["rms_m"], 0.02) / 0.003),
    ("size", -1, lambda r: min(r["size_sds"], 10.0)),
    ("curvature", 1, lambda r: min(r["normal_spread"], 1.0) / 0.25),
    ("foreign", -1, lambda r: r["foreign_share"]),
    ("free", -1, lambda r: r["free_share"]),
]
PULL = 0.02  # of each weight but the first: −½ PULL w² beside the log likelihood
MOST_LOOKS = 5.0


def read(folders):
    rows = []
    for folder in folders:
        with open(os.path.join(folder, "candidates.csv"), newline="", encoding="utf-8") as f:
            for row in csv.DictReader(f):
                if row["real"] == "-1" or not row.get("free_share"):
                    continue
                values = {k: float(v) for k, v in row.items() if k not in ("condition", "run")}
                values["thing"] = (folder, row["condition"], row["run"], row["id"])
                rows.append(values)
    looks = collections.Counter(r["thing"] for r in rows)
    for r in rows:
        r["weight"] = min(1.0, MOST_LOOKS / looks[r["thing"]])
        r["x"] = [value(r) for _, _, value in FEATURES]
    return rows


def solved(a, b):
    """x of a x = b by elimination with pivots."""
    n = len(b)
    m = [row[:] + [b[i]] for i, row in enumerate(a)]
    for i in range(n):
        p = max(range(i, n), key=lambda k: abs(m[k][i]))
        m[i], m[p] = m[p], m[i]
        for k in range(i + 1, n):
            f = m[k][i] / m[i][i]
            for j in range(i, n + 1):
                m[k][j] -= f * m[i][j]
    x = [0.0] * n
    for i in reversed(range(n)):
        x[i] = (m[i][n] - sum(m[i][j] * x[j] for j in range(i + 1, n))) / m[i][i]
    return x


def probability(w, x):
    t = sum(a * b for a, b in zip(w, x))
    return 1.0 / (1.0 + math.exp(-max(-40.0, min(40.0, t))))


def newton(rows, used):
    """Weights of the used features, others zero."""
    w = [0.0] * len(FEATURES)
    for _ in range(60):
        g = [-(PULL * w[j] if j else 0.0) for j in used]
        h = [[(PULL if j == k and j else 0.0) for k in used] for j in used]
        for r in rows:
            p = probability(w, r["x"])
            d = r["weight"] * (r["real"] - p)
            s = r["weight"] * max(p * (1.0 - p), 1e-9)
            x = [r["x"][j] for j in used]
            for i, a in enumerate(x):
                g[i] += d * a
                for k in range(i + 1):
                    h[i][k] += s * a * x[k]
        for i in range(len(used)):
            for k in range(i):
                h[k][i] = h[i][k]
        step = solved(h, g)
        largest = max(abs(s) for s in step)
        for j, s in zip(used, step):
            w[j] += s * min(1.0, 2.0 / largest)
        if largest < 1e-6:
            break
    return w


def fit(rows):
    used = list(range(len(FEATURES)))
    while True:
        w = newton(rows, used)
        wrong = [j for j in used if FEATURES[j][1] * w[j] < 0.0]
        if not wrong:
            return w
        used.remove(max(wrong, key=lambda j: abs(w[j])))


def table(rows, w, title):
    print(f"\n{title}: {len(rows)} looks at {len({r['thing'] for r in rows})} things")
    print("| confidence | looks (things) | real, of looks | real, looks weighed |")
    print("|---|---|---|---|")
    edges = [0.0, 0.1, 0.3, 0.5, 0.6, 0.7, 0.8, 0.9, 0.95, 1.01]
    for low, high in zip(edges, edges[1:]):
        here = [r for r in rows if low <= probability(w, r["x"]) < high]
        if not here:
            continue
        real = sum(r["real"] for r in here)
        things = len({r["thing"] for r in here})
        weighed = sum(r["weight"] * r["real"] for r in here) / sum(r["weight"] for r in here)
        share = f"{100.0 * real / len(here):.0f} % | {100.0 * weighed:.0f} %"
        print(f"| {low:g} to {min(high, 1.0):g} | {len(here)} ({things}) | {share} |")
    loss = -sum(math.log(max(1e-12, p if r["real"] else 1.0 - p)) for r in rows for p in [probability(w, r["x"])])
    print(f"log loss {loss / max(1, len(rows)):.4f}")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--fit", nargs="+", required=True, metavar="DIR")
    parser.add_argument("--hold", nargs="+", default=[], metavar="DIR")
    arguments = parser.parse_args()
    rows = read(arguments.fit)
    w = fit(rows)
    for (name, _, _), value in zip(FEATURES, w):
        print(f"{name:12s} {value:8.3f}")
    print("weights << " + ", ".join(f"{value:.3f}" for value in w) + ";")
    table(rows, w, "fitted to")
    if arguments.hold:
        held = read(arguments.hold)
        table(held, w, "held back")
        table([r for r in held if r["last"] == 1.0], w, "held back, at the end of each run")


if __name__ == "__main__":
    main()
