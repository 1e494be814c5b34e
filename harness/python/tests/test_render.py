"""Renders equal the program's to the bit; callbacks, interrupts and bad requests."""
import gc
import json
import os
import pickle
import signal
import subprocess
import sys
import threading
import time
import warnings

import numpy as np
import pytest

import photonproof


@pytest.fixture
def cornell(scenes):
    return photonproof.load(scenes / "cornell" / "scene.xml", size=(48, 40))


@pytest.mark.parametrize("integrator, threads, options", [
    ("path", 1, {}), ("path", 3, {"sampler": "independent"}), ("photonmapper", 2, {"photons": 5000}),
    ("bdpt", 2, {}), ("path", 2, {"crop": (3, 5, 20, 11)}), ("path", 2, {"grid": 2}), ("path", 2, {"isa": "scalar"}),
    ("photonmapper", 2, {"indirect": "map"}), ("photonmapper", 1, {"view": "caustics"}),
    ("path", 2, {"target_error": 0.2, "spp": None}), ("path", 2, {"no_skip": ("all",)})])
def test_a_render_has_the_bits_of_the_programs_file(cornell, scenes, program, tmp_path, integrator, threads, options):
    options = {"spp": 16, **options}
    words = [word for name, value in options.items() if value is not None
             for word in ["--" + name.replace("_", "-"), *map(str, value if isinstance(value, tuple) else [value])]]
    program("render", scenes / "cornell" / "scene.xml", "--size", "48x40", "--integrator", integrator,
            "--seed", 5, "--threads", 2, *words, "-o", "image.exr", "--quiet", folder=tmp_path)
    rendered = cornell.render(integrator, seed=5, threads=threads, **options)
    stored = photonproof.read(tmp_path / "image.exr")
    if "crop" in options:  # the file's image is black around the crop
        x, y, width, height = options["crop"]
        np.testing.assert_array_equal(rendered.image, stored.image[y:y + height, x:x + width])
        return
    np.testing.assert_array_equal(rendered.image, stored.image)
    np.testing.assert_array_equal(rendered.variance, stored.variance)
    stats = json.loads((tmp_path / "image.stats.json").read_text())
    stats["plan"]["skips"] = stats["plan"]["skips"] or {}  # null in the file
    for key in ("engine", "version", "width", "height", "seed", "counts", "skipped", "choices", "losses", "cannot_find",
                "plan", "interrupted"):
        assert rendered.stats[key] == stats[key], key
    rendered.save(tmp_path / "again.exr")
    again = photonproof.read(tmp_path / "again.exr")
    np.testing.assert_array_equal(again.image, stored.image)
    np.testing.assert_array_equal(again.variance, stored.variance)
    stored.metadata.pop("photonproof:command")
    assert again.metadata == stored.metadata


def test_a_render_unpacks_and_shares_the_renderers_memory(cornell):
    image, variance, stats = cornell.render("path", spp=4)
    assert image.shape == variance.shape == (40, 48, 3) and image.dtype == np.float32
    assert not image.flags.owndata and image.flags.writeable and stats["counts"]["samples_per_pixel"] == 4
    kept = image.copy()
    del variance, stats
    gc.collect()
    np.testing.assert_array_equal(image, kept)  # the memory lives as long as the array
    assert isinstance(image, photonproof.Image)


def test_a_notebook_shows_a_render_as_the_programs_png(cornell, scenes, program, tmp_path):
    rendered = cornell.render("path", spp=4, seed=2)
    for stops in (0, 1.5):
        program("render", scenes / "cornell" / "scene.xml", "--size", "48x40", "--integrator", "path", "--spp", 4,
                "--seed", 2, "-o", "image.png", "--exposure", stops, "--quiet", folder=tmp_path)
        assert rendered.image.exposed(stops)._repr_png_() == (tmp_path / "image.png").read_bytes()
    assert rendered._repr_png_().startswith(b"\x89PNG")
    assert rendered.image[:, :, 0]._repr_png_() is None


def test_progress_comes_in_the_callers_thread_and_can_end_the_render(cornell):
    seen = []

    def progress(fraction, phase):
        seen.append((fraction, phase, threading.get_ident()))
        return len(seen) < 3

    rendered = cornell.render("path", seconds=30, progress=progress)
    assert rendered.stats["interrupted"] and len(seen) >= 3
    assert {ident for _, _, ident in seen} == {threading.get_ident()}
    assert all(0 <= fraction <= 1 and isinstance(phase, str) for fraction, phase, _ in seen)
    assert np.isfinite(rendered.image).all() and rendered.image.max() > 0


def test_an_error_in_progress_ends_the_render_and_leaves_it(cornell):
    def progress(fraction, phase):
        raise KeyError("mine")

    began = time.monotonic()
    with pytest.raises(KeyError, match="mine"):
        cornell.render("path", seconds=60, progress=progress)
    assert time.monotonic() - began < 30


@pytest.mark.parametrize("progress", ["lambda fraction, phase: None", "None"])
def test_ctrl_c_ends_a_render(scenes, progress):
    code = ("import photonproof, sys\n"
            f"scene = photonproof.load({str(scenes / 'cornell' / 'scene.xml')!r})\n"
            "print('goes', flush=True)\n"
            "try:\n"
            f"    scene.render('path', seconds=300, progress={progress})\n"
            "except KeyboardInterrupt:\n"
            "    print('interrupted'); sys.exit(7)\n")
    child = subprocess.Popen([sys.executable, "-c", code], stdout=subprocess.PIPE, text=True)
    assert child.stdout.readline() == "goes\n"
    time.sleep(1)  # into the render
    child.send_signal(signal.SIGINT)
    out, _ = child.communicate(timeout=120)
    assert child.returncode == 7 and out.endswith("interrupted\n")


def test_other_threads_run_during_a_render(cornell):
    counted, stop = [0], threading.Event()

    def count():
        while not stop.is_set():
            counted[0] += 1
            time.sleep(0.001)

    other = threading.Thread(target=count)
    other.start()
    cornell.render("path", seconds=1)
    stop.set()
    other.join()
    assert counted[0] > 20


def test_renders_at_the_same_time_have_the_bits_of_one(cornell):
    alone = cornell.render("photonmapper", spp=16).image
    images = [None] * 4

    def render(i):
        images[i] = cornell.render("photonmapper", spp=16).image

    threads = [threading.Thread(target=render, args=(i,)) for i in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    for image in images:
        np.testing.assert_array_equal(image, alone)


def test_a_scenes_error_is_the_programs_with_its_place(scenes, program, tmp_path):
    text = (scenes / "cornell" / "scene.xml").read_text().replace('type="path"', 'type="path">\n  <oops/', 1)
    bad = tmp_path / "bad.xml"
    bad.write_text(text)
    with pytest.raises(photonproof.InputError) as caught:
        photonproof.load(bad)
    error = caught.value
    assert isinstance(error, ValueError) and error.line > 0 and error.column > 0
    assert error.place == f"{bad}:{error.line}:{error.column}"
    printed = program("render", bad, "-o", tmp_path / "x.exr", code=2).stderr
    assert printed.splitlines()[0] == str(error).splitlines()[0] == f"{error.place}: error: {error.message}"
    copy = pickle.loads(pickle.dumps(error))
    assert (str(copy), copy.place, copy.line) == (str(error), error.place, error.line)


@pytest.mark.parametrize("options, place", [
    ({"spp": 0}, "spp"), ({"spp": -1}, "spp"), ({"spp": 2**40}, "spp"), ({"photons": 0}, "photons"),
    ({"seconds": float("nan")}, "seconds"), ({"seconds": -1.0}, "seconds"), ({"target_error": 0.0}, "target_error"),
    ({"threads": -1}, "threads"), ({"threads": 10**6}, "threads"), ({"grid": -1}, "grid"),
    ({"spp": 4, "seconds": 1.0}, "seconds"), ({"seconds": 1.0, "target_error": 0.1}, "target_error"),
    ({"spp": 4, "target_error": 0.1}, "target_error"),
    ({"sampler": "halton"}, "sampler"), ({"view": "nothing"}, "--view"), ({"isa": "v9"}, "--isa"),
    ({"indirect": "magic"}, "indirect"), ({"crop": (0, 0, 500, 1)}, "--crop"), ({"crop": (-1, 0, 5, 5)}, "--crop"),
    ({"no_skip": ["nothing"]}, "--no-skip"), ({"photons": 100}, "--photons"), ({"integrator": "vcm"}, "--integrator")])
def test_a_request_that_cannot_be_rendered_is_one_error(cornell, options, place):
    with pytest.raises(photonproof.InputError) as caught:
        cornell.render(**{"integrator": "path", **options})
    assert caught.value.place == place, str(caught.value)


@pytest.mark.parametrize("options", [{"spp": "many"}, {"seed": -1}, {"seed": 2**64}, {"crop": (1, 2)}, {"spp": 1.5}])
def test_an_argument_of_another_type_is_a_type_error(cornell, options):
    with pytest.raises(TypeError):
        cornell.render("path", **options)


@pytest.mark.parametrize("size", [(0, 4), (4, -1), (2**20, 2**20)])
def test_a_size_that_is_none_is_an_error(scenes, size):
    with pytest.raises(photonproof.InputError, match="size"):
        photonproof.load(scenes / "cornell" / "scene.xml", size=size)


def test_unused_definitions_and_missing_files_are_errors(scenes, tmp_path):
    with pytest.raises(photonproof.InputError, match="nowhere"):
        photonproof.load(scenes / "cornell" / "scene.xml", defines={"nowhere": 3})
    with pytest.raises(photonproof.InputError, match="none.xml"):
        photonproof.load(tmp_path / "none.xml")


def test_a_warning_of_the_program_is_a_render_warning(scenes, program, tmp_path):
    ball = scenes / "ball-lens" / "scene.xml"
    printed = program("render", ball, "--size", "8x8", "--spp", 1, "-o", tmp_path / "x.exr").stderr
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        photonproof.load(ball, size=(8, 8)).render(spp=1)
    assert caught and all(issubclass(warning.category, photonproof.RenderWarning) for warning in caught)
    for warning in caught:
        assert os.path.basename(warning.filename) == "test_render.py"
        assert str(warning.message).replace(": ", ": warning: ", 1) in printed


def test_definitions_sensors_and_lenient_reading_are_the_programs(scenes, program, tmp_path):
    text = (scenes / "cornell" / "scene.xml").read_text()
    scene = tmp_path / "scene.xml"
    scene.write_text(text)
    assert photonproof.load(scene, defines={"size": 24}).width == 24
    with pytest.raises(photonproof.InputError, match="sensor"):
        photonproof.load(scene, sensor=3)
    scene.write_text(text.replace("<bsdf", '<shape type="teapot"/><bsdf', 1))
    with pytest.raises(photonproof.InputError, match="teapot"):
        photonproof.load(scene)
    [note] = photonproof.load(scene, lenient=True).notes
    printed = program("render", scene, "--lenient", "--size", "8x8", "--spp", 1, "-o", tmp_path / "x.exr").stderr
    assert "teapot" in note and note.replace(": ", ": warning: ", 1) in printed


def test_files_outside_the_scenes_folder_and_mitsubas_errors_are_read_on_request(scenes, tmp_path):
    (tmp_path / "inside").mkdir()
    (tmp_path / "part.xml").write_text('<scene version="3.0.0"></scene>')
    scene = tmp_path / "inside" / "scene.xml"
    text = (scenes / "cornell" / "scene.xml").read_text()
    scene.write_text(text.replace("<bsdf", '<include filename="../part.xml"/><bsdf', 1))
    with pytest.raises(photonproof.InputError, match="outside"):
        photonproof.load(scene)
    assert photonproof.load(scene, allow_outside=True, size=(4, 4)).width == 4
    scene = photonproof.load(scenes / "cornell" / "scene.xml", as_mitsuba=True, size=(8, 8))
    with pytest.warns(photonproof.RenderWarning, match="follows Mitsuba"):
        faithful = scene.render(spp=1)
    assert faithful.metadata["photonproof:as_mitsuba"] == "3.9.1"


def test_a_scene_tells_its_facts(cornell, scenes):
    assert (cornell.width, cornell.height, cornell.integrator) == (48, 40, "path")
    assert cornell.files == [str(scenes / "cornell" / "scene.xml")] and cornell.notes == [] and cornell.spp > 0
    assert "48x40" in repr(cornell)
