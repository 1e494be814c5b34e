#!/usr/bin/env python3
"""Applies the diffs of a page of this folder to the sources, in their order.

  apply.py PAGE...            changes the sources
  apply.py --check PAGE...    only verifies that the diffs fit or are applied already; the sources stay as they are
  apply.py --reverse PAGE...  takes the changes back

The diffs of several pages are applied in turn. Prints the number of diffs of each page. Ends with 1 if one does not fit;
then nothing is changed.
"""
import os
import re
import subprocess
import sys
from pathlib import Path

root = Path(__file__).resolve().parents[2]
fence = re.compile(r"^```diff\n(.*?)^```$", re.MULTILINE | re.DOTALL)


def diffs_of(page):
    return fence.findall(page.read_text())


def apply(diffs, options, quiet=False):
    """Whether all diffs fit. One call of git takes all or nothing."""
    # No repository above the sources: git would leave out paths that are not below its working folder.
    environment = dict(os.environ, GIT_CEILING_DIRECTORIES=str(root.parent))
    return subprocess.run(["git", "apply", "--whitespace=error-all", *options, "-"], input="".join(diffs), text=True,
                          stderr=subprocess.DEVNULL if quiet else None, cwd=root, env=environment).returncode == 0


def main(arguments):
    options = [a for a in arguments if a.startswith("--")]
    pages = [Path(a) for a in arguments if not a.startswith("--")]
    if not pages or not set(options) <= {"--check", "--reverse"}:
        sys.exit(__doc__)
    diffs = [diff for page in pages for diff in diffs_of(page)]
    if options == ["--check"] and apply(diffs, ["--check", "--reverse"], quiet=True):
        print("the diffs are applied already")
        return 0
    if not apply(diffs, options):
        return 1
    for page in pages:
        print(f"{page.name}: {len(diffs_of(page))} diffs {'fit' if '--check' in options else 'applied'}")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
