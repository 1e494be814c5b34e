"""The command line program that the wheel brings."""
from __future__ import annotations

import os
import sys
from typing import NoReturn

from ._errors import refusal


def path() -> str:
    """The program's file. Raises InputError where the package was built without it."""
    file = os.path.join(os.path.dirname(os.path.abspath(__file__)), "bin", "photonproof")
    if not os.access(file, os.X_OK):
        raise refusal(file, "is not here: this package was built without the program")
    return file


def data() -> str:
    """The folder with ``scenes``, suites and templates, in the layout of the source tree."""
    return os.path.join(os.path.dirname(os.path.abspath(__file__)), "share", "photonproof")


def main() -> NoReturn:
    """Becomes the program, with the arguments of this process."""
    file = path()
    os.execv(file, [file, *sys.argv[1:]])
