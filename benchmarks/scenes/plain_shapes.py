"""Shapes of plain things: how far they rise above the land at places along and across them.

Arguments are metres along (u) and across (v), then the sizes of a row. What is earth returns a rise
everywhere, 0 beside it. What stands on the land returns minus infinity beside it.
"""

from __future__ import annotations

import numpy as np

from .relief import smooth

# Metres in plan that an upright wall of earth takes, so that it is a wall at any density.
_FACE = 0.25
# Fall over run of ramps, and of those to bridges.
_RAMP, _APPROACH = 0.15, 0.06


def _trapezoid(distance, top, flank):
    """Return 1 within half the top, and a straight fall to 0 over `flank` metres beside it."""
    return np.clip(1.0 - (distance - top / 2) / flank, 0.0, 1.0)


def bowl(u, v, width, depth):
    r = np.minimum(np.hypot(u, v) / (width / 2), 1.0)
    return -depth * 0.5 * (1.0 + np.cos(np.pi * r))


def crater(u, v, width, depth):
    r = np.hypot(u, v) / (width / 2)
    rim = 0.2 * depth * np.exp(-(((r - 1.15) * width / 2 / 0.7) ** 2))
    return -depth * np.clip(1.0 - r**2, 0.0, None) + rim


def funnel(u, v, width, depth):
    return -depth * np.clip(1.0 - np.hypot(u, v) / (width / 2), 0.0, None)


def pit(u, v, width, depth):
    return -depth * _trapezoid(np.hypot(u, v), width - 0.6, 0.3)


def cellar(u, v, width, depth, length):
    inside = np.minimum(width / 2 - np.abs(v), length / 2 - np.abs(u))
    return -depth * np.clip(inside / _FACE, 0.0, 1.0)


def ramp(u, v, width, depth):
    run = depth / _RAMP
    down = np.clip((u + run / 2) / run, 0.0, 1.0) * (u < run / 2 + 5.0)
    return -depth * down * _trapezoid(np.abs(v), width, _FACE)


def trench(u, v, width, depth):
    along = np.clip((u + 25.0) / (depth / 0.2), 0.0, 1.0) * (u < 20.0)
    return -depth * along * _trapezoid(np.abs(v), width, _FACE)


def ditch(u, v, width, depth):
    return -depth * np.clip(1.0 - np.abs(v) / (width / 2), 0.0, None)


def hollow_way(u, v, width, depth):
    return -depth * smooth(1.5 - 2.0 * np.abs(v + 3.0 * np.sin(u / 15.0)) / width)


def cutting(u, v, bottom, depth):
    return -depth * _trapezoid(np.abs(v), bottom, 1.5 * depth)


def crest(u, v, width, height):
    return height * np.clip(1.0 - np.abs(v + 2.0 * np.sin(u / 12.0)) / (width / 2), 0.0, None)


def crag(u, v, width, height):
    """A crest of rock: steep, broken, and lower towards its ends."""
    broken = 1.0 + 0.15 * np.sin(u * 1.1) * np.sin(v * 0.9 + u * 0.5)
    return crest(u, v, width, height) * broken * smooth(2.0 - np.abs(u) / 15.0)


def rock(u, v, width, height):
    """A rock that rises from one side and ends at a face."""
    back = np.clip((u + width / 2) / width, 0.0, 1.0) * np.clip((width / 2 - u) / 0.5, 0.0, 1.0)
    bumps = 1.0 + 0.1 * np.sin(u * 1.7) * np.cos(v * 1.3)
    return height * back * smooth(2.0 - 4.0 * np.abs(v) / width) * bumps


def dyke(u, v, top, height, flank=2.0):
    return height * _trapezoid(np.abs(v), top, flank * height)


def embankment(u, v, top, height):
    return dyke(u, v, top, height, 1.5)


def levee(u, v, top, height):
    return dyke(u, v, top, height, 3.0)


def plateau(u, v, side, height, run):
    """A raised square with walls, and one way up."""
    inside = side / 2 - np.maximum(np.abs(u), np.abs(v))
    way = np.where(np.abs(v) < side / 6, (side / 2 + run - u) / run, 0.0) * (u > 0)
    return height * np.clip(np.maximum(inside / _FACE, way), 0.0, 1.0)


def bund(u, v, top, height):
    return dyke(u, v, top, height, 1.0)


def approach(u, v, width, height):
    """A ramp between walls up to the abutment of a bridge."""
    run = height / _APPROACH
    up = np.clip(u / run + 0.5, 0.0, 1.0) * np.clip((run / 2 - u) / _FACE, 0.0, 1.0)
    return height * up * np.clip((width / 2 - np.abs(v)) / _FACE, 0.0, 1.0)


def bend(u, v, width, height, radius=60.0):
    """An `approach` along an arc."""
    r, along = np.hypot(u, v - radius), np.arctan2(u, radius - v) * radius
    return approach(along, r - radius, width, height)


def moat(u, v, side, width, depth, is_land=False):
    """A square island behind a moat with upright walls."""
    out = np.maximum(np.abs(u), np.abs(v)) - side / 2
    return out < 0 if is_land else -depth * _trapezoid(np.abs(out - width / 2), width, _FACE)


def channels(u, v, between, width, depth, is_land=False):
    """Land between two parallel channels with upright walls."""
    out = np.abs(v) - between / 2
    return out < 0 if is_land else -depth * _trapezoid(np.abs(out - width / 2), width, _FACE)


def fissures(u, v, side, width, depth, is_land=False):
    """Plates between fissures."""
    out = np.maximum(*(np.abs(np.mod(axis, side) - side / 2) for axis in (u, v))) - side / 2
    inside = np.maximum(np.abs(u), np.abs(v)) < 2.5 * side + width
    fall = np.where(inside, _trapezoid(-out, width, _FACE), 0.0)
    return inside & (fall == 0.0) if is_land else -depth * fall


def bank(u, v, width, height):
    return height * smooth(1.0 - np.abs(v) / (width / 2))


def terraces(u, v, width, height):
    number = np.floor((v + 1000.0) / width)
    within = (v + 1000.0) - number * width
    number = np.clip(number - np.floor(1000.0 / width), -2.0, 2.0)
    rise = np.where(np.abs(v) < 2.5 * width, np.clip((within - width) / _FACE + 1.0, 0.0, 1.0), 0.0)
    return height * np.clip(number + rise, -2.0, 2.0)


def scarp(u, v, run, height):
    return height * np.clip(v / run + 0.5, 0.0, 1.0)


def benches(u, v, width, height):
    """A pit of three benches, whose faces stand at 70 degrees."""
    edge, face = np.maximum(np.abs(u), np.abs(v)) - 12.0, 0.36 * height
    step = width + face
    return -3 * height + sum(height * np.clip((edge - k * step) / face, 0.0, 1.0) for k in range(3))


def ruin(u, v, side, height):
    ring = np.abs(np.maximum(np.abs(u), 1.4 * np.abs(v)) - side / 2)
    inner = np.where(np.abs(v) * 1.4 < side / 2, np.abs(u - side / 8), np.inf)
    return height * np.exp(-((np.minimum(ring, inner) / 1.1) ** 2))


def mound(u, v, width, height):
    return -bowl(u, v, width, height)


def butte(u, v, width, height):
    """A table mountain: rough, and its sides take metres to fall."""
    bend = 0.05 * width * np.sin(3.0 * np.arctan2(v, u))
    rough = 0.2 * np.sin(u * 1.3 + 0.7 * v) * np.sin(v * 1.1 - 0.4 * u)
    return (height + rough) * _trapezoid(np.hypot(u, v) + bend, width - 3.0, 3.0)


def table(u, v, length, width, height):
    """A table mountain of rock, whose sides stand at 70 degrees."""
    rough = 0.2 * np.sin(u * 1.3 + 0.7 * v) * np.sin(v * 1.1 - 0.4 * u)
    bend = 1.5 * np.sin(u / 5.0 + v / 7.0)
    out = np.maximum(np.abs(u) - length / 2, np.abs(v) - width / 2) + bend
    return (height + rough) * np.clip(-out / (0.36 * height), 0.0, 1.0)


def heap(u, v, width, height):
    return -funnel(u, v, width, height)


def _within(u, v, length, width, rise):
    return np.where((np.abs(u) <= length / 2) & (np.abs(v) <= width / 2), rise, -np.inf)


def flat(u, v, length, width, eaves):
    return _within(u, v, length, width, eaves)


def gable(u, v, length, width, eaves, pitch=0.5):
    return _within(u, v, length, width, eaves + pitch * (width / 2 - np.abs(v)))


def low_gable(u, v, length, width, eaves):
    return gable(u, v, length, width, eaves, 0.1)


def lean_to(u, v, length, width, eaves, pitch=0.12):
    return _within(u, v, length, width, eaves + pitch * (width / 2 + v))


def court(u, v, length, width, eaves):
    yard = (np.abs(u) < 0.25 * length) & (np.abs(v) < 0.25 * width)
    return np.where(yard, -np.inf, flat(u, v, length, width, eaves))


def angled(u, v, length, width, eaves):
    """A flat roof in the shape of an L, whose wings are a third of the sides wide."""
    missing = (u > -length / 6) & (v > -width / 6)
    return np.where(missing, -np.inf, flat(u, v, length, width, eaves))


def stepped(u, v, length, width, eaves):
    """A hall whose middle part stands higher than its ends."""
    return flat(u, v, length, width, eaves) + 3.0 * (np.abs(u) < length / 5)


def a_frame(u, v, length, width, height):
    return gable(u, v, length, width, 0.0, 2.0 * height / width)


def _row(v, width, gap, count):
    """Return metres across the row that a place lies in; many where there is none."""
    place = v / (width + gap) + count / 2
    across = (np.mod(place, 1.0) - 0.5) * (width + gap)
    return np.where((place > 0) & (place < count), across, 1e6)


def vaults(u, v, length, width, height, gap, count):
    """Tunnels side by side, round from the ground on."""
    across = _row(v, width, gap, count)
    arch = height * np.sqrt(np.clip(1.0 - (2 * across / width) ** 2, 0.0, 1.0))
    return _within(u, across, length, width, arch)


def glasshouses(u, v, length, width, eaves, gap, count):
    """Houses with gables side by side."""
    return gable(u, _row(v, width, gap, count), length, width, eaves)


def panels(u, v, length, width, low, tilt, gap, count):
    """Rows of panels, tilted towards one side."""
    return lean_to(u, _row(v, width, gap, count), length, width, low, tilt)


def boxes(u, v, length, width, height, gap, count):
    """As many boxes by as many, a gap apart."""
    return flat(_row(u, length, gap, count), _row(v, width, gap, count), length, width, height)


def domes(u, v, width, height, gap, count):
    """As many round bushes by as many, a gap apart."""
    r = 2.0 * np.hypot(_row(u, width, gap, count), _row(v, width, gap, count)) / width
    return np.where(r <= 1.0, height * (0.35 + 0.65 * np.sqrt(np.clip(1 - r**2, 0, 1))), -np.inf)


def cushions(u, v, width, height, count):
    """Dense bushes in a row, which touch, each second one lower."""
    across, low = _row(u, width, 0.0, count), np.mod(np.floor(u / width + count / 2), 2.0)
    r = 2.0 * np.hypot(across, v) / width
    arch = (1.0 - 0.4 * low) * height * np.sqrt(np.clip(1.0 - r**2, 0.0, 1.0))
    return np.where(r <= 1.0, arch, -np.inf)


def crop_rows(u, v, height, cover, apart):
    """Rows of a crop, whose cover is in percent."""
    on = np.abs(np.mod(v / apart, 1.0) - 0.5) < cover / 200.0
    return np.where(on, height, -np.inf)


def steps(v, width, gap, count, rise):
    """Return how high level terraces lie, each `rise` higher than the one before."""
    place = (v / (width + gap) + count / 2) * np.ones_like(v)
    number = np.clip(np.floor(place), 0.0, count - 1.0)
    within = np.clip((place - number) * (width + gap) / _FACE, 0.0, 1.0)
    return rise * np.where(number > 0, number - 1.0 + within, 0.0)


def terraced_halls(u, v, length, width, eaves, gap, count, rise):
    """Halls on terraces, each in the middle of its own."""
    return flat(u, _row(v, width, gap, count), length, width, eaves)


def ship(u, v, length, width, deck):
    """A ship whose stern has a bridge, beside a quay along the middle."""
    across = v + width / 2 + 1.0
    narrow = np.clip((length / 2 - u) / width, 0.0, 1.0)
    hull = flat(u, across / np.maximum(narrow, 1e-6), length, width, deck)
    return hull + 8.0 * ((u < -0.35 * length) & (u > -0.45 * length))


def aisled(u, v, length, width, eaves, aisle):
    """A hall 6 m higher than the aisle that is all round it."""
    nave = flat(u, v, length - 2.0 * aisle, width - 2.0 * aisle, 0.0)
    return flat(u, v, length, width, eaves) + 6.0 * np.isfinite(nave)


def hemisphere(u, v, width):
    return np.sqrt(np.maximum((width / 2) ** 2 - u**2 - v**2, 0.0)) + drum(u, v, width, 0.0)


def drum(u, v, width, height):
    return np.where(np.hypot(u, v) <= width / 2, height, -np.inf)
