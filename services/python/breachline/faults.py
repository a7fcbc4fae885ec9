"""What can go wrong, in words of who asks: what, where, how to mend it."""


class BreachlineError(Exception):
    """No such run, a file that is not what it should be, a question that this run has no answer to."""


class Unreachable(BreachlineError):
    """The service does not answer."""
