"""What was measured, and what follows from it: ratios, exponents, shares."""

from __future__ import annotations

import json
import statistics
from dataclasses import dataclass, field
from pathlib import Path
from typing import NamedTuple

import numpy as np

from .contestants import FLOOR
from .process import Cost
from .tiles import Tile


class Run(NamedTuple):
    """One process: names of the tile and the contestant, the round from 0 on, and the cost."""

    tile: str
    contestant: str
    round: int
    cost: Cost


class Spread(NamedTuple):
    """The median of some figures, the least and the greatest of them."""

    median: float
    least: float
    most: float


@dataclass
class Results:
    """All of one run of the benchmark.

    Attributes
    ----------
    facts : dict of str to str
        The machine, the versions and the date.
    tiles : list of Tile
        By the number of points.
    runs : list of Run
        In the order in which they were made.
    profiles : dict of str to Profile
        Where the time of each filter goes, if that was asked for.
    """

    facts: dict[str, str] = field(default_factory=dict)
    tiles: list[Tile] = field(default_factory=list)
    runs: list[Run] = field(default_factory=list)
    profiles: dict[str, Profile] = field(default_factory=dict)

    def contestants(self) -> list[str]:
        """Return the names of those that ran, in the order of the first round."""
        return list(dict.fromkeys(run.contestant for run in self.runs))

    def costs(self, tile: str, contestant: str) -> dict[int, Cost]:
        """Return the cost of the whole runs of each round."""
        return {
            run.round: run.cost
            for run in self.runs
            if (run.tile, run.contestant) == (tile, contestant) and not run.cost.problem
        }

    def problem(self, tile: str, contestant: str) -> str:
        """Return why a contestant has no figures on a tile; empty if it was not tried."""
        problems = [
            run.cost.problem
            for run in self.runs
            if (run.tile, run.contestant) == (tile, contestant) and run.cost.problem
        ]
        return problems[-1] if problems else ""

    def spread(self, tile: str, contestant: str, figure: str) -> Spread | None:
        """Return one figure of a contestant over the rounds."""
        return spread([getattr(cost, figure) for cost in self.costs(tile, contestant).values()])

    def ratio(
        self, tile: str, contestant: str, figure: str = "wall", to: str = FLOOR
    ) -> Spread | None:
        """Return the ratio of one figure to that of another contestant in the same round."""
        others = self.costs(tile, to)
        return spread(
            [
                getattr(cost, figure) / getattr(others[number], figure)
                for number, cost in self.costs(tile, contestant).items()
                if number in others
            ]
        )

    def added(self, tile: str, contestant: str) -> Spread | None:
        """Return the seconds more than the floor of the same round."""
        floor = self.costs(tile, FLOOR)
        return spread(
            [
                cost.wall - floor[number].wall
                for number, cost in self.costs(tile, contestant).items()
                if number in floor
            ]
        )

    def largest(self, *contestants: str) -> Tile | None:
        """Return the largest tile that all of these finished."""
        done = [
            tile
            for tile in self.tiles
            if all(self.costs(tile.name, contestant) for contestant in contestants)
        ]
        return done[-1] if done else None

    def exponent(self, contestant: str, figure: str = "wall", least: int = 0) -> float | None:
        """Return b of cost = a x points^b, by least squares of logs.

        Over the generated tiles of at least so many points.
        """
        pairs = [
            (tile.count, found.median)
            for tile in self.tiles
            if tile.is_generated
            and tile.count >= least
            and (found := self.spread(tile.name, contestant, figure))
        ]
        if len(pairs) < 2:
            return None
        counts, costs = np.log(np.array(pairs, dtype=float)).T
        return float(np.polyfit(counts, costs, 1)[0])


class Profile(NamedTuple):
    """Where the time of one run goes.

    Attributes
    ----------
    tile : str
        What was classified.
    seconds : float
        What was sampled of the main thread.
    shares : dict of str to float
        Percent of the time in each part of the work.
    heaviest : list of (str, float)
        The functions in which most threads were found at work, and percent of all finds.
    """

    tile: str
    seconds: float
    shares: dict[str, float]
    heaviest: list[tuple[str, float]]


def spread(values: list[float]) -> Spread | None:
    """Return median, least and most; None of nothing."""
    return Spread(statistics.median(values), min(values), max(values)) if values else None


def save(results: Results, path: Path) -> None:
    """Write all that was measured as JSON."""
    content = {
        "facts": results.facts,
        "tiles": [tile._asdict() | {"path": str(tile.path)} for tile in results.tiles],
        "runs": [run._asdict() | {"cost": run.cost._asdict()} for run in results.runs],
        "profiles": {name: profile._asdict() for name, profile in results.profiles.items()},
    }
    path.write_text(json.dumps(content, indent=1) + "\n", encoding="utf-8")


def load(path: Path) -> Results:
    """Return what `save` wrote."""
    content = json.loads(path.read_text(encoding="utf-8"))
    return Results(
        content["facts"],
        [Tile(**tile | {"path": Path(tile["path"])}) for tile in content["tiles"]],
        [Run(**run | {"cost": Cost(**run["cost"])}) for run in content["runs"]],
        {name: Profile(**profile) for name, profile in content["profiles"].items()},
    )
