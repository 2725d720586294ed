"""Options of `hypoid correct`: what may be moved and how far, what is wanted, and what was dialled before."""

from __future__ import annotations

import json
import math
import string
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from hypoid.geometry import DesignError, Problem

from ._options import quantities

if TYPE_CHECKING:
    from hypoid.flank import Side
    from hypoid.inspect import Comparison, MeasuringGrid, Wish

DIGITS, LETTERS = string.digits, string.ascii_uppercase


def wish_of(
    free: tuple[str, ...],
    noise: str,
    rank: int | None,
    exact: bool,
    bounds: tuple[str, ...],
    increment: tuple[str, ...],
) -> Wish:
    from hypoid.inspect import Wish

    problems: list[Problem] = []
    if rank is not None and rank < 1:
        problems.append(Problem("--rank", str(rank), "at least 1", "--rank 3"))
    sigma = quantities({"--noise": (noise, "length")})["--noise"]
    if not 0.0 < sigma < 1.0:
        problems.append(Problem("--noise", noise, "above 0 and below 1 mm", '--noise "1.5 um"'))
    names = tuple(n for group in free for n in group.replace(",", " ").split())
    steps = {
        n: _value(n, v, "--increment", problems)
        for n, v in _pairs_of(increment, "--increment", problems)
    }
    ends: dict[str, tuple[float, float]] = {}
    for name, text in _pairs_of(bounds, "--bounds", problems):
        low, dots, high = text.partition("..")
        if not dots:
            problems.append(
                Problem(
                    "--bounds",
                    text,
                    "two readings with .. between",
                    '--bounds "cradle_angle=66 deg..68 deg"',
                )
            )
            continue
        ends[name] = (
            _value(name, low, "--bounds", problems),
            _value(name, high, "--bounds", problems),
        )
    if problems:
        raise DesignError(problems)
    return Wish(
        free=names, noise=sigma, rank=rank, rounded=not exact, bounds=ends, increments=steps
    )


def _pairs_of(
    given: tuple[str, ...], option: str, problems: list[Problem]
) -> list[tuple[str, str]]:
    made: list[tuple[str, str]] = []
    for text in given:
        name, equals, value = text.partition("=")
        if equals:
            made.append((name.strip(), value.strip()))
        else:
            problems.append(
                Problem(option, text, "a name and a value", f'{option} "cradle_angle=1 min"')
            )
    return made


def _value(name: str, text: str, option: str, problems: list[Problem]) -> float:
    """A quantity by what its name says: an angle, a plain number, else a length."""
    from hypoid.io import QuantityError, parse

    try:
        if name.startswith(("ratio", "modified", "motions", "helical")):
            return float(text)
        return parse(text, "angle" if name.endswith("angle") else "length")
    except QuantityError as error:
        problems.append(
            Problem(option, error.given, error.expected, f'{option} "{name}={error.example}"')
        )
    except ValueError:
        problems.append(Problem(option, text, "a number", f'{option} "{name}=0.001"'))
    return 0.0


def targets_of(
    pair: Any, found: Comparison, other: Comparison | None, target: tuple[str, ...]
) -> Any:
    from hypoid.inspect import form, mates_ease_off

    problems: list[Problem] = []
    known = ("profile_crowning", "lengthwise_crowning", "bias")
    forms: dict[str, float] = {}
    for name, text in _pairs_of(target, "--target", problems):
        if name not in known:
            problems.append(
                Problem("--target", name, f"one of {', '.join(known)}", '--target "bias=3 um"')
            )
        else:
            forms[name] = _value(name, text, "--target", problems)
    if problems:
        raise DesignError(problems)
    made: dict[Any, Any] = {}
    for side, one in found.sides.items():
        made[side] = form(one.nodes, **forms)
        mate_side = "convex" if side == "concave" else "concave"
        if other is not None and mate_side in other.sides:
            mate = other.sides[mate_side]
            made[side] = made[side] + mates_ease_off(pair, one.nodes, mate.nodes, mate.mean)
    return made


def weights_of(grid: MeasuringGrid, weight: tuple[str, ...]) -> Any:
    """Weights (rows, columns) of both flanks: of rows and columns by their names, and of points."""
    from hypoid.flank import SIDES

    nodes = grid.flanks["concave"]
    names = [[nodes.name(r, c) for c in range(grid.columns)] for r in range(grid.rows)]
    found, problems = np.ones((grid.rows, grid.columns)), list[Problem]()
    for name, text in _pairs_of(weight, "--weight", problems):
        mine = np.array(
            [[name in (n, n.rstrip(DIGITS), n.lstrip(LETTERS)) for n in r] for r in names]
        )
        try:
            value = float(text)
        except ValueError:
            value = math.nan
        if not mine.any() or not 0.0 <= value < math.inf:
            expected = f"a row, column or point of {names[0][0]} to {names[-1][-1]} and a number of 0 or more"
            problems.append(
                Problem("--weight", f"{name}={text}", expected, f'--weight "{names[0][0]}=0.5"')
            )
        found[mine] *= value
    if problems:
        raise DesignError(problems)
    return dict.fromkeys(SIDES, found) if weight else {}


def steps_before(
    path: Path | None, shape: tuple[int, int]
) -> tuple[dict[str, dict[str, float]], dict[Side, np.ndarray], int]:
    """Steps by setup, deviations by side that earlier measurements predict, and how many those were."""
    if path is None:
        return {}, {}, 0
    try:
        given = json.loads(path.read_text(encoding="utf-8"))
        steps = {
            name: {n: float(v) for n, v in own.items()} for name, own in given["total"].items()
        }
        known = given.get("predicted_deviations_mm", {})
        earlier = {side: np.array(values, dtype=float) for side, values in known.items()}
        if any(deviation.shape != shape for deviation in earlier.values()):
            raise ValueError(f"of another grid than {shape[0]} x {shape[1]}")
        return steps, earlier, int(given.get("measurements", 0))
    except (OSError, ValueError, KeyError, AttributeError, TypeError) as error:
        said = f"{path} ({error})"
        raise DesignError(
            [Problem("--on-machine", said, "a file that --save wrote", "--on-machine steps.json")]
        ) from None
