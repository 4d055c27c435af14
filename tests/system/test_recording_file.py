"""Recordings as files: written for independent readers, read when whole, cut off or damaged, and as tables."""

import csv
import io
import random
import zlib

import mcap_kit
import numpy as np
import pytest
from libins.cli import main
from libins.errors import UsageError
from libins.recorder import Recorder
from libins.recording_mcap import Recording
from mcap.reader import make_reader
from mcap_ros2.decoder import DecoderFactory
from rosbags.rosbag2 import Reader
from rosbags.typesys import Stores, get_types_from_msg, get_typestore

from libins import _dds, cdr, idl, play_cli

SEED = 20260801
MESSAGES = 60
TRUTH = get_typestore(Stores.ROS2_JAZZY)


@pytest.fixture(scope="module")
def bag(tmp_path_factory):
    path = tmp_path_factory.mktemp("bag") / "drive.mcap"
    return path, mcap_kit.write(path, MESSAGES, SEED)


def same(got, want):
    assert dict(mcap_kit.leaves(got)) == dict(mcap_kit.leaves(want))


@pytest.mark.parametrize("kind", _dds.raw_types())
def test_a_definition_is_the_message_of_ros_by_its_hash(kind):
    name, text = idl.definition(kind)
    store = get_typestore(Stores.EMPTY)
    store.register(get_types_from_msg(text, name))
    assert idl.dds_name(name) == kind
    if not kind.startswith("libins::"):
        assert store.hash_rihs01(name) == TRUTH.hash_rihs01(name)


def test_mcap_ros2_support_reads_every_message_own_types_too(bag):
    path, said = bag
    with path.open("rb") as file:
        reader = make_reader(file, validate_crcs=True, decoder_factories=[DecoderFactory()])
        assert reader.get_header().profile == "ros2"
        heard = list(reader.iter_decoded_messages())
    assert len(heard) == len(said)
    for (_, channel, message, value), (topic, at, want, octets) in zip(heard, said, strict=True):
        assert (channel.topic, message.log_time, message.publish_time) == (topic, at, at - 1000)
        assert message.data == octets
        same(value, want)


def test_rosbags_reads_it_with_its_definitions_and_quality(bag):
    path, said = bag
    with Reader(path) as reader:
        store = get_typestore(Stores.EMPTY)
        for connection in reader.connections:
            types = get_types_from_msg(connection.msgdef.data, connection.msgtype)
            store.register({k: v for k, v in types.items() if k not in store.fielddefs})
        tf = next(c for c in reader.connections if c.topic == "/tf")
        (quality,) = tf.ext.offered_qos_profiles
        assert (quality.durability.name, quality.deadline.sec, quality.deadline.nsec) == (
            "TRANSIENT_LOCAL",
            1,
            5 * 10**8,
        )
        heard = [(c.topic, at, store.deserialize_cdr(raw, c.msgtype)) for c, at, raw in reader.messages()]
    assert [(topic, at) for topic, at, _ in heard] == [(topic, at) for topic, at, _, _ in said]
    for (_, _, value), (_, _, want, _) in zip(heard, said, strict=True):
        same(value, want)


def test_its_octets_are_read_by_their_definition_in_both_orders():
    rng = random.Random(SEED)
    for kind in _dds.raw_types():
        name, text = idl.definition(kind)
        definition = cdr.Definition(name, text)
        for little in (True, False) * 10:
            value = mcap_kit.message(name, rng)
            got = definition.read(mcap_kit.octets_of(name, value, little))
            flat = dict(mcap_kit.leaves(value))
            numbers = {}
            for path, found in got.items():
                many = isinstance(found, tuple)
                numbers |= {f"{path}.{i}": each for i, each in enumerate(found)} if many else {path: found}
            assert numbers == flat, (name, little)


def test_damaged_octets_are_refused_and_nothing_else():
    rng = random.Random(SEED + 1)
    refused = 0
    for kind in _dds.raw_types():
        name, text = idl.definition(kind)
        definition = cdr.Definition(name, text)
        for _ in range(100):
            octets = bytearray(mcap_kit.octets_of(name, mcap_kit.message(name, rng)))
            for _ in range(rng.randrange(1, 4)):
                octets[rng.randrange(len(octets))] = rng.randrange(256)
            try:
                definition.read(bytes(octets[: rng.randrange(len(octets) + 1)]))
            except UsageError as error:
                refused += name in str(error)
    assert refused > 50


def test_a_file_cut_off_anywhere_gives_what_is_whole_of_it(tmp_path):
    path = tmp_path / "whole.mcap"
    said = [entry[:2] for entry in mcap_kit.write(path, 200, SEED, compression="none")]
    octets = path.read_bytes()
    cut = tmp_path / "cut.mcap"
    counts = []
    for length in [*range(8, len(octets), len(octets) // 97), len(octets) - 1]:
        cut.write_bytes(octets[:length])
        with Recording(cut) as recording:
            heard = [(taken.topic, taken.log_ns) for taken in recording.messages()]
            assert recording.problem is not None and str(len(heard)) in recording.problem
            assert sum(topic.count for topic in recording.topics.values()) == len(heard)
        assert heard == said[: len(heard)]
        counts.append(len(heard))
    assert counts == sorted(counts) and counts[-1] == len(said)
    cut.write_bytes(octets[:5])
    with pytest.raises(UsageError, match="is no MCAP file"):
        Recording(cut)


def test_an_octet_that_has_turned_is_noticed(tmp_path):
    path = tmp_path / "whole.mcap"
    mcap_kit.write(path, 50, SEED, compression="none")
    octets = bytearray(path.read_bytes())
    at = octets.index(b"imu") if b"imu" in octets else len(octets) // 3
    octets[at + 4000] ^= 4
    path.write_bytes(octets)
    with Recording(path) as recording, pytest.raises(UsageError, match="damaged: crc"):
        list(recording.messages())


class Counted(io.BufferedReader):
    """Counts what is read of it."""

    octets = 0

    def read(self, size: int | None = -1) -> bytes:
        found = super().read(size)
        self.octets += len(found)
        return found


def test_a_part_is_found_by_the_index(tmp_path):
    path = tmp_path / "long.mcap"
    few = mcap_kit.write(tmp_path / "few.mcap", 10, SEED)
    recorder = Recorder(path, "none")
    number = recorder.topic(_dds.raw_topic("libins/nav_state", "libins::NavState"))
    said = [("libins/nav_state", mcap_kit.BEGIN_NS + k * 10**6, None, few[k % 2 * 5][3]) for k in range(20000)]
    for _, at, _, octets in said:
        recorder.add(number, at, at, octets)
    recorder.close()
    size = path.stat().st_size
    begin = said[10000][1]
    window = [entry for entry in said if begin <= entry[1] < begin + 10**8]
    with Counted(io.FileIO(path)) as file:
        reader = make_reader(file)
        assert len(reader.get_summary().chunk_indexes) >= 5
        heard = list(reader.iter_messages(starting_at=begin, ending_before=begin + 10**8))
        assert [message.data for _, _, message in heard] == [entry[3] for entry in window]
        assert file.octets < size / 4, "all of it was read"
    with Recording(path) as recording:
        part = list(recording.messages(None, 10.0, 10.1))
        assert [taken.octets for taken in part] == [entry[3] for entry in window]
        assert recording.duration_s == pytest.approx(19.999)


def test_the_same_messages_give_the_same_file(tmp_path):
    sums = set()
    for name in ("a.mcap", "b.mcap"):
        mcap_kit.write(tmp_path / name, 100, SEED)
        sums.add(zlib.crc32((tmp_path / name).read_bytes()))
    assert len(sums) == 1


def test_tables_hold_every_value_under_its_unit(bag, tmp_path):
    path, said = bag
    assert main(["export", str(path), "--csv", str(tmp_path / "csv"), "--npz", str(tmp_path / "all.npz")]) == 0
    imu = [value for topic, _, value, _ in said if topic == "/imu/data"]
    state = [value for topic, _, value, _ in said if topic == "libins/nav_state"]
    tf = [value for topic, _, value, _ in said if topic == "/tf"]
    with np.load(tmp_path / "all.npz") as arrays:
        np.testing.assert_array_equal(arrays["imu/data/angular_velocity.y_rad_s"], [m.angular_velocity.y for m in imu])
        np.testing.assert_array_equal(arrays["libins/nav_state/w_ib_b_rad_s"], [m.w_ib_b for m in state])
        np.testing.assert_array_equal(arrays["libins/nav_state/euler_rad"], [m.euler_rad for m in state])
        assert arrays["libins/nav_state/source"].tolist() == [m.source for m in state]
        third = [m.transforms[2].transform.translation.z if len(m.transforms) > 2 else np.nan for m in tf]
        np.testing.assert_array_equal(arrays["tf/transforms.2.transform.translation.z_m"], third)
        assert arrays["imu/data/log_time_ns"][0] == next(at for topic, at, _, _ in said if topic == "/imu/data")
    with (tmp_path / "csv/libins_nav_state.csv").open(newline="") as file:
        rows = list(csv.DictReader(file))
    assert [float(row["euler_pitch_rad"]) for row in rows] == [m.euler_rad[1] for m in state]
    assert [row["source"] for row in rows] == [m.source for m in state]
    assert [int(row["published_ns"]) for row in rows] == [m.published_ns for m in state]
    assert {"q_nb_w", "w_ib_b_z_rad_s", "t_s", "counts.lost"} <= set(rows[0])
    assert "latitude_deg" in (tmp_path / "csv/gnss_fix.csv").read_text().splitlines()[0]


@pytest.mark.parametrize(
    ("options", "text"),
    [
        ((), "--csv FOLDER or --npz F.npz is needed"),
        (("--csv", "x", "--topic", "/odometry"), "has no topic /odometry; it has libins/nav_state"),
        (("--csv", "x", "--from", "9"), "--from 9: must lie in 0 .. 0.059"),
        (("--csv", "x", "--from", "0.02", "--to", "0.01"), "--from 0.02 --to 0.01"),
    ],
)
def test_what_cannot_be_exported_is_said(bag, capsys, tmp_path, options, text):
    path, _ = bag
    assert main(["export", str(path), *(str(tmp_path / o) if o == "x" else o for o in options)]) == 2
    assert text in capsys.readouterr().err
    assert not (tmp_path / "x").exists()


def test_a_topic_is_offered_again_as_it_was(tmp_path):
    before = [
        _dds.raw_topic(
            "rt/car/odometry", "nav_msgs::msg::dds_::Odometry_", user="typehash=RIHS01_3c;", deadline_s=0.25
        ),
        _dds.raw_topic("libins/nav_state", "libins::NavState", "left", exclusive=True, strength=7),
        _dds.raw_topic("libins/nav_solution", "libins::NavSolution", latched=True, exclusive=True),
        _dds.raw_topic("libins/raw_imu", "libins::RawImu", best_effort=True),
    ]
    recorder = Recorder(tmp_path / "a.mcap")
    for topic in before:
        recorder.topic(topic)
    recorder.add(0, 1, 1, bytes(8))
    recorder.close()
    with Recording(tmp_path / "a.mcap") as recording:
        after = [play_cli.raw_topic(topic, _dds) for topic in recording.topics.values()]
    names = ("name", "type", "partition", "user", "latched", "exclusive", "strength", "deadline_s", "best_effort")
    assert [[getattr(t, n) for n in names] for t in after] == [[getattr(t, n) for n in names] for t in before]


def test_a_file_that_is_not_there_names_its_part(tmp_path):
    (tmp_path / "a.mcap.part").write_bytes(b"")
    with pytest.raises(UsageError, match=r"a.mcap: cannot be read: No such file.*a.mcap.part is there"):
        Recording(tmp_path / "a.mcap")
