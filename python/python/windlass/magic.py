"""`%%windlass`: a cell of records in a notebook.

    %load_ext windlass
    %%windlass
    &STATUS F_CONNECTOR

The cell runs in the session `w` of the notebook, or in that of the name behind `%%windlass`; one that is not there is made. Its text is shown as a
terminal shows it, and its tables are `w.table()`, `w.tables`.
"""

from __future__ import annotations

from typing import Any

from ._core import Result, Session

__all__ = ["load_ipython_extension"]


def _session(namespace: dict[str, Any], name: str) -> Session:
    if not name.isidentifier():
        raise ValueError(f"%%windlass takes the name of a session, not {name!r}")
    held = namespace.setdefault(name, None)
    if held is None:
        held = namespace[name] = Session()
    if not isinstance(held, Session):
        raise TypeError(f"{name} is no windlass.Session but a {type(held).__name__}")
    return held


def load_ipython_extension(ipython: Any) -> None:
    """What `%load_ext windlass` calls."""

    def windlass(line: str, cell: str) -> Result:
        """Runs records in the session `w`, or in that of the name given."""
        return _session(ipython.user_ns, line.strip() or "w").run(cell)

    ipython.register_magic_function(windlass, magic_kind="cell", magic_name="windlass")
