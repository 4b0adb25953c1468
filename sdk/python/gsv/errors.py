"""What goes wrong, as exceptions: each says in one sentence what was expected, what was found and
what to do, and most are one of Python's own as well."""


class Error(Exception):
    """Anything that gsv raises."""


class Refused(Error, ValueError):
    """A request that can never succeed as it stands."""


class BadModel(Error, ValueError):
    """A world, robot, mesh or texture that cannot be used."""


class BehaviourFailed(Error):
    """A behaviour that raised, crashed or hung."""


class NotFound(Error, LookupError):
    """A name, file or offer that is not there."""


class Unavailable(Error, ConnectionError):
    """A peer, port, display or disk that does not respond."""


class TimedOut(Error, TimeoutError):
    """Something took longer than its limit."""


class NotRunning(Error):
    """A call that is not allowed in this state."""


class Ended(Error):
    """The simulation or sensor that was addressed is gone."""


class Corrupt(Error):
    """Bytes that do not decode."""
