"""What ties keys together in a file with [cutting], as far as each of them can be read by itself."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from hypoid.geometry import Problem

from ._document import Document, assigned, number_at, shown, value_at
from ._keys import MOST_TEETH


def design_rules(document: Document) -> Iterator[Problem]:
    """Every fault between keys."""
    wheel = value_at(document, ("wheel",))
    if isinstance(wheel, Mapping):
        sizes = {"mean_pitch_radius", "mean_pitch_diameter"} & wheel.keys()
        if len(sizes) != 1:
            given = "both of them" if sizes else "nothing"
            expected = "either mean_pitch_radius or mean_pitch_diameter"
            yield Problem(
                "wheel.mean_pitch_radius", given, expected, 'mean_pitch_radius = "130 mm"'
            )
    few, many = (value_at(document, (member, "teeth")) for member in ("pinion", "wheel"))
    if isinstance(few, int) and isinstance(many, int) and 1 <= many <= few <= MOST_TEETH:
        expected = f"more teeth than the pinion, which has {few}"
        yield Problem("wheel.teeth", str(many), expected, assigned("teeth", few + 1))
    radius = number_at(document, "wheel.mean_pitch_radius", "length")
    if radius is None:
        diameter = number_at(document, "wheel.mean_pitch_diameter", "length")
        radius = None if diameter is None else diameter / 2
    if radius is None or radius <= 0:
        return
    for path, limit, why in (
        ("pair.offset", radius, "the wheel's mean pitch radius: the offset lies beyond the wheel"),
        ("wheel.face_width", 2 * radius, "the wheel's mean pitch diameter: no cone is that wide"),
    ):
        length = number_at(document, path, "length")
        if length is not None and length >= limit:
            key, given = path.split(".")[1], shown(value_at(document, tuple(path.split("."))))
            example = assigned(key, f"{0.25 * limit:g} mm")
            yield Problem(path, given, f"less than {limit:g} mm, {why}", example)
