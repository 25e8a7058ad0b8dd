"""Compares settings on a window of a survey, on a page with pictures side by side."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Any, Iterable, Sequence

from ..core.errors import BareEarthError
from ..core.files import replacing
from ..core.points import Box, box_in_words
from ..core.progress import SILENT, Progress
from ..core.threads import may_use
from ..engine.file_points import fits_in_memory
from ..engine.memory import Resources
from ..report.page import check_page
from ..report.units import Units
from .commands import commands_for
from .options import USUAL_CONTEXT, TrialOptions
from .page import TrialPage
from .points import TrialPoints, read_trial_points
from .profile import Profile, can_be_shown
from .window import Outcome, figures_of, line_across


@dataclass(frozen=True)
class TrialSummary:
    """The result of a comparison."""

    page: str  # that was written
    read_count: int
    point_count: int  # in the window
    window: Box  # in units of the CRS
    context: float  # metres that were read round the window
    settings: list[dict[str, Any]]  # `Figures` and `Commands` of each setting

    def lines(self) -> list[str]:
        """Return the figures as lines of text for a terminal or a log."""
        wide = max(len(each["name"]) for each in self.settings)
        return [
            f"{each['name']:<{wide}}  {each['ground_share']:6.2f} % ground, confidence"
            f" {each['confidence']:3.0f} %; {each['gained']:,} points more and {each['lost']:,}"
            " less ground than the first"
            for each in self.settings
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
    """Classify a window of a survey with several settings, and write a page that compares them.

    Only the window and its surroundings are used. COPC files are read only there, LAS and LAZ files
    completely. No point cloud is written.

    Parameters
    ----------
    sources : iterable of Path
        LAS, LAZ and COPC files, folders of them, virtual point clouds (.vpc) and lists (.txt).
    page : Path
        The HTML file to write, which contains its pictures.
    extent : tuple of float, optional
        The window: smallest x and y, largest x and y in units of the CRS. By default, a square of
        250 m in the middle of the survey.
    options : TrialOptions
        The settings, and how much is read round the window.
    resources : Resources
        Threads and memory.
    progress : Progress
        Receives progress and messages.
    crs : str, optional
        The CRS of the points in place of the one that files state: an EPSG code, such as
        "EPSG:25832", or "EPSG:2230+6360" with that of the heights, or well-known text.

    Raises
    ------
    BareEarthError
        If the window has no points or is too wide, an input cannot be read, or the page cannot be
        written.
    Cancelled
        If the user asked to stop; no page is left behind.
    """
    paths, page = [Path(each) for each in sources], Path(page)
    check_page(page, tuple(paths))
    settings, resources = options.chosen, resources.now()
    reach = max(each.reach for each in settings)
    context = min(reach, USUAL_CONTEXT) if options.context is None else options.context
    with may_use(resources.thread_count):
        points = read_trial_points(paths, extent, context, progress.part(0.0, 0.4), crs)
        if not fits_in_memory(points.count, resources):
            raise BareEarthError(
                f"The window and what lies round it have {points.count:,} points, more than fit"
                " into the memory that may be used. Choose a smaller one."
            )
        parts = progress.part(0.4, 0.8).shares(*[1.0] * len(settings))
        labelled = [
            points.labelled(setting, resources, part, is_first=part is parts[0])
            for setting, part in zip(settings, parts)
        ]
        outcomes = points.outcomes(labelled)
        found = _page(paths, points, outcomes, options, (context, reach), crs)
        html = found.html()
    with replacing(page) as temporary:
        temporary.write_text(html, encoding="utf-8")
    progress(1.0)
    told = [{**a._asdict(), **b._asdict()} for a, b in zip(found.figures, found.commands)]
    counts = points.count, found.figures[0].point_count
    return TrialSummary(str(page), *counts, points.box, context, told)


def _page(
    paths: Sequence[Path],
    points: TrialPoints,
    outcomes: Sequence[Outcome],
    options: TrialOptions,
    seen: tuple[float, float],
    crs: str | None,
) -> TrialPage:
    """Return the page; `seen` is how far was read, and how far the methods look."""
    window, first = points.window, outcomes[0]
    line = points.line(options.profile) if options.profile else line_across(window, outcomes)
    profile = Profile.of(window, line, can_be_shown(first.classes, points.withheld))
    return TrialPage(
        paths,
        f"Window: {box_in_words(points.box)} ({window.size})",
        _notes(window.units, *seen),
        window,
        outcomes,
        [figures_of(window, each, first) for each in outcomes],
        [commands_for(paths, each, crs) for each in options.chosen],
        profile,
    )


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
