"""The rooms' sources, and what Universal Ctags says of them, for the checks beside this file."""
import subprocess
import tempfile
from pathlib import Path

tops = ("scenes", "renderer", "reference", "reports", "harness")
not_ours = ("harness/setup/", "harness/courses/", "harness/suites/foreign/")


def room_sources(root, *ends):
    """Paths below root, in their order, without the checks' inputs and foreign programs, which lie in no room."""
    paths = [p.relative_to(root).as_posix() for top in tops for end in ends for p in (root / top).rglob("*" + end)]
    return sorted(path for path in paths if not path.startswith(not_ours))


def tags(ctags, root, files, kinds, fields):
    """What ctags prints: a line a name, `name<tab>path<tab>line;"<tab>fields`. It reads copies, because it does not know
    `namespace a::inline b`."""
    command = [ctags, "--language-force=C++", "--c++-kinds=" + kinds, "--fields=" + fields, "--excmd=number", "-L", "-",
               "-f", "-"]
    with tempfile.TemporaryDirectory() as folder:
        for file in files:
            copy = Path(folder) / file
            copy.parent.mkdir(parents=True, exist_ok=True)
            copy.write_text((root / file).read_text().replace("::inline ", "::"))
        return subprocess.run(command, input="\n".join(files), cwd=folder, capture_output=True, text=True, check=True).stdout


def tell(problems, summary):
    """The exit code."""
    print("\n".join(problems) or summary)
    return 1 if problems else 0
