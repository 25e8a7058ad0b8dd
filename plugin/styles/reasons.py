"""Reasons of places in the user's language; layers and files have them in English."""

from __future__ import annotations

from ...algorithms.tools.review.reasons import parts_of
from ..i18n import tr


def in_own_language(reason: str) -> str:
    """Return a reason in the user's language; as it is if it is in other words than ours."""
    parts = (tr(text).format(**figures) for text, figures in parts_of(reason))
    return ", ".join(parts) or reason
