#!/usr/bin/env python3
"""Holds names that are local to a source (unnamed namespaces) apart from those of other sources of its room, which a
release build compiles together (PHOTONPROOF_UNITY): two functions of one name would silently overload each other.

  local_names.py CTAGS ROOT    CTAGS: Universal Ctags

Prints what two sources have as file:line: sentence and ends with 1.
"""
import re
import sys
from pathlib import Path

from source_tags import defined_twice, room_sources, tags, tell

alone = re.compile(r"(_(test|bench|fuzz)\.cpp|/test_[^/]*)$")


def local_names(ctags, root, files):
    """Path, line and name of each."""
    found = tags(ctags, root, files, kinds="fvsgectud", fields="sn")
    scope = r"namespace:(?:\w+::)*__anon[0-9a-f]+"
    for name, path, line in re.findall(rf'^([^!\t][^\t]*)\t([^\t]+)\t(\d+);".*\t{scope}$', found, re.MULTILINE):
        yield path, int(line), name


def main(ctags, root):
    files = [path for path in room_sources(root, ".cpp") if not alone.search(path)]
    found = list(local_names(ctags, root, files))
    problems = defined_twice(found, lambda path, name: (path.rpartition("/")[0], name))
    return tell(problems if found else ["ctags found no local names"], f"{len(found)} local names in {len(files)} files")


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    sys.exit(main(sys.argv[1], Path(sys.argv[2]).resolve()))
