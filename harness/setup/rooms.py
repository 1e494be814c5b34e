#!/usr/bin/env python3
"""Holds every source to its room: what it may include, and how large rooms and files may grow; and every test to a list.

  rooms.py ROOMS ROOT    ROOMS: as CMake writes it into the build folder, a line a room, "folder | may include"

A room's names are in an inline namespace of its own, so that two rooms may have one name without being linked as one.
A room's files may include the rooms it links and those that they may. Tests, benches and what only they use (test_*) may
include anything; a CMakeLists.txt has to name them, or they would never run. Tests run beside each other, so each takes its
files from a folder of its own: FolderTest or ScratchFolder. Prints what is wrong as file:line: sentence and ends with 1.
"""
import re
import sys
from pathlib import Path

from source_tags import room_sources

most_files, most_lines = 45, 500
# These name their files by process or by what fails.
makers_of_folders = {"scenes/files/test_folder.h", "scenes/base/test_fuzz.h", "scenes/base/test_corpus.h",
                     "scenes/records/test_record.h", "harness/sandbox/escapes_test.cpp"}


def read_rooms(text):
    may = {}
    for line in filter(None, text.splitlines()):
        room, others = (part.strip() for part in line.split("|"))
        may[room] = others.split()
    return may


def reachable(may, room, found):
    for other in may[room]:
        if other not in found:
            found.add(other)
            reachable(may, other, found)
    return found


def main(rooms_file, root):
    may = read_rooms(Path(rooms_file).read_text())
    allowed = {room: reachable(may, room, set()) | {room} for room in may}
    problems = [f"{room}: may include itself through {', '.join(may[room])}" for room in may
                if any(room in allowed[other] for other in may[room])]
    namespaces = {room.replace("/", "_") for room in may}
    built = " ".join(list_file.read_text() for list_file in root.glob("*/CMakeLists.txt"))
    count = dict.fromkeys(may, 0)
    for file in room_sources(root, ".h", ".cpp"):
        path, room = root / file, file.rpartition("/")[0]
        if room not in may:
            problems.append(f"{file}:1: lies in no room")
            continue
        count[room] += 1
        lines = path.read_text().splitlines()
        if len(lines) > most_lines:
            problems.append(f"{file}:{most_lines}: has {len(lines)} lines, more than {most_lines}")
        for number, line in enumerate(lines, 1):
            named = re.match(r"namespace photonproof(?:::reports)?(?:::inline (\w+))?(?:::[A-Z_]+)? \{", line)
            if named and named[1] not in namespaces:
                problems.append(f"{file}:{number}: names of {room} belong into photonproof::inline {room.replace('/', '_')}")
        if re.search(r"_(test|bench|fuzz)\.cpp$|^test_", path.name) and path.name != "verb_bench.cpp":
            if path.suffix == ".cpp" and path.name not in built:
                problems.append(f"{file}:1: no CMakeLists.txt names it, so that it is never built")
            if file not in makers_of_folders:
                problems += [f"{file}:{number}: another test may use this folder; take FolderTest or ScratchFolder"
                             for number, line in enumerate(lines, 1)
                             if re.search(r"\bTempDir\(|temp_directory_path\(", line)]
            continue
        for number, line in enumerate(lines, 1):
            included = re.match(r'#include "([a-z_/0-9]+)/[^/"]+"', line)
            if included and included[1] in may and included[1] not in allowed[room]:
                problems.append(f"{file}:{number}: {room} may not include {included[1]}")
    problems += [f"{room}: has {files} sources, more than {most_files}"
                 for room, files in count.items() if files > most_files]
    print("\n".join(problems) or f"{len(may)} rooms, {sum(count.values())} files")
    return 1 if problems else 0


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    sys.exit(main(sys.argv[1], Path(sys.argv[2])))
