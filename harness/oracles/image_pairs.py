"""The image pairs the oracles judge, and how every oracle encodes them for display.

    /usr/bin/python3 harness/oracles/image_pairs.py     writes images/ again (numpy, Pillow)

The images are committed: the tests read them, and the expected values hold for exactly these files. Between them they
cover values far past 1, values below 0, odd and unequal sides, the smallest side SSIM has (11), 8-bit files, flat
areas, hard edges, thin lines, saturated colours and exposures of either sign.
"""
import os

import numpy as np
from PIL import Image

import exr_file

FOLDER = os.path.dirname(os.path.abspath(__file__))
PAIRS = [  # name, reference, test, exposure in stops
    ("hdr", "hdr_reference.exr", "hdr_test.exr", -1.5),
    ("ldr", "ldr_reference.png", "ldr_test.png", 0.0),
    ("strip", "strip_reference.exr", "strip_test.exr", 0.75),
    ("smallest", "smallest_reference.exr", "smallest_test.exr", 0.0),
]


def decode_srgb(v):
    """IEC 61966-2-1."""
    return np.where(v <= 0.04045, v / 12.92, ((v + 0.055) / 1.055)**2.4)


def encode_srgb(v):
    return np.where(v <= 0.0031308, v * 12.92, 1.055 * np.maximum(v, 0)**(1 / 2.4) - 0.055)


def read(name):
    """Linear RGB float64, (height, width, 3)."""
    path = os.path.join(FOLDER, "images", name)
    if name.endswith(".exr"):
        return exr_file.read(path)
    return decode_srgb(np.asarray(Image.open(path).convert("RGB"), dtype=np.float64) / 255)


def display(linear, exposure):
    """Scaled by 2^exposure, clamped to [0,1], sRGB."""
    return encode_srgb(np.clip(linear * 2.0**exposure, 0, 1))


def _grid(width, height):
    y, x = np.mgrid[0:height, 0:width]
    return (x + 0.5) / width, (y + 0.5) / height


def _blur(image):
    """Mean of each pixel and its four neighbours."""
    padded = np.pad(image, ((1, 1), (1, 1), (0, 0)), mode="edge")
    return (padded[1:-1, 1:-1] + padded[:-2, 1:-1] + padded[2:, 1:-1] + padded[1:-1, :-2] + padded[1:-1, 2:]) / 5


def _hdr(random):
    x, y = _grid(72, 50)
    image = np.stack((0.2 + 1.5 * x, 0.8 * y + 0.05, 0.3 + 0.4 * np.sin(9 * x * y)), axis=-1)
    image += 40 * np.exp(-((x - 0.7)**2 + (y - 0.3)**2) / 0.004)[..., None] * (1, 0.8, 0.5)  # a highlight
    image[30:44, 8:24] = (0.02, 0.25, 3.5)
    image[12:14, :] *= 0.1
    return image, image * random.gamma(8, 1 / 8, image.shape)


def _ldr(random):
    x, y = _grid(96, 80)
    image = np.stack((x, y, 1 - x * y), axis=-1)
    image[((x * 12).astype(int) + (y * 10).astype(int)) % 2 == 0] *= 0.35
    image[20:52, 60:84] = (0.9, 0.1, 0.1)
    image[60:61, 5:90] = (1, 1, 1)
    test = image.copy()
    test[10:60, 10:60] = image[10:60, 12:62]  # a patch two pixels off
    test[20:52, 60:84] = (0.1, 0.75, 0.2)  # another hue
    test += random.normal(0, 0.03, image.shape) * (y[..., None] > 0.5)
    return image, test


def _strip(random):
    x, y = _grid(61, 17)
    image = np.where((np.floor(x * 61) % 7 < 3)[..., None], (0.9, 0.6, 0.1), (0.05, 0.1, 0.5)) * (0.4 + y[..., None])
    image[8, :] = -0.05  # as a filter with negative lobes leaves it
    test = _blur(image)
    test[:, 40:] = image[:, 40:] + random.normal(0, 0.2, image[:, 40:].shape)
    return image, test


def _smallest(random):
    image = random.uniform(0, 1.2, (23, 11, 3))
    return image, 0.7 * image + 0.3 * random.uniform(0, 1.2, image.shape)


def _write(name, image):
    path = os.path.join(FOLDER, "images", name)
    if name.endswith(".exr"):
        exr_file.write(path, np.asarray(image, dtype=np.float16))
    else:
        Image.fromarray((np.clip(image, 0, 1) * 255 + 0.5).astype(np.uint8)).save(path, optimize=True)


def main():
    os.makedirs(os.path.join(FOLDER, "images"), exist_ok=True)
    for (_, reference, test, _), make in zip(PAIRS, (_hdr, _ldr, _strip, _smallest)):
        images = make(np.random.Generator(np.random.PCG64(20200707)))
        _write(reference, images[0])
        _write(test, images[1])


if __name__ == "__main__":
    main()
