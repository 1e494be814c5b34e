"""Prints what a call costs: processor time of ssim on arrays of 16 x 16 pixels, and of converting them alone."""
import time

import numpy as np

import photonproof
from photonproof._arrays import as_pixels


def microseconds(function, calls=20_000):
    """Processor time of a call, the least mean of five repetitions."""
    means = []
    for _ in range(5):
        begin = time.process_time()
        for _ in range(calls // 5):
            function()
        means.append((time.process_time() - begin) / (calls // 5) * 1e6)
    return min(means)


def main():
    rng = np.random.default_rng(1)
    reference, test = rng.random((2, 16, 16, 3), np.float32)
    one = np.zeros((1, 1, 3), np.float32)
    print(f"ssim of 16 x 16 pixels: {microseconds(lambda: photonproof.ssim(reference, test)):.1f} us a call")
    print(f"mse of one pixel, which is the overhead: {microseconds(lambda: photonproof.mse(one, one)):.1f} us a call")
    print(f"checking an array: {microseconds(lambda: as_pixels(reference, 'reference')):.1f} us a call")


if __name__ == "__main__":
    main()
