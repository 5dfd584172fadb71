"""Traces as NumPy arrays."""

from __future__ import annotations

import os
from collections.abc import Iterator, Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from . import _lockstep
from .errors import TraceError


class Trace(Mapping[str, "NDArray[Any]"]):
    """Rows of signals over time: a mapping of names to columns, each as long as :attr:`time`.

    The arrays look into the memory in which the run has put the values; nothing is copied, and they cannot be
    written. That memory is kept for as long as any of them is there, also when the project is closed or gone. A trace
    is what there was when it was asked for: rows that come later are in the next one.

    Columns of BOOL are of dtype ``bool``, of integers ``int64`` or ``uint64``, all others ``float64``; TIME is in [s].
    From a CSV file all are ``float64``, since it has no types.

    >>> trace = project.trace
    >>> trace["Knife.Velocity"].max(), trace.units["Knife.Velocity"]
    (450.0, '°/s')

    ``pandas.DataFrame(dict(trace), index=trace.time)`` is a table of it.
    """

    __slots__ = ("_view", "_time", "_columns", "_types", "_units")

    def __init__(self, view: _lockstep.TraceView) -> None:
        signals = view.signals
        self._set(
            view.times(),
            {name: view.column(index) for index, (name, _, _) in enumerate(signals)},
            {name: kind for name, kind, _ in signals},
            {name: unit for name, _, unit in signals},
        )

    def _set(
        self, time: NDArray[np.float64], columns: dict[str, NDArray[Any]], types: dict[str, str], units: dict[str, str]
    ) -> None:
        self._time = time
        self._columns = columns
        self._types = types
        self._units = units

    @classmethod
    def from_arrays(
        cls,
        time: NDArray[np.float64],
        columns: Mapping[str, NDArray[Any]],
        types: Mapping[str, str],
        units: Mapping[str, str],
    ) -> Trace:
        """A trace of arrays that are there already; all columns as long as ``time``."""
        trace = cls.__new__(cls)
        for name, column in columns.items():
            if len(column) != len(time):
                raise ValueError(f"the column {name!r} has {len(column)} rows; allowed: {len(time)}, as the times have")
        trace._set(time, dict(columns), dict(types), dict(units))
        return trace

    @property
    def time(self) -> NDArray[np.float64]:
        """Time of each row since the start of the run [s]."""
        return self._time

    @property
    def names(self) -> tuple[str, ...]:
        """Names of the signals, in the order of the columns."""
        return tuple(self._columns)

    @property
    def units(self) -> dict[str, str]:
        """Unit of each signal as the project has it, such as ``mm/s``; empty where there is none, as in a CSV file."""
        return dict(self._units)

    @property
    def types(self) -> dict[str, str]:
        """IEC 61131-3 type of each signal, such as ``LREAL``."""
        return dict(self._types)

    @property
    def rows(self) -> int:
        """Number of rows."""
        return len(self._time)

    def __getitem__(self, name: str) -> NDArray[Any]:
        """The column of a signal; as in every path, capital letters are as good as small ones."""
        if name in self._columns:
            return self._columns[name]
        for one, column in self._columns.items():
            if isinstance(name, str) and one.lower() == name.lower():
                return column
        raise KeyError(f"the trace has no signal {name!r}; it has: {', '.join(self._columns) or 'none'}")

    def __iter__(self) -> Iterator[str]:
        return iter(self._columns)

    def __len__(self) -> int:
        return len(self._columns)

    def __eq__(self, other: object) -> bool:
        """Whether names, types, units and the bits of all values are the same."""
        if not isinstance(other, Trace):
            return NotImplemented
        if (self.names, self._types, self._units) != (other.names, other._types, other._units):
            return False
        pairs = [(self._time, other._time), *((self[name], other[name]) for name in self)]
        return all(a.dtype == b.dtype and a.tobytes() == b.tobytes() for a, b in pairs)

    __hash__ = None  # type: ignore[assignment]

    def __reduce__(self) -> tuple[Any, ...]:
        return Trace.from_arrays, (self._time, self._columns, self._types, self._units)

    def __repr__(self) -> str:
        span = f", {self._time[0]:g} s to {self._time[-1]:g} s" if self.rows else ""
        return f"<lockstep.Trace: {self.rows} rows of {len(self)} signals{span}>"

    def _ipython_key_completions_(self) -> list[str]:
        return list(self._columns)


def read_trace(path: str | os.PathLike[str]) -> Trace:
    """Reads a trace that ``lockstep run --trace`` has written: ``.csv``, or ``.lcm`` for a log.

    :raises TraceError: the file cannot be read, or is damaged; the text says where
    """
    name = os.fsdecode(path)
    if "\0" in name:
        raise TraceError(f"{name!r} is no name of a file; allowed: one without NUL")
    return Trace(_lockstep.read_trace(os.fsencode(name)))
