"""Faults that the examples of foreign renderers plant in themselves, and a writer of PFM images.

The names are those of faults.txt; "none" is the healthy program.
"""
import os
import sys
import time

import numpy as np


class Job:
    """The arguments SCENE OUTPUT.pfm WIDTH HEIGHT SPP SEED FAULT, changed as the fault asks."""

    def __init__(self):
        self.scene, self.output = sys.argv[1:3]
        self.width, self.height, self.spp, self.seed = map(int, sys.argv[3:7])
        self.fault = sys.argv[7]
        if self.fault == "crash":
            os.abort()
        if self.fault == "hang":
            time.sleep(3600)
        if self.fault == "no-image":
            sys.exit(0)
        if self.fault == "size":
            self.width //= 2
        if self.fault == "stuck-seed":
            self.seed = 1
        self.seed %= 2**31

    def write(self, image):
        """`image`: height x width x 3 linear values, the upper row first."""
        image = np.array(image, dtype="<f4")
        if self.fault == "gamma":
            image = np.maximum(image, 0) ** np.float32(1 / 2.2)
        if self.fault == "dim":
            image *= np.float32(0.98)
        if self.fault == "mirrored":
            image = image[:, ::-1]
        if self.fault == "shifted":
            image = np.concatenate([image[:, :1], image[:, :-1]], axis=1)
        if self.fault == "channels":
            image = image[:, :, ::-1]
        if self.fault == "nan":
            image[7, 9, 1] = np.nan
        with open(self.output, "wb") as file:
            file.write(b"PF\n%d %d\n-1.0\n" % (image.shape[1], image.shape[0]))
            file.write(np.ascontiguousarray(image[::-1]).tobytes())
