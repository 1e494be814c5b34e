#!/usr/bin/env python3
"""Holds that a type's name is defined once in the whole program, but for what is local to a source: two classes of one
name in two rooms are linked as one (their destructors are one inline function), which no compiler tells.

  type_names.py CTAGS ROOT    CTAGS: Universal Ctags

Prints what two files define as file:line: sentence and ends with 1.
"""
import re
import sys
from pathlib import Path

from source_tags import defined_twice, room_sources, tags, tell


def type_names(ctags, root, files):
    """Path, line and qualified name of each; not of specializations, whose names go on with <."""
    found = tags(ctags, root, files, kinds="sgcu", fields="sn")
    for name, path, line, scope in re.findall(
            r'^([^!\t][^\t]*)\t([^\t]+)\t(\d+);"\t(?:.*\t)?namespace:([\w:]+)$', found, re.MULTILINE):
        text = (root / path).read_text().splitlines()[int(line) - 1]
        if "__anon" not in scope and not re.search(rf"\b{name}<", text):
            yield path, int(line), scope + "::" + name


def main(ctags, root):
    files = room_sources(root, ".h", ".cpp")
    found = list(type_names(ctags, root, files))
    problems = defined_twice(found, lambda _, name: name)
    return tell(problems if found else ["ctags found no types"], f"{len(found)} types in {len(files)} files")


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    sys.exit(main(sys.argv[1], Path(sys.argv[2]).resolve()))
