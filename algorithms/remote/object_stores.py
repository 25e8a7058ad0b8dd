"""Reads from stores of objects (s3, gs, az) by fsspec, if it is installed.

Its `cat_file` gives a short answer without an error, so lengths and versions are checked here.
"""

from __future__ import annotations

import threading
from typing import Any
from urllib.parse import urlsplit

from ..core.errors import BareEarthError
from .addresses import shown
from .answers import Missing, State, Unfinished, changed

_PACKAGES = {"s3": "s3fs", "gs": "gcsfs", "az": "adlfs", "abfs": "adlfs"}


class StoreReader:
    """Reads objects of stores; several threads can use it at the same time."""

    def __init__(self) -> None:
        self.requests = self.received = 0
        self.notes: list[str] = []
        self._lock = threading.Lock()

    def read(self, address: str, start: int, stop: int, known: State | None) -> tuple[bytes, State]:
        """Return bytes of an object, of the known version of it."""
        before = self._state(address) if known is None else known
        stop = min(stop, before.size) if known is None else stop
        data = self._ask(address, "cat_file", start=start, end=stop)
        # Stores tell no version with the bytes: the object is the same if it was before and after.
        if self._state(address) != before:
            raise changed(address)
        if len(data) != stop - start:
            raise Unfinished(f"it sent {len(data):,} of {stop - start:,} bytes")
        return data, before

    def read_whole(self, address: str, most: int) -> bytes:
        """Return a whole object of at most so many bytes."""
        state = self._state(address)
        if state.size > most:
            raise BareEarthError(
                f"{shown(address)} has {state.size:,} bytes, which is too much for what it should"
                " be. Check the address."
            )
        return self.read(address, 0, state.size, state)[0]

    def close(self) -> None:
        """End nothing: fsspec keeps its connections."""

    def _state(self, address: str) -> State:
        found = self._ask(address, "info", refresh=True)
        etag = found.get("ETag") or found.get("etag") or ""
        modified = found.get("LastModified") or found.get("last_modified") or found.get("updated")
        return State(int(found["size"]), str(etag), str(modified or ""))

    def _ask(self, address: str, name: str, **options: Any) -> Any:
        """Call a function of the file system of a store, and tell its errors in a sentence."""
        scheme = urlsplit(address).scheme.lower()
        try:
            import fsspec

            store = fsspec.filesystem(scheme)
        except ImportError as error:
            raise BareEarthError(
                f"{shown(address)} needs fsspec and {_PACKAGES[scheme]}: pip install fsspec"
                f" {_PACKAGES[scheme]}, or give an address that begins with https://."
            ) from error
        with self._lock:
            self.requests += 1
        try:
            found = getattr(store, name)(address, **options)
        except FileNotFoundError as error:
            raise Missing(f"{shown(address)} does not exist. Check the address.") from error
        except PermissionError as error:
            raise Missing(
                f"You may not read {shown(address)}. Check the address and the keys of the store."
            ) from error
        except (OSError, TimeoutError) as error:
            raise Unfinished(type(error).__name__) from error
        if isinstance(found, bytes):
            with self._lock:
                self.received += len(found)
        return found
