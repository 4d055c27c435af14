"""The one exception the command line turns into a message and exit code 2."""


class UsageError(Exception):
    """A scenario, option, file or device is not usable; the text names the place and the remedy."""
