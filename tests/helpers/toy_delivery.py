"""A delivery as somebody would add it: all that it is stands in one row."""

from toy_raster import forget

from bare_earth.algorithms.delivery.deliveries import DELIVERIES, Delivery
from bare_earth.algorithms.delivery.parameters import DeliveryChoice

NAME = "toy-plan"
ROW = Delivery(
    "Toy plan",
    "Hands over a coarse terrain model and its contour lines, without noise.",
    rasters=("dtm",),
    pictures=("dtm",),
    finest=2.0,
    values={"to_class": 31},
    contours=True,
    contour_metres=1.0,
)


def add_toy(monkeypatch):
    """Do what the row does in the table, from which the choice of dialogs is made."""
    (choice,) = DeliveryChoice.declarations()
    monkeypatch.setitem(DELIVERIES, NAME, ROW)
    monkeypatch.setitem(choice.choices, NAME, ROW.label)
    forget()
    return ROW
