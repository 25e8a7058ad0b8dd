"""Reads from stores of objects (s3, gs, az) by fsspec, if it is installed.

Its `cat_file` gives a short answer without an error, so lengths and versions are checked here.
"""

from __future__ import annotations

import threading
from typing import Any
from urllib.parse import urlsplit

from ..core.errors import BareEarthError
from .addresses import host_of, shown
from .answers import Missing, State, Unfinished, changed

# Options of stores, of which the next are tried where the ones before may not read: wrong keys, or
# none, must not hide public objects of s3.
_OPTIONS: dict[str, list[dict[str, Any]]] = {"s3": [{}, {"anon": True}]}
_PACKAGES = {"s3": "s3fs", "gs": "gcsfs", "az": "adlfs", "abfs": "adlfs"}


class StoreReader:
    """Reads objects of stores; several threads can use it at the same time."""

    def __init__(self) -> None:
        self.requests = self.received = 0
        self.notes: list[str] = []
        self._options: dict[str, dict[str, Any]] = {}  # that work, by scheme and bucket
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

    def place_of(self, address: str) -> str:
        """Return the address itself."""
        return address

    def close(self) -> None:
        """End nothing: fsspec keeps its connections."""

    def _state(self, address: str) -> State:
        found = self._ask(address, "info", refresh=True)
        etag = found.get("ETag") or found.get("etag") or ""
        modified = found.get("LastModified") or found.get("last_modified") or found.get("updated")
        return State(int(found["size"]), str(etag), str(modified or ""))

    def _ask(self, address: str, name: str, **options: Any) -> Any:
        """Call a function of the file system of a store."""
        scheme = urlsplit(address).scheme.lower()
        place = f"{scheme}://{host_of(address)}"
        known = self._options.get(place)
        refusal: Exception | None = None
        for used in _OPTIONS.get(scheme, [{}]) if known is None else [known]:
            try:
                found = self._call(scheme, used, name, address, options)
            except PermissionError as error:
                refusal = error
                continue
            with self._lock:
                if used and place not in self._options:
                    self.notes.append(f"{place} is read without keys.")
                self._options[place] = used
                self.received += len(found) if isinstance(found, bytes) else 0
            return found
        raise Missing(
            f"You may not read {shown(address)}. Check the address and the keys of the store."
        ) from refusal

    def _call(
        self, scheme: str, used: dict[str, Any], name: str, address: str, options: dict[str, Any]
    ) -> Any:
        """Call a function of a file system, and tell its errors; `PermissionError` without keys."""
        with self._lock:
            self.requests += 1
        try:
            import fsspec

            return getattr(fsspec.filesystem(scheme, **used), name)(address, **options)
        except ImportError as error:
            raise BareEarthError(
                f"{shown(address)} needs fsspec and {_PACKAGES[scheme]}: pip install fsspec"
                f" {_PACKAGES[scheme]}, or give an address that begins with https://."
            ) from error
        except FileNotFoundError as error:
            raise Missing(f"{shown(address)} does not exist. Check the address.") from error
        except PermissionError:
            raise
        except Exception as error:  # each store has its own
            if "Credentials" in type(error).__name__:
                raise PermissionError from error
            raise Unfinished(type(error).__name__) from error
