import dataclasses
import re
from pathlib import Path

import numpy as np
import pytest
from runs import Heard

from bare_earth import BareEarthError, Progress
from bare_earth.algorithms.classes.corrections import Corrections
from bare_earth.algorithms.classes.point_chooser import PointChooser
from bare_earth.algorithms.classes.point_counts import PointCounts
from bare_earth.algorithms.classes.selection import Selection
from bare_earth.algorithms.crs.system import Crs
from bare_earth.algorithms.las.cloud import PointCloud


def cloud_of(classes, number=None, total=None, withheld=None, point_format=6, crs=None):
    count = len(classes)
    xyz = [np.arange(count, dtype=np.int32)] * 3
    ones = np.ones(count, np.uint8)
    return PointCloud(
        Path("in.las"), *xyz, (0.01,) * 3, (0.0,) * 3, np.array(classes, np.uint8),
        ones if number is None else np.array(number, np.uint8),
        ones if total is None else np.array(total, np.uint8),
        np.zeros(count, bool) if withheld is None else np.array(withheld, bool),
        point_format, crs or Crs(),
    )  # fmt: skip


def with_overlap(classes, flags):
    return dataclasses.replace(cloud_of(classes), overlap=np.array(flags, bool))


def selected_by(selection, cloud, progress, within=None):
    """Return which points take part, and tell of the others, as a run does."""
    PointChooser(selection).choose(cloud, PointCounts())
    counts = PointCounts()
    selected = selection.choose(cloud, counts, within)
    selection.report(counts, cloud.path, progress, within is not None)
    return selected


def test_only_classes_without_a_further_meaning_take_part_and_roads():
    heard, every = Heard(), np.arange(256)
    decided = (0, 1, 2, 3, 4, 5, 6, 8, 12)
    selected = selected_by(Selection(), cloud_of(every), heard)
    assert np.flatnonzero(selected).tolist() == sorted((*decided, 10, 11))
    classes = np.array(new_classes(Selection(others="unclassified"), cloud_of(every), selected))
    assert (classes[list(decided)] == 2).all()
    others = np.delete(every, decided)
    assert classes[others].tolist() == others.tolist()


@pytest.mark.parametrize("point_format", [0, 3, 5])
def test_classes_that_old_point_formats_reserve_take_no_part_and_are_told(point_format):
    heard, cloud = Heard(), cloud_of([1, 2, 10, 11, 11, 18, 7, 9, 12], point_format=point_format)
    selected = selected_by(Selection(), cloud, heard)
    assert selected.tolist() == [1, 1, 0, 0, 0, 0, 0, 0, 1]
    noise, water = heard.infos[:2]
    assert noise.startswith("Noise") and "1 of class 7." in noise
    assert re.search(r"^1 point of class 9 \(water\).* from_classes='all'", water)
    (warning,) = heard.warnings
    assert warning.startswith("1 point of class 10, 2 of class 11, 1 of class 18 ")
    assert re.search("formats 0 to 5 .* from_classes='all'", warning)
    heard = Heard()
    selected = selected_by(Selection(from_classes="all"), cloud, heard)
    assert selected.tolist() == [1, 1, 1, 1, 1, 1, 0, 1, 1]
    heard = Heard()
    assert selected_by(Selection(seed_classes=(11,)), cloud, heard).sum() == 5
    assert any("2 points of class 11" in text for text in heard.infos)


def test_the_log_names_the_classes_that_stay_and_how_to_classify_them():
    heard = Heard()
    selected_by(Selection(), cloud_of([1, 9, 9, 10, 11, 11, 17, 64, 7]), heard)
    assert heard.infos == [
        "Noise is left out: 1 of class 7.",
        "1 point of class 10 (rail), 2 of class 11 (road surface) keep their class. Where they lie"
        " on the ground, they support it.",
        "2 points of class 9 (water), 1 of class 17 (bridge deck), 1 of class 64 keep their class"
        " and do not take part. To classify them too, give from_classes='all'.",
        "4 of 9 points take part.",
    ]
    heard = Heard()
    selected_by(Selection(from_classes=(1,)), cloud_of([1, 9]), heard)
    assert heard.infos == ["1 of 2 points take part."]


@pytest.mark.parametrize("all_", ["all", "ALL", ["all"], ("All",)])
def test_all_is_every_class_but_noise(all_):
    heard, selection = Heard(), Selection(from_classes=all_, others="unclassified")
    cloud = cloud_of([0, 1, 2, 5, 6, 7, 18, 64, 9])
    selected = selected_by(selection, cloud, heard)
    assert selected.tolist() == [True] * 5 + [False, False, True, True]
    assert heard.infos == [
        "Noise is left out: 1 of class 7, 1 of class 18.",
        "7 of 9 points take part.",
    ]
    assert new_classes(selection, cloud, [0] * 8 + [1]) == [1, 1, 1, 1, 1, 7, 18, 1, 2]
    assert selection == Selection(from_classes="all", others="unclassified")


def test_another_word_is_no_class():
    with pytest.raises(BareEarthError, match="list of numbers, not 'every'"):
        Selection(from_classes="every")
    with pytest.raises(BareEarthError, match="a number, not 'all'"):
        Selection(from_classes=["all", "1"])


def test_the_class_of_the_ground_is_decided_anew():
    cloud = cloud_of([1, 20, 20, 9])
    assert new_classes(Selection(to_class=20), cloud, [1, 1, 0, 0]) == [20, 20, 1, 9]


def test_overlap_is_counted_and_left_out_on_demand():
    heard, cloud = Heard(), with_overlap([1, 1, 12, 2], [0, 1, 0, 1])
    assert selected_by(Selection(), cloud, heard).all()
    assert any("3 points of overlap take part" in text for text in heard.infos)
    heard, leave = Heard(), Selection(overlap="leave-out")
    assert selected_by(leave, cloud, heard).tolist() == [1, 0, 0, 0]
    assert any("3 points of overlap are left out" in text for text in heard.infos)
    assert new_classes(leave, cloud, [1, 1, 1, 0]) == [2, 1, 12, 2]
    old = cloud_of([1, 12], point_format=1)
    assert selected_by(leave, old, Progress()).tolist() == [1, 0]


def test_polygons_change_classes_that_stay_but_not_noise():
    cloud, square = cloud_of([1, 9, 17, 7]), np.array([(-1, -1), (1, -1), (1, 1), (-1, 1)], float)
    corrections = Corrections(((square,),), (2,))
    by_hand = Selection().by_hand(cloud, corrections)
    assert by_hand.known.tolist() == [1, 1, 1, 0]
    by_hand = Selection(from_classes=(1,)).by_hand(cloud, corrections)
    assert by_hand.known.tolist() == [1, 0, 0, 0]


def test_only_the_given_classes_take_part_noise_among_them_where_it_is_given():
    cloud = cloud_of([0, 1, 2, 7, 18])
    assert selected_by(Selection(from_classes=(1, 7)), cloud, Progress()).tolist() == [
        0,
        1,
        0,
        1,
        0,
    ]


def test_withheld_points_take_no_part_and_are_told():
    heard = Heard()
    selected = selected_by(Selection(), cloud_of([1, 1, 1], withheld=[0, 1, 0]), heard)
    assert selected.tolist() == [True, False, True]
    assert any("1 withheld point" in text for text in heard.infos)


def test_last_and_single_returns_take_part():
    cloud = cloud_of([1] * 5, number=[1, 1, 2, 2, 3], total=[1, 2, 2, 3, 3])
    assert selected_by(Selection(), cloud, Progress()).tolist() == [1, 0, 1, 0, 1]
    assert selected_by(Selection(returns="all"), cloud, Progress()).all()


def test_a_number_above_the_total_is_a_last_return():
    cloud = cloud_of([1, 1], number=[3, 1], total=[2, 2])
    assert selected_by(Selection(), cloud, Progress()).tolist() == [1, 0]


def test_points_without_return_numbers_all_take_part_and_it_is_told():
    heard = Heard()
    cloud = cloud_of([1] * 3, number=[0, 0, 0], total=[0, 0, 0])
    assert selected_by(Selection(), cloud, heard).all()
    (warning,) = heard.warnings
    assert "no return numbers" in warning


def test_some_points_without_return_numbers_are_single_returns_and_it_is_told():
    heard = Heard()
    cloud = cloud_of([1] * 4, number=[0, 1, 1, 0], total=[0, 2, 1, 3])
    assert selected_by(Selection(), cloud, heard).tolist() == [1, 0, 1, 1]
    (warning,) = heard.warnings
    assert re.search("^2 points .* single returns", warning)


def test_no_warning_of_return_numbers_where_all_returns_are_wanted():
    heard = Heard()
    selected_by(Selection(returns="all"), cloud_of([1], number=[0], total=[0]), heard)
    assert not heard.warnings


@pytest.mark.parametrize(
    ("selection", "cloud", "text"),
    [
        (Selection(), cloud_of([7, 18]), r"classes 7, 18\b"),
        (Selection(from_classes=(2,)), cloud_of([1, 5]), r"only the classes 1, 5\b"),
        (Selection(), cloud_of([9, 9]), r"only the class 9\b"),
        (Selection(), cloud_of([1, 1], withheld=[1, 1]), "withheld.* flag"),
        (
            Selection(overlap="leave-out"),
            with_overlap([1, 12], [1, 0]),
            r"in\.las .* overlap='use'",
        ),
        (Selection(), cloud_of([1], number=[1], total=[2]), "all returns"),
        (Selection(), cloud_of([1], crs=Crs(is_geographic=True)), "not in a projected CRS"),
        (Selection(to_class=32), cloud_of([1], point_format=3), "31, not 32"),
    ],
)
def test_a_selection_without_points_says_what_to_change(selection, cloud, text):
    with pytest.raises(BareEarthError, match=text) as caught:
        selected_by(selection, cloud, Progress())
    assert "\n" not in str(caught.value)


def test_a_class_above_31_fits_into_the_new_formats():
    assert selected_by(Selection(to_class=64), cloud_of([1], point_format=6), Progress()).all()


def new_classes(selection, cloud, ground):
    before = cloud.classification.copy()
    classes = selection.classes(cloud, np.array(ground, bool))
    np.testing.assert_array_equal(cloud.classification, before)
    return classes.tolist()


def test_others_keep_their_class_but_old_ground_and_class_0_do_not():
    cloud = cloud_of([0, 1, 2, 2, 5, 6, 7, 18])
    ground = [0, 0, 0, 1, 0, 1, 0, 0]
    assert new_classes(Selection(), cloud, ground) == [1, 1, 1, 2, 5, 2, 7, 18]


def test_others_become_unclassified_where_wanted_but_noise_and_withheld_stay():
    cloud = cloud_of([0, 2, 5, 6, 7, 18, 4], withheld=[0, 0, 0, 0, 0, 0, 1])
    ground = [0, 1, 0, 1, 0, 0, 0]
    assert new_classes(Selection(others="unclassified"), cloud, ground) == [1, 2, 1, 2, 7, 18, 4]


@pytest.mark.parametrize("others", ["keep", "unclassified"])
def test_classes_that_were_not_to_be_classified_stay(others):
    cloud = cloud_of([0, 1, 2, 5, 9])
    selection = Selection(from_classes=(1, 5), others=others)
    assert new_classes(selection, cloud, [0, 1, 0, 0, 0]) == [
        0, 2, 2, 5 if others == "keep" else 1, 9,
    ]  # fmt: skip


def test_old_ground_of_earlier_returns_goes_too():
    cloud = cloud_of([2, 2, 5], number=[1, 2, 1], total=[2, 2, 2])
    assert new_classes(Selection(), cloud, [0, 1, 0]) == [1, 2, 5]


def test_another_class_of_the_ground():
    cloud = cloud_of([0, 2, 8, 8, 5])
    assert new_classes(Selection(to_class=8), cloud, [1, 0, 1, 0, 0]) == [8, 1, 8, 1, 5]


def test_only_points_within_take_part():
    heard, within = Heard(), np.array([0, 1, 1, 0], bool)
    assert selected_by(Selection(), cloud_of([1, 1, 7, 1]), heard, within).tolist() == [0, 1, 0, 0]
    assert "1 of 4 points take part." in heard.infos


@pytest.mark.parametrize(
    ("selection", "cloud", "text"),
    [
        (Selection(), cloud_of([1, 7, 18]), r"in the area .* classes 7, 18\b"),
        (Selection(), cloud_of([1, 1, 1], withheld=[0, 1, 1]), "in the area are withheld"),
        (Selection(), cloud_of([1] * 3, [1] * 3, [1, 2, 2]), "in the area .* last or single"),
    ],
)
def test_where_nothing_within_is_left_the_area_is_named(selection, cloud, text):
    with pytest.raises(BareEarthError, match=text):
        selected_by(selection, cloud, Progress(), np.array([0, 1, 1], bool))


def test_known_ground_takes_part_whatever_its_return_and_class_but_not_withheld():
    cloud = cloud_of(
        [1, 2, 2, 8, 5, 2], number=[1, 1, 1, 1, 1, 1], total=[1, 1, 2, 2, 1, 1],
        withheld=[0, 0, 0, 0, 0, 1],
    )  # fmt: skip
    selection, heard = Selection(from_classes=(1,), seed_classes=(2, 8)), Heard()
    assert selected_by(selection, cloud, heard).tolist() == [1, 1, 1, 1, 0, 0]
    assert selection.known_ground(cloud).tolist() == [0, 1, 1, 1, 0, 0]
    assert any("3 points of class 2, 8" in text for text in heard.infos)
    within = np.array([1, 1, 0, 0, 1, 1], bool)
    assert selection.known_ground(cloud, within).tolist() == [0, 1, 0, 0, 0, 0]
    assert not Selection().known_ground(cloud).any()


def test_known_ground_alone_is_nothing_to_classify():
    with pytest.raises(BareEarthError, match="can be classified"):
        selected_by(Selection(from_classes=(1,), seed_classes=(2,)), cloud_of([2, 2]), Progress())


def test_known_ground_gets_the_class_of_the_ground_only_where_it_may_change():
    cloud = cloud_of([1, 8, 8])
    assert new_classes(Selection(seed_classes=(8,)), cloud, [0, 1, 1]) == [1, 2, 2]
    selection = Selection(seed_classes=(8,), from_classes=(1,))
    assert new_classes(selection, cloud, [0, 1, 1]) == [1, 8, 8]


@pytest.mark.parametrize("others", ["keep", "unclassified"])
def test_low_outliers_become_class_7_and_outside_nothing_changes(others):
    cloud = cloud_of([1, 5, 2, 1, 5, 0, 6])
    low, inside = np.array([0, 1, 1, 1, 0, 0, 0], bool), np.array([1, 1, 1, 0, 0, 0, 1], bool)
    ground = np.array([1, 0, 0, 0, 1, 0, 0], bool)
    classes = Selection(others=others).classes(cloud, ground, low, inside)
    assert classes.tolist() == [2, 7, 7, 1, 5, 0, 6 if others == "keep" else 1]
