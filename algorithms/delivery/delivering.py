"""Makes a delivery: everything that a job hands over, from raw points, in one folder."""

from __future__ import annotations

import contextlib
from dataclasses import asdict
from pathlib import Path
from typing import Callable, Iterator, Sequence

from ..core.errors import BareEarthError, Cancelled, FinishedFilesStay
from ..core.files import temporary_folder
from ..core.progress import SILENT, PassingOn, Progress
from ..core.version import __version__
from ..engine.workers import Workers
from ..survey.files import Inputs, Sources, Survey, open_survey
from ..survey.shapes import Place
from ..tools import POINT_TOOLS
from .folder import PAGE, DeliveryFolder
from .page import delivery_html, settings_of
from .request import DeliveryRequest
from .steps import DeliverySteps
from .summary import DeliverySummary


def deliver(
    sources: Sources,
    folder: str | Path,
    request: DeliveryRequest = DeliveryRequest(),
    progress: Progress = SILENT,
    workers: Workers | None = None,
) -> DeliverySummary:
    """Make all outputs of a job from raw points: a delivery."""
    paths, place = Inputs(sources), DeliveryFolder(Path(folder))
    place.check(paths)
    is_one = not paths.is_survey
    messages = _Messages(progress)
    survey = _opened(paths, request, messages)
    if not is_one:
        place.begin(request.delivery)
    # On the disk of the folder, so that outputs can be moved there.
    beside = place.path.parent if is_one else place.path
    with _left_in_order(place, is_one), temporary_folder(beside) as working:
        changed = {place.waiting / command: place.points for command in POINT_TOOLS}
        messages.folders = {working: place.path, **changed}
        summary = DeliverySummary(
            str(place.path), request.delivery, str(place.path / PAGE), warnings=messages.warnings
        )
        work = DeliveryFolder(working)
        steps = DeliverySteps(request, survey, paths, is_one, work, place, workers, summary)
        try:
            steps.run(messages.part(0.01, 0.97))
        except BareEarthError as error:
            raise BareEarthError(str(error).replace(str(working), str(place.path))) from error
        page = delivery_html(request, summary, survey, working, steps.files)
        (working / PAGE).write_text(page, encoding="utf-8")
        shown = {"cloud": summary.cloud, **summary.layers}
        places = {name: path.replace(str(working), str(place.path)) for name, path in shown.items()}
        summary.cloud, summary.layers = places.pop("cloud"), places
        messages(1.0)  # the last moment to cancel
        # The points of many files are in the folder already.
        there = [path for path in steps.files if path.parent == place.points and path.is_file()]
        record = {
            "delivery": request.delivery,
            "version": __version__,
            "settings": settings_of(request, summary.cell_size),
            "points": summary.point_count,
            "ground": summary.ground_count,
            "classes": summary.class_counts,
            "water": None if summary.water is None else asdict(summary.water),
            "files": [path.relative_to(place.path).as_posix() for path in there],
        }
        place.replace(working, steps.waiting, record)
    return summary


class _Messages(PassingOn):
    """Passes on messages, each once, since several steps read the same files; keeps warnings."""

    def __init__(self, whole: Progress) -> None:
        super().__init__(whole)
        # which messages name in place of those that are temporary
        self.folders: dict[Path, Path] = {}
        self.warnings: list[str] = []
        self._said: set[str] = set()

    def info(self, text: str) -> None:
        """Pass on a message."""
        self._tell(super().info, text)

    def choice(self, text: str) -> None:
        """Pass on a choice."""
        self._tell(super().choice, text)

    def warning(self, text: str) -> None:
        """Pass on a warning, and keep it."""
        self._tell(super().warning, text, self.warnings)

    def _tell(
        self, pass_on: Callable[[str], None], text: str, kept: list[str] | None = None
    ) -> None:
        """Pass on a message as it is to be read, unless it was passed on before."""
        for temporary, folder in self.folders.items():
            text = text.replace(str(temporary), str(folder))
        if text not in self._said:
            self._said.add(text)
            pass_on(text)
            if kept is not None:
                kept.append(text)


def _opened(paths: Sequence[Path], request: DeliveryRequest, progress: Progress) -> Survey:
    """Open the files, and refuse now what would fail after hours."""
    recursive, stated = request.files.recursive, request.stated
    survey = open_survey(paths, recursive, progress.part(0.0, 0.01), stated)
    if request.checkpoints is not None:
        request.checkpoints.located(Place("the files", survey.crs, survey.box), progress)
    return survey


@contextlib.contextmanager
def _left_in_order(place: DeliveryFolder, is_one: bool) -> Iterator[None]:
    """After a cancel or an error, leave no empty folder; say if the run can be continued."""
    try:
        yield
    except (BareEarthError, Cancelled, KeyboardInterrupt) as error:
        if is_one:
            raise
        stays = place.leave()
        if stays and not isinstance(error, (BareEarthError, FinishedFilesStay)):
            raise FinishedFilesStay from error
        if not stays and isinstance(error, FinishedFilesStay):
            raise Cancelled from error
        raise
