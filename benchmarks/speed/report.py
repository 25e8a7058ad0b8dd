"""The tables, the plot and results/performance.md."""

from __future__ import annotations

from pathlib import Path
from string import Template
from typing import Sequence

from bare_earth.algorithms.filters import METHODS

from .. import report
from ..tables import NONE, number, table
from .contestants import FLOOR, OURS, Contestant
from .goals import goals
from .process import STOPPED
from .profiling import SHARES
from .results import Results, Spread
from .tiles import Tile

PAGE = report.RESULTS / "performance.md"
TEMPLATE = Path(__file__).parent / "page.md"
PLOT = "speed.png"
BILLIONS = (1, 100)
# Title of a table, figure, what it is divided by, digits.
_FIGURES = (("wall", "s", 1.0, 2), ("cpu", "CPU s", 1.0, 2), ("memory", "MB", 1e6, 0))


class Report:
    """All that can be told of one run of the benchmark.

    Parameters
    ----------
    results : Results
        What was measured.
    contestants : sequence of Contestant
        Those that took part, and those that could not.
    """

    def __init__(self, results: Results, contestants: Sequence[Contestant]) -> None:
        self._results = results
        self._contestants = [
            contestant for contestant in contestants if contestant.name in results.contestants()
        ]
        self._missing = [contestant for contestant in contestants if contestant.missing]

    def blocks(self) -> dict[str, list[str]]:
        """Return the lines of every part, by its name in the template."""
        return {
            "machine": [f"- {name}: {value}." for name, value in self._results.facts.items()],
            "contestants": self._notes(),
            "goals": self._goals(),
            "ratios": self._ratios(),
            "added": self._added(),
            "absolute": self._absolute(),
            "exponents": self._exponents(),
            "sizing": self._sizing(),
            "profiles": self._profiles(),
            "problems": self._problems(),
        }

    def write(self, page: Path) -> None:
        """Draw the plot, fill the template and write the page."""
        draw(self._results, self._contestants, report.IMAGES / PLOT)
        parts = {name: "\n".join(lines) for name, lines in self.blocks().items()}
        text = Template(TEMPLATE.read_text(encoding="utf-8")).substitute(parts, plot=PLOT)
        page.write_text(text.rstrip() + "\n", encoding="utf-8")

    def _notes(self) -> list[str]:
        lines = [
            f"- {_label(contestant)}: {contestant.note}."
            for contestant in self._contestants
            if contestant.note
        ]
        return lines + [
            f"- Not measured: {contestant.label}: needs {contestant.missing}."
            for contestant in self._missing
        ]

    def _goals(self) -> list[str]:
        rows = []
        for goal in goals(self._results):
            rows.append(
                [
                    goal.title,
                    f"{'≤' if goal.is_most else '≥'} {goal.limit:g}",
                    number(goal.reached, 2),
                    goal.where,
                    goal.verdict,
                ]
            )
        return table(["", "wanted", "reached", "on", "goal met"], rows)

    def _ratios(self) -> list[str]:
        """Return the time of each contestant, measured by the floor of the same round."""
        tiles = [tile for tile in self._results.tiles if self._results.costs(tile.name, FLOOR)]
        rows = [
            [_label(contestant), *(self._ratio(tile, contestant) for tile in tiles)]
            for contestant in self._contestants
        ]
        return table(["Time, as a multiple of reading and writing", *_heads(tiles)], rows)

    def _added(self) -> list[str]:
        """Return the seconds that each contestant takes beside reading and writing."""
        tiles = [tile for tile in self._results.tiles if self._results.costs(tile.name, FLOOR)]
        rows = []
        for contestant in self._contestants:
            if contestant.name != FLOOR:
                found = [self._results.added(tile.name, contestant.name) for tile in tiles]
                cells = [_ranged(one, 1) if one else NONE for one in found]
                rows.append([_label(contestant), *cells])
        return table(["Seconds beside reading and writing", *_heads(tiles)], rows)

    def _ratio(self, tile: Tile, contestant: Contestant) -> str:
        found = self._results.ratio(tile.name, contestant.name)
        return _ranged(found, 2) if found else self._why(tile, contestant)

    def _why(self, tile: Tile, contestant: Contestant) -> str:
        """Return what stands in a table where there is no figure."""
        problem = self._results.problem(tile.name, contestant.name)
        if problem.startswith(STOPPED):
            return problem.replace(STOPPED, ">")
        return "failed" if problem else NONE

    def _absolute(self) -> list[str]:
        lines: list[str] = []
        for tile in self._results.tiles:
            rows = []
            for contestant in self._contestants:
                found = [
                    self._results.spread(tile.name, contestant.name, figure)
                    for figure, *_ in _FIGURES
                ]
                if all(found):
                    cells = [
                        number(one.median / unit, digits)
                        for one, (_, _, unit, digits) in zip(found, _FIGURES)
                    ]
                    rounds = len(self._results.costs(tile.name, contestant.name))
                    per_point = number(found[-1].median / tile.count, 0)
                    rows.append([_label(contestant), *cells, per_point, str(rounds)])
            head = [f"{tile.name}, {tile.density:.1f} points/m²", *(row[1] for row in _FIGURES)]
            lines += [*table([*head, "bytes a point", "runs"], rows), ""] if rows else []
        return lines[:-1]

    def _exponents(self) -> list[str]:
        rows = []
        for contestant in self._contestants:
            found = [self._results.exponent(contestant.name, figure) for figure in ("wall", "cpu")]
            if None not in found:
                rows.append([_label(contestant), *(number(one, 2) for one in found)])
        return table(["Exponent", "time", "CPU time"], rows)

    def _sizing(self) -> list[str]:
        """Return core hours and disk for surveys, from the largest generated tile."""
        rows, used = [], ""
        for name in OURS:
            done = [
                tile
                for tile in self._results.tiles
                if tile.is_generated and self._results.costs(tile.name, name)
            ]
            if not done:
                continue
            tile, cpu = done[-1], self._results.spread(done[-1].name, name, "cpu")
            seconds = cpu.median / tile.count * 1e6
            size = tile.path.stat().st_size / tile.count if tile.path.exists() else float("nan")
            hours = (number(1000 * count * seconds / 3600, 1) for count in BILLIONS)
            disk = (number(2 * count * size, 0) for count in BILLIONS)
            rows.append([_bold(name), number(seconds, 2), *hours, number(size, 1), *disk])
            used = tile.name
        head = [f"Computed from {used}", "CPU s a million"]
        head += [f"core hours, {count} billion" for count in BILLIONS] + ["LAZ bytes a point"]
        return table(head + [f"GB in and out, {count} billion" for count in BILLIONS], rows)

    def _profiles(self) -> list[str]:
        profiles = self._results.profiles
        if not profiles:
            return [
                "Not measured in this run: `--profile` asks for it, and needs `pip install py-spy`."
            ]
        tile = next(iter(profiles.values())).tile
        rows = [
            [_bold(name), *(number(profile.shares[part], 0) for part in SHARES)]
            for name, profile in profiles.items()
        ]
        lines = table([f"Time on {tile}, %", *SHARES], rows)
        for name, profile in profiles.items():
            heaviest = ", ".join(
                f"`{function}` {share:.0f} %" for function, share in profile.heaviest
            )
            lines += ["", f"{METHODS[name].label}, most at work in: {heaviest}."]
        return lines

    def _problems(self) -> list[str]:
        lines = []
        for tile in self._results.tiles:
            for contestant in self._contestants:
                problem = self._results.problem(tile.name, contestant.name)
                if problem:
                    lines.append(f"- **{contestant.label}** on {tile.name}: {problem}.")
        return lines


def draw(results: Results, contestants: Sequence[Contestant], target: Path) -> None:
    """Draw time and peak memory against the number of points of the generated tiles."""
    from matplotlib import colormaps
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure

    figure = Figure(figsize=(10.5, 4.6), layout="constrained")
    FigureCanvasAgg(figure)
    tiles = [tile for tile in results.tiles if tile.is_generated]
    titles = (("wall", "Time, s", 1.0), ("memory", "Peak memory, MB", 1e6))
    for axes, (cost, title, unit) in zip(figure.subplots(1, 2), titles):
        # As many colours as there may be contestants; there are ten as a rule.
        axes.set_prop_cycle(color=colormaps["tab20"].colors[::2] + colormaps["tab20"].colors[1::2])
        for contestant in contestants:
            found = [
                (tile.count, *one)
                for tile in tiles
                if (one := results.spread(tile.name, contestant.name, cost))
            ]
            if not found:
                continue
            counts, medians, least, most = zip(*found)
            medians, least, most = (
                [one / unit for one in costs] for costs in (medians, least, most)
            )
            style = "k--" if contestant.name == FLOOR else ":" if contestant.is_peer else "-"
            (line,) = axes.plot(
                counts, medians, style, marker="o", markersize=4, label=contestant.label
            )
            axes.fill_between(counts, least, most, alpha=0.15, color=line.get_color())
        axes.set(xscale="log", yscale="log", xlabel="Points", title=title)
        axes.grid(which="both", alpha=0.25)
    figure.legend(*axes.get_legend_handles_labels(), loc="outside right upper", fontsize=8)
    target.parent.mkdir(parents=True, exist_ok=True)
    # Without the software's name: the same picture whatever version drew it.
    figure.savefig(target, dpi=110, metadata={"Software": None}, pil_kwargs={"optimize": True})


def _label(contestant: Contestant) -> str:
    is_ours = not contestant.is_peer and contestant.name != FLOOR
    return f"**{contestant.label}**" if is_ours else contestant.label


def _bold(name: str) -> str:
    return f"**{METHODS[name].label}**"


def _heads(tiles: Sequence[Tile]) -> list[str]:
    return [tile.name for tile in tiles]


def _ranged(found: Spread, digits: int) -> str:
    """Return the median, and the range where there is one."""
    middle, least, most = (number(figure, digits) for figure in found)
    return middle if least == most else f"{middle} ({least} to {most})"
