"""The figures of the quality of a survey, computed anew from docs/quality.md with NumPy alone."""

import itertools

import numpy as np

# Returns of points that were measured, in metres; sides of the cells of a survey.
SIZE, COARSE, SQUARE, VOID = 1.0, 2.0, 10.0, 3.0
STEEP, FLAT = np.tan(np.radians((45.0, 10.0)))


def quality_by_hand(points, is_made, spacing, least):
    """Return figures of points, a dict of columns; `is_made` are those that nobody measured."""
    every = {name: np.asarray(column) for name, column in points.items()}
    noise, withheld = np.isin(every["classification"], (7, 18)), every["withheld"] > 0
    kept = ~withheld & ~noise & ~is_made
    some = {name: column[kept] for name, column in every.items()}
    corner = [np.floor(every[axis].min() / SQUARE) * SQUARE for axis in "xy"]
    shape = [int(np.floor(every[axis].max() / COARSE) - low / COARSE) + 1
             for axis, low in zip("xy", corner)][::-1]  # fmt: skip
    coarse = cells(some, corner, COARSE)
    fine = cells(some, corner, SIZE)
    first, last = some["return_number"] == 1, some["return_number"] == some["number_of_returns"]
    ground, wet = some["classification"] == 2, some["classification"] == 9
    fine_shape = [2 * count for count in shape]

    # The area: squares of 10 m.
    present = counted(cells({n: c[~withheld] for n, c in every.items()}, corner, COARSE), shape) > 0
    inside = without_holes(squares(present))
    inner = inside.copy()
    for row, column in itertools.product((-1, 0, 1), repeat=2):
        inner &= shifted(inside, row, column, False)
    is_wet = counted(coarse[:, wet], shape) > 0
    dry = inner & ~squares(is_wet)
    inner, dry = (blown_up(values, 5, shape) for values in (inner, dry))
    area = np.count_nonzero(inner) * COARSE**2
    inner_fine, dry_fine = (blown_up(values, 2, fine_shape) for values in (inner, dry))

    pulses, returns, bare = (
        counted(fine[:, which], fine_shape) for which in (first, first | True, ground)
    )
    found = {"area": area, "strips": sorted(set(every["point_source_id"][~withheld & ~is_made]))}
    found["pulse_density"] = pulses[inner_fine].sum() / area
    found["point_density"] = returns[inner_fine].sum() / area
    found["ground_density"] = bare[inner_fine].sum() / area
    of_four = counted(coarse[:, first], shape)[inner]
    found["dense_share"] = np.mean(of_four / COARSE**2 >= least)
    far = np.ones(fine_shape, dtype=bool)
    reach = int(VOID / SIZE)
    for row, column in itertools.product(range(-reach, reach + 1), repeat=2):
        if np.hypot(row, column) * SIZE <= VOID:
            far &= ~shifted(bare > 0, row, column, False)
    found["ground_void_share"] = np.mean(far[dry_fine])

    # Cells of twice the pulse spacing.
    side = 2 * spacing
    start = [np.floor(every[axis].min() / side) for axis in "xy"]
    count = [int(np.floor(every[axis].max() / side) - low) + 1 for axis, low in zip("xy", start)]
    origin = [low * side for low in start]
    spaced = cells(some, origin, side)
    hit, water = (counted(spaced[:, which], count[::-1]) > 0 for which in (first, wet))
    middles = [
        np.clip(np.floor((low + side * (np.arange(number) + 0.5) - edge) / COARSE), 0, most - 1)
        for low, number, edge, most in zip(origin, count, corner, shape[::-1])
    ]
    column, row = (middle.astype(int) for middle in middles)
    land = dry[np.ix_(row, column)] & ~water
    empty = land & ~hit
    found["filled_share"] = np.mean(hit[land])
    of_two = empty[1:, 1:] & empty[:-1, 1:] & empty[1:, :-1] & empty[:-1, :-1]
    found["void_count"] = np.count_nonzero(of_two)

    # Strips.
    names = found["strips"]
    slots = {name: number for number, name in enumerate(names)}
    seen = np.zeros((len(names), *shape), dtype=int)
    lowest = np.full((len(names), *shape), np.inf)
    slot = np.array([slots[name] for name in some["point_source_id"]])
    np.add.at(seen, (slot, *coarse), 1)
    np.minimum.at(lowest, (slot[last], *coarse[:, last]), some["z"][last])
    several = (np.count_nonzero(seen, axis=0) > 1) & inner
    found["overlap_share"] = np.count_nonzero(several) / np.count_nonzero(inner)
    found["overlapping"] = np.count_nonzero(several)
    rough = counted(coarse[:, some["number_of_returns"] > 1], shape) > 0
    differences = {}
    order = np.lexsort(coarse[::-1])
    starts = np.searchsorted(coarse[0][order] * shape[1] + coarse[1][order],
                             np.arange(shape[0] * shape[1] + 1))  # fmt: skip
    fine_order = np.lexsort(fine[::-1])
    fine_starts = np.searchsorted(fine[0][fine_order] * fine_shape[1] + fine[1][fine_order],
                                  np.arange(fine_shape[0] * fine_shape[1] + 1))  # fmt: skip

    def ground_round(row, column, window):
        rows = range(max(row - window, 0), min(row + window + 1, fine_shape[0]))
        low, high = max(column - window, 0), min(column + window, fine_shape[1] - 1)
        there = [fine_order[fine_starts[r * fine_shape[1] + low] :
                            fine_starts[r * fine_shape[1] + high + 1]] for r in rows]  # fmt: skip
        there = np.concatenate(there)
        return there[ground[there]]

    def above_ground(point, row, column):
        """Return height and slope at a place above a plane through the ground around."""
        for window in (1, 2, 4, 10):
            near = ground_round(row, column, window)
            if len(near) < (6 if window < 10 else 1):
                continue
            _, which = np.unique(fine[:, near], axis=1, return_inverse=True)
            number = np.bincount(which.ravel())
            means = (np.bincount(which.ravel(), some[axis][near]) / number for axis in "xyz")
            plane, is_good = plane_through(*means, number)
            if is_good or window == 10:
                return [some["z"][p] - plane(some["x"][p], some["y"][p]) for p in point], abs(
                    plane.rise[0]
                ) + abs(plane.rise[1])
        return [np.nan] * len(point), np.nan

    for row, column in zip(*np.nonzero(np.count_nonzero(seen > 2, axis=0) > 1)):
        number = row * shape[1] + column
        there = order[starts[number] : starts[number + 1]]
        there = there[last[there]]
        heights = {}
        for r, c in set(zip(*fine[:, there].tolist())):
            mine = there[(fine[0][there] == r) & (fine[1][there] == c)]
            above, slope = above_ground(mine, r, c)
            for point, height in zip(mine, above):
                low = lowest[slot[point], row, column]
                if some["z"][point] <= low + 0.5 + slope * COARSE:
                    heights.setdefault(slot[point], []).append(height)
        means = {name: np.mean(values) for name, values in heights.items() if len(values) > 2}
        if len(means) < 2:
            continue
        tilts = {name: tilt(lowest[name], row, column) for name in means}
        for kind, steepest in enumerate((STEEP, FLAT)):
            even = [means[name] for name in means if tilts[name] <= steepest]
            if len(even) > 1:
                differences.setdefault(kind, {})[row, column] = max(even) - min(even)
    every_land, even_land = (near_others(differences.get(kind, {}), shape) for kind in (0, 1))
    apart = every_land[inner & ~np.isnan(every_land)]
    found["strip_shares"] = [
        np.mean(apart < 0.08), np.mean((apart >= 0.08) & (apart < 0.16)), np.mean(apart >= 0.16),
    ] if len(apart) else None  # fmt: skip
    apart = even_land[inner & ~rough & ~is_wet & ~np.isnan(even_land)]
    found["compared"] = len(apart)
    found["strip_rms"] = np.sqrt(np.mean(apart**2)) if len(apart) else None
    found["strip_largest"] = apart.max() if len(apart) else None
    return found


def cells(points, corner, size):
    """Return rows and columns of the cells of points."""
    x, y = (np.floor((points[axis] - low) / size + 1e-9) for axis, low in zip("xy", corner))
    return np.array((y, x), dtype=int)


def counted(place, shape):
    found = np.zeros(shape, dtype=int)
    np.add.at(found, tuple(place), 1)
    return found


def squares(values):
    """Return whether squares of 10 m hold a true cell."""
    rows, columns = (-(-count // 5) for count in values.shape)
    found = np.zeros((rows, columns), dtype=bool)
    row, column = np.nonzero(values)
    found[row // 5, column // 5] = True
    return found


def blown_up(values, times, shape):
    return np.kron(values, np.ones((times, times), dtype=bool))[: shape[0], : shape[1]]


def shifted(values, row, column, outside):
    """Return the values of the cells so many rows and columns farther."""
    reach = max(abs(row), abs(column))
    wide = np.pad(values, reach, constant_values=outside)
    rows, columns = values.shape
    return wide[reach + row : reach + row + rows, reach + column : reach + column + columns]


def without_holes(values):
    outside = np.pad(np.zeros(values.shape, dtype=bool), 1, constant_values=True)
    free, before = ~np.pad(values, 1), 0
    while before != (before := np.count_nonzero(outside)):
        steps = ((0, 1), (1, 0), (0, -1), (-1, 0))
        for step in steps:
            outside |= shifted(outside, *step, False) & free
    return ~outside[1:-1, 1:-1]


def plane_through(x, y, z, number):
    """Return the plane of least squares through the means of some numbers of points, level if they
    are few or on a line, and whether they are not.
    """
    x0, y0, z0 = (np.average(axis, weights=number) for axis in (x, y, z))
    spread = np.cov(x, y, bias=True, fweights=number) if len(x) > 1 else np.zeros((2, 2))
    total = spread[0, 0] + spread[1, 1]
    is_good = number.sum() > 5 and np.linalg.det(spread) > 0.02 * total**2 > 0
    sides = np.stack((x - x0, y - y0), 1) * np.sqrt(number)[:, None]
    rise = np.linalg.lstsq(sides, (z - z0) * np.sqrt(number), rcond=None)[0] * is_good

    def plane(east, north):
        return z0 + rise[0] * (east - x0) + rise[1] * (north - y0)

    plane.rise = rise
    return plane, is_good


def tilt(lowest, row, column):
    """Return the slope of a strip round a cell; infinity if it is not even there."""
    rows, columns = lowest.shape
    near = [
        (right * COARSE, down * COARSE, lowest[row + down, column + right])
        for down, right in itertools.product((-1, 0, 1), repeat=2)
        if 0 <= row + down < rows and 0 <= column + right < columns
    ]
    x, y, z = np.array([point for point in near if np.isfinite(point[2])]).T
    plane, is_good = plane_through(x, y, z, np.ones(len(z), dtype=int))
    is_even = is_good and abs(plane(0.0, 0.0) - lowest[row, column]) <= 0.25
    return np.hypot(*plane.rise) if is_even else np.inf


def near_others(differences, shape):
    """Return the differences near the median of those of the 5 x 5 cells around."""
    values = np.full(shape, np.nan)
    for place, value in differences.items():
        values[place] = value
    found = values.copy()
    for row, column in differences:
        around = values[max(row - 2, 0) : row + 3, max(column - 2, 0) : column + 3]
        if abs(values[row, column] - np.nanmedian(around)) > 0.25:
            found[row, column] = np.nan
    return found
