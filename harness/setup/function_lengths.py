#!/usr/bin/env python3
"""Holds every function to what can be read at a time: at most 60 lines, tests' bodies too.

  function_lengths.py CTAGS ROOT    CTAGS: Universal Ctags, which knows where a function ends

Prints what is longer as file:line: sentence and ends with 1.
"""
import re
import subprocess
import sys
from pathlib import Path

most_lines = 60
tops = ("scenes", "renderer", "reference", "reports", "harness")


def functions(ctags, root, files):
    """Path, line, name and number of lines of each."""
    command = [ctags, "--language-force=C++", "--c++-kinds=f", "--fields=e", "--excmd=number", "-L", "-", "-f", "-"]
    tags = subprocess.run(command, input="\n".join(files), cwd=root, capture_output=True, text=True, check=True).stdout
    for name, path, line, end in re.findall(r'^([^!\t][^\t]*)\t([^\t]+)\t(\d+);"\tend:(\d+)$', tags, re.MULTILINE):
        yield path, int(line), name, int(end) - int(line) + 1


def main(ctags, root):
    paths = [p.relative_to(root).as_posix() for top in tops for end in ("*.h", "*.cpp") for p in (root / top).rglob(end)]
    files = sorted(path for path in paths if not path.startswith("harness/setup/"))
    found = list(functions(ctags, root, files))
    problems = [f"{path}:{line}: {name} has {lines} lines, more than {most_lines}"
                for path, line, name, lines in found if lines > most_lines]
    if not found:
        problems = ["ctags found no functions"]
    print("\n".join(problems) or f"{len(found)} functions in {len(files)} files")
    return 1 if problems else 0


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    sys.exit(main(sys.argv[1], Path(sys.argv[2]).resolve()))
