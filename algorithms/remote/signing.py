"""Signs addresses of the Planetary Computer, whose containers in Azure need a token.

A token is for a whole container and is valid for less than an hour. It stays in memory: files and
messages contain the address without it.

References
----------
https://planetarycomputer.microsoft.com/docs/concepts/sas/
"""

from __future__ import annotations

import json
import threading
from typing import Callable
from urllib.parse import urlsplit, urlunsplit

from ..core.words import option
from .addresses import host_of
from .answers import Expired, Missing

# Followed by the names of an account and of one of its containers.
_TOKENS = "https://planetarycomputer.microsoft.com/api/sas/v1/token"
_AZURE = ".blob.core.windows.net"
_MOST_BYTES = 1 << 16


class Signatures:
    """The tokens of a run, which are requested, if the user allows it, when a server refuses an
    address without a valid one.
    """

    def __init__(self, read_whole: Callable[[str, int], bytes], is_allowed: bool) -> None:
        self._read_whole, self._is_allowed = read_whole, is_allowed
        self._tokens: dict[str, str] = {}  # by container
        self._strange: set[str] = set()  # containers of others
        self.notes: list[str] = []  # what the user should know, not yet told
        self._lock = threading.Lock()

    def signed(self, address: str) -> str:
        """Return an address with the token of its container, if there is one."""
        token = self._tokens.get(_container_of(address) or "")
        return address if token is None else urlunsplit(urlsplit(address)._replace(query=token))

    def sign(self, address: str, refused: str, error: Missing | Expired) -> str:
        """Return an address with a new token, after a server has refused it without one or with
        another; raise the error if there is none.
        """
        container = _container_of(address)
        # If an address with a token is missing, the file does not exist.
        if container is None or (isinstance(error, Missing) and refused != address):
            raise error
        if not self._is_allowed:
            raise type(error)(
                f"{error} If it belongs to the Planetary Computer,"
                f" {option('follow', True, of='fetch')} gets a signature for it."
            )
        # One thread requests the token, and the others use it.
        with self._lock:
            if self.signed(address) in (address, refused) and container not in self._strange:
                self._ask(container)
        signed = self.signed(address)
        if signed in (address, refused):
            raise error
        return signed

    def _ask(self, container: str) -> None:
        if container not in self._tokens:
            self.notes.append(f"{host_of(_TOKENS)} is asked for a signature for {container}.")
        try:
            content = json.loads(self._read_whole(f"{_TOKENS}/{container}", _MOST_BYTES))
            self._tokens[container] = str(content["token"])
        except (Missing, ValueError, TypeError, KeyError, RecursionError):
            self._strange.add(container)


def _container_of(address: str) -> str | None:
    """Return account and container of an address of Azure."""
    account, _, rest = host_of(address).partition(".")
    container = urlsplit(address).path.split("/")[1:2]
    return f"{account}/{container[0]}" if f".{rest}" == _AZURE and container else None
