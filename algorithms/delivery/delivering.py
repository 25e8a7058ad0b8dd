"""Makes a delivery: everything that a job hands over, from raw points, in one folder."""

from __future__ import annotations

import contextlib
from dataclasses import asdict
from pathlib import Path
from typing import Iterable, Iterator

from ..core.errors import BareEarthError, Cancelled, FinishedFilesStay
from ..core.files import temporary_folder
from ..core.progress import SILENT, Progress
from ..core.version import __version__
from ..engine.workers import Workers
from ..report.units import Units
from ..survey.files import Survey, is_one_file, open_survey
from ..survey.shapes import Place
from .folder import CHANGES, PAGE, DeliveryFolder
from .heard import Heard
from .page import cell_text, delivery_html, settings_of
from .request import DeliveryRequest
from .steps import DeliverySteps, Made
from .summary import DeliverySummary


def deliver(
    sources: str | Path | Iterable[str | Path],
    folder: str | Path,
    request: DeliveryRequest = DeliveryRequest(),
    progress: Progress = SILENT,
    workers: Workers | None = None,
) -> DeliverySummary:
    """Make all outputs of a job from raw points: a delivery."""
    given = [sources] if isinstance(sources, (str, Path)) else list(sources)
    paths, place = [Path(each) for each in given], DeliveryFolder(Path(folder))
    place.check(paths)
    is_one = is_one_file(paths)
    heard = Heard(progress)
    survey = _opened(paths, request, heard)
    if not is_one:
        place.begin(request.delivery)
    # On the disk of the folder, so that outputs can be moved there.
    beside = place.path.parent if is_one else place.path
    with _left_in_order(place, is_one), temporary_folder(beside) as working:
        changed = {place.waiting / name: place.points for name in CHANGES}
        heard.folders.update({working: place.path, **changed})
        work = DeliveryFolder(working)
        steps = DeliverySteps(request, survey, paths, is_one, work, place, workers)
        try:
            made = steps.run(heard.part(0.01, 0.97))
        except BareEarthError as error:
            raise BareEarthError(str(error).replace(str(working), str(place.path))) from error
        made.warnings = heard.warnings
        page = delivery_html(request, made, survey, working)
        (working / PAGE).write_text(page, encoding="utf-8")
        summary = _summary(request, made, survey, working, place.path)
        heard(1.0)  # the last moment to cancel
        place.take(working, made.waiting, _record(request, made, place.path))
    return summary


def _opened(paths: list[Path], request: DeliveryRequest, progress: Progress) -> Survey:
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


def _moved(path: Path, working: Path, folder: Path) -> Path:
    """Return where a file of the working folder will be."""
    return folder / path.relative_to(working) if working in path.parents else path


def _summary(
    request: DeliveryRequest, made: Made, survey: Survey, working: Path, folder: Path
) -> DeliverySummary:
    if made.cloud is None or made.quality is None:
        raise BareEarthError("The delivery is not complete.")
    units = Units(survey.crs.horizontal_unit, survey.crs.vertical_unit)
    return DeliverySummary(
        folder=str(folder),
        delivery=request.delivery,
        page=str(folder / PAGE),
        cloud=str(_moved(made.cloud, working, folder)),
        layers={name: str(_moved(path, working, folder)) for name, path in made.layers.items()},
        point_count=made.point_count,
        ground_count=made.ground_count,
        class_counts=made.class_counts,
        cell_size=made.cell_size,
        cell_text=cell_text(request, made, units),
        failures=made.failures,
        warnings=made.warnings,
        seconds={name: round(took, 2) for name, took in made.seconds.items()},
        quality=made.quality,
        check=made.check,
        water=made.water,
        interval=made.interval,
    )


def _record(request: DeliveryRequest, made: Made, folder: Path) -> dict[str, object]:
    """Return what is said of a delivery beside its files."""
    # The points of many files are in the folder already. Their records are no part of a delivery.
    points = DeliveryFolder(folder).points
    there = [each for each in made.files if each.parent == points and each.is_file()]
    return {
        "delivery": request.delivery,
        "version": __version__,
        "settings": settings_of(request, made.cell_size),
        "points": made.point_count,
        "ground": made.ground_count,
        "classes": made.class_counts,
        "water": None if made.water is None else asdict(made.water),
        "files": [each.relative_to(folder).as_posix() for each in there],
    }
