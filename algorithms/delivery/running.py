"""Makes a delivery from raw points, in one folder."""

from __future__ import annotations

import contextlib
from dataclasses import asdict
from functools import partial
from pathlib import Path
from typing import Any, Callable, Collection, Iterator, Mapping, Sequence

from ..core.errors import BareEarthError, Cancelled, FinishedFilesStay
from ..core.files import temporary_folder
from ..core.parameters import ParameterSet
from ..core.progress import SILENT, PassingOn, Progress
from ..core.temporary import remove
from ..core.version import __version__
from ..engine.options import TileInput
from ..engine.workers import Workers
from ..survey.files import Inputs, Sources, open_survey
from ..tools.listing import POINT_TOOLS
from .deliveries import DELIVERIES
from .folder import PAGE, DeliveryFolder
from .job import DeliveryJob
from .page import delivery_html, setting_in_words, settings_of
from .rows import rows_of
from .summary import DeliverySummary


def deliver(
    sources: Sources,
    folder: str | Path,
    delivery: str,
    sets: Sequence[ParameterSet],
    inputs: Mapping[str, Any],
    progress: Progress = SILENT,
    workers: Workers | None = None,
    named: Collection[str] = (),
) -> DeliverySummary:
    """Make all outputs of a job from raw points: a delivery, given parameters, inputs, and the
    names of the parameters that the user gave, which the delivery does not change.
    """
    if delivery not in DELIVERIES:
        raise BareEarthError(
            f"There is no delivery '{delivery}'. Choose one of {', '.join(DELIVERIES)}."
        )
    files, place, messages = Inputs(sources), DeliveryFolder(Path(folder)), _Messages(progress)
    place.check(files)
    files = _opened(files, sets, inputs, messages)
    if files.output_kind == "folder":
        place.begin(delivery)
    # On the disk of the folder, so that outputs can be moved there.
    new = partial(temporary_folder, place.path if place.has_begun else place.path.parent)
    with _cleaned_up_after_errors(place), new() as working, new() as unpacked:
        changed = {place.waiting / command: place.points for command in POINT_TOOLS}
        messages.folders = {working: place.path, **changed}
        summary = DeliverySummary(
            str(place.path), delivery, str(place.path / PAGE), warnings=messages.warnings
        )
        folders = DeliveryFolder(working), place, unpacked
        content = DELIVERIES[delivery]
        job = DeliveryJob(content, files, sets, inputs, summary, *folders, workers, named)
        _report_settings(job, messages)
        summary.seconds = job.seconds
        try:
            job.work(rows_of(job), messages.part(0.01, 0.97))
        except BareEarthError as error:
            raise BareEarthError(str(error).replace(str(working), str(place.path))) from error
        remove(folders[0].waiting)
        page = delivery_html(job, working)
        (working / PAGE).write_text(page, encoding="utf-8")
        shown = {"cloud": summary.cloud, **summary.layers}
        places = {name: path.replace(str(working), str(place.path)) for name, path in shown.items()}
        summary.cloud, summary.layers = places.pop("cloud"), places
        messages(1.0)  # the last moment to cancel
        # The points of many files have been written into the folder already.
        present = [path for path in job.files if path.parent == place.points and path.is_file()]
        record = {
            "delivery": delivery,
            "version": __version__,
            "settings": settings_of(job),
            "asked": sorted(job.asked()),
            "points": summary.point_count,
            "ground": summary.ground_count,
            "classes": summary.class_counts,
            "water": None if summary.water is None else asdict(summary.water),
            "files": [path.relative_to(place.path).as_posix() for path in present],
        }
        place.replace(working, job.changed_files, record)
    return summary


def _report_settings(job: DeliveryJob, progress: Progress) -> None:
    """Tell which parameters the user gave, and which the delivery sets."""
    asked, chosen = (
        ", ".join(f"{name.replace('_', ' ')} {setting_in_words(value)}" for name, value in found)
        for found in (job.asked().items(), job.chosen().items())
    )
    if asked:
        progress.info(f"As asked: {asked}.")
    if chosen:
        progress.choice(f"{job.content.label}: {chosen}.")


class _Messages(PassingOn):
    """Passes on each message once, since several tools read the same files, and keeps warnings."""

    def __init__(self, whole: Progress) -> None:
        super().__init__(whole)
        # The folders that messages name in place of temporary ones.
        self.folders: dict[Path, Path] = {}
        self.warnings: list[str] = []
        self._passed_on: set[str] = set()

    def info(self, text: str) -> None:
        """Pass on a message."""
        self._report(super().info, text)

    def choice(self, text: str) -> None:
        """Pass on a choice."""
        self._report(super().choice, text)

    def warning(self, text: str) -> None:
        """Pass on a warning, and keep it."""
        self._report(super().warning, text, self.warnings)

    def _report(
        self, pass_on: Callable[[str], None], text: str, kept: list[str] | None = None
    ) -> None:
        """Pass on a message with the final names of folders, unless it was passed on before."""
        for temporary, folder in self.folders.items():
            text = text.replace(str(temporary), str(folder))
        if text not in self._passed_on:
            self._passed_on.add(text)
            pass_on(text)
            if kept is not None:
                kept.append(text)


def _opened(
    files: Inputs, sets: Sequence[ParameterSet], inputs: Mapping[str, Any], progress: Progress
) -> Inputs:
    """Open the files, and refuse before the work what would fail after hours."""
    files = files.read_as(inputs["crs"], TileInput.among(sets).recursive)
    survey = open_survey(files, progress.part(0.0, 0.01))
    if inputs["checkpoints"] is not None:
        inputs["checkpoints"].located(survey.place, progress)
    return files.holding(survey)


@contextlib.contextmanager
def _cleaned_up_after_errors(place: DeliveryFolder) -> Iterator[None]:
    """After a cancel or an error, remove an empty folder, and raise `FinishedFilesStay` after a
    cancel if the run can be continued.
    """
    try:
        yield
    except (BareEarthError, Cancelled, KeyboardInterrupt) as error:
        if not place.has_begun:
            raise
        stays = place.leave()
        if stays and not isinstance(error, (BareEarthError, FinishedFilesStay)):
            raise FinishedFilesStay from error
        if not stays and isinstance(error, FinishedFilesStay):
            raise Cancelled from error
        raise
