"""Assessments of files that have only a part of their points in common."""

import json

import laspy
import numpy as np
import pytest
from runs import CancelAt, Heard
from surveys import write_points

from bare_earth import BareEarthError, Cancelled, assess, water_classes
from bare_earth.algorithms.cli import main
from bare_earth.algorithms.survey import common_points

COUNT = 5000


def survey(seed=1):
    """Return x, y, z, classes and times of points, of which many lie at the same place."""
    random = np.random.default_rng(seed)
    x, y = random.integers(0, 40, (2, COUNT)) + 0.25
    z = random.integers(0, 3, COUNT) * 1.0
    return x, y, z, random.choice([1, 2, 6], COUNT), np.arange(COUNT) * 0.001 + 1e8


def write(path, which, classes, scale=0.01, offset=(0.0, 0.0), point_format=6, times=True):
    x, y, z, _, gps = survey()
    east, north = offset
    return write_points(
        path, x[which] + 1000 - east, y[which] + 2000 - north, z[which] + 50, classes[which],
        offset=(*offset, 0.0), scale=scale, point_format=point_format,
        **({"gps_time": gps[which]} if times else {}),
    )  # fmt: skip


X, Y, _, TRUTH, _ = survey()
FOUND = np.where(np.random.default_rng(2).random(COUNT) < 0.1, 3 - np.minimum(TRUTH, 2), TRUTH)
CLIP = np.flatnonzero((X > 10) & (X < 25) & (Y > 5))
MIXED = np.random.default_rng(3).permutation(CLIP)


def figures(assessment):
    return (
        assessment.point_count, assessment.ground_as_other, assessment.other_as_ground,
        assessment.classes,
    )  # fmt: skip


@pytest.fixture
def expected(tmp_path):
    """The figures of the clip, when its reference is cut in the same way."""
    files = write(tmp_path / "a.las", CLIP, FOUND), write(tmp_path / "b.las", CLIP, TRUTH)
    return figures(assess(*files))


@pytest.mark.parametrize("order", [CLIP, MIXED], ids=["in order", "mixed"])
@pytest.mark.parametrize("ending", [".las", ".laz", ".copc.laz"])
def test_a_clip_is_assessed_against_the_whole_reference(tmp_path, expected, order, ending):
    found = write(tmp_path / "found.las", order, FOUND)
    truth, whole = tmp_path / "truth.las", tmp_path / f"whole{ending}"
    write(truth, slice(None), TRUTH)
    water_classes(truth, whole, water=())  # which changes no class
    progress = Heard()
    result = assess(found, whole, report=tmp_path / "r.html", progress=progress)
    assert figures(result) == expected
    assert (result.classified_only, result.reference_only) == (0, COUNT - len(CLIP))
    (told,) = (text for text in progress.infos if "have no partner" in text)
    assert told.startswith(f"{len(CLIP):,} points are in both")
    assert progress.fractions[-1] == 1 and progress.fractions == sorted(progress.fractions)
    page = (tmp_path / "r.html").read_text(encoding="utf-8")
    assert f"{COUNT - len(CLIP):,} of the reference" in page


def test_the_reference_may_be_the_part(tmp_path, expected):
    found = write(tmp_path / "found.las", slice(None), FOUND)
    truth = write(tmp_path / "truth.las", MIXED, TRUTH)
    result = assess(found, truth)
    assert figures(result) == expected
    assert (result.classified_only, result.reference_only) == (COUNT - len(CLIP), 0)


def test_both_may_have_points_of_their_own(tmp_path, expected):
    rest = np.setdiff1d(np.arange(COUNT), CLIP)
    found = write(tmp_path / "found.las", np.concatenate([CLIP, rest[:700]]), FOUND)
    truth = write(tmp_path / "truth.las", np.concatenate([rest[700:1400], MIXED]), TRUTH)
    result = assess(found, truth)
    assert figures(result) == expected
    assert (result.classified_only, result.reference_only) == (700, 700)


def test_other_offsets_and_scales_are_the_same_places(tmp_path, expected):
    found = write(tmp_path / "found.las", CLIP, FOUND, 0.001, (1000.0, 2000.5))
    truth = write(tmp_path / "truth.las", slice(None), TRUTH, 0.01)
    assert figures(assess(found, truth)) == expected


def test_without_times_no_point_is_used_twice(tmp_path):
    found = write(tmp_path / "found.las", MIXED, FOUND, point_format=0, times=False)
    truth = write(tmp_path / "truth.las", slice(None), TRUTH, point_format=0, times=False)
    result = assess(found, truth)
    assert result.point_count == len(CLIP) and result.reference_only == COUNT - len(CLIP)
    # The classes of the reference are those of the clip, up to points at the same place.
    kinds, counts = np.unique(TRUTH[CLIP], return_counts=True)
    assert {kind: figure["points"] for kind, figure in result.classes.items()} == pytest.approx(
        dict(zip(kinds.tolist(), counts.tolist())), rel=0.1
    )


def test_changed_times_do_not_keep_points_apart(tmp_path):
    las = laspy.read(write(tmp_path / "found.las", CLIP, FOUND))
    las.gps_time = las.gps_time + 1e9
    las.write(str(tmp_path / "found.las"))
    truth = write(tmp_path / "truth.las", slice(None), TRUTH)
    assert assess(tmp_path / "found.las", truth).point_count == len(CLIP)


def test_the_same_points_in_another_order_are_read_with_messages_once(tmp_path):
    progress = Heard()
    mixed = np.random.default_rng(5).permutation(COUNT)
    found = write(tmp_path / "found.las", mixed, FOUND)
    truth = write(tmp_path / "truth.las", slice(None), TRUTH)
    result = assess(found, truth, progress=progress)
    assert result.point_count == COUNT and not result.reference_only
    assert result.ground_as_other == np.count_nonzero((TRUTH == 2) & (FOUND != 2))
    assert progress.fractions == sorted(progress.fractions)
    assert sorted(text[:5] for text in progress.warnings) == ["found", "truth"]  # of the CRS


def test_strips_make_no_difference(tmp_path, expected, monkeypatch):
    monkeypatch.setattr(common_points, "_STRIP", 100)
    found = write(tmp_path / "found.las", MIXED, FOUND)
    truth = write(tmp_path / "truth.las", slice(None), TRUTH)
    assert figures(assess(found, truth)) == expected


def test_points_of_another_survey_are_refused(tmp_path):
    truth = laspy.read(write(tmp_path / "truth.las", slice(None), TRUTH))
    truth.x = np.asarray(truth.x) + 0.03
    truth.write(str(tmp_path / "other.las"))
    found = write(tmp_path / "found.las", CLIP, FOUND)
    with pytest.raises(BareEarthError, match=r"same points: .* 0 are in both"):
        assess(found, tmp_path / "other.las")


def test_a_cancel_while_points_are_matched(tmp_path):
    found = write(tmp_path / "found.las", MIXED, FOUND)
    truth = write(tmp_path / "truth.las", slice(None), TRUTH)
    for share in (0.1, 0.3, 0.63):
        with pytest.raises(Cancelled):
            assess(found, truth, report=tmp_path / "r.html", progress=CancelAt(share))
    assert not (tmp_path / "r.html").exists()


def test_the_command_tells_what_is_not_compared(tmp_path, capsys):
    found = write(tmp_path / "found.las", MIXED, FOUND)
    truth = write(tmp_path / "truth.las", slice(None), TRUTH)
    assert main(["assess", str(found), str(truth)]) == 0
    assert f"{COUNT - len(CLIP):,} of the reference only" in capsys.readouterr().out
    assert main(["assess", str(found), str(truth), "--json"]) == 0
    assert json.loads(capsys.readouterr().out)["reference_only"] == COUNT - len(CLIP)
