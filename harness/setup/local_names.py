#!/usr/bin/env python3
"""Holds names that are local to a source (unnamed namespaces) apart from those of other sources of its room, which a
release build compiles together (PHOTONPROOF_UNITY): two functions of one name would silently overload each other.

  local_names.py CTAGS ROOT    CTAGS: Universal Ctags

Prints what two sources have as file:line: sentence and ends with 1.
"""
import re
import subprocess
import sys
from pathlib import Path

tops = ("scenes", "renderer", "reference", "reports", "harness")
alone = re.compile(r"(_(test|bench|fuzz)\.cpp|/test_[^/]*)$")


def local_names(ctags, root, files):
    """Path, line and name of each."""
    command = [ctags, "--language-force=C++", "--c++-kinds=fvsgectud", "--fields=sn", "--excmd=number", "-L", "-", "-f", "-"]
    tags = subprocess.run(command, input="\n".join(files), cwd=root, capture_output=True, text=True, check=True).stdout
    scope = r"namespace:(?:\w+::)*__anon[0-9a-f]+"
    for name, path, line in re.findall(rf'^([^!\t][^\t]*)\t([^\t]+)\t(\d+);".*\t{scope}$', tags, re.MULTILINE):
        yield path, int(line), name


def main(ctags, root):
    paths = [p.relative_to(root).as_posix() for top in tops for p in (root / top).rglob("*.cpp")]
    files = sorted(path for path in paths if not path.startswith("harness/setup/") and not alone.search(path))
    names, problems = {}, []
    for path, line, name in local_names(ctags, root, files):
        room = path.rpartition("/")[0]
        first = names.setdefault((room, name), path)
        if first != path:
            problems.append(f"{path}:{line}: {name} is also in {first}")
    if not names:
        problems = ["ctags found no local names"]
    print("\n".join(problems) or f"{len(names)} local names in {len(files)} files")
    return 1 if problems else 0


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    sys.exit(main(sys.argv[1], Path(sys.argv[2]).resolve()))
