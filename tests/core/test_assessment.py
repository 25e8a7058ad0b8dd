import numpy as np
import pytest

from bare_earth.algorithms.assessment import AssessmentOptions, compare


def test_the_four_figures_of_a_known_confusion():
    # Sithole & Vosselman's cross matrix: a = 40, b = 10, c = 5, d = 45.
    reference = np.repeat([2, 2, 1, 1], [40, 10, 5, 45])
    ground = np.repeat([True, False, True, False], [40, 10, 5, 45])
    result = compare(ground, reference)
    assert result.type_1_error == pytest.approx(20.0)
    assert result.type_2_error == pytest.approx(10.0)
    assert result.total_error == pytest.approx(15.0)
    assert result.kappa == pytest.approx(70.0)
    assert result.classes == {1: {"points": 50, "ground": 5}, 2: {"points": 50, "ground": 40}}


def test_chance_agreement_has_a_kappa_of_zero():
    reference = np.tile([2, 2, 1, 1], 10)
    ground = np.tile([True, False, True, False], 10)
    assert compare(ground, reference).kappa == pytest.approx(0.0)


def test_classes_may_count_as_ground_or_not_at_all():
    reference = np.array([2, 9, 7, 1])
    ground = np.array([True, True, True, False])
    options = AssessmentOptions(ground_classes=(2, 9), ignored_classes=(7,))
    assert compare(ground, reference, options).total_error == 0.0
    assert compare(ground, reference).total_error == pytest.approx(50.0)


def test_a_figure_without_points_is_none_in_json():
    figures = compare(np.array([True]), np.array([2])).as_dict()
    assert figures["type_2_error"] is None
    assert figures["total_error"] == 0.0
