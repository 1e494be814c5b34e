"""Metrics equal the program's to the bit; every dtype and layout; hostile arrays."""
import math

import numpy as np
import pytest

import photonproof


def program_values(comparison):
    return {metric["name"]: (metric["value"], metric["parameters"], metric.get("undefined"))
            for metric in comparison["metrics"]}


def assert_equal_to_program(comparison, from_program):
    values = program_values(from_program)
    assert list(comparison) == list(values)
    for name, value in comparison.items():
        expected, parameters, why = values[name]
        if value is not None and math.isinf(value):
            assert expected is None and why.startswith("infinite")
        else:
            assert value == expected, name  # JSON has every digit
        if value is None:
            assert comparison.undefined[name] == why
        assert comparison.parameters[name] == parameters


def write_pair(folder, pair):
    files = [folder / "reference.exr", folder / "test.exr"]
    for file, image in zip(files, pair):
        photonproof.write(file, image)
    return files


@pytest.mark.parametrize("words, options", [
    ([], {}),
    (["--exposure", 1.5], {"exposure": 1.5}),
    (["--metrics", "hdr_flip,differing,differing_pixels", "--more-than", 0.02, "--exposures", -2, 1, 4],
     {"metrics": ["hdr_flip", "differing", "differing_pixels"], "more_than": 0.02, "exposures": (-2, 1, 4)}),
    (["--region", 20, 30, 50, 40], {"region": (20, 30, 50, 40)}),
    (["--metrics", "ssim"], {"metrics": "ssim", "threads": 3})])
def test_values_are_the_programs_to_the_bit(pair, program_json, tmp_path, words, options):
    files = write_pair(tmp_path, pair)
    comparison = photonproof.compare(*pair, **options)
    assert_equal_to_program(comparison, program_json("compare", *files, *words))
    assert comparison == photonproof.compare(*files, **options)


def test_a_masks_values_are_the_programs(pair, program_json, tmp_path):
    files = write_pair(tmp_path, pair)
    mask = np.zeros(pair[0].shape[:2], bool)
    mask[40:120, 30:90] = True
    photonproof.write(tmp_path / "mask.exr", mask.astype(np.float32))
    expected = program_values(program_json("compare", *files, "--mask", tmp_path / "mask.exr"))
    for name, value in photonproof.compare(*pair, mask=mask).items():
        assert value == expected[name][0], name


def test_equal_images_and_small_ones(pair, program_json, tmp_path):
    small = pair[0][:8, :8].copy()
    files = write_pair(tmp_path, (small, small))
    comparison = photonproof.compare(small, small)
    assert_equal_to_program(comparison, program_json("compare", *files))
    assert comparison["psnr"] == math.inf and comparison["ssim"] is None and "11 pixels" in comparison.undefined["ssim"]
    with pytest.raises(photonproof.InputError, match="ssim: error: is undefined: a side is under 11 pixels"):
        photonproof.ssim(small, small)


def test_a_function_has_the_value_of_compare(pair):
    everything = photonproof.compare(*pair, photonproof.metrics.names)
    functions = [name for name in photonproof.metrics.names if hasattr(photonproof, name)]
    assert {"mse", "rmse", "mae", "relmse", "smape", "psnr", "ssim", "ms_ssim", "flip", "hdr_flip", "differing",
            "bias"} <= set(functions)
    for name in functions:
        assert getattr(photonproof, name)(*pair) == everything[name], name
    assert "ssim" in str(everything) and "window=11" in str(everything)


@pytest.mark.parametrize("depth, mode", [(np.uint8, "L"), (np.uint8, "RGB"), (np.uint8, "RGBA")])
def test_bytes_are_read_as_the_programs_pngs(program_json, tmp_path, depth, mode):
    pillow = pytest.importorskip("PIL.Image")
    rng = np.random.default_rng(3)
    shape = (40, 50) if mode == "L" else (40, 50, len(mode))
    images = [rng.integers(0, 256, shape, dtype=depth) for _ in range(2)]
    for i, image in enumerate(images):
        pillow.fromarray(image, mode).save(tmp_path / f"{i}.png")
    from_program = program_json("compare", tmp_path / "0.png", tmp_path / "1.png")
    assert_equal_to_program(photonproof.compare(*images), from_program)


def test_all_samples_of_both_depths_are_decoded_as_files_are(tmp_path):
    import struct
    import zlib

    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    for depth, side in ((8, 16), (16, 256)):
        samples = np.arange(2**depth).reshape(side, side)
        rows = b"".join(b"\0" + row.astype(">u2" if depth == 16 else "u1").tobytes() for row in samples)
        file = tmp_path / f"{depth}.png"
        file.write_bytes(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", side, side, depth, 0, 0, 0, 0))
                         + chunk(b"IDAT", zlib.compress(rows)) + chunk(b"IEND", b""))
        read = photonproof.read(file).image
        assert photonproof.max_abs(read, samples.astype(f"u{depth // 8}")) == 0


@pytest.mark.parametrize("change", [
    lambda a: a.astype(np.float64), lambda a: a.astype(">f4"), lambda a: a.astype(">f8"), np.asfortranarray,
    lambda a: np.repeat(a, 2, axis=1)[:, ::2], lambda a: a[::-1].copy()[::-1], lambda a: np.dstack([a, a[:, :, :1]]),
    lambda a: a.tolist(), lambda a: a.view(photonproof.Image), lambda a: np.ma.masked_array(a),
    lambda a: np.frombuffer(b"x" + a.tobytes(), np.uint8)[1:].view(np.float32).reshape(a.shape)])
def test_every_layout_gives_the_same_bits(pair, change):
    reference, test = (image[:40, :40] for image in pair)
    expected = photonproof.compare(np.ascontiguousarray(reference), np.ascontiguousarray(test))
    assert photonproof.compare(change(reference), change(test)) == expected


def test_grey_half_and_read_only_arrays(pair):
    grey = np.ascontiguousarray(pair[0][:30, :30, 0])
    colour = np.repeat(grey[:, :, None], 3, axis=2)
    assert photonproof.max_abs(grey, colour) == photonproof.max_abs(grey[:, :, None], colour) == 0
    half = colour.astype(np.float16)
    assert photonproof.max_abs(half, half.astype(np.float32)) == 0
    colour.flags.writeable = False
    assert photonproof.max_abs(colour, colour) == 0


good = np.ones((12, 12, 3), np.float32)


def with_value(value, dtype=np.float32):
    image = good.astype(dtype)
    image[3, 5, 1] = value
    return image


@pytest.mark.parametrize("image, says", [
    (with_value(np.nan), r"pixel \(5, 3\) of the test image is NaN in G; 1 non-finite in all"),
    (with_value(np.inf), r"pixel \(5, 3\) of the test image is \+infinity in G"),
    (with_value(-np.inf, np.float16), r"pixel \(5, 3\) of the test image is -infinity in G"),
    (with_value(1e300, np.float64), r"test: error: pixel \(5, 3\) is 1e\+300 in G, beyond single precision"),
    (good[:, :11], r"the test image is 11x12 pixels, the reference image 12x12"),
    (good[:0], r"shape \(0, 12, 3\) and no pixels"),
    (good[:, :, :2], r"shape \(12, 12, 2\), expected float16"),
    (good[0, 0, 0], r"shape \(\), expected"), (good[0, 0], r"shape \(3,\), expected"),
    (good[None], r"shape \(1, 12, 12, 3\), expected"), (np.dstack([good, good]), r"shape \(12, 12, 6\), expected"),
    (good.astype(np.int64), "dtype int64"), (good.astype(bool), "dtype bool"), (good.astype(complex), "dtype complex128"),
    (good.astype(np.uint32), "dtype uint32"), (good.astype(np.int8), "dtype int8"), (good.astype(object), "dtype object"),
    (good.astype("U1"), "dtype <U1"), (good.astype(np.longdouble), "dtype float128"),
    (np.zeros((12, 12, 3), "M8[s]"), "dtype datetime64"), (np.zeros((12, 12), [("r", "f4")]), "dtype"),
    (None, "dtype object"), (object(), "dtype object"), ([[1, 2], [3]], "is no array"), ({}, "dtype object"),
    (np.broadcast_to(np.float32(1), (2**15, 2**15, 3)), "more than 2\\^28 pixels"),
    (np.broadcast_to(np.float32(1), (1, 2**19, 3)), "2\\^18 columns"),
    (np.ma.masked_array(good, good > 0), "masked values")])
def test_an_image_that_cannot_be_compared_is_one_clear_error(image, says):
    for function in (photonproof.compare, photonproof.ssim):
        with pytest.raises(photonproof.InputError, match=says) as caught:
            function(good, image)
        assert len(str(caught.value).splitlines()) == 1


@pytest.mark.parametrize("options, says", [
    ({"metrics": "ssin"}, "'ssin'.*ssim"), ({"exposure": float("nan")}, "exposure"), ({"exposure": 1000}, "exposure"),
    ({"more_than": 2}, "more_than"), ({"exposures": (1, 0, 3)}, "exposures"), ({"region": (0, 0, 99, 1)}, "region"),
    ({"mask": np.ones((3, 3), bool)}, "mask"), ({"mask": np.zeros((12, 12), bool)}, "chooses no pixel"),
    ({"mask": np.ones((12, 12))}, "expected bool"), ({"threads": -1}, "threads"), ({"threads": 10**6}, "threads")])
def test_an_option_out_of_range_is_one_clear_error(options, says):
    with pytest.raises(photonproof.InputError, match=says):
        photonproof.compare(good, good, **options)


def resident_bytes():
    with open("/proc/self/statm") as file:
        return int(file.read().split()[1]) * 4096


def test_a_hundred_thousand_calls_keep_the_memory(pair):
    small = [np.ascontiguousarray(image[:16, :16]) for image in pair]
    for _ in range(2000):
        photonproof.ssim(*small)
    before = resident_bytes()
    for i in range(100_000):
        photonproof.ssim(*small)
    assert resident_bytes() - before < 1 << 20


def test_errors_keep_the_memory():
    bad = with_value(np.nan)

    def fail():
        try:
            photonproof.ssim(good, bad)
        except photonproof.InputError:
            pass

    for _ in range(1000):
        fail()
    before = resident_bytes()
    for _ in range(10_000):
        fail()
    assert resident_bytes() - before < 1 << 20


def test_no_array_is_copied_on_the_way_in(pair):
    from photonproof._arrays import as_pixels
    assert as_pixels(pair[0], "x") is pair[0]


def test_comparisons_at_the_same_time_have_the_bits_of_one(pair):
    from concurrent.futures import ThreadPoolExecutor
    alone = photonproof.compare(*pair)
    with ThreadPoolExecutor(4) as pool:
        assert all(found == alone for found in pool.map(lambda _: photonproof.compare(*pair), range(16)))
