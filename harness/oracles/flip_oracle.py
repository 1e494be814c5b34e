"""Expected LDR-FLIP of the image pairs: writes flip_expected.csv, which metric_flip_test.cpp reads.

    /usr/bin/python3 harness/oracles/flip_oracle.py     (Debian: python3-numpy, python3-scipy)

Andersson, Nilsson, Akenine-Möller, Oskarsson, Åström, Fairchild: "FLIP: A Difference Evaluator for Alternating
Images", Proc. ACM Comput. Graph. Interact. Tech. 3(2), 2020. Written from the paper's colour and feature pipelines,
with the details that NVIDIA's tool settles: replicated borders, filtered colours clamped to the unit cube of linear
RGB, one support for all contrast sensitivity filters, and the pooled values it prints. Every filter here is one
two-dimensional kernel applied directly and every colour space is spelt out, where the C++ runs sums of separable
passes on rescaled channels: the two share the definition, not the method.

Needed only to make the table again; neither the build nor the tests run it.
"""
import csv
import os

import numpy as np
import scipy
from scipy.ndimage import correlate

import image_pairs

PIXELS_PER_DEGREE = 0.7 * (3840 / 0.7) * np.pi / 180  # 0.7 m from a screen 0.7 m and 3840 pixels wide

# Contrast sensitivity: a_i and b_i (degrees squared) of the sums of Gaussians, the paper's constants.
CSF = {"achromatic": [(1, 0.0047)], "red_green": [(1, 0.0053)], "blue_yellow": [(34.1, 0.04), (13.5, 0.025)]}

# sRGB primaries and D65 white as exact ratios.
RGB_TO_XYZ = np.array([[10135552 / 24577794, 8788810 / 24577794, 4435075 / 24577794],
                       [2613072 / 12288897, 8788810 / 12288897, 887015 / 12288897],
                       [1425312 / 73733382, 8788810 / 73733382, 70074185 / 73733382]])
XYZ_TO_RGB = np.linalg.inv(RGB_TO_XYZ)
WHITE = RGB_TO_XYZ @ np.ones(3)


def rgb_to_ycxcz(rgb):
    x, y, z = np.moveaxis(rgb @ RGB_TO_XYZ.T / WHITE, -1, 0)
    return np.stack((116 * y - 16, 500 * (x - y), 200 * (y - z)), axis=-1)


def ycxcz_to_rgb(ycxcz):
    y = (ycxcz[..., 0] + 16) / 116
    xyz = np.stack((y + ycxcz[..., 1] / 500, y, y - ycxcz[..., 2] / 200), axis=-1) * WHITE
    return xyz @ XYZ_TO_RGB.T


def rgb_to_lab(rgb):
    t = rgb @ RGB_TO_XYZ.T / WHITE
    f = np.where(t > (6 / 29)**3, np.cbrt(t), t / (3 * (6 / 29)**2) + 4 / 29)
    fx, fy, fz = np.moveaxis(f, -1, 0)
    return np.stack((116 * fy - 16, 500 * (fx - fy), 200 * (fy - fz)), axis=-1)


def hunt(lab):
    return lab * np.concatenate((np.ones_like(lab[..., :1]), np.repeat(0.01 * lab[..., :1], 2, axis=-1)), axis=-1)


def hyab(a, b):
    return np.abs(a[..., 0] - b[..., 0]) + np.hypot(a[..., 1] - b[..., 1], a[..., 2] - b[..., 2])


def csf_kernel(terms, ppd):
    widest = max(b for channel in CSF.values() for _, b in channel)
    radius = int(np.ceil(3 * np.sqrt(widest / (2 * np.pi**2)) * ppd))
    y, x = np.mgrid[-radius:radius + 1, -radius:radius + 1] / ppd
    kernel = sum(a * np.sqrt(np.pi / b) * np.exp(-np.pi**2 * (x * x + y * y) / b) for a, b in terms)
    return kernel / kernel.sum()


def filtered_colour(ycxcz, ppd):
    channels = [correlate(ycxcz[..., c], csf_kernel(terms, ppd), mode="nearest") for c, terms in
                enumerate(CSF.values())]
    return hunt(rgb_to_lab(np.clip(ycxcz_to_rgb(np.stack(channels, axis=-1)), 0, 1)))


def colour_difference(reference, test, ppd):
    qc, pc, pt = 0.7, 0.4, 0.95
    green, blue = (hunt(rgb_to_lab(np.array(rgb))) for rgb in ((0.0, 1.0, 0.0), (0.0, 0.0, 1.0)))
    largest = hyab(green, blue)**qc
    error = hyab(filtered_colour(reference, ppd), filtered_colour(test, ppd))**qc
    knee = pc * largest
    return np.where(error < knee, pt / knee * error, pt + (error - knee) / (largest - knee) * (1 - pt))


def features(ycxcz, ppd):
    """Magnitudes of the edge and the point detector."""
    sigma = 0.5 * 0.082 * ppd
    radius = int(np.ceil(3 * sigma))
    y, x = np.mgrid[-radius:radius + 1, -radius:radius + 1].astype(float)
    gauss = np.exp(-(x * x + y * y) / (2 * sigma * sigma))
    grey = (ycxcz[..., 0] + 16) / 116
    magnitudes = []
    for kernel in (-x * gauss, (x * x / (sigma * sigma) - 1) * gauss):
        kernel = np.where(kernel > 0, kernel / kernel[kernel > 0].sum(), kernel / -kernel[kernel < 0].sum())
        magnitudes.append(np.hypot(correlate(grey, kernel, mode="nearest"), correlate(grey, kernel.T, mode="nearest")))
    return magnitudes


def flip(reference_srgb, test_srgb, ppd=PIXELS_PER_DEGREE):
    """The error map of two sRGB-encoded images."""
    reference, test = (rgb_to_ycxcz(image_pairs.decode_srgb(image)) for image in (reference_srgb, test_srgb))
    differences = [np.abs(a - b) for a, b in zip(features(reference, ppd), features(test, ppd))]
    feature = (np.maximum(*differences) / np.sqrt(2))**0.5
    return colour_difference(reference, test, ppd)**(1 - feature)


def weighted_percentile(values, fraction):
    """The smallest error at which the running sum of the sorted errors passes `fraction` of their sum."""
    ordered = np.sort(values, axis=None)
    passed = np.cumsum(ordered) > fraction * ordered.sum()
    return ordered[np.argmax(passed)] if passed.any() else 0.0


def main():
    with open(os.path.join(image_pairs.FOLDER, "flip_expected.csv"), "w", newline="") as out:
        out.write(f"# numpy {np.__version__}, scipy {scipy.__version__}, by flip_oracle.py\n")
        rows = csv.writer(out, lineterminator="\n")
        rows.writerow(("pair", "reference", "test", "exposure", "flip", "flip_weighted_quartile1",
                       "flip_weighted_median", "flip_weighted_quartile3", "flip_max"))
        for name, reference, test, exposure in image_pairs.PAIRS:
            error = flip(image_pairs.display(image_pairs.read(reference), exposure),
                         image_pairs.display(image_pairs.read(test), exposure))
            numbers = (error.mean(), *(weighted_percentile(error, f) for f in (0.25, 0.5, 0.75)), error.max())
            rows.writerow((name, reference, test, exposure, *(f"{v:.12f}" for v in numbers)))


if __name__ == "__main__":
    main()
