"""The check behind the fixture ``assert_agrees`` of pytest; it needs no pytest itself."""
from __future__ import annotations

import os
from pathlib import Path
from typing import Any, List, Optional

from . import _native
from ._errors import InputError, refusal
from .images import read, write
from .metrics import pixels_of, value_of


class AgreementError(AssertionError):
    """A metric of a pair of images breaks its bound. ``pictures`` are the files that show where."""

    pictures: List[Path]

    def __init__(self, text: str, pictures: List[Path]) -> None:
        super().__init__("\n".join([text, *(f"  {picture}" for picture in pictures)]))
        self.pictures = pictures


def _pictures(folder: Path, image: Any, golden: Any, exposure: float) -> List[Path]:
    folder.mkdir(parents=True, exist_ok=True)
    files = [folder / "image.png", folder / "golden.png"]
    for file, pixels in zip(files, (image, golden)):
        write(file, pixels, exposure=exposure)
    _native.write_heatmaps(golden, image, exposure, str(folder), "image")
    return [*files, folder / "image-flip.png", folder / "image-error.png"]


def check_agrees(image: Any, golden: Any, bound: float, *, metric: str = "flip", exposure: float = 0.0,
                 mask: Optional[Any] = None, pictures: "str | os.PathLike[str] | None" = None) -> float:
    """Returns the metric's value. Raises AgreementError where it breaks the bound.

    golden: the path of an image file, or an array. bound: a maximum; for psnr, ssim and ms_ssim a minimum; for bias a
    maximum of the absolute value. pictures: a folder for image, golden image and heat maps of a failure.

    Raises InputError where the golden image is missing, or the images cannot be compared.
    """
    if isinstance(golden, (str, os.PathLike)):
        name = os.fspath(golden)
        if not os.path.exists(name):
            raise refusal(name, "there is no such golden image; photonproof.write makes one")
        expected = pixels_of(read(name), "golden")
    else:
        name, expected = "the golden image", pixels_of(golden, "golden")
    pixels = pixels_of(image, "image")
    try:
        value = value_of(expected, pixels, metric, exposure, mask=mask)
        broken = _native.broken_bound(metric, value, bound)
    except InputError as error:
        if error.place != "images":
            raise
        raise AgreementError(f"against {name}: {error.message}", []) from None
    if broken is None:
        return value
    files = [] if pictures is None else _pictures(Path(pictures), pixels, expected, exposure)
    raise AgreementError(f"against {name}: {broken}", files)
