"""Names of the F2812's registers and interrupts."""

from libins import _run
from libins.errors import UsageError

READ, WRITTEN, BEGAN, ENDED = range(4)
"""What a record of a run is of; KINDS by it."""
KINDS: tuple[str, ...] = tuple(_run.RECORD_WHAT)
PIE_FIRST = 32
"""Entry of INT1.1 in the table of vectors."""
PIE_EACH = 8
NAMED = {
    "INT1.6": "ADCINT",
    "INT1.7": "TINT0",
    "INT1.8": "WAKEINT",
    "INT9.1": "SCIRXINTA",
    "INT9.2": "SCITXINTA",
    "INT9.3": "SCIRXINTB",
    "INT9.4": "SCITXINTB",
}


def address_of(register: str) -> int:
    """Word address of a register that is modelled, by TI's name. Raises UsageError."""
    try:
        return int(_run.f2812_register(register)[0])
    except ValueError as error:
        raise UsageError(f"{error}; names are as in SCIFFRXA, PIEIER9, LOSPCP") from error


def name_of(address: int) -> str:
    """TI's name, or the address in hexadecimal."""
    return _run.f2812_register(address)[1] or f"{address:#06x}"


def interrupt_name(vector: int) -> str:
    """Of an entry of the table of vectors: SCIRXINTA, INT3.2, INT13."""
    if vector < PIE_FIRST:
        return f"INT{vector}"
    group, place = divmod(vector - PIE_FIRST, PIE_EACH)
    name = f"INT{group + 1}.{place + 1}"
    return NAMED.get(name, name)
