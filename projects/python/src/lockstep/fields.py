"""What :func:`help` tells of the fields of a named tuple."""

from __future__ import annotations

import ast
import inspect
import textwrap
from typing import TypeVar

_Class = TypeVar("_Class", bound=type)


def with_field_docs(cls: _Class) -> _Class:
    """Makes the text below each field in the source the docstring of the field, as :func:`help` shows it.

    Without the source, as in a frozen program, the fields stay as they are.
    """
    try:
        (definition,) = ast.parse(textwrap.dedent(inspect.getsource(cls))).body
    except (OSError, TypeError, SyntaxError, ValueError):
        return cls
    assert isinstance(definition, ast.ClassDef)
    for field, below in zip(definition.body, definition.body[1:]):
        if not (isinstance(field, ast.AnnAssign) and isinstance(field.target, ast.Name)):
            continue
        if isinstance(below, ast.Expr) and isinstance(below.value, ast.Constant) and isinstance(below.value.value, str):
            getattr(cls, field.target.id).__doc__ = inspect.cleandoc(below.value.value)
    return cls
