"""Assertions on images for pytest, with pictures on failure.

  def test_my_renderer(assert_agrees):
      assert_agrees(my_render(), "golden.exr", bound=0.02)

A failure writes image, golden image and heat maps as PNG into ``photonproof-failures/NAME-OF-THE-TEST``;
``--photonproof-pictures FOLDER`` names another folder.
"""
from __future__ import annotations

import os
import re
from pathlib import Path
from typing import Any, Iterator, List, Optional

import pytest

from .checks import AgreementError, check_agrees


def pytest_addoption(parser: pytest.Parser) -> None:
    parser.getgroup("photonproof").addoption(
        "--photonproof-pictures", metavar="FOLDER", default="photonproof-failures",
        help="folder for pictures of images that fail (default: photonproof-failures)")


@pytest.fixture
def assert_agrees(request: pytest.FixtureRequest) -> Iterator[Any]:
    """``assert_agrees(image, "golden.exr", bound=0.02)``: fails the test where the metric breaks the bound.

    The arguments are those of photonproof.checks.check_agrees.
    """
    name = re.sub(r"[^\w.-]+", "_", request.node.nodeid).strip("_")
    folder = Path(request.config.getoption("--photonproof-pictures")) / name
    calls: List[int] = []

    def check(image: Any, golden: "str | os.PathLike[str] | Any", bound: float, metric: str = "flip",
              exposure: float = 0.0, mask: Optional[Any] = None) -> float:
        __tracebackhide__ = True
        calls.append(1)
        place = folder if len(calls) == 1 else folder.with_name(f"{folder.name}-{len(calls)}")
        try:
            return check_agrees(image, golden, bound, metric=metric, exposure=exposure, mask=mask, pictures=place)
        except AgreementError as error:
            request.node.user_properties.append(("photonproof_pictures", str(place)))
            pytest.fail(str(error), pytrace=False)

    yield check
