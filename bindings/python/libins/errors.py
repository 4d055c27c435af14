"""Exceptions that the command line turns into a message and an exit code."""


class UsageError(Exception):
    """A scenario, option, file or device is not usable; the text names the place and the remedy. Exit code 2."""


class CrashError(Exception):
    """The process of a board came to its end, or no further; the text names program, board and instant. Exit code 3."""
