"""Verdicts: whether images have one expectation, and whether they keep a bound, with the noise that they have."""
from __future__ import annotations

import math
import os
from dataclasses import dataclass, field
from typing import Any, Dict, List, Mapping, Optional, Tuple

import numpy as np

from . import _native
from ._errors import refusal
from .images import Rendering, read, rendering_from
from .metrics import pixels_of


@dataclass(frozen=True)
class Tile:
    """A part of an image where a gate failed, in pixels, row 0 on top."""

    x: int
    y: int
    width: int
    height: int
    score: float  #: Standard errors beyond noise, or the tile's share of the error.
    sentence: str  #: "+6.1 % over 41 px at (12, 40), red only"


@dataclass(frozen=True)
class Verdict:
    """The decision on images. It is false as a condition unless it is a pass."""

    verdict: str  #: "pass", "fail" or "inconclusive"
    sentence: str  #: Place and kind of the decision.
    #: The smallest relative error of the whole image, and of a block of 8 x 8 pixels, that would have been found with
    #: probability 0.99. None where that is unknown.
    would_see: Optional[float] = None
    would_see_in_a_block: Optional[float] = None
    observed: Optional[float] = None  #: The judged deviation or metric.
    interval: Optional[Tuple[float, float]] = None  #: Of ``observed``.
    tiles: List[Tile] = field(default_factory=list)  #: Of a failure, worst first.
    #: Of two images with variances: the tests of pixels, blocks and the whole image.
    parts: Mapping[str, Mapping[str, Any]] = field(default_factory=dict)

    def __bool__(self) -> bool:
        return self.verdict == "pass"

    def __str__(self) -> str:
        return f"{self.verdict}: {self.sentence}"


_Stated = Tuple[Any, Any, Dict[str, str]]


def _stated(value: Any, name: str) -> Optional[_Stated]:
    """Image, variance and metadata of a Rendering or a pair; None for anything else."""
    if isinstance(value, Rendering):
        if value.variance is None:
            raise refusal(name, "has no variance: render with two passes or more, or give several images")
        return pixels_of(value, name), pixels_of(value.variance, f"the variance of {name}"), value.metadata
    if isinstance(value, tuple) and len(value) == 2:
        return pixels_of(value[0], name), pixels_of(value[1], f"the variance of {name}"), {}
    return None


def _images(value: Any, name: str) -> List[Any]:
    """Several images: a list, or an array of shape (images, height, width, 3)."""
    if isinstance(value, np.ndarray) and value.ndim == 4 or isinstance(value, (list, tuple)):
        return [pixels_of(image, f"{name}[{i}]") for i, image in enumerate(value)]
    raise refusal(name, "is neither a Rendering, nor a pair of image and variance, nor a list of images")


def _verdict_of(judged: Dict[str, Any]) -> Verdict:
    return Verdict(judged["verdict"], judged["sentence"], judged["would_see"], judged["would_see_in_a_block"],
                   judged["observed"], judged["interval"], [Tile(*tile) for tile in judged["tiles"]])


def _verdict_of_pair(found: Dict[str, Any]) -> Verdict:
    parts = {name: found[name] for name in ("pixels", "blocks", "whole")}
    failing = [part["sentence"] for part in parts.values() if not part["pass"]]
    if found["inconclusive"]:
        return Verdict("inconclusive", "pixels share noise, and the images do not state their means' standard errors",
                       parts=parts)
    return Verdict("fail" if failing else "pass", "; ".join(failing) or found["power"], found["would_see"], parts=parts)


def mean(images: Any) -> Rendering:
    """The mean of independent images, two or more, with the variance of that mean."""
    return rendering_from(_native.mean_of_images(_images(images, "images")), {})


def agreement(images_a: Any, images_b: Any, *, alpha: float = 0.01, shared_noise: bool = False) -> Verdict:
    """Whether both sides have the same expected image.

    A side is a Rendering with variance, a pair (image, variance), or a list of independent images: renders that differ
    in their seeds alone. ``alpha`` is the probability of a failure by chance.

    Two images with variances are compared as ``photonproof compare --agreement`` does. ``shared_noise``: pixels gather
    the same photons. A list of three images or more is compared with the other side as a gate does.
    """
    a, b = _stated(images_a, "images_a"), _stated(images_b, "images_b")
    if a is not None and b is not None:
        return _verdict_of_pair(_native.agreement(a, b, alpha, shared_noise))
    if shared_noise:
        raise refusal("shared_noise", "is for two images with variances")
    if b is not None:
        a, b, images_a, images_b = b, None, images_b, images_a
    batches = 0
    if a is None:
        several = _images(images_a, "images_a")
        batches = len(several)
        parts = _native.mean_of_images(several)
        a = (parts[0], parts[1], {})
    return _verdict_of(_native.judge(
        _images(images_b, "images_b"), a, provenance=None, name="images_a", batches=batches, metric="agreement",
        bound=math.inf, block_bound=math.inf, alpha=alpha, looks=1, spp=None, unbiased=True, exposure=0.0))


def _reference(value: Any) -> Tuple[_Stated, Optional[str], str, int]:
    """The reference of a gate, the text and name of its provenance, and the number of images behind it."""
    if isinstance(value, (str, os.PathLike)):
        path = os.fspath(value)
        stored = read(path)
        provenance = os.path.splitext(path)[0] + ".json"
        text = None
        if os.path.exists(provenance):
            with open(provenance, encoding="utf-8") as file:
                text = file.read()
        return (stored.image, stored.variance, stored.metadata), text, provenance, 0
    if isinstance(value, list) or isinstance(value, np.ndarray) and value.ndim == 4:
        several = _images(value, "reference")
        parts = _native.mean_of_images(several)
        return (parts[0], parts[1], {}), None, "reference", len(several)
    if isinstance(value, Rendering) and value.variance is None or not isinstance(value, (Rendering, tuple)):
        return (pixels_of(value, "reference"), None, {}), None, "reference", 0
    stated = _stated(value, "reference")
    assert stated is not None
    return stated, None, "reference", 0


def gate(images: Any, reference: Any, bound: float, metric: str = "agreement", *, block_bound: Optional[float] = None,
         alpha: float = 0.001, looks: int = 1, spp: Optional[float] = None, unbiased: bool = True,
         exposure: float = 0.0) -> Verdict:
    """Decides one gate on images that were rendered with different seeds, three or more, as ``photonproof gate`` does.

    reference: the path of an EXR, whose provenance beside it is used, too; a Rendering; a pair (image, variance); a list
    of images; or one image whose noise is unknown.
    metric: "agreement", "bias" (of the whole image), "block_bias", or a metric of compare such as "ssim".
    bound: of the metric; for agreement, the relative error that must be found with probability 0.99. With fewer images
    than that needs, the verdict is inconclusive. block_bound: the same for blocks of 8 x 8 pixels; else 5 times bound.
    alpha: the probability of a failure by chance, over all looks. looks: the number of times that you may look, each
    time with more images. spp: samples per pixel of an image, where known. unbiased: the images' noise averages out.
    """
    stated, provenance, name, batches = _reference(reference)
    return _verdict_of(_native.judge(
        _images(images, "images"), stated, provenance=provenance, name=name, batches=batches, metric=metric,
        bound=bound, block_bound=5 * bound if block_bound is None else block_bound, alpha=alpha, looks=looks, spp=spp,
        unbiased=unbiased, exposure=exposure))
