"""The parts of the acquisition board with their pins and nets, for a schematic (Zheng and Zhou 2010, figure 3)."""

from typing import Any

from libins.scenario import Tables
from libins.view_history import NET_OF_PIN

Json = dict[str, Any]
CHANNELS = 11
"""Analogue inputs of a TLC2543."""
SENSORS = 3
"""On each of two converters."""
SECOND = {"EOC": "P1.5", "DATA OUT": "P1.6"}
"""Pins of the second converter that are its own."""


def parts(tables: Tables, sensors: int) -> list[Json]:
    """Name, kind and pins of each; sensors: 3 gyros or 6 accelerometers."""
    gyros = sensors == len("XYZ")
    names = [f"G{axis}" for axis in "XYZ"] if gyros else [f"A{i + 1}" for i in range(sensors)]
    kind = "gyro" if gyros else "accelerometer"
    line = [_pin("T1IN", "TXD"), _pin("R1OUT", "RXD"), _pin("T1OUT", "HOST RXD"), _pin("R1IN", "HOST TXD")]
    return [
        _cpu(tables.part),
        _converter("U2", {}, CHANNELS if gyros else SENSORS),
        *([] if gyros else [_converter("U3", SECOND, SENSORS)]),
        *[{"name": name, "kind": kind, "pins": [_pin("OUT", f"AIN{i}")]} for i, name in enumerate(names)],
        {"name": "Y1", "kind": "crystal", "hz": tables.clock_hz, "pins": [_pin("1", "XTAL1"), _pin("2", "XTAL2")]},
        {"name": "U4", "kind": "max232", "pins": line},
        {"name": "J1", "kind": "host", "pins": [_pin("RXD", "HOST RXD"), _pin("TXD", "HOST TXD")]},
    ]


def _pin(name: str, net: str) -> Json:
    return {"name": name, "net": net}


def _cpu(part: str) -> Json:
    ports = [f"P{port}.{bit}" for port in range(4) for bit in range(8)]
    pins = [_pin(pin, NET_OF_PIN.get(pin, pin)) for pin in ports]
    return {"name": "U1", "kind": part, "pins": [*pins, _pin("XTAL1", "XTAL1"), _pin("XTAL2", "XTAL2")]}


def _converter(name: str, own: dict[str, str], connected: int) -> Json:
    """connected: of its inputs, from AIN0."""
    nets = [net for net in NET_OF_PIN.values() if net not in ("RXD", "TXD")]
    first = SENSORS if own else 0
    inputs = [_pin(f"AIN{i}", f"AIN{first + i}" if i < connected else f"{name} AIN{i}") for i in range(CHANNELS)]
    return {"name": name, "kind": "tlc2543", "pins": [*[_pin(net, own.get(net, net)) for net in nets], *inputs]}
