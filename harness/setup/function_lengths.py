#!/usr/bin/env python3
"""Holds every function to what can be read at a time: at most 60 lines, tests' bodies too.

  function_lengths.py CTAGS ROOT    CTAGS: Universal Ctags, which knows where a function ends

Prints what is longer as file:line: sentence and ends with 1.
"""
import re
import sys
from pathlib import Path

from source_tags import room_sources, tags, tell

most_lines = 60


def functions(ctags, root, files):
    """Path, line, name and number of lines of each."""
    found = tags(ctags, root, files, kinds="f", fields="e")
    for name, path, line, end in re.findall(r'^([^!\t][^\t]*)\t([^\t]+)\t(\d+);"\tend:(\d+)$', found, re.MULTILINE):
        yield path, int(line), name, int(end) - int(line) + 1


def main(ctags, root):
    files = room_sources(root, ".h", ".cpp")
    found = list(functions(ctags, root, files))
    problems = [f"{path}:{line}: {name} has {lines} lines, more than {most_lines}"
                for path, line, name, lines in found if lines > most_lines]
    return tell(problems if found else ["ctags found no functions"], f"{len(found)} functions in {len(files)} files")


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    sys.exit(main(sys.argv[1], Path(sys.argv[2]).resolve()))
