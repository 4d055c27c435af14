"""Prints navigation states that arrive over DDS. Of libins it has the layout of a type, the rest is PyPI's cyclonedds.

pip install cyclonedds; python subscribe.py [DOMAIN [COUNT]]
"""
# SPDX-License-Identifier: MIT

import os
import sys
from dataclasses import dataclass
from math import degrees, sqrt

from cyclonedds.core import Policy, Qos
from cyclonedds.domain import Domain, DomainParticipant
from cyclonedds.idl import IdlStruct, annotations, types
from cyclonedds.sub import DataReader
from cyclonedds.topic import Topic
from cyclonedds.util import duration

LOOPBACK = """<CycloneDDS><Domain><General><Interfaces><NetworkInterface name="lo" multicast="false"/></Interfaces>
<AllowMulticast>false</AllowMulticast></General><Discovery><ParticipantIndex>auto</ParticipantIndex>
<MaxAutoParticipantIndex>60</MaxAutoParticipantIndex><Peers><Peer address="127.0.0.1"/></Peers></Discovery>
</Domain></CycloneDDS>"""

POSITION, COVARIANCE = 0x20, 0x80  # bits of valid: ins_nav/navigation.h


# As in share/libins/idl/libins.idl, which has the units. A layout that differs gets no samples: DDS compares the types.
@dataclass
@annotations.final
class NavCounts(IdlStruct, typename="libins.NavCounts"):
    accepted: types.uint64
    lost: types.uint64
    invalid: types.uint64
    duplicates: types.uint64
    corrupt: types.uint64
    timeouts: types.uint64
    stray: types.uint64


@dataclass
@annotations.final
class NavState(IdlStruct, typename="libins.NavState"):
    source: types.bounded_str[63]
    annotations.key("source")
    published_ns: types.int64
    time_ns: types.int64
    time_base: types.uint32
    valid: types.uint32
    index: types.uint64
    t_s: types.float64
    q_nb: types.array[types.float64, 4]
    euler_rad: types.array[types.float64, 3]
    w_ib_b: types.array[types.float64, 3]
    f_b: types.array[types.float64, 3]
    v_n: types.array[types.float64, 3]
    llh: types.array[types.float64, 3]
    P: types.array[types.float64, 45]
    dtheta_b: types.array[types.float64, 3]
    seq: types.uint32
    bridged: types.uint32
    status: types.uint32
    used: types.uint64
    missed: types.uint64
    counts: NavCounts


domain = int(sys.argv[1]) if len(sys.argv) > 1 else 0
left = int(sys.argv[2]) if len(sys.argv) > 2 else -1
configured = Domain(domain, os.environ.get("CYCLONEDDS_URI", LOOPBACK))  # before the participant, and kept
qos = Qos(Policy.Reliability.Reliable(duration(seconds=1)), Policy.History.KeepLast(100))
participant = DomainParticipant(domain)
reader = DataReader(participant, Topic(participant, "libins/nav_state", NavState), qos=qos)
for state in reader.take_iter(timeout=duration(seconds=10)):
    roll, pitch, yaw = state.euler_rad
    place = ""
    if state.valid & POSITION:
        latitude, longitude = map(degrees, state.llh[:2])
        sigma = f" +- {sqrt(max(state.P[39], state.P[42])):.2f} m" if state.valid & COVARIANCE else ""
        place = f", {latitude:.7f} {longitude:.7f} deg{sigma}"
    print(f"{state.source} {state.index}: roll {roll:.6f} pitch {pitch:.6f} yaw {yaw:.6f} rad{place}", flush=True)
    left -= 1
    if left == 0:
        break
sys.exit(left > 0)
