"""Exceptions of the package: what is wrong, where, and what to write instead."""


class BreachlineError(Exception):
    """The run does not exist, a file is invalid, or the run lacks the requested data."""


class Unreachable(BreachlineError):
    """The service does not answer."""
