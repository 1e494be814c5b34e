#!/usr/bin/env python3
"""Fills figures of pages from published records, and finds those that differ or have no record.

  figures.py check ROOT         prints figures of pages that differ from their records; ends with 1
  figures.py fill ROOT          writes the records' figures into the pages
  figures.py count ROOT         counts the figures of each page: from a record, measured once, by hand
  figures.py tests ROOT BUILD   runs the tests whose figures docs/evidence.md shows, and writes reports/published/tests.txt

A page marks a figure by the comment <!--NAME--> before it. reports/published/figures.toml says which record has NAME, and
where. The page decides how many decimals it shows, and whether with a plus. A whole table from a record lies between
<!-- table NAME --> and <!-- end of table -->. Figures in a column of results need a mark. A cell, a caption or a paragraph
with a date is exempt: it was measured once, on that day.
"""
import datetime
import platform
import re
import subprocess
import sys
import tomllib
from pathlib import Path

from source_tags import tell

folder = "reports/published"
pages = ("README.md", "docs/evidence.md", "docs/performance.md", "docs/testing.md", "docs/limits.md", "docs/showcase.md",
         "docs/verbs/report.md", "docs/verbs/stress.md")
plain_number = r"(?:\d+(?:,\d{3})*(?:\.\d+)?|\.\d+)(?:e-?\d+)?"
mark = re.compile(rf"<!--([a-z]\w*\.[\w.]+(?:/[\w./: -]*)?)-->([-−+]?{plain_number})")
block = re.compile(r"<!-- table (\S+) -->\n(.*?)<!-- end of table -->", re.DOTALL)
date = re.compile(r"\b20\d\d-\d\d-\d\d\b")
# Columns whose cells are results; all other columns name what was measured, against which bound, and by which command.
results = re.compile(r"measured|faster by|AVX2|AVX-512|path|photonmapper|sppm|bdpt|ptracer|volpath|last run|`\./run`|`\./check`|"
                     r"size|seconds|processor seconds|our mean|right|degraded|refused|undecided|silently wrong")
figure = re.compile(rf"(?<![\w.^×/-])[-−+]?{plain_number}(?![\w.^×]*[A-Za-z×^])")


class Records:
    """The figures that reports/published/figures.toml names."""

    def __init__(self, root):
        self.root, self.texts = root, {}
        self.names = tomllib.loads((root / folder / "figures.toml").read_text())

    def text(self, file):
        if file not in self.texts:
            self.texts[file] = (self.root / folder / file).read_text()
        return self.texts[file]

    def value(self, address):
        """The number, or a LookupError."""
        name, *arguments = address.split("/")
        group, _, key = name.partition(".")
        row = self.names.get(group, {}).get(key)
        if row is None:
            raise LookupError(f"figures.toml has no {name}")
        row = row if isinstance(row, dict) else {"find": row}
        if "ratio" in row:
            return self.value(row["ratio"][0]) / self.value(row["ratio"][1])
        pattern = row["find"]
        for place, argument in enumerate(arguments):
            pattern = pattern.replace(f"{{{place}}}", re.escape(argument))
        files = self.names[group]["files"]
        found = [match for file in files for match in re.finditer(pattern, self.text(file), re.MULTILINE)]
        if not found:
            if row.get("as") in ("count", "sum"):
                return 0.0
            raise LookupError(f"{name}: {', '.join(files)} has no line {pattern}")
        return value_of(found, row)


def number(text):
    return float(text.replace("−", "-").replace(",", "").replace("$-$", "-"))


def value_of(matches, row):
    """The number of the first match, or what `as` makes of all matches."""
    way = row.get("as", "first")
    if way == "count":  # of different keys, the first group, whose numbers, the second, lie within the bounds
        best = {}
        for match in matches:
            best[match[1]] = max(best.get(match[1], -1e30), abs(number(match[2])) if match.re.groups > 1 else 0)
        return float(sum(row.get("least", -1e30) <= value <= row.get("most", 1e30) for value in best.values()))
    values = [number(match[1]) for match in matches]
    ways = {"first": lambda: values[0], "percent": lambda: 100 * (values[0] - 1), "most": lambda: max(values),
            "least": lambda: min(values), "sum": lambda: sum(values)}
    return ways[way]()


def shown_like(value, shown):
    """The value with the decimals, the sign and the leading zero of what a page shows."""
    if "e" in shown:
        mantissa, _, power = f"{value:.{len(re.sub('[^0-9].*', '', shown.partition('.')[2]))}e}".partition("e")
        return f"{mantissa}e{int(power)}"
    decimals = len(shown.partition(".")[2])
    text = f"{abs(value):,.{decimals}f}" if "," in shown else f"{abs(value):.{decimals}f}"
    if re.match(r"[-−+]?\.", shown):
        text = text.removeprefix("0")
    zero = not text.strip("0.,")
    signed = shown[0] in "+-−"
    minus = "-" if shown[0] == "-" else "−"
    return (minus if value < 0 and not zero else "+" if signed and not zero else "") + text


def seconds_to_targets(records):
    """The table of processor seconds to a relMSE of 1e-2 and 1e-3; the least of a row is bold."""
    engines = ("photonmapper", "sppm", "path", "bdpt")
    rows, scene = {}, None
    tail = records.text("photons.tex").split("Target relMSE", 1)[1]
    for line in tail.split("\n"):
        cells = [cell.strip() for cell in line.removesuffix(" \\\\").split(" & ")]
        if len(cells) != 6:
            continue
        scene = cells[0] or scene
        text = re.sub(r" \[.*", "", cells[5])
        sign = {"$": "≤ ", "\\": "> "}.get(text[0], "")
        seconds = float(re.search(r"[\d.]+$", text)[0])
        rows.setdefault(scene, {})[cells[1], float(cells[4])] = (sign, seconds)
    lines = ["| scene | " + " | ".join(engines) + " |", "|---|" + "---|" * len(engines)]
    for scene, found in rows.items():
        least = {target: min((s for (_, t), (sign, s) in found.items() if t == target and sign != "> "), default=None)
                 for target in (0.01, 0.001)}
        lines.append(f"| `{scene}` | " + " | ".join(seconds_cell(found, engine, least) for engine in engines) + " |")
    return "\n".join(lines) + "\n"


def seconds_cell(found, engine, least):
    cells = []
    for target in (0.01, 0.001):
        sign, seconds = found[engine, target]
        text = sign + (f"{seconds:#.2g}" if seconds < 100 else f"{seconds:.0f}").removeprefix("0").removesuffix(".")
        cells.append(f"**{text}**" if sign != "> " and seconds == least[target] else text)
    both = cells[0] if cells[0] == cells[1] and cells[0].startswith(">") else ", ".join(cells)
    return both.replace("**, **", ", ")


tables = {"photons.seconds_to_targets": seconds_to_targets}


def filled(text, records):
    """The page's text with the records' figures, and (line, problem) of all that changed."""
    problems = []

    def line_of(match):
        return text.count("\n", 0, match.start()) + 1

    def fill(match):
        try:
            new = shown_like(records.value(match[1]), match[2])
        except LookupError as error:
            problems.append((line_of(match), str(error)))
            return match[0]
        if new != match[2]:
            problems.append((line_of(match), f"{match[1]} is {new} in the record, {match[2]} in the page"))
        return f"<!--{match[1]}-->{new}"

    def fill_table(match):
        new = tables[match[1]](records)
        if new != match[2]:
            problems.append((line_of(match), f"the table {match[1]} differs from its record"))
        return f"<!-- table {match[1]} -->\n{new}<!-- end of table -->"

    marked = mark.sub(fill, text)
    return block.sub(fill_table, marked), problems


def cells_with_results(text):
    """(line, cell, exempt) of every cell in a column of results. Cells between marks of a table are left out."""
    text = block.sub(lambda match: "\n" * match[0].count("\n"), text)
    columns, dated, fenced, paragraph, caption = None, [], False, "", ""
    for number_of_line, line in enumerate(text.split("\n"), 1):
        fenced ^= line.startswith("```")
        if fenced or not line.startswith("|"):
            paragraph = f"{paragraph} {line}" if line.strip() else ""
            columns, caption = None, paragraph or caption
            continue
        cells = re.split(r"(?<!\\)\|", line)[1:-1]
        if columns is None:
            columns = [bool(results.fullmatch(re.sub(r",.*", "", cell.strip()))) for cell in cells]
            dated = [bool(date.search(cell)) for cell in cells]
        elif not re.fullmatch(r"[\s:-]*", cells[0]):
            whole_row = date.search(cells[0]) or date.search(caption) or any(date.fullmatch(cell.strip()) for cell in cells)
            for cell, wanted, once in zip(cells, columns, dated):
                if wanted:
                    yield number_of_line, cell, bool(whole_row or once or date.search(cell))


def figures_of(cell):
    """The figures of a cell that have no mark."""
    return figure.findall(re.sub(r"`[^`]*`|\]\([^)]*\)|<!--.*?-->", " ", date.sub(" ", mark.sub(" ", cell))))


def count_of(text):
    """How many figures of a page's results are from a record, measured once, and by hand."""
    counts = [0, 0, 0]
    for match in block.finditer(text):
        counts[0] += sum(len(figures_of(line.split("|", 2)[2])) for line in match[2].split("\n")[2:] if line)
    for _, cell, exempt in cells_with_results(text):
        counts[1 if exempt else 2] += len(figures_of(cell))
    counts[0] += len(mark.findall(text))
    return counts


def problems_of(page, text, records):
    problems = [f"{page}:{line}: {problem}" for line, problem in filled(text, records)[1]]
    for line, cell, exempt in cells_with_results(text):
        others = figures_of(cell)
        if others and not exempt:
            problems.append(f"{page}:{line}: no record and no date: {', '.join(others)}")
    return problems


def host():
    cpu = re.search(r"model name\s*: (.*)", Path("/proc/cpuinfo").read_text())
    with_avx512 = "with" if "avx512f" in Path("/proc/cpuinfo").read_text() else "without"
    return f"{cpu[1] if cpu else platform.machine()} {with_avx512} AVX-512"


def write_tests(root, build):
    """Lines with a number that the tests print, and how many tests of each name pass, check by check."""
    evidence = (root / "docs/evidence.md").read_text()
    rows = "\n".join(line for line in evidence.split("\n") if "<!--tests." in line)
    patterns = dict.fromkeys(p.replace("\\|", "|") for p in re.findall(r'`\./check "?([^"`]+?)"?`', rows))
    lines = [f"# harness/setup/figures.py tests, {datetime.date.today()}, {host()}: what the tests print whose figures docs/evidence.md shows."]
    bad = []
    for pattern in patterns:
        command = ["ctest", "--test-dir", build, "-R", pattern, "--verbose", "--no-tests=error"]
        output = subprocess.run(command, capture_output=True, text=True, errors="replace").stdout
        found = lines_of(output)
        bad += [line for line in found if re.match(r"\d+ (?!passed|skipped)", line)]
        lines += ["", f"./check {pattern}"] + found
        print(f"{pattern}: {len(re.findall(' Passed ', output))} passed", flush=True)
    (root / folder / "tests.txt").write_text("\n".join(lines) + "\n")
    return tell(bad, "reports/published/tests.txt")


def lines_of(output):
    outcomes = {}
    for name, outcome in re.findall(r"Test +#\d+: (\S+).*? \.*\s*(?:\*\*\*)?(Passed|Skipped|Failed|Timeout|Exception)", output):
        key = name.rpartition("/")[0] if name.count("/") > 1 else name, outcome.lower()
        outcomes[key] = outcomes.get(key, 0) + 1
    printed = re.findall(r"^\d+: (?!Test |Working |\[|Note: |Running main|Environment|  )(.*\d.*)$", output, re.MULTILINE)
    return [f"{count} {outcome}: {name}" for (name, outcome), count in outcomes.items()] + [
        f"  {line}" for line in dict.fromkeys(printed) if not re.search(r"_test\.cpp:\d|\d+ tests? from", line)]


def main(verb, root, build):
    if verb == "tests":
        return write_tests(root, build)
    records, problems, summary = Records(root), [], []
    for page in pages:
        path = root / page
        if not path.exists():
            continue
        text = path.read_text()
        if verb == "fill":
            path.write_text(filled(text, records)[0])
        problems += problems_of(page, path.read_text(), records)
        summary.append("{}: {} from a record, {} measured once, {} by hand".format(page, *count_of(text)))
    if verb == "count":
        return print("\n".join(summary)) or 0
    return tell(problems, "\n".join(summary))


if __name__ == "__main__":
    if len(sys.argv) not in (3, 4) or sys.argv[1] not in ("check", "fill", "count", "tests"):
        sys.exit(__doc__)
    sys.exit(main(sys.argv[1], Path(sys.argv[2]).resolve(), sys.argv[3] if len(sys.argv) == 4 else None))
