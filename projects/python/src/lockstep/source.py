"""Where a project comes from: a file or its content, with keys changed by JSON pointers (RFC 6901)."""

from __future__ import annotations

import json
import math
import os
import re
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any, NamedTuple, Union

import numpy as np

from .errors import InvalidProject, OutOfRange, PathError

ProjectSource = Union[str, "os.PathLike[str]", Mapping[str, Any]]
"""A project file, or its content as ``json.load`` gives it."""

_LONGEST = (16 << 20) + 1
"""What is read of a file at most: a byte more than the loader takes, so that it tells."""


_TEXT_OR_COMMENT = re.compile(r'"(?:[^"\\\n]|\\.)*"|//[^\n]*|/\*.*?\*/', re.DOTALL)
"""A text, in which nothing is a comment, or a comment, which a project file may have and JSON has not."""


class Text(NamedTuple):
    """The text of a project, and the folder to which names of files in it are relative."""

    text: bytes
    folder: str
    file: str
    """Its name; empty: none."""
    as_written: bool = False
    """Whether its lines are those of the file, which is not so once keys have been changed."""

    def for_runtime(self) -> tuple[bytes, bytes, bytes, bool]:
        """The same with names as the system has them."""
        return self.text, os.fsencode(self.folder), os.fsencode(self.file), self.as_written


def text_of(project: ProjectSource) -> Text:
    """The text of a project.

    :raises OSError: the file cannot be read
    :raises InvalidProject: a number of the content is not finite
    :raises OutOfRange: the name or the content is none that files can have
    :raises TypeError: what is given is neither a path nor a mapping
    """
    if isinstance(project, Mapping):
        return Text(_json_of(plain(project), ""), "", "")
    if not isinstance(project, (str, os.PathLike)):
        kind = type(project).__name__
        raise TypeError(f"a project is the path of its file, or its content as a mapping; not {kind}")
    path = Path(file_name(project))
    with path.open("rb") as file:
        return Text(file.read(_LONGEST), str(path.parent), str(path), as_written=True)


def file_name(path: str | os.PathLike[str]) -> str:
    """The name of a file as such.

    :raises OutOfRange: it has a NUL, at which the system would end it
    """
    name = os.fsdecode(path)
    if "\0" in name:
        raise OutOfRange(f"{name!r} is no name of a file; allowed: one without NUL")
    return name


def unicode_of(text: str, what: str, error: type[Exception]) -> str:
    """A text as such, which has no halves of surrogate pairs: no file and no name of a project has them."""
    if not text.isascii():
        try:
            text.encode()
        except UnicodeEncodeError as wrong:
            found = text[wrong.start]
            raise error(f"{what} {text!a} has half of a surrogate pair, {found!a}, which is no character") from None
    return text


_DEEPEST = 128
"""Levels of objects and lists in each other; project files have 64 at most, which the loader tells with the place."""


def plain(value: Any, level: int = 0) -> Any:
    """A value as JSON has it; NumPy's scalars and arrays and tuples become Python's numbers and lists.

    :raises TypeError: JSON has no such value
    :raises OutOfRange: it is nested too deeply, as one that holds itself is, or a text is no Unicode
    """
    if level > _DEEPEST:
        raise OutOfRange("a value is nested too deeply, or holds itself; allowed are 64 levels")
    if isinstance(value, (np.generic, np.ndarray)):
        return plain(value.tolist(), level)
    if isinstance(value, str):
        return unicode_of(value, "the text", OutOfRange)
    if value is None or isinstance(value, (bool, int, float)):
        return value
    if isinstance(value, Mapping):
        if not all(isinstance(key, str) for key in value):
            raise TypeError("keys of an object have to be str")
        return {unicode_of(key, "the key", OutOfRange): plain(item, level + 1) for key, item in value.items()}
    if isinstance(value, (list, tuple)):
        return [plain(item, level + 1) for item in value]
    raise TypeError(f"JSON has no {type(value).__name__}; allowed: bool, int, float, str, None, list, dict")


def changed(source: Text, changes: Mapping[str, Any]) -> Text:
    """The project with other values at some JSON pointers. Of an object a member may be added, an array keeps its
    elements.

    :raises PathError: a pointer leads nowhere
    :raises InvalidProject: the text is no JSON, or has a key twice, or a number is not finite
    """
    if not changes:
        return source
    try:
        text = _without_comments(source.text.decode())
        document = json.loads(text, object_pairs_hook=_each_once, parse_float=_number)
    except json.JSONDecodeError as error:
        place = f"{error.lineno}:{error.colno}"
        raise InvalidProject([(place, f"the text is no JSON: {error.msg}", source.file)]) from None
    except (ValueError, RecursionError) as error:
        raise InvalidProject([("1:1", f"the text cannot be changed: {error}", source.file)]) from None
    for pointer, value in changes.items():
        _set(document, pointer, plain(value))
    return source._replace(text=_json_of(document, source.file), as_written=False)


def _json_of(document: Any, file: str) -> bytes:
    """A document as text.

    :raises InvalidProject: with the places of numbers that are not finite, which JSON has not
    """
    try:
        return json.dumps(document, allow_nan=False).encode()
    except ValueError:
        found = [(place, f"{number} is no number of JSON; allowed: finite ones", file) for place, number in _not_finite(document)]
        if not found:
            raise
        raise InvalidProject(found) from None


def _not_finite(value: Any, place: str = "") -> Iterator[tuple[str, float]]:
    """Numbers that are none, with their JSON pointers."""
    if isinstance(value, float) and not math.isfinite(value):
        yield place, value
    elif isinstance(value, dict):
        for key, member in value.items():
            yield from _not_finite(member, f"{place}/{key.replace('~', '~0').replace('/', '~1')}")
    elif isinstance(value, list):
        for index, element in enumerate(value):
            yield from _not_finite(element, f"{place}/{index}")


def _without_comments(text: str) -> str:
    """The text with spaces for its comments, so that every place stays what it is."""

    def blank(found: re.Match[str]) -> str:
        return found[0] if found[0].startswith('"') else re.sub(r"[^\n]", " ", found[0])

    return _TEXT_OR_COMMENT.sub(blank, text)


def _number(text: str) -> int | float:
    """A number with a point or an exponent: ``3e2`` is whole in a project file, ``3.0`` is not."""
    number = float(text)
    return int(number) if "." not in text and abs(number) < 2**53 and number.is_integer() else number


def _each_once(pairs: list[tuple[str, Any]]) -> dict[str, Any]:
    members = dict(pairs)
    if len(members) != len(pairs):
        twice = next(key for key, _ in pairs if [name for name, _ in pairs].count(key) > 1)
        raise ValueError(f"the key {twice!r} is there twice")
    return members


def _set(document: Any, pointer: str, value: Any) -> None:
    keys = [key.replace("~1", "/").replace("~0", "~") for key in pointer.split("/")[1:]]
    place = document
    for depth, key in enumerate(keys):
        is_last = depth == len(keys) - 1
        at = "/" + "/".join(keys[:depth])
        if isinstance(place, dict):
            if not is_last and key not in place:
                raise PathError(f"{pointer}: there is no {key!r} at {at}; there are: {', '.join(place) or 'none'}")
        elif isinstance(place, list):
            if not (key.isdecimal() and int(key) < len(place)):
                raise PathError(f"{pointer}: {at} has {len(place)} elements, from 0; {key!r} is none of them")
            key = int(key)  # type: ignore[assignment]
        else:
            raise PathError(f"{pointer}: {at} is {place!r}, which has no members")
        if is_last:
            place[key] = value
        else:
            place = place[key]
