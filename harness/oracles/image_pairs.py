"""The image pairs the oracles judge, and how every oracle encodes them for display.

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
