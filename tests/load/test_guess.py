"""Windows that are foretold: from two positions' contacts to the next one's."""

from __future__ import annotations

import numpy as np
import pytest

from hypoid.load._dense import LIBRARIES, on_one_thread
from hypoid.load._guess import Guess, places
from hypoid.load._patch import Window

SHAPE = (25, 11)


def seen(window: Window, contact: Window) -> Guess:
    """A window whose cells in a rectangle touch."""
    sizes = [np.ptp(ends) / n for ends, n in zip(window.ends, SHAPE, strict=True)]
    at = [
        ends[0] + (np.arange(n) + 0.5) * size
        for ends, n, size in zip(window.ends, SHAPE, sizes, strict=True)
    ]
    inside = [(v > low) & (v < high) for v, (low, high) in zip(at, contact.ends, strict=True)]
    return Guess(window, np.outer(*inside))


def test_a_contact_that_goes_on_evenly_is_where_it_is_foretold() -> None:
    """The rectangle moves and grows by what it did before, the window about it leaves the same room all round."""
    earlier = seen(Window((-5.0, 7.5), (-1.2, 1.0)), Window((-4.0, 5.0), (-0.8, 0.6)))
    now = seen(Window((-5.0, 7.5), (-1.2, 1.0)), Window((-3.5, 6.5), (-0.6, 1.0)))
    found = now.after(earlier)
    assert found.contact is not None
    np.testing.assert_allclose(found.contact.ends, ((-3.0, 8.0), (-0.4, 1.4)), atol=1e-12)
    for (low, high), (start, end), room in zip(
        found.window.ends, found.contact.ends, (2.5 / 20.0, 1.6 / 7.8), strict=True
    ):
        assert start - low == pytest.approx(room * (end - start))
        assert high - end == pytest.approx(room * (end - start))
    # cells within the foretold rectangle are those that are thought to touch
    assert found.touching is not None
    assert found.frame is not None
    middle = np.array([[2.5, 0.5], [2.5, -0.5]])
    there, (column, row) = places(found.frame, middle, SHAPE)
    assert (there & found.touching[column, row]).tolist() == [True, False]


def test_a_contact_that_leaps_is_followed_with_care() -> None:
    """No end moves by more than 0.3 of the length: the next position may bring it back."""
    wide = Window((-10.0, 15.0), (-1.2, 1.0))
    earlier = seen(wide, Window((-10.0, -6.0), (-0.8, 0.8)))
    now = seen(wide, Window((2.0, 6.0), (-0.8, 0.8)))
    found = now.after(earlier).contact
    assert found is not None
    np.testing.assert_allclose(found.along, (3.2, 7.2), atol=1e-12)


def test_without_an_earlier_contact_a_window_stays() -> None:
    now = seen(Window((-5.0, 7.5), (-1.2, 1.0)), Window((-3.5, 6.5), (-0.6, 1.0)))
    assert now.after(None) is now
    assert now.after(Guess(now.window)) is now


def test_blas_keeps_to_one_thread_for_a_while() -> None:
    def threads() -> list[int]:
        return [one["num_threads"] for one in LIBRARIES.info() if one["user_api"] == "blas"]

    before = threads()
    assert before
    assert set(on_one_thread(threads)()) == {1}
    assert threads() == before
