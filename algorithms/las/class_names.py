"""The names of the classes of points."""

from __future__ import annotations

# ASPRS (2019): LAS specification 1.4, table 17, and the classes of its topo-bathymetric profile.
CLASSES = {
    0: "never classified", 1: "unclassified", 2: "ground", 3: "low vegetation",
    4: "medium vegetation", 5: "high vegetation", 6: "building", 7: "low noise",
    8: "model key point", 9: "water", 10: "rail", 11: "road surface", 12: "overlap",
    13: "wire guard", 14: "wire conductor", 15: "transmission tower", 16: "wire connector",
    17: "bridge deck", 18: "high noise", 20: "ignored ground", 40: "bathymetric bottom",
    41: "water surface", 42: "derived water surface", 43: "submerged object",
    44: "S-57 object", 45: "no bottom found",
}  # fmt: skip


def named_class(value: int) -> str:
    """Return a class as text: its number, and its name if the LAS specification has one."""
    return f"class {value} ({CLASSES[value]})" if value in CLASSES else f"class {value}"
