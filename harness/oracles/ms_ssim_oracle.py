"""Expected MS-SSIM of two tilings of the image pairs: prints ms_ssim_expected.csv, which
metric_ms_ssim_test.cpp reads.

    python3 harness/oracles/ms_ssim_oracle.py > harness/oracles/ms_ssim_expected.csv      (numpy, scipy, Pillow)

Wang, Simoncelli, Bovik: "Multi-scale structural similarity for image quality assessment", 2003. Written from the paper
with one two-dimensional window applied to every position in turn and explicit moments, where the C++ runs separable
passes on sums and differences. The pairs are too small for five scales, so each image is repeated to `width` x
`height` (odd ones, which have a last row or column of their own when halved); the test does the same.

nightly.sh holds the table against it.
"""
import csv
import sys

import numpy as np
from scipy.signal import convolve2d

import image_pairs

WEIGHTS = (0.0448, 0.2856, 0.3001, 0.2363, 0.1333)
SIZES = {"hdr": (161, 203), "ldr": (333, 162)}  # width, height


def window():
    x = np.arange(-5, 6)
    line = np.exp(-x * x / (2 * 1.5**2))
    square = np.outer(line, line)
    return square / square.sum()


def terms(r, x):
    """Mean of luminance times contrast times structure, and of the last two, over all whole windows."""
    mean = lambda v: convolve2d(v, window(), mode="valid")
    mr, mx = mean(r), mean(x)
    vr, vx, cov = mean(r * r) - mr * mr, mean(x * x) - mx * mx, mean(r * x) - mr * mx
    c1, c2 = 0.01**2, 0.03**2
    structure = (2 * cov + c2) / (vr + vx + c2)
    return ((2 * mr * mx + c1) / (mr * mr + mx * mx + c1) * structure).mean(), structure.mean()


def halve(v):
    v = np.pad(v, ((0, v.shape[0] % 2), (0, v.shape[1] % 2)), mode="edge")
    return (v[::2, ::2] + v[1::2, ::2] + v[::2, 1::2] + v[1::2, 1::2]) / 4


def ms_ssim(reference, test):
    products = []
    for channel in range(3):
        r, x = reference[..., channel], test[..., channel]
        product = 1.0
        for scale, weight in enumerate(WEIGHTS):
            whole, structure = terms(r, x)
            product *= (whole if scale == len(WEIGHTS) - 1 else structure)**weight
            r, x = halve(r), halve(x)
        products.append(product)
    return np.mean(products)


def repeated(image, width, height):
    return np.tile(image, (-(-height // image.shape[0]), -(-width // image.shape[1]), 1))[:height, :width]


def main():
    print(f"# numpy {np.__version__}, by ms_ssim_oracle.py")
    rows = csv.writer(sys.stdout, lineterminator="\n")
    rows.writerow(("pair", "reference", "test", "exposure", "width", "height", "ms_ssim"))
    for name, reference, test, exposure in image_pairs.PAIRS:
        if name not in SIZES:
            continue
        width, height = SIZES[name]
        images = (image_pairs.display(repeated(image_pairs.read(file), width, height), exposure)
                  for file in (reference, test))
        rows.writerow((name, reference, test, exposure, width, height, f"{ms_ssim(*images):.12f}"))


if __name__ == "__main__":
    main()
