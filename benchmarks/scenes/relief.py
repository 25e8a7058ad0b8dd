"""Shapes of land, to be put together."""

from __future__ import annotations

import numpy as np

from .landscape import Surface


def waves(random: np.random.Generator, amplitude: float, length: float, count: int = 5) -> Surface:
    """Return hills and hollows: waves of some lengths round `length` in all directions.

    Parameters
    ----------
    amplitude : float
        Standard deviation of the heights in metres.
    length : float
        Metres from crest to crest.
    """
    turn, phase = random.uniform(0, 2 * np.pi, (2, count))
    numbers = 2 * np.pi / (length * random.uniform(0.7, 1.5, count))
    east, north = numbers * np.cos(turn), numbers * np.sin(turn)
    scale = amplitude * np.sqrt(2.0 / count)

    def height(x: np.ndarray, y: np.ndarray) -> np.ndarray:
        total = np.zeros(np.shape(x))
        for number in range(count):
            total += np.sin(east[number] * x + north[number] * y + phase[number])
        return scale * total

    return height


def patches(random: np.random.Generator, length: float, share: float) -> Surface:
    """Return where something grows: irregular patches that cover about a share of the land."""
    field = waves(random, 1.0, length)
    level = np.sqrt(2.0) * _normal_quantile(1.0 - share)
    return lambda x, y: field(x, y) > level / np.sqrt(2.0)


def _normal_quantile(share: float) -> float:
    from scipy.special import ndtri

    return float(ndtri(np.clip(share, 0.001, 0.999)))


def smooth(share: np.ndarray) -> np.ndarray:
    """Return a smooth step from 0 to 1."""
    share = np.clip(share, 0.0, 1.0)
    return share * share * (3.0 - 2.0 * share)


def steps(distance: np.ndarray, width: float, height: float, face: float) -> np.ndarray:
    """Return stairs: treads of `width`, risers of `height` that take `face` metres in plan."""
    number = np.floor(distance / width)
    within = distance - number * width
    return height * (number + np.clip((within - (width - face)) / face, 0.0, 1.0))


def bank(distance: np.ndarray, run: float) -> np.ndarray:
    """Return a straight rise from 0 to 1 over `run` metres, half of it before 0."""
    return np.clip(distance / run + 0.5, 0.0, 1.0)


def blend(one: np.ndarray, another: np.ndarray, share: np.ndarray) -> np.ndarray:
    """Return `another` where the share is 1, and `one` where it is 0."""
    return one + (another - one) * share


def yard(terrain: np.ndarray, level: float, inside: np.ndarray, margin: float) -> np.ndarray:
    """Return a terrain with a level yard: `inside` metres within, sloping over `margin` outside."""
    return blend(terrain, np.full_like(terrain, level), smooth(1.0 + inside / margin))
