"""A picture that is drawn on: words, lines, dots, maps and the keys of their colours."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from PIL import Image, ImageDraw, ImageFont

_SHARPER = 2  # drawn so many times larger than shown, so that lines and letters have smooth edges


class Canvas:
    """A picture on which places are pixels of what is shown, from its upper left corner."""

    def __init__(self, width: int, height: int) -> None:
        self.image = Image.new("RGB", (width * _SHARPER, height * _SHARPER), "white")
        self._draw = ImageDraw.Draw(self.image)

    def text(self, x: float, y: float, words: str, size: int = 14, anchor: str = "la") -> None:
        """Write words whose `anchor`, as Pillow names it, is at a place."""
        font = ImageFont.load_default(size * _SHARPER)
        place = x * _SHARPER, y * _SHARPER
        self._draw.text(place, words, fill="#222222", font=font, anchor=anchor)

    def line(self, x: np.ndarray, y: np.ndarray, width: float = 1, colour: str = "#222222") -> None:
        """Draw a line through places."""
        places = np.column_stack((x, y)).ravel() * _SHARPER
        self._draw.line(places.tolist(), colour, round(width * _SHARPER))

    def dots(self, x: np.ndarray, y: np.ndarray, size: float, colour: str) -> None:
        """Draw squares."""
        half = size * _SHARPER / 2
        for left, top in (np.column_stack((x, y)) * _SHARPER - half).tolist():
            self._draw.rectangle((left, top, left + 2 * half, top + 2 * half), colour)

    def pixels(self, pixels: np.ndarray, x: int, y: int, shape: tuple[int, int]) -> None:
        """Show an array, (rows, columns, 3), in a width and height."""
        size = shape[0] * _SHARPER, shape[1] * _SHARPER
        shown = Image.fromarray(pixels).resize(size, Image.Resampling.NEAREST)
        self.image.paste(shown, (x * _SHARPER, y * _SHARPER))

    def keys(self, x: float, y: float, labels: dict[str, str]) -> None:
        """Explain colours in a row, by the label of each."""
        for colour, label in labels.items():
            self.dots(np.array([x + 6]), np.array([y]), 12, colour)
            self.text(x + 18, y, label, anchor="lm")
            x += 18 + ImageFont.load_default(14).getlength(label) + 18

    def save(self, target: Path) -> None:
        """Write it."""
        self.image.reduce(_SHARPER).save(target, optimize=True)
