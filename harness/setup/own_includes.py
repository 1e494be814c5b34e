#!/usr/bin/env python3
"""Every source includes the header of ours that declares what it uses, itself or by another header.

A release build compiles sources of a room together, where one finds what another included (PHOTONPROOF_UNITY).
    harness/setup/own_includes.py CTAGS ROOT    CTAGS: Universal Ctags

Looks at types and free functions that one header alone declares. Prints file:line of each whose header is missing;
exit code 1 if there is any.
"""
import functools
import re
import sys
from pathlib import Path

from source_tags import room_sources, tags
from std_includes import NO_CODE, Sources, blank

# Keywords before a use of a name, not before its declaration, as in "auto name" or "class Name".
keywords = {"return", "else", "case", "throw", "new", "const", "constexpr", "static", "inline", "friend", "virtual",
            "explicit", "operator", "mutable", "in", "co_return", "delete", "sizeof", "extern", "thread_local", "namespace"}


def declarations(ctags, root, files):
    """Path, name and kind of what is declared in namespaces: p prototype, f function, others types."""
    found = tags(ctags, root, files, kinds="pfscgutm", fields="ks")
    for name, path, kind, scope in re.findall(r'^([^!\t][^\t]*)\t([^\t]+)\t\d+;"\t(\w)(?:\t(.*))?$', found, re.MULTILINE):
        yield path, name, kind, scope


@functools.lru_cache(maxsize=None)
def forward(path):
    return set(re.findall(r"^(?:struct|class) (\w+);", path.read_text(), re.MULTILINE))


def main(ctags, root):
    sources = Sources(root)
    files = room_sources(root, ".h", ".cpp")
    owners, local, functions, members = {}, {}, set(), set()
    for path, name, kind, scope in declarations(ctags, root, files):
        local.setdefault(path, set()).add(name)
        if kind == "m" or not scope.startswith("namespace:") or "__anon" in scope:
            members.add(name)
        elif path.endswith(".h"):
            owners.setdefault(name, set()).add(path)
            if kind in "pf":
                functions.add(name)
    single = {name: next(iter(paths)) for name, paths in owners.items() if len(paths) == 1 and name not in members}
    used = re.compile(r"(?<![\w.:>])(?:photonproof::)?([A-Za-z_]\w*)(\s*[(<]?)")
    problems = []
    for path in files:
        reached = sources.files(path)
        code = re.sub(r"\bTEST\w*\(\w+", "", NO_CODE.sub(blank, (root / path).read_text()))  # a suite's name
        told = {name for word, name in re.findall(r"\b(\w+)[>&*]*\s+[&*]*(?=(\w+))", code) if word not in keywords}
        told |= local.get(path, set()).union(*(forward(root / other) for other in reached))
        for number, line in enumerate(code.splitlines(), 1):
            for name, after in used.findall(line):
                header = single.get(name)
                if header is None or name in told or header in reached or (name in functions and "(" not in after):
                    continue
                told.add(name)
                problems.append(f"{path}:{number}: {name} needs #include \"{header}\"")
    print("\n".join(problems) or f"{len(single)} names in {len(files)} files")
    return 1 if problems or not single else 0


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    sys.exit(main(sys.argv[1], Path(sys.argv[2]).resolve()))
