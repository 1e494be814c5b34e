#!/usr/bin/env python3
"""Puts the libraries that a wheel needs into it by auditwheel, with their licences.

  repair_wheel.py repair WHEEL FOLDER     writes the repaired wheel into FOLDER
  repair_wheel.py sizes WHEEL             prints the sizes of the wheel's parts

auditwheel takes it for granted that a desktop has libX11, libexpat and some others. A server has none of them, so they are
put into the wheel, too. Only the C library and GCC's libraries, which NumPy's wheel also needs, stay outside. The
licences are those of the Debian packages that the libraries come from.
"""
import json
import re
import shutil
import subprocess
import sys
import tempfile
import zipfile
from collections import Counter
from pathlib import Path

outside = {"libatomic.so.1", "libgcc_s.so.1", "libstdc++.so.6", "libm.so.6", "libmvec.so.1", "libanl.so.1", "libdl.so.2",
           "librt.so.1", "libc.so.6", "libutil.so.1", "libpthread.so.0", "libresolv.so.2"}
libraries = "photonproof.libs"


def package_of(library):
    """The Debian package with a library that auditwheel renamed: libpng16-0a0c6ccf.so.16.39.0 is libpng16.so.16.39.0."""
    name = re.sub(r"-[0-9a-f]{8}(?=\.so)", "", library)
    found = subprocess.run(["dpkg", "-S", f"*/{name}"], capture_output=True, text=True, check=True).stdout
    return found.split(":")[0]


def add_licences(wheel):
    """Adds the notice of each library to the wheel, as photonproof.libs/licences/PACKAGE."""
    from auditwheel.wheeltools import InWheel

    with InWheel(wheel, wheel):
        folder = Path(libraries) / "licences"
        folder.mkdir()
        for package in sorted({package_of(file.name) for file in Path(libraries).glob("*.so*")}):
            shutil.copyfile(f"/usr/share/doc/{package}/copyright", folder / package)


def repair(wheel, folder):
    """The exit code of auditwheel with the shorter list of libraries outside."""
    from auditwheel import main, policy
    from auditwheel.libc import Libc

    policies = json.loads(policy._POLICY_JSON_MAP[Libc.GLIBC].read_text())
    for row in policies:
        row["lib_whitelist"] = [library for library in row["lib_whitelist"] if library in outside]
    with tempfile.TemporaryDirectory() as temporary:
        shorter, repaired = Path(temporary) / "policy.json", Path(temporary) / "repaired"
        shorter.write_text(json.dumps(policies))
        policy._POLICY_JSON_MAP[Libc.GLIBC] = shorter
        sys.argv[1:] = ["repair", "-w", str(repaired), wheel]
        if code := main.main():
            return code
        [made] = repaired.glob("*.whl")
        add_licences(made)
        shutil.move(made, folder)
    return 0


def sizes(wheel):
    """Prints compressed and unpacked megabytes: the libraries of others, and the rest."""
    packed, unpacked = Counter(), Counter()
    with zipfile.ZipFile(wheel) as archive:
        for file in archive.infolist():
            part = "libraries" if file.filename.startswith(libraries) else "photonproof"
            packed[part] += file.compress_size
            unpacked[part] += file.file_size
    print(wheel)
    for part in sorted(packed):
        print(f"  {part:<12} {packed[part] / 1e6:6.1f} MB in the wheel, {unpacked[part] / 1e6:6.1f} MB installed")
    return 0


if __name__ == "__main__":
    if len(sys.argv) == 4 and sys.argv[1] == "repair":
        sys.exit(repair(sys.argv[2], sys.argv[3]))
    if len(sys.argv) == 3 and sys.argv[1] == "sizes":
        sys.exit(sizes(sys.argv[2]))
    sys.exit(__doc__)
