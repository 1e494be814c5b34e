#!/usr/bin/env python3
"""Runs the commands of a page of the documentation and compares their output with the page's.

  docs_commands.py PROGRAM ROOT PAGE     PROGRAM: photonproof; ROOT: the sources; PAGE: a path below ROOT

A block ```console has commands, which begin with "$ " ("> " continues them), and their output. One bash session runs all
blocks of a page in an empty folder with copies of the scenes, suites and courses that they name. A number stands for any
number, a line "..." for any lines, and " ..." at the end of a line for the rest of it. <!-- as in PAGE --> above a block
says that PAGE runs it: the block's lines must be there, in this order. A block ```sh is not run; the line above it says
why: <!-- not run: REASON -->. A page with <!-- needs: bwrap --> is skipped (77) where that program does not work.
"""
import os
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

from source_tags import tell

skipped = 77
number = r"[-+−±]?(?:\d+(?:[.,]\d+)*|\.\d+)(?:e[-+]?\d+)?"
end_of_command = "<end of a command>"
sources = ("scenes/library", "scenes/showcase", "harness/ci", "harness/courses", "harness/init", "harness/suites")
needs = {"bwrap": ["bwrap", "--ro-bind", "/", "/", "true"], "povray": ["povray", "--version"],
         "pdflatex": ["pdflatex", "--version"]}


class Command:
    def __init__(self, line, text):
        self.line, self.text, self.output = line, text, []


class Elsewhere:
    """A page that runs a block's commands."""

    def __init__(self, page):
        self.page, self.lines = page, iter(page.read_text().split("\n"))

    def has_next(self, content):
        return content == "..." or content in self.lines


def commands_of(page, text, root):
    """The commands of all console blocks; a shell block without a reason is a problem."""
    commands, problems, fence, above, elsewhere = [], [], None, "", None
    for line, content in enumerate(text.split("\n"), 1):
        mark = re.match(r"\s*```(\w*)", content)
        if mark and fence is None:
            fence = mark[1]
            other = re.match(r"<!-- as in (\S+) -->", above)
            elsewhere = Elsewhere(root / other[1]) if other else None
            if fence in ("sh", "bash", "shell") and not re.match(r"<!-- not run: .+ -->", above):
                problems.append(f"{page}:{line}: a block that is not run needs a line <!-- not run: REASON --> above it")
        elif mark:
            fence = None
        elif fence == "console" and elsewhere:
            if not elsewhere.has_next(content):
                problems.append(f"{page}:{line}: {elsewhere.page.relative_to(root)} has no such line here")
        elif fence == "console":
            if content.startswith("$ "):
                commands.append(Command(line, content[2:]))
            elif content.startswith(">") and commands and not commands[-1].output:
                commands[-1].text += "\n" + content[2:]
            elif commands:
                commands[-1].output.append(content.rstrip())
            else:
                problems.append(f"{page}:{line}: a console block begins with '$ ' and a command")
        if content.strip():
            above = content.strip()
    return commands, problems


def pattern(line):
    rest = line.endswith(" ...")
    pieces = re.split(number, line[:-4] if rest else line)
    text = number.join(re.escape(piece) for piece in pieces)
    return re.compile(re.sub(r"(?:\\ )+", " +", text) + ("" if rest else r"\s*$"))


def matches(expected, printed):
    if not expected:
        return not printed
    if expected[0] == "...":
        return any(matches(expected[1:], printed[skip:]) for skip in range(len(printed) + 1))
    return bool(printed) and bool(pattern(expected[0]).match(printed[0])) and matches(expected[1:], printed[1:])


def sources_of(commands, root):
    """Folders to copy, since copying all would take longer than most pages. Suites name library scenes."""
    text = "".join(c.text for c in commands)
    named = {name for name in sources if name in text} | ({"scenes/library"} if "harness/" in text else set())
    return [name for name in sorted(named) if (root / name).is_dir()]


def outputs_of(commands, program, root):
    """The lines that each command prints, errors included."""
    with tempfile.TemporaryDirectory() as folder:
        programs, work = Path(folder) / "bin", Path(folder) / "work"
        programs.mkdir()
        work.mkdir()
        (programs / "photonproof").symlink_to(program)
        for name in sources_of(commands, root):
            shutil.copytree(root / name, work / name, symlinks=True)
        # In braces on one line, so that bash has read the whole command before it runs it.
        script = "".join(f"{c.text}\n{{ code=$?; printf '\\n%s\\n' '{end_of_command}'; (exit $code); }}\n" for c in commands)
        environment = dict(os.environ, PATH=f"{programs}:{os.environ['PATH']}", PHOTONPROOF_CACHE=f"{folder}/cache")
        (Path(folder) / "commands.sh").write_text(script)
        outcome = subprocess.run(["bash", "../commands.sh"], cwd=work, env=environment, stdin=subprocess.DEVNULL,
                                 stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, errors="replace")
    outputs = outcome.stdout.split(f"\n{end_of_command}\n")
    return [output.rstrip().split("\n") if output.strip() else [] for output in outputs]


def missing_program(text):
    for name in re.findall(r"<!-- needs: (\w+) -->", text):
        try:
            if subprocess.run(needs[name], capture_output=True).returncode != 0:
                return name
        except FileNotFoundError:
            return name
    return None


def main(program, root, page):
    text = (root / page).read_text()
    commands, problems = commands_of(page, text, root)
    if missing := missing_program(text):
        print(f"{page}: skipped, {missing} does not work here")
        return skipped
    for command, printed in zip(commands, outputs_of(commands, program, root)):
        if not matches(command.output, printed):
            problems.append(f"{page}:{command.line}: `{command.text}` prints something else:\n" + "\n".join(printed[:60]))
    return tell(problems, f"{page}: {len(commands)} commands print what the page has")


if __name__ == "__main__":
    if len(sys.argv) != 4:
        sys.exit(__doc__)
    sys.exit(main(Path(sys.argv[1]).resolve(), Path(sys.argv[2]).resolve(), sys.argv[3]))
