"""The place of the cells of a raster, as rasterio has it."""

from __future__ import annotations

from typing import Any, Iterable, NamedTuple

from ..core.errors import BareEarthError


class Transform(NamedTuple):
    """Maps columns and rows to x and y as `affine.Affine`, which stands in its place if it is
    installed.
    """

    a: float  # x of the next column, less that of a column
    b: float  # the same of rows
    c: float  # x of the corner where columns and rows begin
    d: float
    e: float
    f: float
    g: float = 0.0
    h: float = 0.0
    i: float = 1.0

    def __invert__(self) -> Transform:
        """Return the transform of x and y to columns and rows."""
        a, b, c, d, e, f = self[:6]
        scale = a * e - b * d
        if not scale:
            raise BareEarthError("A transform that maps all cells to one line has no inverse.")
        a, b, d, e = e / scale, -b / scale, -d / scale, a / scale
        return Transform(a, b, -c * a - f * b, d, e, -c * d - f * e)

    def __mul__(self, given: Any) -> Any:
        """Return x and y of a column and a row, numbers or arrays, or two transforms as one."""
        a, b, c, d, e, f = self[:6]
        if len(given) == 2:
            column, row = given
            return a * column + b * row + c, d * column + e * row + f
        k, m, x, n, o, y = given[:6]
        x, y = self * (x, y)
        return Transform(a * k + b * n, a * m + b * o, x, d * k + e * n, d * m + e * o, y)

    def __matmul__(self, given: Any) -> Any:
        """Return what `*` returns; newer versions of affine ask for `@`."""
        return self * given

    def to_gdal(self) -> tuple[float, ...]:
        """Return the geotransform of GDAL."""
        return geotransform_of(self)


def transform_of(numbers: Iterable[float]) -> Any:
    """Return six numbers in the order of `affine.Affine` as one, or as a `Transform`."""
    six = [float(number) for number in tuple(numbers)[:6]]
    try:
        from affine import Affine
    except ImportError:
        return Transform(*six)
    return Affine(*six)


def geotransform_of(transform: Iterable[float]) -> tuple[float, ...]:
    """Return the geotransform of GDAL, as plain numbers."""
    a, b, c, d, e, f = map(float, tuple(transform)[:6])
    return c, a, b, f, d, e
