#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Fits the weights of core/recognition/place_evidence.cpp.

    cornerd-bench --evidence samples.csv --positions 16000
    fit_evidence.py samples.csv

Conditional logistic regression: the places of a scan compete with "elsewhere" (log odds 0). A wrong
place beyond the threshold of a fix (log odds 11.5) costs as much as WRONG_COST or WRONG_PLACE_COST
right ones below it. The loss has more than one minimum: the search begins at the weights in the tree
(START). Prints last how much likelier log odds are at the right place than at one that is given and
wrong (core/recognition/place_filter.cpp). The weights in the tree were fitted with other scans as
well (src/bench/poses.md, "Evidence for a place"). Needs NumPy and SciPy.
"""

import sys

import numpy as np
from scipy.optimize import minimize

FIX = 11.51  # -log(1e-5)
SCALE = 2.0
WRONG_COST = 40.0  # in a wrong map
WRONG_PLACE_COST = 100.0  # in the right one
RIDGE = 1e-4
START = {
    "intercept": -1.835, "face": 1.571, "faces_log_ratio": 0.113, "wall_end": 1.476,
    "log_map_sigma": -2.217, "log_hits": 12.33, "log_unexplained": -1.683,
    "log_unpredicted": -3.636, "log_violations": -2.185, "violation_share": 19.34,
    "short_share": 34.79, "obstacle_share": -26.78, "log_rays_through": -3.489,
    "log_missing_walls": 3.415, "unseen_face": -1.011, "segment_share": -11.52,
    "log_segments": 4.7, "log_rays": -5.009,
}


def features(c):
    """Columns of BeamStatistics and ScanStructure as log_odds_of_place() takes them."""
    rays = np.maximum(1, c["rays"])

    def log_share(count, of, least=1 / 2000):
        return np.log(np.maximum((count + 1) / (of + 1), least))

    return {
        "intercept": np.ones(len(rays)),
        "face": c["faces"],
        "faces_log_ratio": c["faces_log_ratio"],
        "wall_end": c["wall_ends"],
        "log_map_sigma": np.log(c["map_sigma"] / 0.003),
        "log_hits": log_share(c["hits"], rays, 0),
        "log_unexplained": log_share(rays - c["hits"], rays, 0.005),
        "log_unpredicted": log_share(c["predicted"] - c["predicted_hits"], c["predicted"]),
        "log_violations": log_share(c["violations"], rays),
        "violation_share": c["violations"] / rays,
        "short_share": c["shorts"] / rays,
        "obstacle_share": c["obstacles_m"] / (c["wall_m"] + c["obstacles_m"] + 0.3),
        "log_rays_through": np.log1p(c["rays_through"]),
        "log_missing_walls": np.log1p(c["missing_walls"]),
        "unseen_face": c["unseen_faces"],
        "segment_share": c["faces"] / np.maximum(3, c["segments"]),
        "log_segments": np.log(np.maximum(1, c["segments"])),
        "log_rays": np.log(np.maximum(150, rays)),
    }


def lead(z, scan, count):
    """For each scan: its best place, and the log odds of it against all others and elsewhere."""
    best = np.full(count, -np.inf)
    np.maximum.at(best, scan, z)
    top = np.zeros(count, int)
    first = np.where(z >= best[scan])[0][::-1]
    top[scan[first]] = first
    others = z.copy()
    others[top] = -np.inf
    second = np.zeros(count)  # elsewhere
    np.maximum.at(second, scan, others)
    weight = np.exp(others - second[scan])
    total = np.exp(-second)
    np.add.at(total, scan, weight)
    return top, best - second - np.log(total), weight / total[scan]


def fit(x, right, scan, wrong_map, start):
    count = scan.max() + 1
    wrong_cost = np.where(wrong_map, WRONG_COST, WRONG_PLACE_COST)
    scale = x.std(0)
    scale[scale == 0] = 1
    z_x = x / scale

    def loss(w):
        top, lo, share = lead(z_x @ w, scan, count)
        good = right[top] == 1
        d = (lo - FIX) / SCALE
        value = np.where(good, np.logaddexp(0, -d), wrong_cost * np.logaddexp(0, d))
        with np.errstate(over="ignore"):
            by_lo = np.where(good, -1 / (1 + np.exp(d)), wrong_cost / (1 + np.exp(-d))) / SCALE
        by_z = -share * by_lo[scan]
        by_z[top] += by_lo
        return value.sum() / count + RIDGE * w @ w, z_x.T @ by_z / count + 2 * RIDGE * w

    found = minimize(loss, start * scale, jac=True, method="L-BFGS-B",
                     options={"maxiter": 2000})
    return found.x / scale


def print_ratios(given):
    """The logarithm of the ratio of both histograms, by log odds."""
    edges = [-1e9, -40, -30, -25, -20, -16, -12, -8, -4, 0, 5, 11.5, 1e9]
    right = given["right"] == 1
    share = [np.histogram(given["log_odds"][m], edges)[0] / m.sum() for m in (right, ~right)]
    for low, high, at_right, at_wrong in zip(edges, edges[1:], *share):
        ratio = np.log(at_right / at_wrong) if at_right > 0 and at_wrong > 0 else np.nan
        print(f"log odds {max(low, -99):5.1f} to {min(high, 99):5.1f}: right {at_right:.5f}, "
              f"given and wrong {at_wrong:.5f}, log ratio {ratio:5.1f}", file=sys.stderr)


def main():
    table = np.genfromtxt(sys.argv[1], delimiter=",", names=True)
    given, table = table[table["given"] == 1], table[table["given"] == 0]
    wrong_but_fits = (table["wrong_map"] == 1) & (table["hits"] >= 0.975 * table["rays"])
    table = table[~np.isin(table["scan"], table["scan"][wrong_but_fits])]
    scan = np.unique(table["scan"], return_inverse=True)[1]
    by_name = features(table)
    x = np.stack(list(by_name.values()), 1)
    wrong_map = np.zeros(scan.max() + 1)
    wrong_map[scan] = table["wrong_map"]
    w = fit(x, table["right"], scan, wrong_map == 1, np.array([START[name] for name in by_name]))
    for name, weight in zip(by_name, w):
        print(f"  double {name} = {weight:.4g};")
    top, lo, _ = lead(x @ w, scan, scan.max() + 1)
    good = table["right"][top] == 1
    in_map = table["wrong_map"][top] == 0
    print(f"right places named {np.mean(lo[in_map & good] > FIX):.3f}, of right maps' scans "
          f"{np.sum(in_map & good & (lo > FIX)) / in_map.sum():.3f}; wrong ones named: "
          f"{np.sum(~good & (lo > FIX))} of {len(lo)} scans", file=sys.stderr)
    print_ratios(given)


if __name__ == "__main__":
    main()
