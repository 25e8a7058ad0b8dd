"""The former name of `opening.open_las`."""

from .opening import open_las as read_layout

__all__ = ["read_layout"]
