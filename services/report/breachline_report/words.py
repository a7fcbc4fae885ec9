"""Numbers and entries of JSON documents as text."""
from __future__ import annotations

import math
from collections.abc import Iterable

from .document import Json

at_least = "\u2265 "  #: before a lower bound


def rounded(value: float, digits: int = 6) -> str:
    """Significant digits, without trailing zeros; large numbers without an exponent."""
    return f"{float(f'{value:.{digits}g}'):.12g}"


def entry(document: Json, pointer: str, default: Json = None) -> Json:
    """The entry at a JSON pointer; default: there is none, or it is null."""
    for key in pointer.split("/")[1:]:
        if isinstance(document, dict):
            document = document.get(key)
        elif isinstance(document, list) and key.isdigit() and int(key) < len(document):
            document = document[int(key)]
        else:
            return default
    return default if document is None else document


def number(document: Json, pointer: str) -> float | None:
    """None: no number is there."""
    value = entry(document, pointer)
    return float(value) if isinstance(value, (int, float)) and not isinstance(value, bool) else None


def fact(document: Json, pointer: str, unit: float = 1.0, digits: int = 4) -> str:
    """An entry as text, a number divided by `unit`; "-": there is none. Whole numbers keep their digits."""
    value = entry(document, pointer)
    if value is None:
        return "-"
    if isinstance(value, bool):
        return "yes" if value else "no"
    if isinstance(value, int) and unit == 1.0:
        return str(value)
    return rounded(value / unit, digits) if isinstance(value, float) or isinstance(value, int) else str(value)


def or_dash(value: Json, digits: int = 3) -> str:
    return rounded(value, digits) if isinstance(value, (int, float)) else "-"


def counted(count: int, noun: str) -> str:
    return f"{count} {noun}" + ("" if count == 1 else "s")


def joined(words: Iterable[str], between: str = ", ") -> str:
    return between.join(words)


def with_error(value: float, error: float | None, digits: int = 3) -> str:
    """With the digits that its error allows: two of the error's; without an error `digits` in all."""
    if not error or not math.isfinite(error):
        return rounded(value, digits)
    decimals = max(0, 1 - math.floor(math.log10(error)))
    return f"{value:.{decimals}f}"


def capital(text: str) -> str:
    return text[:1].upper() + text[1:]
