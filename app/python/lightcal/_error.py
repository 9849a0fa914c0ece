# SPDX-License-Identifier: Apache-2.0
"""What goes wrong, and what an answer survives but a person should know."""
from __future__ import annotations

from typing import Literal

Kind = Literal["failed", "usage", "refused"]


class Error(Exception):
    """A question that has no answer.

    kind     "refused": the data cannot support an answer (the command's exit 3); "usage": what is
             asked for makes no sense (2); "failed": files, devices, ourselves (1)
    code     a stable word: "underdetermined", "no_exposure_metadata", "exists", "usage", ...
    subject  what it is about: a light, a file and line, a keyword; may be empty
    message  what is wrong and what to do
    others   what else is wrong, each an Error: of a session every lamp that cannot be fitted
    """

    kind: Kind
    code: str
    subject: str
    message: str
    others: tuple[Error, ...]

    def __init__(
        self, kind: Kind, code: str, subject: str, message: str, others: tuple[Error, ...] = ()
    ) -> None:
        super().__init__(kind, code, subject, message, others)
        self.kind, self.code, self.subject, self.message = kind, code, subject, message
        self.others = others

    def __str__(self) -> str:
        where = f"{self.subject}: " if self.subject else ""
        return "\n".join([f"{self.code}: {where}{self.message}", *map(str, self.others)])


class DataWarning(UserWarning):
    """An answer was given, but something about the data should be known; the same stands in the
    answer under "warnings". `warnings.simplefilter("error", lightcal.DataWarning)` refuses such
    answers, as --strict does."""
