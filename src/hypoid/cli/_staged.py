"""Several files written together: all of them, or none."""

from __future__ import annotations

import os
from collections.abc import Callable, Generator, Iterable, Iterator
from contextlib import ExitStack, contextmanager
from dataclasses import replace
from pathlib import Path
from tempfile import TemporaryDirectory

from hypoid.geometry import DesignError, Problem

Place = Callable[[Path], Path]


@contextmanager
def staged(folders: Iterable[Path]) -> Generator[Place, None, None]:
    """Where to write files of these folders first; at the end they are moved to where they belong."""
    with ExitStack() as stack:
        stages: dict[Path, Path] = {}
        try:
            for folder in dict.fromkeys(folders):
                made = TemporaryDirectory(dir=folder, prefix=".hypoid-")
                stages[folder] = Path(stack.enter_context(made))
        except OSError as error:
            raise _unwritable(str(error.filename), error) from None
        try:
            yield lambda path: stages[path.parent] / path.name
        except DesignError as error:
            raise DesignError(_named(error.problems, stages)) from None
        for folder, stage in stages.items():
            for file in sorted(stage.iterdir()):
                try:
                    os.replace(file, folder / file.name)
                except OSError as error:
                    raise _unwritable(str(folder / file.name), error) from None


def _named(problems: Iterable[Problem], stages: dict[Path, Path]) -> Iterator[Problem]:
    """Problems with files by the places they were meant for."""
    for problem in problems:
        path = problem.path
        for folder, stage in stages.items():
            if Path(path).parent == stage:
                path = str(folder / Path(path).name)
        yield replace(problem, path=path)


def _unwritable(path: str, error: OSError) -> DesignError:
    given = f"a place that cannot be written ({error.strerror})"
    return DesignError([Problem(path, given, "a file that can be written", "--stl gear.stl")])
