#!/usr/bin/env python3
"""Finds links of pages to files or headings that do not exist, and pages that no page or no menu of the site links to.

  docs_links.py ROOT     every page of the top folder and of docs/

Addresses of other sites are not visited. Prints file:line: sentence and ends with 1.
"""
import re
import sys
from pathlib import Path

from source_tags import tell

link = re.compile(r"!?\[[^\]]*\]\(([^()\s]+)(?:\s+\"[^\"]*\")?\)")


def lines_outside_code(text):
    fenced = False
    for number, line in enumerate(text.split("\n"), 1):
        if line.lstrip().startswith("```"):
            fenced = not fenced
        elif not fenced:
            yield number, line


def anchors(text):
    """Headings as code hosts name them: lower case, without punctuation, hyphens for spaces."""
    found = set()
    for _, line in lines_outside_code(text):
        if heading := re.match(r"#+\s+(.*?)\s*#*$", line):
            words = re.sub(r"`|\*|\[([^\]]*)\]\([^)]*\)", r"\1", heading[1]).lower()
            found.add(re.sub(r"[^\w\- ]", "", words).replace(" ", "-"))
        found.update(re.findall(r"<a (?:id|name)=\"([^\"]+)\"", line))
    return found


def pages_of(root):
    return sorted([*root.glob("*.md"), *(root / "docs").rglob("*.md")])


def problems_of(root):
    linked, problems = set(), []
    pages = pages_of(root)
    for page in pages:
        name = page.relative_to(root).as_posix()
        for number, line in lines_outside_code(page.read_text()):
            for target in link.findall(re.sub(r"`[^`]*`", "", line)):
                if re.match(r"[a-z]+:", target):
                    continue
                path, _, anchor = target.partition("#")
                file = (page.parent / path).resolve() if path else page
                linked.add(file if file != page else None)
                if not file.exists() or root not in file.parents:
                    problems.append(f"{name}:{number}: no file {target}")
                elif anchor and file.suffix == ".md" and anchor not in anchors(file.read_text()):
                    problems.append(f"{name}:{number}: no heading {target}")
    problems += [f"{page.relative_to(root)}:1: no page links to it"
                 for page in pages if page not in linked and page.name not in ("README.md", "index.md")]
    return problems + missing_in_menu(root), len(pages)


def missing_in_menu(root):
    """Pages that docs/mkdocs.yml does not list. The site's build ends at them."""
    menu = root / "docs/mkdocs.yml"
    if not menu.exists():
        return []
    listed = set(re.findall(r"(?m)^ +- [^:\n]+: (\S+\.md)$", menu.read_text()))
    pages = {page.relative_to(root / "docs").as_posix() for page in (root / "docs").rglob("*.md")}
    return [f"docs/mkdocs.yml:1: the menu lacks {page}" for page in sorted(pages - listed)]


def main(root):
    problems, pages = problems_of(root)
    return tell(problems, f"links of {pages} pages")


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    sys.exit(main(Path(sys.argv[1]).resolve()))
