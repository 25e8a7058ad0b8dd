"""What the jobs of a survey report: each message once, and what the jobs took."""

from __future__ import annotations

import re
from typing import Iterable, Sequence

from ..core.memory import GIGABYTE
from ..core.progress import Progress
from ..core.words import first_of
from .summary import JobCost

# Numbers and names of files, in which messages of jobs may differ.
_NUMBERS = re.compile(r"\S*\d\S*|\S+\.la[sz]\b\S*")


class JobMessages:
    """The messages of jobs, of jobs on files only the warnings."""

    def __init__(self) -> None:
        # The texts, each with the name of its file ("" for blocks), by kind, text without numbers,
        # and whether the message is about a file.
        self._texts: dict[tuple[str, str, bool], dict[str, str]] = {}

    def add(self, name: str, messages: Iterable[tuple[str, str]]) -> None:
        """Collect the messages of a job on a file, or of one on blocks, whose name is empty."""
        for kind, text in messages:
            if not name or kind == "warning":
                key = kind, _NUMBERS.sub("#", text), bool(name)
                alike = self._texts.setdefault(key, {})
                alike.setdefault(f"{name}: {text}" if name else text, name)

    def report(self, progress: Progress) -> None:
        """Report each message once, with the files whose messages differ only in numbers."""
        for (kind, _, of_files), alike in self._texts.items():
            first, *more_texts = alike
            more = ""
            if more_texts and of_files:
                names = first_of(sorted(alike[text] for text in more_texts))
                more = f" The same, with other numbers: {names}."
            elif more_texts:
                parts = (
                    "another part" if len(more_texts) == 1 else f"{len(more_texts):,} other parts"
                )
                more = f" The same, with other numbers, in {parts} of the survey."
            getattr(progress, kind)(first + more)


def report_costs(costs: Sequence[JobCost], progress: Progress) -> None:
    """Report how long jobs took, and the one that took most memory."""
    for cost in costs:
        stage = "blocks" if cost.job == "blocks" else "files"
        progress.took(stage, cost.seconds)
    known = [cost for cost in costs if cost.memory is not None]
    if known:
        most = max(known, key=lambda cost: cost.memory or 0)
        progress.info(
            f"{len(costs):,} jobs are done. The largest took"
            f" {(most.memory or 0) / GIGABYTE:.2f} GB of memory"
            f" ({most.planned / GIGABYTE:.2f} GB planned)."
        )
