from __future__ import annotations

from collections.abc import Callable

import pytest
from inspection import Bench, bench_of


@pytest.fixture(scope="session")
def bench() -> Callable[[str, str], Bench]:
    """A member of an example with its grid and setups, by names."""
    return bench_of
