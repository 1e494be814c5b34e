"""The fixture assert_agrees passes, fails with pictures, and refuses what it cannot compare."""
import numpy as np
import pytest

import photonproof
from photonproof.checks import AgreementError, check_agrees

loads = ("-p", "photonproof.pytest_plugin", "-p", "no:cacheprovider")


@pytest.fixture
def golden(pytester, pair):
    photonproof.write(pytester.path / "golden.exr", pair[0][:40, :40])
    return pytester


def run(pytester, body):
    pytester.makepyfile("import numpy as np\nimport photonproof\ndef test_it(assert_agrees):\n"
                        "    image = photonproof.read('golden.exr').image\n" + body)
    installed = any(name == "photonproof" for name in _entry_points())
    return pytester.runpytest_subprocess(*(loads[2:] if installed else loads))


def _entry_points():
    from importlib.metadata import entry_points
    return [point.name for point in entry_points(group="pytest11")]


def test_a_right_image_passes(golden):
    result = run(golden, "    assert assert_agrees(image, 'golden.exr', bound=0.02) == 0\n"
                         "    assert assert_agrees(image, image, 0.9, metric='ssim') == 1\n")
    result.assert_outcomes(passed=1)
    assert not (golden.path / "photonproof-failures").exists()


def test_a_wrong_image_fails_with_pictures(golden):
    result = run(golden, "    assert_agrees(image * np.float32(1.5), 'golden.exr', bound=0.02)\n")
    result.assert_outcomes(failed=1)
    result.stdout.fnmatch_lines(["*against golden.exr: flip * is over its maximum 0.02*", "*image-flip.png*"])
    [folder] = (golden.path / "photonproof-failures").iterdir()
    assert {file.name for file in folder.iterdir()} == {"image.png", "golden.png", "image-flip.png", "image-error.png"}
    for file in folder.iterdir():
        assert photonproof.read(file).image.shape == (40, 40, 3)


@pytest.mark.parametrize("body, says", [
    ("    assert_agrees(image[:20], 'golden.exr', bound=0.02)\n", "*the test image is 40x20 pixels*"),
    ("    image[3, 4] = np.nan\n    assert_agrees(image, 'golden.exr', bound=0.02)\n", "*pixel (4, 3)*NaN*"),
    ("    assert_agrees(image, 'nowhere.exr', bound=0.02)\n", "*nowhere.exr: error: there is no such golden image*"),
    ("    assert_agrees(image, 'golden.exr', bound=0.02, metric='flop')\n", "*flop*")])
def test_what_cannot_be_compared_fails(golden, body, says):
    result = run(golden, body)
    result.assert_outcomes(failed=1)
    result.stdout.fnmatch_lines([says])


def test_bounds_have_the_side_of_their_metric(pair):
    reference, test = (image[:40, :40] for image in pair)
    value = photonproof.ssim(reference, test)
    assert check_agrees(test, reference, value, metric="ssim") == value
    with pytest.raises(AgreementError, match="minimum"):
        check_agrees(test, reference, value + 1e-6, metric="ssim")
    darker = reference * np.float32(0.9)
    with pytest.raises(AgreementError, match="bias"):
        check_agrees(darker, reference, 0.05, metric="bias")
    check_agrees(darker, reference, 0.11, metric="bias")


def test_a_mask_and_an_exposure_count(pair):
    reference = pair[0][:40, :40]
    wrong = reference.copy()
    wrong[:20] *= 3
    lower = np.zeros((40, 40), bool)
    lower[20:] = True
    assert check_agrees(wrong, reference, 0, metric="mse", mask=lower) == 0
    with pytest.raises(AgreementError, match="mse"):
        check_agrees(wrong, reference, 0, metric="mse")
    assert check_agrees(wrong, reference, 1, exposure=2) == photonproof.flip(reference, wrong, exposure=2)


@pytest.mark.parametrize("spoil, says", [
    (lambda image: image[:20], "40x20"), (lambda image: image * np.float32(np.nan), "NaN")])
def test_a_wrong_size_or_value_is_a_failure_and_no_error(pair, spoil, says):
    reference = pair[0][:40, :40]
    with pytest.raises(AgreementError, match=says) as caught:
        check_agrees(spoil(reference), reference, 0.1)
    assert caught.value.pictures == []
    with pytest.raises(photonproof.InputError, match="flop"):
        check_agrees(reference, reference, 0.1, metric="flop")
