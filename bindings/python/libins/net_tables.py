"""Tables of a scenario with an F2812 on it: one board and what is on its two serial ports, or many boards on lines.

The short form is another way to write the long one: spread() gives what a run is made of.
"""

from dataclasses import dataclass

from libins.schema import Place, field
from libins.sensor_tables import Gimu, Gps, Track
from libins.tables import ACQUISITION, Acquisition, Common, Motion, Nav

F2812 = "f2812"
BOARDS = (*ACQUISITION, F2812)
PORTS = {"a": "SCIA", "b": "SCIB"}
DSP, GIMU = "dsp", "gimu"
"""Names of the board and of its sensor in the short form; a host has the port's, "scia"."""
HOST_BAUD = 9600.0
STILL = Motion(kind="still")


@dataclass(frozen=True, kw_only=True)
class F2812Board:
    """A board with a TMS320F2812 and a program built for it."""

    kind: str = field(F2812, choices=(F2812,))
    name: str = field(DSP)
    firmware: str
    oscclk_hz: int = field(30_000_000, minimum=4_000_000, maximum=150_000_000)
    switches: dict[str, str] = field({})


@dataclass(frozen=True, kw_only=True)
class AcquisitionBoard(Acquisition):
    """An acquisition board among others."""

    kind: str = field(choices=ACQUISITION)
    name: str


@dataclass(frozen=True, kw_only=True)
class Host:
    """Who is at the other end of a line: octets for a test or the outside, or a receiver and navigator."""

    name: str
    baud: float = field(HOST_BAUD, minimum=50.0, maximum=4e6)
    mode: str = field("octets", choices=("octets", "codes", "nav"))
    nav: Nav | None = field(None)


@dataclass(frozen=True, kw_only=True)
class LineKeys:
    """A serial line, both directions, and what goes wrong on it."""

    delay_s: float | None = field(None, above=0.0, maximum=1.0)
    bit_error: float = field(0.0, minimum=0.0, maximum=0.5)
    octet_loss: float = field(0.0, minimum=0.0, maximum=0.5)
    cuts_s: list[list[float]] = field([])


@dataclass(frozen=True, kw_only=True)
class Line(LineKeys):
    """Between two ends: "dsp.SCIA", "gimu.T", the name of a host. The same end twice ties its output to its input."""

    ends: list[str]
    baud: float | None = field(None, minimum=50.0, maximum=4e6)


@dataclass(frozen=True, kw_only=True)
class Port(LineKeys):
    """What is on a serial port of the one board."""

    to: str = field("open", choices=("open", "host", "gimu", "nmea", "loop"))
    baud: float | None = field(None, minimum=50.0, maximum=4e6)
    mode: str | None = field(None, choices=("octets", "nav"))


@dataclass(frozen=True, kw_only=True)
class Ports:
    """SCI-A and SCI-B."""

    a: Port = field(Port)
    b: Port = field(Port)


@dataclass(frozen=True, kw_only=True)
class NetCommon(Common):
    """Keys of both forms."""

    motion: Motion = field(STILL)
    track: Track = field(Track)
    gps: Gps = field(Gps)


@dataclass(frozen=True, kw_only=True)
class Single(NetCommon):
    """A scenario file of one F2812 board, as written."""

    board: str = field(choices=(F2812,))
    firmware: str
    oscclk_hz: int = field(30_000_000, minimum=4_000_000, maximum=150_000_000)
    switches: dict[str, str] = field({})
    sci: Ports = field(Ports)
    gimu: Gimu = field(Gimu)


@dataclass(frozen=True, kw_only=True)
class Many(NetCommon):
    """A scenario file of several boards, as written; or what the short form stands for."""

    board: list[F2812Board | AcquisitionBoard]
    gimu: list[Gimu] = field([])
    host: list[Host] = field([])
    line: list[Line] = field([])


@dataclass(frozen=True)
class Places:
    """Where the tables of a document stand, for a message about them."""

    board: list[Place]
    gimu: list[Place]
    host: list[Place]
    line: list[Place]


def spread(single: Single) -> tuple[Many, Places]:
    """The long form of the short one."""
    board = F2812Board(firmware=single.firmware, oscclk_hz=single.oscclk_hz, switches=single.switches)
    hosts: list[Host] = []
    lines: list[Line] = []
    host_places: list[Place] = []
    line_places: list[Place] = []
    has_gimu = False
    for letter, sci in PORTS.items():
        port: Port = getattr(single.sci, letter)
        if port.to == "open":
            continue
        mine = f"{DSP}.{sci}"
        far = {"host": sci.lower(), "gimu": f"{GIMU}.T", "nmea": f"{GIMU}.R", "loop": mine}[port.to]
        place: Place = ("sci", letter)
        if port.to == "host":
            hosts.append(Host(name=far, baud=port.baud or HOST_BAUD, mode=port.mode or "octets"))
            host_places.append(place)
        has_gimu = has_gimu or port.to in ("gimu", "nmea")
        keys = {name: getattr(port, name) for name in LineKeys.__dataclass_fields__}
        lines.append(Line(ends=[mine, far], baud=port.baud, **keys))
        line_places.append(place)
    common = {name: getattr(single, name) for name in NetCommon.__dataclass_fields__}
    gimus = [single.gimu] if has_gimu else []
    many = Many(board=[board], gimu=gimus, host=hosts, line=lines, **common)
    return many, Places([()], [("gimu",)] * len(gimus), host_places, line_places)


def places_of(many: Many) -> Places:
    """Of a document in the long form."""

    def numbered(name: str) -> list[Place]:
        return [(name, str(i)) for i in range(len(getattr(many, name)))]

    return Places(numbered("board"), numbered("gimu"), numbered("host"), numbered("line"))
