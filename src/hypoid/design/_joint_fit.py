"""One fit over several flanks that share settings: each unknown says what it moves on which flank.

A setting that one machine holds for both flanks moves the same entry of both vectors, a blade angle
one entry of one, a point width the two point radii by half of it each way. So the flanks' vectors are linear
in the unknowns, the flanks' rows stand on top of each other, and one Gauss-Newton serves a flank alone,
both flanks of a slot, and any process.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, Protocol

import numpy as np

from ._fit import Fit, Look, gauss_newton

Array = np.ndarray[Any, Any]


class FlankLook(Protocol):
    """One flank looked at: rows, their Jacobian by every entry of its vector, where to go on from."""

    @property
    def residual(self) -> Array: ...
    @property
    def jacobian(self) -> Array: ...
    @property
    def memory(self) -> Any: ...


FlankModel = Callable[[Array, Any], FlankLook | None]


@dataclass(frozen=True)
class Entry:
    """One unknown, and how much of it each flank's vector entries take (one mapping a flank)."""

    name: str
    moves: tuple[Mapping[str, float], ...]
    limit: float  # greatest change in one step; its scale, too
    low: float = -np.inf
    high: float = np.inf
    reads: tuple[Mapping[str, float], ...] | None = (
        None  # its value from the vectors, if not as moved
    )

    def value(self, vectors: Sequence[Array], index: Mapping[str, int]) -> float:
        """The unknown as flanks' vectors have it: the mean where those that share it differ."""
        if self.reads is not None:
            reads, size = self.reads, 1.0
        else:
            reads, size = self.moves, sum(v * v for move in self.moves for v in move.values())
        parts = zip(reads, vectors, strict=True)
        return sum(share * v[index[k]] for read, v in parts for k, share in read.items()) / size


@dataclass(frozen=True)
class Wish:
    """A value that an unknown should keep near, and how far it may stray (mm, rad)."""

    value: float
    spread: float


@dataclass(frozen=True)
class Tie:
    """Rows between flanks: residual (k,), and its Jacobian (k, entries) by each flank's vector."""

    residual: Array
    jacobians: tuple[Array, ...]


def shared(
    name: str, flanks: int, limit: float, low: float = -np.inf, high: float = np.inf
) -> Entry:
    """A setting that all flanks have in common."""
    return Entry(name, ({name: 1.0},) * flanks, limit, low, high)


def own(
    name: str,
    key: str,
    flank: int,
    flanks: int,
    limit: float,
    low: float = -np.inf,
    high: float = np.inf,
) -> Entry:
    """An entry ``key`` of one flank alone, called ``name``."""
    moves = tuple({key: 1.0} if n == flank else {} for n in range(flanks))
    return Entry(name, moves, limit, low, high)


@dataclass(frozen=True)
class JointFit:
    """Where a joint fit ended: unknowns, each flank's vector and look."""

    entries: tuple[Entry, ...]
    vectors: tuple[Array, ...]
    looks: tuple[Any, ...]
    fit: Fit

    @property
    def names(self) -> tuple[str, ...]:
        return tuple(entry.name for entry in self.entries)


class Unknowns:
    """The unknowns of a fit, and the flanks' vectors that they make of those at the start."""

    def __init__(
        self, entries: Sequence[Entry], vectors: Sequence[Array], index: Mapping[str, int]
    ) -> None:
        self.entries = tuple(entries)
        self.start = np.array([entry.value(vectors, index) for entry in entries])
        self.matrices: list[Array] = []
        self._bases: list[Array] = []
        plain = np.array([entry.reads is None for entry in entries], dtype=bool)
        for n, vector in enumerate(vectors):
            matrix = np.zeros((len(vector), len(entries)))
            for k, entry in enumerate(entries):
                for key, share in entry.moves[n].items():
                    matrix[index[key], k] = share
            self.matrices.append(matrix)
            # what only unknowns make up is theirs alone, so that flanks share what they should
            made = matrix[:, plain].any(axis=1) & ~matrix[:, ~plain].any(axis=1)
            self._bases.append(np.where(made, 0.0, vector - matrix @ self.start))

    def vectors(self, x: Array) -> tuple[Array, ...]:
        """Each flank's vector."""
        return tuple(b + m @ x for b, m in zip(self._bases, self.matrices, strict=True))

    def joined(self, jacobians: Sequence[Array]) -> Array:
        """Rows of every flank by the unknowns, from rows by each flank's vector; one above the other."""
        return np.concatenate([j @ m for j, m in zip(jacobians, self.matrices, strict=True)])

    def summed(self, jacobians: Sequence[Array]) -> Array:
        """The same for rows that all flanks have a part in."""
        return np.sum([j @ m for j, m in zip(jacobians, self.matrices, strict=True)], axis=0)

    def column(self, name: str) -> Array | None:
        """Unit row of an unknown, None where it is not among them."""
        names = [entry.name for entry in self.entries]
        return np.eye(len(names))[names.index(name)] if name in names else None


def joint_fit(
    flanks: Sequence[FlankModel],
    vectors: Sequence[Array],
    memories: Sequence[Any],
    entries: Sequence[Entry],
    index: Mapping[str, int],
    *,
    wishes: Mapping[str, Wish] | None = None,
    tie: Callable[[Sequence[Any]], Tie] | None = None,
    steps: int = 60,
) -> JointFit | None:
    """Gauss-Newton over the unknowns of all flanks; None where the start cannot be looked at.

    Parameters
    ----------
    flanks, vectors, memories
        One a flank: its model, the vector (m,) to start from, and where its Newton starts.
    entries
        The unknowns, with their bounds.
    index
        Place of each name in a flank's vector.
    wishes
        Values of unknowns to keep near.
    tie
        Rows between the flanks, from their looks: what a slot's width is, say.
    """
    unknowns = Unknowns(entries, vectors, index)
    wanted = [(unknowns.column(n), wish) for n, wish in (wishes or {}).items()]

    def model(x: Array, memory: Any) -> Look | None:
        seen: list[Any] = []
        for flank, vector, kept in zip(flanks, unknowns.vectors(x), memory, strict=True):
            look = flank(vector, kept)
            if look is None:
                return None
            seen.append(look)
        rows = [look.residual for look in seen]
        lines = [unknowns.joined([look.jacobian for look in seen])]
        if tie is not None:
            tied = tie(seen)
            rows.append(tied.residual)
            lines.append(unknowns.summed(tied.jacobians))
        for column, wish in wanted:
            if column is not None:
                rows.append(np.array([(column @ x - wish.value) / wish.spread]))
                lines.append(column[None] / wish.spread)
        memory = tuple(look.memory for look in seen)
        return Look(np.concatenate(rows), np.concatenate(lines), memory)

    limits, low, high = (
        np.array([getattr(entry, name) for entry in entries]) for name in ("limit", "low", "high")
    )
    fit = gauss_newton(
        model, unknowns.start, tuple(memories), limits, low=low, high=high, steps=steps
    )
    if fit is None:
        return None
    ended = unknowns.vectors(fit.x)
    looks = [f(v, m) for f, v, m in zip(flanks, ended, fit.look.memory, strict=True)]
    if any(look is None for look in looks):
        return None
    return JointFit(unknowns.entries, ended, tuple(looks), fit)
