"""Marine mooring analysis: records in the style of MOSES, and the engines below them over numpy arrays.

    >>> import windlass
    >>> w = windlass.Session()
    >>> w.run("&DIMEN -DIMEN METERS K-NTS")
    >>> t = w.table()            # the table that a record showed last
    >>> t["Ten Top"], t.units["Ten Top"], t.to_pandas()

`windlass.catenary` has the quasi-static line, `windlass.dynamics` lines for another program's time loop, `windlass.study` tables of cases.
"""

from . import catenary, dynamics, study
from ._core import Film, Message, Result, Session, Svg, Table, __version__
from .errors import Error, InternalError, RecordError, RecordWarning
from .magic import load_ipython_extension

__all__ = [
    "Error",
    "Film",
    "InternalError",
    "Message",
    "RecordError",
    "RecordWarning",
    "Result",
    "Session",
    "Svg",
    "Table",
    "__version__",
    "catenary",
    "dynamics",
    "load_ipython_extension",
    "study",
]
