"""Addresses of remote files: which are allowed, and how they are shown without secrets."""

from __future__ import annotations

import os
import re
from pathlib import Path
from urllib.parse import quote, unquote, urljoin, urlsplit, urlunsplit

from ..core.errors import BareEarthError

DEFAULT_PORTS = {"http": 80, "https": 443}
WEB = tuple(DEFAULT_PORTS)
STORES = ("s3", "gs", "az", "abfs")
# A scheme such as "s3://", but not a single letter, which is a drive of Windows.
_SCHEME = re.compile(r"([a-z][a-z0-9+.-]+)://", re.IGNORECASE)
# Mistyped addresses: "http:/user:password@host/..." and "user:password@host/...".
_MISTYPED = re.compile(r"https?:[/\\]|[^/\\:@]{2,}:[^\\]*@[\w.:\[\]-]+(/|$)", re.IGNORECASE)
# A server and its port, without a user.
_HOST = re.compile(r"([^@:\[\]]*|\[[^@\[\]]*\])(:\d*)?")
# Characters that are not encoded, because signatures depend on them.
_SAFE = "%/:?&=#+@!$'()*,;~[]|"


def is_address(text: str) -> bool:
    """Return whether a text is an address, or a mistyped one, and not a path on this computer."""
    if _SCHEME.match(text):
        return True
    return _MISTYPED.match(text) is not None and not os.path.exists(text)


def checked(address: str) -> str:
    """Return an address with spaces and such characters encoded; refuse one of an unknown kind or
    without a server.
    """
    scheme = _SCHEME.match(address)
    if scheme is None or scheme[1].lower() not in (*WEB, *STORES):
        raise BareEarthError(
            f"{shown(address)} cannot be fetched. Give an address that begins with https://, http://,"
            " s3://, gs:// or az://."
        )
    is_web = scheme[1].lower() in WEB  # the names of objects in stores are as they stand
    try:
        parts = urlsplit(quote(address.strip(), safe=_SAFE) if is_web else address.strip())
        parts.port  # noqa: B018  a ValueError if it is no number
    except ValueError:
        parts = urlsplit("")
    # An @ in a path would be part of a password that holds a slash.
    if not parts.hostname or (parts.username is not None and "@" in parts.path):
        raise BareEarthError(
            f"{shown(address)} names no server. Check the address; in a password, / is %2F and @ is"
            " %40."
        )
    return urlunsplit(parts._replace(fragment=""))


def shown(address: str) -> str:
    """Return an address without user, password, query and fragment, which may be secret."""
    scheme = _SCHEME.match(address)
    if scheme is None:
        return f"...@{address.rpartition('@')[2]}" if is_address(address) else address
    rest = address[scheme.end() :]
    if _HOST.fullmatch(re.split("[/?#]", rest)[0]):
        return f"{scheme[0]}{re.split('[?#]', rest)[0]}"
    # A password can contain characters that end a server or a path in other addresses.
    return f"{scheme[0]}{re.split('[?#]', rest.rpartition('@')[2])[0]}"


def host_of(address: str) -> str:
    """Return the server of an address, or the bucket of a store."""
    return (urlsplit(address).hostname or "").lower()


def origin_of(address: str) -> str:
    """Return scheme, server and port of an address, or scheme and bucket."""
    parts = urlsplit(address)
    scheme, host = parts.scheme.lower(), host_of(address)
    host = f"[{host}]" if ":" in host else host
    is_usual = scheme not in WEB or parts.port in (None, DEFAULT_PORTS[scheme])
    return f"{scheme}://{host}" if is_usual else f"{scheme}://{host}:{parts.port}"


def name_of(address: str) -> str:
    """Return the last part of the path of an address or of a path."""
    path = urlsplit(address).path if is_address(address) else address.replace("\\", "/")
    return unquote(path.rstrip("/").rpartition("/")[2])


def ends_with(address: str, *endings: str) -> bool:
    """Return whether the path of an address has one of the endings."""
    return name_of(address).lower().endswith(endings)


def beside(address: str, name: str) -> str:
    """Return the address or path of a file in the folder of another one, with the same query, which
    may contain a signature for the folder.
    """
    if not is_address(address):
        return str(Path(address).parent / name)
    parts = urlsplit(address)
    folder = parts.path.rpartition("/")[0]
    return urlunsplit(parts._replace(path=f"{folder}/{name}"))


def referred(base: str, reference: str) -> str:
    """Return the address that a document at `base` refers to."""
    if not is_address(base) or is_address(reference) or urlsplit(base).scheme in WEB:
        return urljoin(base, reference)
    # urljoin knows no stores, and their objects no "." and "..".
    path = urljoin(quote(urlsplit(base).path), reference)
    return urlunsplit(urlsplit(base)._replace(path=unquote(path)))
