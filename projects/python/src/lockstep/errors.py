"""What can go wrong, and how it is told. Every exception of the package is a LockstepError."""

from __future__ import annotations

import re
from typing import Any, Iterable, NamedTuple

from .fields import with_field_docs


@with_field_docs
class Problem(NamedTuple):
    """One thing that is wrong with a project file, or that is legal and looks like a mistake."""

    place: str
    """JSON pointer, such as ``/tags/start/init``; ``line:column`` where the text is no JSON."""
    text: str
    """What is wrong, and what is allowed; one line."""
    severity: str = "error"
    """``error``: the project is not valid; ``warning``: it is."""
    file: str = ""
    """The file in which it is: the project file, or one that it includes; empty where a project has no file."""
    line: int = 0
    """From 1; 0: not known, since the project has no file or its keys have been changed."""
    column: int = 0
    """In characters, from 1; 0 where ``line`` is."""
    owner: str = ""
    """What it is part of, such as ``call 'gear'``; empty: nothing that has a name."""

    def __str__(self) -> str:
        """As ``lockstep check`` tells it: ``FILE:place: text (line 3, column 5, call 'gear')``."""
        text = f"{self.file}:" if self.file else ""
        text += f"{self.place}: {'warning: ' if self.severity == 'warning' else ''}{self.text}"
        told = self.place == f"{self.line}:{self.column}"
        where = [f"line {self.line}", f"column {self.column}"] if self.line and not told else []
        where += [self.owner] if self.owner else []
        return f"{text} ({', '.join(where)})" if where else text


def _problem(
    severity: str, place: str, text: str, file: str = "", line: int = 0, column: int = 0, owner: str = ""
) -> Problem:
    # Where a text is no JSON, there are no pointers into it: its place is the line.
    if not line and re.fullmatch(r"[0-9]+:[0-9]+", place):
        line, column = map(int, place.split(":"))
    return Problem(place, text, severity, file, line, column, owner)


def problems_from(errors: Iterable[tuple[Any, ...]], warnings: Iterable[tuple[Any, ...]]) -> list[Problem]:
    """Problems as the runtime lists them, (place, text, file, line, column, owner): errors first."""
    return [_problem("error", *one) for one in errors] + [_problem("warning", *one) for one in warnings]


class LockstepError(Exception):
    """The base of all exceptions of this package."""


class InvalidProject(LockstepError, ValueError):
    """A project is not valid; ``problems`` has all that is wrong, not the first only."""

    def __init__(self, errors: Iterable[tuple[Any, ...]], warnings: Iterable[tuple[Any, ...]] = ()) -> None:
        self.problems: list[Problem] = problems_from(errors, warnings)
        super().__init__(
            [(one.place, one.text, *one[3:]) for one in self.problems if one.severity == "error"],
            [(one.place, one.text, *one[3:]) for one in self.problems if one.severity == "warning"],
        )

    def __str__(self) -> str:
        wrong = [str(problem) for problem in self.problems if problem.severity == "error"]
        return "\n".join([f"the project is not valid ({len(wrong)} problem{'s'[: len(wrong) != 1]})", *wrong])


class PathError(LockstepError, KeyError):
    """A path leads to no value; the text says what is wrong and what is near."""

    def __str__(self) -> str:
        return str(self.args[0]) if self.args else ""


class ReadOnly(LockstepError, TypeError):
    """What is there cannot be written; the text says why."""


class OutOfRange(LockstepError, ValueError):
    """A value that its place does not take; the text says what is allowed."""


class ExpressionError(LockstepError, ValueError):
    """A text is no expression of the project; the text says where and why."""


class BusyError(LockstepError, RuntimeError):
    """Another thread runs or waits for what is asked for."""


class ClosedError(LockstepError, ValueError):
    """The project has been closed."""


class RunError(LockstepError, RuntimeError):
    """A run in real time could not be started; the text says what is wrong and why."""


class TraceError(LockstepError, ValueError):
    """A trace file cannot be read, or is damaged; the text names file and place."""


class SweepError(LockstepError, RuntimeError):
    """A sweep cannot be begun or resumed, such as with the results of another one."""
