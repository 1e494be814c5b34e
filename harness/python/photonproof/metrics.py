"""Metrics of a pair of images, as ``photonproof compare`` computes them. docs/metrics.md defines each.

The reference comes first. Images are paths, Renderings, or arrays of shape (height, width, 3), or grey, or with alpha.
Values of float16, float32 and float64 are linear; those of uint8 and uint16 are sRGB, as files of these depths are read.
Other shapes and dtypes, values that are not finite and images of different sizes raise InputError.
"""
from __future__ import annotations

import os
from typing import Any, Dict, Iterable, List, Optional, Sequence, Tuple, Union

from . import _native
from ._arrays import as_mask, as_pixels
from ._errors import refusal
from .images import Rendering, read

#: Every metric's name, in the order of reports.
names: List[str] = [name for name, _, _ in _native.metric_table()]

Region = Tuple[int, int, int, int]


class Comparison(Dict[str, Optional[float]]):
    """Values by metric; None where a metric is undefined, infinity for psnr of images that are equal once displayed."""

    #: Parameters by metric: "exposure=0, window=11, ...".
    parameters: Dict[str, str]
    #: The reason by metric where a value is None.
    undefined: Dict[str, str]

    def __init__(self, rows: Iterable[Tuple[str, Optional[float], str, Optional[str]]]) -> None:
        measured = list(rows)
        super().__init__((name, value) for name, value, _, _ in measured)
        self.parameters = {name: parameters for name, _, parameters, _ in measured}
        self.undefined = {name: why or "undefined" for name, value, _, why in measured if value is None}

    def __str__(self) -> str:
        lines = []
        for name, value in self.items():
            notes = self.parameters[name]
            if value is None:
                notes += ("; " if notes else "") + "undefined: " + self.undefined[name]
            lines.append(f"{name:<24}{'-' if value is None else format(value, '.8g'):<16}{notes}".rstrip())
        return "\n".join(lines)


def pixels_of(image: Any, name: str) -> Any:
    """The pixels of an array, a Rendering, an image file, or anything that NumPy reads, such as a Bitmap of Mitsuba."""
    if isinstance(image, (str, os.PathLike)):
        image = read(image)
    return as_pixels(image.image if isinstance(image, Rendering) else image, name)


def compare(reference: Any, test: Any, metrics: Union[str, Sequence[str], None] = None, *, exposure: float = 0.0,
            exposures: Optional[Tuple[float, float, int]] = None, more_than: float = 0.004,
            region: Optional[Region] = None, mask: Any = None, threads: int = 0) -> Comparison:
    """The metrics of a pair; without names, all but hdr_flip, differing and differing_pixels.

    exposure: stops before psnr, ssim and flip encode for display. exposures: first, last and number of those of
    hdr_flip; else derived from the reference. more_than: displayed difference from which a pixel differs.
    region: x, y, width, height of the part to compare. mask: booleans of shape (height, width), the pixels that count.
    threads: 0 for every core; the numbers do not depend on it.
    """
    wanted = [metrics] if isinstance(metrics, str) else list(metrics or [])
    return Comparison(_native.measure(
        pixels_of(reference, "reference"), pixels_of(test, "test"), wanted, exposure,
        None if exposures is None else [float(number) for number in exposures], more_than, region,
        None if mask is None else as_mask(mask), threads))


def value_of(reference: Any, test: Any, metric: str, exposure: float = 0.0, more_than: float = 0.004,
             exposures: Optional[Tuple[float, float, int]] = None, mask: Any = None) -> float:
    """One metric's value. Raises InputError where it is undefined."""
    [(name, value, _, why)] = _native.measure(
        pixels_of(reference, "reference"), pixels_of(test, "test"), [metric], exposure,
        None if exposures is None else [float(number) for number in exposures], more_than, None,
        None if mask is None else as_mask(mask), 0)
    if value is None:
        raise refusal(name, f"is undefined: {why}")
    return float(value)


def mse(reference: Any, test: Any, *, mask: Any = None) -> float:
    """Mean over pixels and channels of (x - r)^2."""
    return value_of(reference, test, "mse", mask=mask)


def rmse(reference: Any, test: Any, *, mask: Any = None) -> float:
    """Root of mse."""
    return value_of(reference, test, "rmse", mask=mask)


def mae(reference: Any, test: Any, *, mask: Any = None) -> float:
    """Mean of abs(x - r)."""
    return value_of(reference, test, "mae", mask=mask)


def max_abs(reference: Any, test: Any, *, mask: Any = None) -> float:
    """Greatest abs(x - r)."""
    return value_of(reference, test, "max_abs", mask=mask)


def bias(reference: Any, test: Any, *, mask: Any = None) -> float:
    """mean(x - r) / mean(r), signed."""
    return value_of(reference, test, "bias", mask=mask)


def relmse(reference: Any, test: Any, *, mask: Any = None) -> float:
    """Mean of (x - r)^2 / (r^2 + 0.01)."""
    return value_of(reference, test, "relmse", mask=mask)


def relmse_trimmed(reference: Any, test: Any, *, mask: Any = None) -> float:
    """relmse without the 0.1 % of pixels with the largest error."""
    return value_of(reference, test, "relmse_trimmed", mask=mask)


def relmse_jeri(reference: Any, test: Any, *, mask: Any = None) -> float:
    """Mean of (x - r)^2 / (r^2 + 0.0001)."""
    return value_of(reference, test, "relmse_jeri", mask=mask)


def mrse_pbrt(reference: Any, test: Any, *, mask: Any = None) -> float:
    """Mean of (x - r)^2 / (r + 0.01)^2."""
    return value_of(reference, test, "mrse_pbrt", mask=mask)


def smape(reference: Any, test: Any, *, mask: Any = None) -> float:
    """Symmetric mean absolute percentage error, from 0 to 2."""
    return value_of(reference, test, "smape", mask=mask)


def psnr(reference: Any, test: Any, *, exposure: float = 0.0, mask: Any = None) -> float:
    """Peak signal-to-noise ratio of displayed values in dB; infinite where these are equal."""
    return value_of(reference, test, "psnr", exposure, mask=mask)


def ssim(reference: Any, test: Any, *, exposure: float = 0.0, mask: Any = None) -> float:
    """Structural similarity of displayed values. Sides of 11 pixels or more."""
    return value_of(reference, test, "ssim", exposure, mask=mask)


def ms_ssim(reference: Any, test: Any, *, exposure: float = 0.0) -> float:
    """Structural similarity on five scales. Sides of 161 pixels or more."""
    return value_of(reference, test, "ms_ssim", exposure)


def flip(reference: Any, test: Any, *, exposure: float = 0.0, mask: Any = None) -> float:
    """Mean of the LDR-FLIP map of displayed colours."""
    return value_of(reference, test, "flip", exposure, mask=mask)


def hdr_flip(reference: Any, test: Any, *, exposures: Optional[Tuple[float, float, int]] = None,
             mask: Any = None) -> float:
    """Mean over pixels of the largest FLIP over several exposures: first, last, number; else from the reference."""
    return value_of(reference, test, "hdr_flip", exposures=exposures, mask=mask)


def differing(reference: Any, test: Any, *, more_than: float = 0.004, exposure: float = 0.0, mask: Any = None) -> float:
    """Share of pixels whose displayed value is off by more than ``more_than`` in a channel."""
    return value_of(reference, test, "differing", exposure, more_than, mask=mask)
