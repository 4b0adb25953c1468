"""The exceptions of gsv. Each message contains what was expected, what was found and what to do.
Most classes also derive from an exception of Python, such as ValueError."""


class Error(Exception):
    """The base class of all exceptions of gsv."""


class Refused(Error, ValueError):
    """A request that can never succeed in this form and must be changed."""


class BadModel(Error, ValueError):
    """A world, robot, mesh or texture that cannot be used."""


class BehaviourFailed(Error):
    """A behaviour that raised, crashed or hung."""


class NotFound(Error, LookupError):
    """A name, file or offer that does not exist."""


class Unavailable(Error, ConnectionError):
    """A peer, port, display or disk that does not respond."""


class TimedOut(Error, TimeoutError):
    """An operation that took longer than its time limit."""


class NotRunning(Error):
    """A call that is not allowed in the current state."""


class Ended(Error):
    """A call to a simulation or sensor that no longer exists."""


class Corrupt(Error):
    """A file or a message whose bytes cannot be decoded."""
