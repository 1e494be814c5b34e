#!/usr/bin/env python3
"""Puts the libraries that a wheel needs into it, by auditwheel.

  repair_wheel.py repair [OPTION...] WHEEL     auditwheel's own options
  repair_wheel.py sizes WHEEL                  prints the sizes of the wheel's parts

auditwheel takes it for granted that a desktop has libX11, libexpat and some others. A server has none of them, so they are
put into the wheel, too. Only the C library and GCC's libraries, which NumPy's wheel also needs, stay outside.
"""
import json
import sys
import tempfile
import zipfile
from collections import Counter
from pathlib import Path

outside = {"libatomic.so.1", "libgcc_s.so.1", "libstdc++.so.6", "libm.so.6", "libmvec.so.1", "libanl.so.1", "libdl.so.2",
           "librt.so.1", "libc.so.6", "libutil.so.1", "libpthread.so.0", "libresolv.so.2"}


def repair():
    """The exit code of auditwheel with the shorter list of libraries outside."""
    from auditwheel import main, policy
    from auditwheel.libc import Libc

    policies = json.loads(policy._POLICY_JSON_MAP[Libc.GLIBC].read_text())
    for row in policies:
        row["lib_whitelist"] = [library for library in row["lib_whitelist"] if library in outside]
    with tempfile.TemporaryDirectory() as folder:
        shorter = Path(folder) / "policy.json"
        shorter.write_text(json.dumps(policies))
        policy._POLICY_JSON_MAP[Libc.GLIBC] = shorter
        return main.main()


def sizes(wheel):
    """Prints compressed and unpacked megabytes: the libraries of others, and the rest."""
    packed, unpacked = Counter(), Counter()
    with zipfile.ZipFile(wheel) as archive:
        for file in archive.infolist():
            part = "libraries" if file.filename.startswith("photonproof.libs/") else "photonproof"
            packed[part] += file.compress_size
            unpacked[part] += file.file_size
    print(wheel)
    for part in sorted(packed):
        print(f"  {part:<12} {packed[part] / 1e6:6.1f} MB in the wheel, {unpacked[part] / 1e6:6.1f} MB installed")
    return 0


if __name__ == "__main__":
    if len(sys.argv) < 3 or sys.argv[1] not in ("repair", "sizes"):
        sys.exit(__doc__)
    sys.exit(repair() if sys.argv[1] == "repair" else sizes(sys.argv[2]))
