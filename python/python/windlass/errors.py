"""What windlass raises and warns of."""


class Error(Exception):
    """An engine refuses: the text says what, with the value and what is allowed."""


class InternalError(Error):
    """A defect of windlass. The session it happened in is not to be relied on."""


class RecordError(Error):
    """A record was refused. Those before it acted; it changed nothing, and those behind it were not read.

    `str(error)` is the message as a terminal prints it, with the record and the word underlined. `message` is its first line alone, `line`
    and `column` (from 1) are the place of the word in `source`, `help` what to write instead.
    """

    def __init__(
        self,
        message: str,
        text: str = "",
        source: str | None = None,
        line: int | None = None,
        column: int | None = None,
        word: str | None = None,
        label: str = "",
        help: list[str] | None = None,
    ) -> None:
        super().__init__(message, text, source, line, column, word, label, help)
        self.message = message
        self.text = text or message
        self.source = source
        self.line = line
        self.column = column
        self.word = word
        self.label = label
        self.help = list(help or [])

    def __str__(self) -> str:
        # the traceback stands before it on its line
        return "\n" + self.text.rstrip("\n") if "\n" in self.text else self.text


class RecordWarning(UserWarning):
    """A record was accepted, and is probably not what was meant; or a result needs a look."""
