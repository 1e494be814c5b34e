"""The program in the package, its data, its types, and images of Mitsuba."""
import subprocess
import sys

import numpy as np
import pytest

import photonproof


def test_the_program_runs_as_a_module():
    done = subprocess.run([sys.executable, "-m", "photonproof", "--version"], capture_output=True, text=True)
    assert done.returncode == 0 and photonproof.version() in done.stdout
    failed = subprocess.run([sys.executable, "-m", "photonproof", "nothing"], capture_output=True, text=True)
    assert failed.returncode == 2


def test_the_program_finds_its_scenes(program):
    assert "cornell" in program("scenes").stdout


def test_every_public_name_is_documented():
    for name in photonproof.__all__:
        assert getattr(photonproof, name).__doc__, name


def test_types_are_complete(tmp_path):
    pytest.importorskip("mypy")
    user = tmp_path / "user.py"
    user.write_text("import photonproof\n"
                    "image, variance, stats = photonproof.load('x.xml').render('path', spp=4)\n"
                    "value: float = photonproof.ssim(image, image)\n"
                    "table: 'dict[str, float | None]' = photonproof.compare(image, image)\n"
                    "ok: bool = bool(photonproof.gate([image], image, 0.1))\n")
    done = subprocess.run([sys.executable, "-m", "mypy", "--strict", "--disable-error-code", "import-untyped",
                           "--cache-dir", str(tmp_path / "cache"), "--package", "photonproof"],
                          capture_output=True, text=True)
    assert done.returncode == 0, done.stdout
    done = subprocess.run([sys.executable, "-m", "mypy", "--strict", "--cache-dir", str(tmp_path / "cache"), user],
                          capture_output=True, text=True)
    assert done.returncode == 0, done.stdout


def test_a_bitmap_of_mitsuba_is_an_image(pair):
    mitsuba = pytest.importorskip("mitsuba")
    mitsuba.set_variant("scalar_rgb")
    bitmaps = [mitsuba.Bitmap(np.ascontiguousarray(image[:20, :20])) for image in pair]
    arrays = [np.ascontiguousarray(image[:20, :20]) for image in pair]
    assert photonproof.compare(*bitmaps) == photonproof.compare(*arrays)
    tensors = [mitsuba.TensorXf(image) for image in arrays]
    assert photonproof.compare(*tensors) == photonproof.compare(*arrays)
