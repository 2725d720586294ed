"""Windows that are foretold: from contacts of other torques and positions."""

from __future__ import annotations

from dataclasses import replace

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
    """The rectangle moves and grows by what another did, the window about it leaves the same room all round."""
    earlier = seen(Window((-5.0, 7.5), (-1.2, 1.0)), Window((-4.0, 5.0), (-0.8, 0.6)))
    now = seen(Window((-5.0, 7.5), (-1.2, 1.0)), Window((-3.5, 6.5), (-0.6, 1.0)))
    found = now.changed(earlier, now)
    assert found is not None
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
    """No end moves by more than 0.3 of the length: the next try may bring it back."""
    wide = Window((-10.0, 15.0), (-1.2, 1.0))
    earlier = seen(wide, Window((-10.0, -6.0), (-0.8, 0.8)))
    now = seen(wide, Window((2.0, 6.0), (-0.8, 0.8)))
    guess = now.changed(earlier, now)
    found = guess and guess.contact
    assert found is not None
    np.testing.assert_allclose(found.along, (3.2, 7.2), atol=1e-12)


def test_a_small_contact_does_not_shrink_to_nothing_as_a_large_one_shrinks() -> None:
    wide = Window((-10.0, 15.0), (-1.2, 1.0))
    earlier, now = (seen(wide, Window((-9.0, end), (-0.8, 0.8))) for end in (14.0, 12.0))
    small = seen(Window((-1.0, 1.5), (-1.2, 1.0)), Window((-0.8, 0.8), (-0.8, 0.8)))
    assert now.changed(earlier, now) is not None
    assert small.changed(earlier, now) is None


def test_without_the_other_contacts_nothing_is_foretold() -> None:
    now = seen(Window((-5.0, 7.5), (-1.2, 1.0)), Window((-3.5, 6.5), (-0.6, 1.0)))
    nothing = Guess(now.window)
    for first, then in ((nothing, now), (now, nothing)):
        assert now.changed(first, then) is None
    assert nothing.changed(now, now) is None
    assert nothing.grown(1.0) is None
    assert now.grown(1.0) is None  # its own approach is not known


@pytest.mark.parametrize(("times", "length"), [(4.0, 2.0), (0.25, 0.5), (1e4, 4.0)])
def test_a_contact_grows_with_the_root_of_its_approach(times: float, length: float) -> None:
    """As an ellipse does; about the place where the pair touches first, and by four at the most."""
    window, contact = Window((-5.0, 7.5), (-1.2, 1.0)), Window((-3.5, 6.5), (-0.6, 1.0))
    now = replace(seen(window, contact), approach=2e-3)
    found = now.grown(2e-3 * times)
    assert found is not None
    assert found.contact is not None
    np.testing.assert_allclose(found.contact.ends, length * np.array(contact.ends), atol=1e-12)


def test_blas_keeps_to_one_thread_for_a_while() -> None:
    def threads() -> list[int]:
        return [one["num_threads"] for one in LIBRARIES.info() if one["user_api"] == "blas"]

    before = threads()
    assert before
    assert set(on_one_thread(threads)()) == {1}
    assert threads() == before
