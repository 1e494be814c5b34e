"""Fixtures: the scenes, the program, and images to compare."""
import json
import os
import subprocess
from pathlib import Path

import numpy as np
import pytest

import photonproof

pytest_plugins = ["pytester"]


@pytest.fixture(scope="session")
def sources() -> Path:
    """The source tree; an installed package has the same layout in its data."""
    return Path(os.environ.get("PHOTONPROOF_SOURCES", photonproof.program.data()))


@pytest.fixture(scope="session")
def scenes(sources) -> Path:
    return sources / "scenes" / "library"


@pytest.fixture(scope="session")
def program():
    """Runs the command line program; returns the finished process."""
    def run(*arguments, folder=None, code=0):
        done = subprocess.run([photonproof.program.path(), *map(str, arguments)], capture_output=True, text=True,
                              cwd=folder)
        assert done.returncode == code, done.stderr + done.stdout
        return done
    return run


@pytest.fixture(scope="session")
def program_json(program):
    """The JSON that a verb prints with --json."""
    def run(*arguments, **options):
        return json.loads(program(*arguments, "--json", **options).stdout)
    return run


@pytest.fixture
def pair():
    """Two images of high dynamic range with noise, of no tile's size."""
    rng = np.random.default_rng(7)
    reference = rng.lognormal(-1, 1, (181, 203, 3)).astype(np.float32)
    return reference, (reference * rng.normal(1, 0.1, reference.shape)).astype(np.float32)
