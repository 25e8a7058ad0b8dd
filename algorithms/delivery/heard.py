"""The messages of a delivery, whose steps read the same files."""

from __future__ import annotations

from pathlib import Path

from ..core.progress import PassingOn, Progress


class Heard(PassingOn):
    """Passes on messages, each once, since several steps read the same files; keeps warnings."""

    def __init__(self, whole: Progress) -> None:
        super().__init__(whole)
        # which messages name in place of those that are temporary
        self.folders: dict[Path, Path] = {}
        self.warnings: list[str] = []
        self._said: set[str] = set()

    def info(self, text: str) -> None:
        """Pass on a message."""
        for each in self._new(text):
            super().info(each)

    def choice(self, text: str) -> None:
        """Pass on a choice."""
        for each in self._new(text):
            super().choice(each)

    def warning(self, text: str) -> None:
        """Pass on a warning, and keep it."""
        for each in self._new(text):
            self.warnings.append(each)
            super().warning(each)

    def _new(self, text: str) -> list[str]:
        """Return a message as it is to be read, or nothing if it was passed on before."""
        for temporary, folder in self.folders.items():
            text = text.replace(str(temporary), str(folder))
        is_new = text not in self._said
        self._said.add(text)
        return [text] if is_new else []
