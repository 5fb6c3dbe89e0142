"""Make the pictures of a page small: lossless, with each repeated pixel once, since browsers repeat it themselves."""

from __future__ import annotations

import base64
import io
from functools import lru_cache

import numpy as np
from PIL import Image


@lru_cache(maxsize=256)  # a report may show one picture in several places
def held(png: bytes) -> tuple[str, int, int]:
    """Return a PNG's picture as the address of an image that holds its own bytes, and its width and height for a page.

    The image is lossless WebP, and has one pixel for each square of equal pixels if the whole picture consists of such
    squares; the width and the height are those of the PNG.
    """
    with Image.open(io.BytesIO(png)) as opened:
        picture = opened.convert("RGBA" if "A" in opened.mode or "transparency" in opened.info else "RGB")
    width, height = picture.size
    pixels = np.asarray(picture)
    times = next((n for n in range(8, 1, -1) if _consists_of_squares(pixels, n)), 1)
    made = io.BytesIO()
    Image.fromarray(np.ascontiguousarray(pixels[::times, ::times])).save(
        made, "WEBP", lossless=True, method=3, quality=50
    )
    return f"data:image/webp;base64,{base64.b64encode(made.getvalue()).decode()}", width, height


def _consists_of_squares(pixels: np.ndarray, n: int) -> bool:
    """Tell whether pixels [height, width, channels] are squares of n × n equal ones."""
    height, width, channels = pixels.shape
    if height % n or width % n:
        return False
    squares = pixels.reshape(height // n, n, width // n, n, channels)
    return bool((squares == squares[:, :1, :, :1]).all())
