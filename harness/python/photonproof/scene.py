"""Scenes and their renders."""
from __future__ import annotations

import os
import warnings
from typing import Any, Callable, Dict, List, Mapping, Optional, Sequence, Tuple

from . import _native
from ._errors import RenderWarning
from .images import Rendering, rendering_from

#: Called with the fraction done, from 0 to 1, and the phase. False ends the render early.
Progress = Callable[[float, str], Any]


class Scene:
    """A scene that was read, by :func:`load`."""

    def __init__(self, native: "_native.Scene") -> None:
        self._native = native

    @property
    def width(self) -> int:
        """Width of the whole image in pixels."""
        return self._native.size[0]

    @property
    def height(self) -> int:
        """Height of the whole image in pixels."""
        return self._native.size[1]

    @property
    def spp(self) -> int:
        """The scene's own samples per pixel, the budget of a render without another one."""
        return self._native.spp

    @property
    def integrator(self) -> str:
        """Name of the scene's own integrator."""
        return self._native.integrator

    @property
    def files(self) -> List[str]:
        """The scene's file, and those that it includes."""
        return list(self._native.files)

    @property
    def notes(self) -> List[str]:
        """Differences from the file: stand-ins, and what ``lenient`` left out."""
        return list(self._native.notes)

    def render(self, integrator: str = "", *, spp: Optional[int] = None, photons: Optional[int] = None,
               seconds: Optional[float] = None, target_error: Optional[float] = None, seed: int = 0, threads: int = 0,
               indirect: Optional[str] = None, sampler: str = "sobol", grid: int = 0, view: str = "whole",
               crop: Optional[Tuple[int, int, int, int]] = None, no_skip: Sequence[str] = (), isa: str = "",
               denoise: bool = False, progress: Optional[Progress] = None) -> Rendering:
        """Renders to ``image, variance, stats``, as ``photonproof render`` does with the options of these names.

        The same scene, request and budget in samples or photons give the same bits, for any number of threads. The
        image is the renderer's own memory and not copied. The GIL is released. Ctrl-C ends the render at the next pass
        and raises KeyboardInterrupt.

        integrator: "path", "photonmapper", "bdpt" and so on; empty: the scene's own.
        spp, photons, seconds, target_error: the budget. Without one, the scene's samples per pixel.
        seed: of the random numbers. threads: 0 for every core.
        crop: x, y, width and height of the pixels to render.
        progress: called in this thread with the fraction done and the phase. If it returns False, the render ends
            early; ``stats["interrupted"]`` is then True, and the image is that of the samples so far.

        Raises InputError where the scene or the request cannot be rendered. Issues RenderWarning.
        """
        def warn(text: str) -> None:
            warnings.warn(text, RenderWarning, stacklevel=3)

        *parts, stats = self._native.render(
            integrator=integrator, indirect=indirect, spp=spp, photons=photons, seconds=seconds,
            target_error=target_error, seed=seed, threads=threads, grid=grid, sampler=sampler, view=view,
            no_skip=list(no_skip), isa=isa, crop=crop, denoise=denoise, progress=progress, warn=warn)
        return rendering_from(parts, stats)

    def __repr__(self) -> str:
        return f"<photonproof.Scene {self.files[0] if self.files else ''} {self.width}x{self.height} {self.integrator}>"


def load(path: "str | os.PathLike[str]", *, size: Optional[Tuple[int, int]] = None,
         defines: Optional[Mapping[str, object]] = None, sensor: int = 0, allow_outside: bool = False,
         lenient: bool = False, as_mitsuba: bool = False) -> Scene:
    """Reads a scene of Mitsuba's format.

    size: (width, height) of the image; else the scene's. defines: values of the scene's ``$name``.
    sensor: which of the scene's cameras, from 0. allow_outside: files outside the scene's folder may be read.
    lenient: leaves out what cannot be read, with a note for each. as_mitsuba: follows Mitsuba where it is wrong.

    Raises InputError, with file:line:col, for anything outside the format.
    """
    values: Dict[str, str] = {name: str(value) for name, value in (defines or {}).items()}
    return Scene(_native.load(os.fspath(path), defines=values, size=size, sensor=sensor, allow_outside=allow_outside,
                              lenient=lenient, as_mitsuba=as_mitsuba))
