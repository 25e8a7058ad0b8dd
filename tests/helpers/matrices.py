"""Matrices of cases, of which a covering set is quick and the others are long."""

import itertools

import pytest


def covering(*axes, rest=()):
    """Return all combinations, of which a Latin square is quick.

    It has each value of two axes, and of more axes any two values together. Of it, what has a value
    of `rest` is not daily.
    """
    shortest = min(map(len, axes))
    rows = []
    for numbers in itertools.product(*(range(len(axis)) for axis in axes)):
        values = [a[n] for a, n in zip(axes, numbers)]
        marks = [pytest.mark.rest] * any(value in rest for value in values)
        marks = pytest.mark.long if sum(numbers) % shortest else marks
        rows.append(pytest.param(*values, marks=marks))
    return rows


def quick(names, *some):
    """Return names, of which all but some are long."""
    return [name if name in some else pytest.param(name, marks=pytest.mark.long) for name in names]
