"""Reads from object stores (s3, gs, az) by fsspec, if it is installed.

`cat_file` of fsspec may return too few bytes without an error, so that lengths and versions are
checked here.
"""

from __future__ import annotations

import threading
from typing import TYPE_CHECKING, Callable, TypeVar
from urllib.parse import urlsplit

from ..core.errors import BareEarthError
from .addresses import shown
from .answers import FileVersion, Missing, Unfinished, changed, too_large

if TYPE_CHECKING:
    from fsspec import AbstractFileSystem

_Result = TypeVar("_Result")


class StoreReader:
    """Reads objects of stores; several threads can use it at the same time."""

    def __init__(self) -> None:
        self.requests = self.received = 0
        self.notes: list[str] = []
        self.refusal: str | None = None
        self._lock = threading.Lock()

    def read(
        self, address: str, start: int, stop: int, known: FileVersion | None
    ) -> tuple[bytes, FileVersion]:
        """Return bytes of an object, of the known version of it."""
        before = self._state(address) if known is None else known
        stop = min(stop, before.size) if known is None else stop

        def bytes_of(store: AbstractFileSystem) -> bytes:
            return store.cat_file(address, start=start, end=stop)

        data = self._ask(address, bytes_of)
        # Stores state no version with the bytes, so it must be the same before and after.
        if self._state(address) != before:
            raise changed(address)
        with self._lock:
            self.received += len(data)
        if len(data) != stop - start:
            raise Unfinished(f"it sent {len(data):,} of {stop - start:,} bytes")
        return data, before

    def read_whole(self, address: str, most: int) -> bytes:
        """Return a whole object of at most `most` bytes."""
        state = self._state(address)
        if state.size > most:
            raise too_large(address, f"has {state.size:,} bytes")
        return self.read(address, 0, state.size, state)[0]

    def place_of(self, address: str) -> str:
        """Return the address itself."""
        return address

    def close(self) -> None:
        """Do nothing, because fsspec keeps its connections."""

    def end_overdue(self) -> None:
        """Do nothing, because fsspec has limits of its own."""

    def _state(self, address: str) -> FileVersion:
        def info_of(store: AbstractFileSystem) -> dict[str, object]:
            return store.info(address, refresh=True)

        found = self._ask(address, info_of)
        etag = found.get("ETag") or found.get("etag") or ""
        modified = found.get("LastModified") or found.get("last_modified") or found.get("updated")
        return FileVersion(int(str(found["size"])), str(etag), str(modified or ""))

    def _ask(self, address: str, work: Callable[[AbstractFileSystem], _Result]) -> _Result:
        """Return the result of work on the file system of a store, and raise its errors as ours."""
        with self._lock:
            self.requests += 1
        try:
            import fsspec

            return work(fsspec.filesystem(urlsplit(address).scheme.lower()))
        except ImportError as error:
            raise BareEarthError(
                f"{shown(address)} needs fsspec ({error}): pip install fsspec and what it names for"
                " this store, or give an address that begins with https://."
            ) from error
        except FileNotFoundError as error:
            raise Missing(f"{shown(address)} does not exist. Check the address.") from error
        except Exception as error:  # each store has its own
            kind = type(error).__name__
            if isinstance(error, PermissionError) or "Credentials" in kind:
                raise Missing(
                    f"You may not read {shown(address)} ({kind}). Check the address and how fsspec"
                    " is set up: the keys of the store, or that it needs none."
                ) from error
            raise Unfinished(kind) from error
