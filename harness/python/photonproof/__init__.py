"""photonproof: renders scenes by photon mapping and path tracing, and measures images with proof.

  import photonproof
  image, variance, stats = photonproof.load("scene.xml").render("photonmapper", spp=64)
  photonproof.compare("reference.exr", image)
"""
from . import metrics, program
from ._errors import InputError, RenderWarning
from ._native import version
from .images import Image, Rendering, read, write
from .metrics import (Comparison, bias, compare, differing, flip, hdr_flip, mae, max_abs, mrse_pbrt, ms_ssim, mse, psnr,
                      relmse, relmse_jeri, relmse_trimmed, rmse, smape, ssim)
from .record import Record
from .scene import Scene, load
from .verdicts import Tile, Verdict, agreement, gate, mean

__all__ = [
    "Comparison", "Image", "InputError", "Record", "Rendering", "RenderWarning", "Scene", "Tile", "Verdict", "agreement",
    "bias", "compare", "differing", "flip", "gate", "hdr_flip", "load", "mae", "max_abs", "mean", "metrics",
    "mrse_pbrt", "ms_ssim", "mse", "program", "psnr", "read", "relmse", "relmse_jeri", "relmse_trimmed", "rmse", "smape",
    "ssim", "version", "write",
]
