"""Exceptions of the package: what is wrong, where, and what to write instead."""


class BreachlineError(Exception):
    """No such run, a file that is not what it should be, a question that this run has no answer to."""


class Unreachable(BreachlineError):
    """The service does not answer."""
