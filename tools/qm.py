"""Makes of translations in a .ts file the .qm file that Qt reads."""

from __future__ import annotations

import struct
import xml.etree.ElementTree as ElementTree
from typing import NamedTuple

_MAGIC = bytes.fromhex("3cb86418caef9c95cd211cbf60a1bddd")
# Sections of the file, and parts of a message (qtranslator.cpp of Qt 5 and 6).
_HASHES, _MESSAGES = 0x42, 0x69
_END, _TRANSLATION, _SOURCE, _CONTEXT, _COMMENT = 1, 3, 6, 7, 8


class Message(NamedTuple):
    """A text, where it belongs, and its translation; empty if there is none yet."""

    context: str
    source: str
    translation: str


def read_ts(text: bytes) -> list[Message]:
    """Return the messages of a .ts file."""
    return [
        Message(context.findtext("name", ""), message.findtext("source", ""),
                message.findtext("translation") or "")
        for context in ElementTree.fromstring(text).iter("context")
        for message in context.iter("message")
    ]  # fmt: skip


def compiled(messages: list[Message]) -> bytes:
    """Return the .qm file of messages; those without a translation are left out."""
    body, places = b"", []
    for message in messages:
        if message.translation:
            places.append((_hash(message.source.encode()), len(body)))
            body += _packed(message)
    hashes = b"".join(struct.pack(">II", *place) for place in sorted(places))
    return _MAGIC + _section(_HASHES, hashes) + _section(_MESSAGES, body)


def _packed(message: Message) -> bytes:
    parts = (
        (_TRANSLATION, message.translation.encode("utf-16-be")),
        (_SOURCE, message.source.encode()),
        (_CONTEXT, message.context.encode()),
        (_COMMENT, b""),
    )
    return b"".join(_section(*part) for part in parts) + bytes([_END])


def _section(tag: int, content: bytes) -> bytes:
    return struct.pack(">BI", tag, len(content)) + content


def _hash(text: bytes) -> int:
    """Return the hash of ELF (System V ABI), by which Qt finds a text."""
    value = 0
    for byte in text:
        value = (value << 4) + byte
        high = value & 0xF0000000
        value = (value ^ (high >> 24)) & ~high & 0xFFFFFFFF
    return value or 1
