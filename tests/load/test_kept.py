"""Compliance on disk: read back where the content is the same, and only there."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from hypoid.load._kept import kept


def test_same_contents_are_computed_once(tmp_path: Path) -> None:
    calls: list[int] = []

    def make() -> dict[str, np.ndarray]:
        calls.append(1)
        return {"a": np.arange(3.0)}

    contents = (np.ones(4), "steel", 7)
    first = kept(contents, make, tmp_path)
    second = kept((np.ones(4), "steel", 7), make, tmp_path)
    assert len(calls) == 1
    np.testing.assert_array_equal(first["a"], second["a"])
    kept((np.ones(4), "steel", 8), make, tmp_path)
    assert len(calls) == 2
    (file, _) = sorted(tmp_path.iterdir())
    for path in tmp_path.iterdir():
        path.write_bytes(b"half written")
    kept(contents, make, tmp_path)
    assert len(calls) == 3
    assert file.suffix == ".npz"


def test_a_folder_that_cannot_be_written_costs_nothing_but_time(tmp_path: Path) -> None:
    file = tmp_path / "file"
    file.write_text("")
    found = kept((1,), lambda: {"a": np.zeros(1)}, file / "folder")
    assert found["a"].shape == (1,)
