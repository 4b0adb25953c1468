"""Ends simulations and offers before the interpreter exits, because their threads must not call
Python after that."""

from __future__ import annotations

import atexit
import weakref
from typing import Any, Callable

_open: dict[int, tuple[weakref.ref[Any], Callable[[Any], None]]] = {}


def end_at_exit(thing: Any, end: Callable[[Any], None]) -> None:
    """Registers the call `end(thing)`, which is made when the interpreter exits, if `thing` still
    exists then. The calls are made in the reverse order of their registration."""
    key = id(thing)
    _open[key] = weakref.ref(thing, lambda _: _open.pop(key, None)), end


@atexit.register
def _end_all() -> None:
    for reference, end in reversed(list(_open.values())):
        thing = reference()
        if thing is not None:
            end(thing)
