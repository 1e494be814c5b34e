"""What of several gradings of the same submissions is the same: regrades_table.py GRADES.json...

Exit code 1 where two gradings differ without saying so, in a verdict, in the points for a measured speed, or in that speed.
"""

import itertools
import json
import math
import sys

WITHIN = 0.02


def verdicts(submission):
    return tuple((scene["scene"], scene["verdict"]) for scene in submission["scenes"])


def ends(speed):
    return speed["speedup"].get("interval") or [speed["speedup"]["value"]] * 2


def differ(a, b):
    """Two measured speeds: "" where they are within 2 %, "said" where their intervals say so, else "silent"."""
    if a["points"] != b["points"]:
        return "silent"
    if abs(math.log(a["speedup"]["value"] / b["speedup"]["value"])) <= WITHIN:
        return ""
    (low_a, high_a), (low_b, high_b) = ends(a), ends(b)
    return "said" if max(low_a, low_b) <= min(high_a, high_b) else "silent"


def row(name, submissions):
    first = verdicts(submissions[0])
    same = sum(verdicts(one) == first for one in submissions)
    speeds = [one["speed"] for one in submissions]
    measured = [speed for speed in speeds if speed["state"] == "measured"]
    pairs = [differ(a, b) for a, b in itertools.combinations(measured, 2)]
    cells = [name, f"{same} of {len(submissions)}", " ".join(sorted({f"{one['correctness_points']:g}" for one in submissions}))]
    values = [speed["speedup"]["value"] for speed in speeds if speed.get("scenes")]
    noisy = sum(speed["state"] == "too noisy" for speed in speeds)
    cells.append(f"{min(values):.3g} to {max(values):.3g}" if values else "-")
    cells.append(f"{len(measured)}, {noisy}")
    cells.append(" ".join(sorted({f"{speed['points']:g}" for speed in measured})) or "-")
    cells.append(f"{pairs.count('')}, {pairs.count('said')}, {pairs.count('silent')}" if pairs else "-")
    return cells, len(submissions) - same + pairs.count("silent")


def main(files):
    gradings = [json.load(open(file, encoding="utf-8")) for file in files]
    rows = [["submission", "verdicts equal", "points", "speed-up", "measured, noisy", "its points",
             "pairs: within 2 %, said, silent"]]
    silent = 0
    for name in [submission["name"] for submission in gradings[0]["submissions"]]:
        cells, differing = row(name, [next(s for s in grading["submissions"] if s["name"] == name) for grading in gradings])
        rows.append(cells)
        silent += differing
    widths = [max(len(cells[i]) for cells in rows) for i in range(len(rows[0]))]
    for cells in rows:
        print("  ".join(cell.ljust(width) for cell, width in zip(cells, widths)).rstrip())
    print(f"{len(gradings)} gradings; {silent} silent differences")
    return 1 if silent else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
