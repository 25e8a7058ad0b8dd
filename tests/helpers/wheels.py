"""Wheels of a package that does nothing."""

import base64
import hashlib
import zipfile

from bare_earth.plugin.libraries.build import Build

PACKAGE = "tinylaz"


def tag_here():
    """Return a tag that this Python takes, of a compiled package."""
    build = Build.here()
    return f"{build.name.partition('-')[0]}-none-any"


def make_wheel(
    path, files=None, name=PACKAGE, tag=None, record=True, links=(), compression=zipfile.ZIP_STORED
):
    """Write a wheel; `record` False leaves the hashes wrong."""
    info = f"{name}-1.0.dist-info"
    content = {f"{name}/__init__.py": "made = True\n"} if files is None else dict(files)
    content[f"{info}/WHEEL"] = f"Wheel-Version: 1.0\nTag: {tag or tag_here()}\n"
    content[f"{info}/METADATA"] = f"Metadata-Version: 2.1\nName: {name}\nVersion: 1.0\n"
    lines = []
    with zipfile.ZipFile(path, "w", compression) as archive:
        for file, text in content.items():
            digest = hashlib.sha256(text.encode()).digest() if record else b"\0" * 32
            value = base64.urlsafe_b64encode(digest).rstrip(b"=").decode()
            lines.append(f"{file},sha256={value},{len(text)}\n")
            entry = zipfile.ZipInfo(file)
            entry.compress_type = compression
            entry.external_attr = (0o120777 if file in links else 0o644) << 16
            archive.writestr(entry, text)
        archive.writestr(f"{info}/RECORD", "".join(lines) + f"{info}/RECORD,,\n")
    return path
