"""Images: arrays that notebooks show, and their files."""
from __future__ import annotations

import os
import tempfile
from dataclasses import dataclass, field
from typing import Any, Dict, Iterator, Optional

import numpy as np

from . import _native
from ._arrays import as_pixels
from ._errors import refusal


class Image(np.ndarray[Any, np.dtype[np.float32]]):
    """An array of shape (height, width, 3), float32: linear Rec. 709, row 0 on top. A notebook shows it as a picture.

    ``image.exposed(2)`` shows it two stops brighter. Everything else is NumPy's.
    """

    exposure: float = 0.0

    def __array_finalize__(self, parent: Any) -> None:
        self.exposure = getattr(parent, "exposure", 0.0)

    def exposed(self, stops: float) -> "Image":
        """The same pixels, without a copy, shown with this exposure."""
        shown = self.view()
        shown.exposure = float(stops)
        return shown

    def png(self) -> bytes:
        """The picture that ``photonproof render -o x.png`` writes: 2^exposure times the image in 8-bit sRGB."""
        with tempfile.TemporaryDirectory(prefix="photonproof-") as folder:
            path = os.path.join(folder, "image.png")
            _native.write_png(path, as_pixels(self, "the image"), self.exposure)
            with open(path, "rb") as file:
                return file.read()

    def _repr_png_(self) -> Optional[bytes]:
        return self.png() if self.ndim == 3 and self.shape[2] == 3 and self.size > 0 else None


@dataclass
class Rendering:
    """An image, the variance of each of its values, and its statistics. Unpacks as ``image, variance, stats``."""

    image: Image
    #: Variance of each value of ``image``, of the same shape. None where there were no two independent estimates.
    variance: Optional[Image]
    #: As the file ``x.stats.json`` of ``photonproof render``; empty for an image that was read.
    stats: Dict[str, Any] = field(default_factory=dict)
    #: Texts of the EXR's header. Statistics use those on noise that pixels share.
    metadata: Dict[str, str] = field(default_factory=dict)
    #: Share of samples on a shape, of shape (height, width), where the scene's film asks for it.
    alpha: Optional["np.ndarray[Any, np.dtype[np.float32]]"] = None

    def __iter__(self) -> Iterator[Any]:
        return iter((self.image, self.variance, self.stats))

    def _repr_png_(self) -> Optional[bytes]:
        return self.image._repr_png_()

    def save(self, path: "str | os.PathLike[str]") -> None:
        """Writes image and variance as EXR. The file appears under its name only when it is whole."""
        write(path, self.image, variance=self.variance, metadata=self.metadata)


def rendering_from(parts: Any, stats: Dict[str, Any]) -> Rendering:
    """From the C++ side's mean, variance, alpha and metadata. No array is copied."""
    mean, variance, alpha, metadata = parts
    return Rendering(mean.view(Image), None if variance is None else variance.view(Image), stats, metadata, alpha)


def read(path: "str | os.PathLike[str]", layer: str = "") -> Rendering:
    """Reads an EXR, PNG or PFM as linear RGB, with the variance that an EXR of ours has.

    Samples of 8 and 16 bits are decoded from sRGB, grey is repeated, alpha left out. ``layer`` chooses one of several.
    Raises InputError where the file is missing or is no image.
    """
    return rendering_from(_native.read(os.fspath(path), layer), {})


def write(path: "str | os.PathLike[str]", image: Any, *, variance: Any = None,
          metadata: Optional[Dict[str, str]] = None, exposure: float = 0.0) -> None:
    """Writes an EXR with the values themselves, or a PNG of 2^exposure times the image in 8-bit sRGB."""
    name = os.fspath(path)
    pixels = as_pixels(image, "image")
    if name.endswith(".exr"):
        spread = None if variance is None else as_pixels(variance, "variance")
        if spread is not None and spread.shape != pixels.shape:
            raise refusal("variance", f"has shape {spread.shape}, the image {pixels.shape}")
        _native.write_exr(name, pixels, spread, metadata or {})
    elif name.endswith(".png"):
        _native.write_png(name, pixels, exposure)
    else:
        raise refusal(name, "is written as .exr or .png")
