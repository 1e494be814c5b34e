"""Arrays as the C++ side takes them: float32, row-major, of shape (height, width, 3)."""
from __future__ import annotations

from functools import lru_cache
from typing import TYPE_CHECKING, Any, cast

import numpy as np

from . import _native
from ._errors import refusal

if TYPE_CHECKING:
    from numpy.typing import NDArray

_single = np.dtype(np.float32)
_most_pixels = 2**28
_most_columns = 2**18
_expected = ("expected float16, float32 or float64 with linear values, or uint8 or uint16 with sRGB, of shape "
             "(height, width), (height, width, 1), (height, width, 3) or (height, width, 4)")


@lru_cache(maxsize=2)
def _srgb_table(greatest: int) -> "NDArray[np.float32]":
    return np.asarray(_native.srgb_table(greatest), np.float32).reshape(-1)


def _decoded(samples: "NDArray[Any]") -> "NDArray[np.float32]":
    """Linear values of 8- or 16-bit sRGB, as image files of these depths are read."""
    return cast("NDArray[np.float32]", _srgb_table(int(np.iinfo(samples.dtype).max))[samples])


def _shaped(array: "NDArray[Any]", name: str) -> "NDArray[Any]":
    """Three channels: grey is repeated, alpha left out."""
    shape = array.shape
    if array.ndim == 2:
        array = array[:, :, np.newaxis]
    if array.ndim != 3 or array.shape[2] not in (1, 3, 4):
        raise refusal(name, f"has shape {shape}, {_expected}")
    height, width = shape[:2]
    if height == 0 or width == 0:
        raise refusal(name, f"has shape {shape} and no pixels, {_expected}")
    if width > _most_columns or height * width > _most_pixels:
        raise refusal(name, f"has shape {shape}, more than 2^28 pixels or 2^18 columns")
    if array.shape[2] == 1:
        return np.broadcast_to(array, (height, width, 3))
    return array[:, :, :3]


def as_pixels(value: Any, name: str) -> "NDArray[np.float32]":
    """The array itself where it has the C++ side's layout, else a copy.

    Raises InputError for another shape or dtype. ``name`` stands for the array in messages.
    """
    if isinstance(value, np.ndarray) and value.dtype == _single and value.ndim == 3 and value.shape[2] == 3 \
            and value.flags.c_contiguous and value.flags.aligned and not isinstance(value, np.ma.MaskedArray) \
            and 0 < value.size <= 3 * _most_pixels and value.shape[1] <= _most_columns:
        return value
    try:
        array: "NDArray[Any]" = np.asarray(value)
    except Exception as error:
        raise refusal(name, f"is no array ({error}), {_expected}") from error
    if isinstance(value, np.ma.MaskedArray) and np.ma.is_masked(value):
        raise refusal(name, "has masked values; choose pixels by the argument mask")
    kind = array.dtype
    if not (kind.kind == "f" and kind.itemsize <= 8 or kind.kind == "u" and kind.itemsize <= 2):
        raise refusal(name, f"has dtype {kind}, {_expected}")
    array = _shaped(array, name)
    if kind.kind == "u":
        return np.ascontiguousarray(_decoded(array))
    with np.errstate(over="ignore", invalid="ignore"):
        single = np.ascontiguousarray(array, dtype=np.float32)
    if kind.itemsize > 4 and not np.array_equal(np.isfinite(single), np.isfinite(array)):
        y, x, channel = np.argwhere(np.isfinite(single) != np.isfinite(array))[0]
        raise refusal(name, f"pixel ({x}, {y}) is {array[y, x, channel]} in {'RGB'[channel]}, beyond single precision")
    return single


def as_mask(value: Any) -> "NDArray[np.bool_]":
    """The pixels to count: booleans of shape (height, width)."""
    mask: "NDArray[Any]" = np.asarray(value)
    if mask.dtype != np.bool_ or mask.ndim != 2:
        raise refusal("mask", f"has dtype {mask.dtype} and shape {mask.shape}, expected bool of shape (height, width)")
    return np.ascontiguousarray(mask)
