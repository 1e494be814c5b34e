"""Agreement and gates equal the program's to the bit, pass right images and fail wrong ones."""
import json

import numpy as np
import pytest

import photonproof


@pytest.fixture(scope="module")
def cornell(scenes):
    return photonproof.load(scenes / "cornell" / "scene.xml", size=(32, 32))


@pytest.fixture(scope="module")
def renders(cornell):
    return [cornell.render("path", spp=64, seed=seed, sampler="independent") for seed in range(8)]


@pytest.mark.parametrize("factor", [1, 1.2])
def test_agreement_of_two_renders_is_the_programs(renders, program_json, tmp_path, factor):
    a, b = renders[0], renders[1]
    b = photonproof.Rendering(b.image * np.float32(factor), b.variance * np.float32(factor**2), {}, b.metadata)
    a.save(tmp_path / "a.exr")
    b.save(tmp_path / "b.exr")
    expected = program_json("compare", tmp_path / "a.exr", tmp_path / "b.exr", "--agreement",
                            code=0 if factor == 1 else 2)["agreement"]
    found = photonproof.agreement(a, b)
    assert bool(found) == expected["pass"] == (factor == 1)
    assert found.would_see == expected["would_see"]
    for part in ("pixels", "blocks", "whole"):
        assert found.parts[part] == expected[part]
    pairs = photonproof.agreement((a.image, a.variance), (b.image, b.variance))
    assert pairs.parts == found.parts


def test_images_that_share_photons_are_judged_as_the_program_does(cornell, program_json, tmp_path):
    a, b = (cornell.render("photonmapper", indirect="map", spp=64, seed=seed) for seed in (1, 2))
    a.save(tmp_path / "a.exr")
    b.save(tmp_path / "b.exr")
    expected = program_json("compare", tmp_path / "a.exr", tmp_path / "b.exr", "--agreement")["agreement"]
    found = photonproof.agreement(a, b)
    assert (found.verdict == "inconclusive") == expected["inconclusive"]
    for part in ("pixels", "blocks", "whole"):
        assert found.parts[part] == expected[part]


def test_lists_of_images_agree_or_not(renders):
    images = [rendered.image for rendered in renders]
    right = photonproof.agreement(images[:4], images[4:])
    assert right.verdict == "pass" and 0 < right.would_see < 0.2
    wrong = photonproof.agreement(images[:4], [image * np.float32(1.15) for image in images[4:]])
    assert wrong.verdict == "fail" and not wrong and "%" in wrong.sentence
    stacked = photonproof.agreement(np.stack(images[:4]), np.stack(images[4:]))
    assert stacked == right
    mixed = photonproof.agreement(images[:4], renders[5])
    assert mixed.verdict == "pass"


def test_the_mean_of_images_is_numpys(renders):
    images = np.stack([rendered.image for rendered in renders]).astype(np.float64)
    mean = photonproof.mean([rendered.image for rendered in renders])
    np.testing.assert_allclose(mean.image, images.mean(axis=0), rtol=1e-6)
    np.testing.assert_allclose(mean.variance, images.var(axis=0, ddof=1) / len(images), rtol=1e-4, atol=1e-12)


def test_a_gates_verdict_is_the_programs(scenes, program, tmp_path):
    (tmp_path / "gates.toml").write_text(f"""
name = "gates"
title = "Gates"
[[scene]]
name = "cornell"
path = "{scenes / 'cornell' / 'scene.xml'}"
width = 64
height = 64
[[gate]]
name = "agreement"
scene = "cornell"
engine = "path"
budget = "spp=16"
metric = "agreement"
bound = 0.02
[[gate]]
name = "ssim"
scene = "cornell"
engine = "path"
budget = "spp=16"
metric = "ssim"
bound = 0.7
""")
    program("gate", "gates.toml", "-o", "out", "--fresh", "--no-report", folder=tmp_path)
    record = photonproof.Record(tmp_path / "out")
    cells = {}
    for file in (tmp_path / "out" / "cells").glob("*/cell.json"):
        seed = json.loads(file.read_text())["result"]["cell"]["seed"]
        cells[seed] = photonproof.read(file.with_name("image.exr")).image
    images = [image for _, image in sorted(cells.items())]
    reference = scenes / "cornell" / "reference-64x64.exr"
    for row in record.gates():
        count = row["samples"] // 16
        found = photonproof.gate(images[:count], reference, row["bound"], row["metric"], alpha=row["alpha"], looks=4,
                                 spp=16)
        assert found.verdict == row["verdict"] == "pass"
        assert found.observed == row["observed"]["value"]
        assert list(found.interval) == row["observed"]["interval"]
        assert found.would_see == row.get("would_see") and found.would_see_in_a_block == row.get("would_see_in_a_block")
    assert set(record.gates_to_pandas().verdict) == {"pass"}


def test_a_gate_fails_and_names_the_place(renders):
    reference = [rendered.image for rendered in renders[:4]]
    images = [rendered.image.copy() for rendered in renders[4:]]
    for image in images:
        image[8:24, 8:24] *= 1.5
    found = photonproof.gate(images, reference, 0.05)
    assert found.verdict == "fail" and found.tiles and str(found).startswith("fail: ")
    worst = found.tiles[0]
    assert 0 <= worst.x < 32 and worst.sentence
    assert photonproof.gate(images, reference, 0.001, "ssim", looks=1).verdict == "pass"
    assert photonproof.gate(images, reference, 0.9999, "ssim").verdict == "fail"


def test_samples_allow_for_one_that_falls_beyond_an_edge():
    """Of 16 stratified samples of a pixel on an edge from 0 to 1, one more or less falls on each side: 1/16 of 1."""
    rng = np.random.default_rng(1)
    reference = np.zeros((16, 16, 3), np.float32)
    reference[:, 8:] = 1
    images = [reference + rng.normal(0, 8e-3, reference.shape).astype(np.float32) for _ in range(8)]
    for image in images:
        image[4, 8] -= 0.03
    stated = reference, np.full_like(reference, 1e-8)
    assert photonproof.gate(images, stated, 0.5).verdict == "fail"
    assert photonproof.gate(images, stated, 0.5, spp=16).verdict == "pass"


def test_a_reference_of_few_images_is_worth_less_than_a_stated_one(renders):
    few = [rendered.image for rendered in renders[:3]]
    images = [rendered.image for rendered in renders[3:]]
    mean = photonproof.mean(few)
    of_images = photonproof.gate(images, few, 0.5)
    stated = photonproof.gate(images, (mean.image, mean.variance), 0.5)
    assert of_images.would_see > stated.would_see


def test_the_exposure_counts_for_displayed_metrics(renders):
    reference, images = renders[0].image, [rendered.image for rendered in renders[1:]]
    for exposure in (0, 2):
        found = photonproof.gate(images, reference, 0.1, "ssim", exposure=exposure)
        values = [photonproof.ssim(reference, image, exposure=exposure) for image in images]
        assert found.observed == pytest.approx(np.mean(values), rel=1e-12)


def test_a_gate_says_inconclusive_where_images_are_too_few(renders):
    reference = [rendered.image for rendered in renders[:4]]
    found = photonproof.gate([rendered.image for rendered in renders[4:]], reference, 1e-5)
    assert found.verdict == "inconclusive" and not found


def test_a_golden_image_of_unknown_noise(renders):
    found = photonproof.gate([rendered.image for rendered in renders[1:]], np.array(renders[0].image), 0.5)
    assert found.verdict in ("pass", "inconclusive")
    copies = photonproof.gate([renders[1].image] * 4, renders[0].image, 0.5)
    assert copies.verdict == "fail" and "identical" in copies.sentence
    biased = photonproof.gate([renders[1].image] * 4, renders[0].image, 0.5, unbiased=False)
    assert biased.verdict == "inconclusive"


@pytest.mark.parametrize("call, says", [
    (lambda r: photonproof.agreement(r[0].image, r[1].image), "neither a Rendering"),
    (lambda r: photonproof.agreement([r[0].image], [r[1].image] * 3), "two images or more"),
    (lambda r: photonproof.agreement(r[0], [r[1].image] * 2), "3 images or more"),
    (lambda r: photonproof.agreement(r[0], r[1], alpha=0), "alpha"),
    (lambda r: photonproof.agreement(photonproof.Rendering(r[0].image, None), r[1]), "no variance"),
    (lambda r: photonproof.agreement((r[0].image, -r[0].variance - 1), r[1]), "negative or not finite"),
    (lambda r: photonproof.agreement((r[0].image, r[0].variance[:9]), r[1]), "another size"),
    (lambda r: photonproof.agreement(r[0], [r[1].image[:9]] * 3), "size|pixels"),
    (lambda r: photonproof.gate([r[1].image] * 2, r[0], 0.1), "3 images or more"),
    (lambda r: photonproof.gate([r[1].image * np.float32(np.nan)] * 3, r[0], 0.1), "NaN"),
    (lambda r: photonproof.gate([x.image for x in r[1:]], r[0], 0.1, "flop"), "flip"),
    (lambda r: photonproof.gate([x.image for x in r[1:]], r[0], 0.1, looks=99), "looks"),
    (lambda r: photonproof.mean([r[0].image, r[1].image[:5]]), "size|pixels")])
def test_bad_input_is_one_clear_error(renders, call, says):
    with pytest.raises(photonproof.InputError, match=says):
        call(renders)
