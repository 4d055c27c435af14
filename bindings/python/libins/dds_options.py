"""Options of the commands that publish or take on DDS: domain, topic, network, security."""

import argparse
import os
from pathlib import Path
from typing import Any

from libins.dds_security import places
from libins.errors import UsageError

DOMAIN_MAX = 230
"""As INS_DDS_DOMAIN_MAX."""


def options(command: argparse.ArgumentParser, topic: bool = True) -> None:
    """What they take."""
    command.add_argument("--domain", type=int, default=0, metavar="N", help=f"DDS domain id, 0..{DOMAIN_MAX} (0)")
    if topic:
        command.add_argument("--topic", default=None, metavar="T", help="DDS topic name")
        command.add_argument(
            "--qos",
            action="append",
            default=[],
            metavar="TOPIC=PROFILE",
            help="for example nav_state=sensor_data; profiles: default, sensor_data, latched, reliable (docs/dds.md)",
        )
    network = command.add_mutually_exclusive_group()
    network.add_argument(
        "--dds-config",
        type=Path,
        metavar="F.xml",
        help="Cyclone DDS configuration; without it, the loopback interface only",
    )
    network.add_argument("--dds-interface", metavar="IF", help="network interface in place of loopback, by multicast")
    command.add_argument(
        "--dds-peer", metavar="ADDR[,...]", help="on --dds-interface: these are asked, nothing is multicast"
    )
    command.add_argument(
        "--security",
        metavar="FOLDER|F.toml",
        help="DDS Security with the files that `ins keys` made there, or those of the table [security]",
    )


def _module(given: argparse.Namespace) -> tuple[Any, dict[str, str | None]]:
    """The extension, and the network. Raises UsageError."""
    try:
        from libins import _dds
    except ImportError as error:
        raise UsageError("this build has no DDS: install cyclonedds-dev and build with INS_BUILD_DDS=ON") from error
    if not 0 <= given.domain <= DOMAIN_MAX:
        raise UsageError(f"--domain {given.domain}: must lie in 0 .. {DOMAIN_MAX}")
    if given.dds_peer is not None and given.dds_interface is None:
        raise UsageError(f"--dds-peer {given.dds_peer}: wants --dds-interface")
    try:
        xml = None if given.dds_config is None else given.dds_config.read_text(encoding="utf-8")
    except OSError as error:
        raise UsageError(f"{given.dds_config}: cannot be read: {error.strerror}") from error
    return _dds, {"xml": xml, "interface": given.dds_interface, "peers": given.dds_peer}


def _security(given: argparse.Namespace) -> str | None:
    return None if given.security is None else places(given.security)


def decimation(command: argparse.ArgumentParser) -> None:
    """What publishers of states take besides."""
    command.add_argument(
        "--decimate", type=int, default=0, metavar="N", help="one state in N on libins/nav_state_decimated too"
    )


def open_dds(
    given: argparse.Namespace,
    publishes: bool,
    exclusive: bool = False,
    kind: str = "state",
    also: tuple[str, ...] = (),
) -> Any:
    """A DDS handle from the command line's options, for one kind of messages, and more. Raises UsageError."""
    decimate = given.decimate if publishes else 0
    if not 0 <= decimate <= 10**6:
        raise UsageError(f"--decimate {decimate}: must be 1 to 1000000")
    _dds, network = _module(given)
    try:
        topic = given.topic or _dds.TOPICS[kind]
        return _dds.Handle(
            given.domain,
            topic,
            publishes=publishes,
            exclusive=exclusive,
            security=_security(given),
            kind=kind,
            also=list(also),
            qos=given.qos,
            decimate=decimate,
            **network,
        )
    except RuntimeError as error:
        raise UsageError(f"DDS: {error}") from error


def open_raw(given: argparse.Namespace) -> Any:
    """Topics as octets, from the command line's options; with --ros on ROS_DOMAIN_ID. Raises UsageError."""
    if given.ros and (ros := os.environ.get("ROS_DOMAIN_ID")):
        if not ros.isdigit():
            raise UsageError(f"ROS_DOMAIN_ID is '{ros}': must be a number, or not set")
        given.domain = int(ros)
    _dds, network = _module(given)
    try:
        return _dds.Raw(given.domain, security=_security(given), **network)
    except RuntimeError as error:
        raise UsageError(f"DDS: {error}") from error


def open_ros(given: argparse.Namespace) -> Any:
    """A ROS 2 node in the namespace of --ros. Raises UsageError."""
    _dds, network = _module(given)
    domain = None if os.environ.get("ROS_DOMAIN_ID") else given.domain
    try:
        return _dds.Node(given.ros, domain, security=_security(given), **network)
    except RuntimeError as error:
        raise UsageError(f"ROS: {error}") from error
