"""Compare settings: classifies a window of a survey with several, and shows them on a page."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Any

from ...core.errors import BareEarthError
from ...core.points import Box
from ...core.progress import SILENT, Progress
from ...core.threads import may_use
from ...engine.file_points import fits_in_memory
from ...engine.memory import Resources
from ...report.units import Units
from ...survey.files import Inputs
from ..declaration import CLOUD, CRS, GROUND, TERRAIN, FileTool, Input, Output
from .page import comparison, figures_of
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
        wide = max(len(figures["name"]) for figures in self.settings)
        return [
            f"{figures['name']:<{wide}}  {figures['ground_share']:6.2f} % ground, expected RMSE"
            f" {_metres(figures['expected_rmse'])}; {figures['gained']:,} points more and"
            f" {figures['lost']:,} less ground than the first"
            for figures in self.settings
        ]


def _metres(value: float | None) -> str:
    return "unknown" if value is None else f"{value:.2f} m"


def compare(
    sources: Inputs,
    extent: Box | None,
    page: Path,
    options: TrialOptions = TrialOptions(),
    resources: Resources = Resources(),
    progress: Progress = SILENT,
) -> TrialSummary:
    """Classify the points in a window and round it with several settings, and write the page."""
    settings, resources = [SETTINGS[name] for name in options.settings], resources.now()
    reach = max(setting.method.reach(setting.parameters) for setting in settings)
    context = min(reach, USUAL_CONTEXT) if options.context is None else options.context
    with may_use(resources.thread_count):
        window = read_points(sources, extent, context, progress.part(0.0, 0.4))
        if not fits_in_memory(window.count, resources):
            raise BareEarthError(
                f"The window and what lies round it have {window.count:,} points, more than fit"
                " into the memory that may be used. Choose a smaller one."
            )
        parts = progress.part(0.4, 0.8).shares(*[1.0] * len(settings))
        outcomes = [
            window.outcome(setting, resources, part, is_first=part is parts[0])
            for setting, part in zip(settings, parts)
        ]
        figures = [
            figures_of(window, outcome, outcomes[0], outcome.setting.commands(sources))
            for outcome in outcomes
        ]
        notes = _notes(window.units, context, reach)
        html = comparison(sources, notes, window, outcomes, figures)
    page.write_text(html, encoding="utf-8")
    counts = window.count, figures[0].point_count
    as_dicts = [setting._asdict() for setting in figures]
    return TrialSummary(str(page), *counts, window.box, context, as_dicts)


def _notes(units: Units, context: float, reach: float) -> list[str]:
    """Return notes on the pictures."""
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


TOOL = FileTool(
    work=compare,
    sets=(TrialOptions, Resources),
    titles=("What is compared", "Threads and memory"),
    inputs=(
        Input("sources", "clouds", label="Point cloud", named="INPUT"),
        Input(
            "extent",
            "extent",
            help="The window to classify: at most 1,000 m wide, and quick up to about 250 x 250 m."
            " Empty: 250 x 250 m in the middle of the points; the log says where.",
            label="Window",
            optional=True,
        ),
        CRS,
    ),
    outputs=(
        Output(
            "page",
            "page",
            help="A web page that compares the settings.",
            label="Comparison of settings",
            named="OUTPUT",
            is_main=True,
        ),
    ),
    json="the figures",
    command="compare-settings",
    identifier="comparesettings",
    title="Compare settings on a window",
    section="Quality",
    about="A setting is a method with a preset, such as slope:town. The points in a window are"
    " classified with each setting, and a web page shows its terrain, the share of ground, where"
    " the settings differ, and how to run each of them on all points. No point cloud is written."
    " Of a COPC file only the window is read, which takes seconds; a LAS or LAZ file is read as a"
    " whole.",
    page="which-method#compare-settings-on-a-window",
    words=(CLOUD, GROUND, TERRAIN, "preview,try,test,preset,parameters,compare"),
)
