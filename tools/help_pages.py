"""Makes the help of the pages in docs/: HTML; and the README of the zip, whose links lead there."""

from __future__ import annotations

import re
from collections.abc import Collection
from html import escape

import markdown

# Pages for those who write programs; links to them lead to the repository.
_ELSEWHERE = ("api.md", "developing.md")
_PAGE = """<!DOCTYPE html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<title>{title}</title>
<style>
:root {{ color-scheme: light dark; --line: #8885; --link: #a05a10; }}
@media (prefers-color-scheme: dark) {{ :root {{ --link: #e0a35c; }} }}
body {{ max-width: 52rem; margin: 0 auto; padding: 1rem; font: 1rem/1.5 sans-serif; }}
a {{ color: var(--link); }}
nav {{ border-bottom: 1px solid var(--line); padding-bottom: .5rem; }}
img {{ max-width: 100%; }}
table {{ border-collapse: collapse; display: block; overflow-x: auto; }}
td, th {{ border: 1px solid var(--line); padding: .2rem .5rem; text-align: left; }}
pre {{ border: 1px solid var(--line); padding: .5rem; overflow-x: auto; }}
</style>
</head>
<body>
<nav><a href="{up}index.html">Bare Earth</a></nav>
{body}
</body>
</html>
"""


def help_pages(docs: dict[str, bytes], repository: str) -> dict[str, bytes]:
    """Return the files of the help.

    Parameters
    ----------
    docs : dict of str to bytes
        Name and content of the files in docs/, ``images/...`` among them.
    repository : str
        Address of the repository.

    Returns
    -------
    dict of str to bytes
        Pages, and the pictures that they show.
    """
    found = {}
    for name, content in docs.items():
        if name.endswith(".md") and name not in _ELSEWHERE:
            text = content.decode()
            found[_new_name(name)] = _page(text, repository, "../" * name.count("/")).encode()
            for picture in re.findall(r"\]\((?:\.\./)*(images/[^)]*)\)", text):
                found[picture] = docs[picture]
    return found


def packed_readme(
    readme: bytes, docs: dict[str, bytes], packed: Collection[str], repository: str
) -> dict[str, bytes]:
    """Return README.md for the zip, and the pictures that it shows.

    Parameters
    ----------
    readme : bytes
        README.md as it is in the repository.
    docs : dict of str to bytes
        As for `help_pages`.
    packed : collection of str
        The other files in the zip, those of the help in ``help/``. Links to what is not among them
        lead to the repository.
    repository : str
        Its address.
    """
    shown = {}

    def link(match: re.Match) -> str:
        name, anchor = match.groups()
        page = name[len("docs/") :] if name.startswith("docs/") else ""
        if page.startswith("images/"):
            shown[f"help/{page}"] = docs[page]
            return f"](help/{page})"
        here = f"help/{_new_name(page)}" if page else name
        return f"]({here if here in packed else f'{repository}/blob/main/{name}'}{anchor})"

    text = re.sub(r"\]\((?!https?:)([\w./-]+)((?:#[\w.-]*)?)\)", link, readme.decode())
    return {"README.md": text.encode(), **shown}


def _page(text: str, repository: str, up: str) -> str:
    """Return a page as HTML; `up` leads from its folder to that of the first page."""

    def link(match: re.Match) -> str:
        name, anchor = match.groups()
        if name[len(up) :] in _ELSEWHERE and name.startswith(up):
            return f"]({repository}/blob/main/docs/{name[len(up) :]}{anchor})"
        return f"]({_new_name(name)}{anchor})"

    text = re.sub(r"\]\(([\w./-]+\.md)((?:#[\w.-]*)?)\)", link, text)
    title = re.search(r"^# (.*)$", text, re.M).group(1)
    body = markdown.markdown(text, extensions=["tables", "fenced_code", "toc"])
    return _PAGE.format(title=escape(title), body=body, up=up)


def _new_name(name: str) -> str:
    return f"{name[: -len('.md')]}.html"
