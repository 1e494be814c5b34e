"""Expected HDR-FLIP of the image pairs: writes hdr_flip_expected.csv, which metric_hdr_flip_test.cpp reads.

    /usr/bin/python3 harness/oracles/hdr_flip_oracle.py     (Debian: python3-numpy, python3-scipy)

Andersson, Nilsson, Shirley, Akenine-Möller: "Visualizing Errors in Rendered High Dynamic Range Images", Eurographics
2021, with ACES tone mapping and the exposures the paper derives from the reference. The LDR-FLIP of each exposure is
flip_oracle.py's, which shares no method with the C++.

Needed only to make the table again; neither the build nor the tests run it.
"""
import csv
import math
import os

import numpy as np

import flip_oracle
import image_pairs

ACES = (0.6 * 0.6 * 2.51, 0.6 * 0.03, 0.0, 0.6 * 0.6 * 2.43, 0.6 * 0.59, 0.14)  # Narkowicz, without pre-exposure


def tone_map(x):
    k0, k1, k2, k3, k4, k5 = ACES
    return np.clip((k0 * x * x + k1 * x + k2) / (k3 * x * x + k4 * x + k5), 0, 1)


def exposures(reference):
    """Start, stop and number: tone mapping takes the brightest and the median pixel to 0.85."""
    k0, k1, k2, k3, k4, k5 = ACES
    target = max(np.roots((k0 - 0.85 * k3, k1 - 0.85 * k4, k2 - 0.85 * k5)))
    luminance = reference @ (0.2126, 0.7152, 0.0722)
    start, stop = math.log2(target / luminance.max()), math.log2(target / np.median(luminance))
    return start, stop, max(2, math.ceil(stop - start))


def hdr_flip(reference, test):
    reference, test = np.clip(reference, 0, 65536), np.clip(test, 0, 65536)
    start, stop, count = exposures(reference)
    error = np.zeros(reference.shape[:2])
    for stops in np.linspace(start, stop, count):
        # flip() takes sRGB-encoded images; the tone-mapped values count as linear ones.
        images = (image_pairs.encode_srgb(tone_map(image * 2.0**stops)) for image in (reference, test))
        error = np.maximum(error, flip_oracle.flip(*images))
    return start, stop, count, error.mean()


def main():
    with open(os.path.join(image_pairs.FOLDER, "hdr_flip_expected.csv"), "w", newline="") as out:
        out.write(f"# numpy {np.__version__}, by hdr_flip_oracle.py\n")
        rows = csv.writer(out, lineterminator="\n")
        rows.writerow(("pair", "reference", "test", "exposure", "start", "stop", "count", "hdr_flip"))
        for name, reference, test, exposure in image_pairs.PAIRS:
            start, stop, count, mean = hdr_flip(image_pairs.read(reference), image_pairs.read(test))
            rows.writerow((name, reference, test, exposure, f"{start:.9f}", f"{stop:.9f}", count, f"{mean:.12f}"))


if __name__ == "__main__":
    main()
