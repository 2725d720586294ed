"""Executables on disk: loaded without tracing, never mixed up, compiled anew when unreadable."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest

from hypoid.geometry import _stored
from hypoid.geometry._stored import Stored


def nothing() -> dict[str, Any] | None:
    return None


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.setattr(_stored, "user_cache_dir", lambda *_, **__: str(tmp_path))
    return tmp_path / "executables"


def test_a_second_start_does_not_trace(folder: Path) -> None:
    traced: list[int] = []

    def twice(tree: Any) -> Any:
        traced.append(1)
        return 2.0 * tree["x"]

    for _ in range(2):
        assert np.asarray(Stored(twice, nothing)({"x": np.arange(3.0)})).tolist() == [0, 2, 4]
    assert len(traced) == 1
    assert len(list(folder.iterdir())) == 1


def test_functions_of_one_shape_are_told_apart_by_name(folder: Path) -> None:
    add = Stored(lambda x: x + 1.0, nothing, "add")
    double = Stored(lambda x: x * 2.0, nothing, "double")
    x = np.full(2, 5.0)
    assert np.asarray(add(x)).tolist() == [6, 6]
    assert np.asarray(double(x)).tolist() == [10, 10]
    assert len(list(folder.iterdir())) == 2


def test_an_unreadable_file_is_compiled_again(folder: Path) -> None:
    def negative(x: Any) -> Any:
        return -x

    x = np.ones(2)
    Stored(negative, nothing)(x)
    for path in folder.iterdir():
        path.write_bytes(b"half")
    assert np.asarray(Stored(negative, nothing)(x)).tolist() == [-1, -1]
