"""Network namespaces for tests: one with a loopback interface and nothing else, or two with a cable between them.

Each is held by a process that ends with ours. An ordinary user gets them in a user namespace, where allowed.
"""

import contextlib
import shutil
import subprocess
import time
from collections.abc import Iterator, Sequence

REMEDY = (
    "no network namespace can be made here ({reason}): run the tests as root, or allow user namespaces "
    "(sysctl kernel.unprivileged_userns_clone=1, kernel.apparmor_restrict_unprivileged_userns=0; in a container "
    "--cap-add SYS_ADMIN)"
)
HOLD = "ip link set lo up && echo ready && exec cat"  # until its standard input ends
ADDRESSES = ("10.97.0.1", "10.97.0.2")
"""Of the two ends of a cable."""
CARRIER_LIMIT_S = 30  # a hang, not a figure


class Namespace:
    """One network. `of`: made inside that one's user namespace, so that a cable can join the two."""

    def __init__(self, of: "Namespace | None" = None) -> None:
        missing = [tool for tool in ("unshare", "nsenter", "ip") if shutil.which(tool) is None]
        assert not missing, f"{missing} missing: apt-get install util-linux iproute2"
        reasons = []
        for options in (["--net"],) if of else (["--user", "--map-root-user", "--net"], ["--net"]):
            command = ["unshare", *options, "sh", "-c", HOLD]
            self.holder = subprocess.Popen(
                command if of is None else of.inside(command),
                stdin=subprocess.PIPE,
                stdout=subprocess.PIPE,
                stderr=subprocess.PIPE,
                text=True,
            )
            self.has_user = of.has_user if of else "--user" in options
            assert self.holder.stdout is not None and self.holder.stderr is not None
            if self.holder.stdout.readline() == "ready\n":
                return
            reasons.append(self.holder.communicate()[1].strip())
        raise AssertionError(REMEDY.format(reason="; ".join(reasons)))

    def inside(self, command: Sequence[object]) -> list[str]:
        """The command, to be run in this network."""
        user = ["--user", "--preserve-credentials"] if self.has_user else []
        return ["nsenter", f"--target={self.holder.pid}", *user, "--net", *map(str, command)]

    def ip(self, *words: str) -> str:
        """What an ip command in it prints; it must succeed."""
        done = subprocess.run(self.inside(["ip", *words]), capture_output=True, text=True)
        assert done.returncode == 0, f"ip {' '.join(words)}: {done.stderr}"
        return done.stdout

    def close(self) -> None:
        """Whatever still runs in it keeps it alive."""
        self.holder.communicate()


@contextlib.contextmanager
def alone() -> Iterator[Namespace]:
    """A network of its own: the loopback interface."""
    with contextlib.closing(Namespace()) as network:
        yield network


@contextlib.contextmanager
def cable() -> Iterator[tuple[Namespace, Namespace]]:
    """Two, joined by interfaces "cable0" and "cable1" with ADDRESSES, over which no multicast goes."""
    with contextlib.closing(Namespace()) as one, contextlib.closing(Namespace(of=one)) as other:
        one.ip("link", "add", "cable0", "type", "veth", "peer", "name", "cable1", "netns", str(other.holder.pid))
        for end, network, address in (("cable0", one, ADDRESSES[0]), ("cable1", other, ADDRESSES[1])):
            network.ip("address", "add", f"{address}/24", "dev", end)
            network.ip("link", "set", end, "multicast", "off", "up")
        limit = time.monotonic() + CARRIER_LIMIT_S
        while "LOWER_UP" not in one.ip("link", "show", "cable0") or "LOWER_UP" not in other.ip(
            "link", "show", "cable1"
        ):
            assert time.monotonic() < limit, f"the cable has no carrier after {CARRIER_LIMIT_S} s"
            time.sleep(0.01)
        yield one, other
