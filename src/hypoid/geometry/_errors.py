"""What is wrong with an input, as data: the one exception that a user of the package can meet."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass


@dataclass(frozen=True)
class Problem:
    """One fault of an input: where it stands, what was given, what was expected, what works."""

    path: str
    given: str
    expected: str
    example: str

    def __str__(self) -> str:
        return (
            f"{self.path}: got {self.given}; expected {self.expected}; for example {self.example}"
        )


class DesignError(ValueError):
    """An input that cannot become a gear pair; carries every problem found, not only the first."""

    def __init__(self, problems: Iterable[Problem]) -> None:
        self.problems = tuple(problems)
        super().__init__("\n".join(str(problem) for problem in self.problems))
