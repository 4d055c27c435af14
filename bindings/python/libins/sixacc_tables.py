"""Tables of a scenario for six accelerometers on the acquisition board.

Keys left out keep the paper's arrangement without errors. Lists are of accelerometers 1 to 6; see ins_truth/accel.h.
"""

from dataclasses import dataclass

from libins.schema import Document, field

COUNT = 6
G_M_S2 = 9.80665
SPAN_CODES = 4096
VECTORS = {"misalignment_rad": 2, "axis": 3, "place_m": 3}
"""Keys of a list of lists, and how long each is."""


@dataclass(frozen=True, kw_only=True)
class SixAcc:
    """The accelerometers, in the place of the gyros."""

    rho_m: float = field(0.1, above=0.0, maximum=10.0)
    range_g: float = field(2.0, above=0.0, maximum=1e3)
    noise_lsb: float = field(0.5, minimum=0.0, maximum=1e3)
    turn_on_m_s2: float = field(0.0, minimum=0.0, maximum=100.0)
    bias_m_s2: list[float] = field([0.0] * COUNT)
    scale_error: list[float] = field([0.0] * COUNT)
    quadratic_s2_m: list[float] = field([0.0] * COUNT)
    misalignment_rad: list[list[float]] = field([[0.0, 0.0]] * COUNT)
    axis: list[list[float]] | None = field(None)
    place_m: list[list[float]] | None = field(None)

    @property
    def lsb_m_s2(self) -> float:
        """One code."""
        return 2.0 * self.range_g * G_M_S2 / SPAN_CODES


@dataclass(frozen=True, kw_only=True)
class Calibration:
    """What is made of the codes of a motion of kind fixture."""

    settle_s: float = field(0.5, minimum=0.0, maximum=1e5)
    paper: bool = field(False)


@dataclass(frozen=True, kw_only=True)
class GyroFree:
    """What their navigator is told: standard deviations at the start, and how long it stands still."""

    attitude_rad: list[float] = field([0.01, 0.01, 0.01], minimum=0.0, maximum=1.0)
    velocity_m_s: float = field(0.01, minimum=0.0, maximum=1e3)
    position_m: float = field(0.1, minimum=0.0, maximum=1e6)
    rate_rad_s: float = field(1e-4, minimum=0.0, maximum=10.0)
    bias_m_s2: float | None = field(None, minimum=0.0, maximum=100.0)
    bias_walk_m_s2_rts: float = field(0.0, minimum=0.0, maximum=1.0)
    still_s: float = field(0.0, minimum=0.0, maximum=1e6)
    still_m_s: float = field(1e-3, above=0.0, maximum=10.0)
    still_rad_s: float = field(1e-3, above=0.0, maximum=10.0)
    gate: float = field(0.0, minimum=0.0)
    gps_m: list[float] | None = field(None, above=0.0, maximum=1e6)


def check(document: Document, table: SixAcc) -> None:
    """What one key alone cannot show. Raises UsageError."""
    for name, value in vars(table).items():
        if not isinstance(value, list):
            continue
        if len(value) != COUNT:
            raise document.refuse(("sixacc", name), f"found {len(value)} entries, but {COUNT} are needed")
        for i, row in enumerate(value):
            if isinstance(row, list) and len(row) != VECTORS[name]:
                needed = f"{VECTORS[name]} numbers are needed"
                raise document.refuse(("sixacc", name, str(i)), f"found {row!r}, but {needed}")


def check_gyro_free(document: Document, table: GyroFree) -> None:
    """As check. Raises UsageError."""
    for key, value in (("attitude_rad", table.attitude_rad), ("gps_m", table.gps_m)):
        if value is not None and len(value) != 3:
            found = f"found {value!r}, but 3 numbers (north, east, down) are needed"
            raise document.refuse(("gyro_free", key), found)
