"""Compares settings on a window of a survey, on a page with pictures side by side."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Any, Iterable

from ...core.errors import BareEarthError
from ...core.files import replacing
from ...core.points import Box
from ...core.progress import SILENT, Progress
from ...core.threads import may_use
from ...engine.file_points import fits_in_memory
from ...engine.memory import Resources
from ...report.page import check_page
from ...report.units import Units
from .page import comparison, figures_of
from .profile import Profile, line_across, line_between
from .settings import SETTINGS, USUAL_CONTEXT, TrialOptions
from .window import read_points


@dataclass(frozen=True)
class TrialSummary:
    """The result of a comparison."""

    page: str  # that was written
    read_count: int
    point_count: int  # in the window
    window: Box  # in units of the CRS
    context: float  # metres that were read round the window
    settings: list[dict[str, Any]]  # `Figures` of each setting

    def lines(self) -> list[str]:
        """Return the figures as lines of text for a terminal or a log."""
        wide = max(len(one["name"]) for one in self.settings)
        return [
            f"{one['name']:<{wide}}  {one['ground_share']:6.2f} % ground, confidence"
            f" {one['confidence']:3.0f} %; {one['gained']:,} points more and {one['lost']:,}"
            " less ground than the first"
            for one in self.settings
        ]


def compare_settings(
    sources: Iterable[Path],
    page: Path,
    extent: Box | None = None,
    options: TrialOptions = TrialOptions(),
    resources: Resources = Resources(),
    progress: Progress = SILENT,
    crs: str | None = None,
) -> TrialSummary:
    """Classify a window of a survey with several settings, and write a page that compares them."""
    paths, page = [Path(source) for source in sources], Path(page)
    check_page(page, tuple(paths))
    settings, resources = [SETTINGS[name] for name in options.settings], resources.now()
    reach = max(setting.method.reach(setting.parameters) for setting in settings)
    context = min(reach, USUAL_CONTEXT) if options.context is None else options.context
    with may_use(resources.thread_count):
        window = read_points(paths, extent, context, progress.part(0.0, 0.4), crs)
        if not fits_in_memory(window.count, resources):
            raise BareEarthError(
                f"The window and what lies round it have {window.count:,} points, more than fit"
                " into the memory that may be used. Choose a smaller one."
            )
        parts = progress.part(0.4, 0.8).shares(*[1.0] * len(settings))
        labels = [
            window.labels(setting, resources, part, is_first=part is parts[0])
            for setting, part in zip(settings, parts)
        ]
        outcomes = window.outcomes(labels)
        ends, first = options.profile, outcomes[0]
        line = line_between(window, ends) if ends else line_across(window, outcomes)
        figures = [
            figures_of(window, outcome, first, outcome.setting.commands(paths, crs))
            for outcome in outcomes
        ]
        notes, profile = _notes(window.units, context, reach), Profile(window, line, first)
        html = comparison(paths, notes, window, outcomes, figures, profile)
    with replacing(page) as temporary:
        temporary.write_text(html, encoding="utf-8")
    progress(1.0)
    told = [one._asdict() for one in figures]
    counts = window.count, figures[0].point_count
    return TrialSummary(str(page), *counts, window.box, context, told)


def _notes(units: Units, context: float, reach: float) -> list[str]:
    """Return notes that are needed to judge the pictures."""
    notes = [
        f"{units.length(context)} round the window were read as well, to judge the points in it.",
        "All other parameters have their defaults. As in a run on all points, the present classes"
        " of the points decide which of them take part.",
    ]
    if context < reach:
        notes[0] += (
            f" The settings look up to {units.length(reach)} far. So a run on all points may give"
            " other classes near the edges of the window, mostly beside large buildings. Give more"
            " context to be sure."
        )
    return notes
