#!/usr/bin/env python3
"""Tells which published tables are older than their sources (reports/published/sources.json).

  published.py check ROOT                    prints the tables whose sources changed since they were made; ends with 1
  published.py made ROOT TABLE               records that the table was made from the sources of now
  published.py unchanged ROOT TABLE REASON   records that a change of the sources cannot change the table, and why
  published.py stale ROOT TABLE REASON       records that it is out of date; its page must then say "Out of date: REASON"

Comments, blank lines and spaces do not count, nor do tests and benchmarks, except where a table names them.
"""
import datetime
import hashlib
import json
import re
import sys
from pathlib import Path

from source_tags import tell

folder = "reports/published"
left_out = re.compile(r"_(test|bench|fuzz)\.(cpp|h)$|/test_[^/]*$")


def code(path):
    """The text without comments and white space."""
    text = path.read_text(errors="replace")
    start = r"//" if path.suffix in (".h", ".cpp", ".js") else r"#"
    return re.sub(r"\s+", "", re.sub(rf"(?m)(^|\s){start}.*$", "", text))


def hash_of(root, patterns):
    digest = hashlib.sha256()
    for pattern in patterns:
        files = sorted(f for f in root.glob(pattern) if f.is_file())
        named = "*" not in pattern
        kept = [f for f in files if named or not left_out.search(f.as_posix())]
        if not kept:
            raise SystemExit(f"{folder}/sources.json: no file matches {pattern}")
        for file in kept:
            digest.update(f"{file.relative_to(root)}:{hashlib.sha256(code(file).encode()).hexdigest()}\n".encode())
    return digest.hexdigest()[:16]


def manifest_of(root):
    return json.loads((root / folder / "sources.json").read_text())


def problem_of(root, table, row):
    page = root / folder / table
    if not page.exists():
        return "no such table"
    if row["hash"] != hash_of(root, row["sources"]):
        return f"its sources changed since {row['date']}; make it again, or say why they do not matter (harness/setup/published.py)"
    if "stale" in row and f"Out of date: {row['stale']}" not in page.read_text():
        return f"the page has to say 'Out of date: {row['stale']}'"
    return None


def check(root):
    rows = manifest_of(root)
    found = [(table, problem_of(root, table, row)) for table, row in rows.items()]
    listed = {p.name for p in (root / folder).iterdir() if p.suffix in (".md", ".tex", ".txt")} - {"README.md"}
    found += [(table, "sources.json does not say what it is made from") for table in sorted(listed - rows.keys())]
    problems = [f"{folder}/{table}: {problem}" for table, problem in found if problem]
    return tell(problems, f"{len(rows)} tables are as new as their sources")


def record(root, table, verb, reason):
    rows, table = manifest_of(root), Path(table).name
    if table not in rows:
        sys.exit(f"no table {table}; there are: {', '.join(rows)}")
    sources = rows[table]["sources"]
    date = datetime.date.today().isoformat() if verb == "made" else rows[table]["date"]
    rows[table] = {"sources": sources, "date": date, "hash": hash_of(root, sources)}
    if verb != "made":
        rows[table][verb] = reason
    (root / folder / "sources.json").write_text(json.dumps(rows, indent=1) + "\n")
    return 0


if __name__ == "__main__":
    verb, arguments = sys.argv[1] if len(sys.argv) > 2 else "", sys.argv[2:]
    if verb == "check" and len(arguments) == 1:
        sys.exit(check(Path(arguments[0]).resolve()))
    if verb in ("made", "unchanged", "stale") and len(arguments) == (2 if verb == "made" else 3):
        sys.exit(record(Path(arguments[0]).resolve(), arguments[1], verb, arguments[-1]))
    sys.exit(__doc__)
