"""Expected SSIM, PSNR and MSE of the image pairs, by scikit-image: writes ssim_expected.csv, which metric_ssim_test.cpp reads.

    /usr/bin/python3 harness/oracles/ssim_oracle.py     (Debian: python3-skimage, 0.19)

Needed only to make the table again; neither the build nor the tests run it.
"""
import csv
import os

import skimage
from skimage.metrics import mean_squared_error, peak_signal_noise_ratio, structural_similarity

import image_pairs


def main():
    with open(os.path.join(image_pairs.FOLDER, "ssim_expected.csv"), "w", newline="") as out:
        out.write(f"# scikit-image {skimage.__version__}, by ssim_oracle.py\n")
        rows = csv.writer(out, lineterminator="\n")
        rows.writerow(("pair", "reference", "test", "exposure", "ssim", "psnr", "mse"))
        for name, reference, test, exposure in image_pairs.PAIRS:
            linear = [image_pairs.read(file) for file in (reference, test)]
            shown = [image_pairs.display(image, exposure) for image in linear]
            values = (structural_similarity(*shown, gaussian_weights=True, sigma=1.5, use_sample_covariance=False,
                                            data_range=1, channel_axis=2),
                      peak_signal_noise_ratio(*shown, data_range=1), mean_squared_error(*linear))
            rows.writerow((name, reference, test, exposure, *(f"{value:.12f}" for value in values)))


if __name__ == "__main__":
    main()
