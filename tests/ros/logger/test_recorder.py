"""Recordings of a logger: on request, on a failing disk, and under overload."""

import signal
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest
from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus
from mcap.reader import make_reader
from mcap.records import Message
from planetary_twin.logger.diagnostics import RECORDING
from planetary_twin_msgs.msg import RecorderStatus
from rclpy.qos import QoSProfile, ReliabilityPolicy
from rclpy.serialization import deserialize_message
from std_msgs.msg import String
from std_srvs.srv import Trigger

from planetary_twin_py.recording.container.records import files_of, records_of
from planetary_twin_py.recording.runs.info import read_info

from ..conftest import Start
from ..peer import LATCHED, LONG, TWIN, Peer, seconds
from ..programs import ended
from ..recordings import counts
from ..reported import recorded, statuses

COUNTER = Path(__file__).parents[1] / "counter.py"
TOPIC = f"{TWIN}/numbers"
DESCRIPTION = f"{TWIN}/robot_description"
URDF = "<robot name='gearbox'/>"
Count = Callable[..., "subprocess.Popen[str]"]


@pytest.fixture
def count(domain: int) -> Iterator[Count]:
    """Start a publisher of numbers."""
    processes: list[subprocess.Popen[str]] = []

    def run(rate: float, number: int, size: int, depth: int, reliability: str = "RELIABLE"):
        values = map(str, (rate, number, size, depth, reliability))
        command = [sys.executable, str(COUNTER), TOPIC, *values]
        pipe = subprocess.PIPE
        process = subprocess.Popen(command, stdin=pipe, stdout=pipe, text=True)
        processes.append(process)
        assert process.stdout and process.stdout.readline() == "ready\n"
        return process

    yield run
    for process in processes:
        process.kill()
        process.communicate()


class Logger:
    """A logger that records the numbers, and its reports."""

    def __init__(self, peer: Peer, start: Start, **settings: Any) -> None:
        self.peer = peer
        self.process = start("planetary_twin.logger", **settings)
        self.status = peer.listen(RecorderStatus, f"{TWIN}/logger/status")
        self._reports = peer.listen(DiagnosticArray, "/diagnostics")

    @property
    def reports(self) -> list[DiagnosticStatus]:
        return statuses(self._reports, RECORDING)

    def recorded(self, topic: str = TOPIC) -> int:
        return recorded(self.status, topic)

    def lost(self) -> int:
        return self.status[-1].lost[list(self.status[-1].topics).index(TOPIC)]

    def ask(self, service: str) -> Trigger.Response:
        return self.peer.call(Trigger, f"{TWIN}/logger/{service}", Trigger.Request())

    def refuses(self, service: str, reason: str) -> None:
        answer = self.ask(service)
        assert not answer.success
        assert reason in answer.message
        assert "\n" not in answer.message

    def ends_with(self, reason: str) -> None:
        """It ends with one line and a non-zero exit code."""
        errors = ended(self.process, 1)
        lines = [line for line in errors.splitlines() if line.startswith("logger: ")]
        assert len(lines) == 1 and reason in lines[0], errors
        assert "Traceback" not in errors


class Ticker:
    """Publishes numbers while the peer spins, and a latched description."""

    def __init__(self, peer: Peer) -> None:
        self.sent = 0
        self.times: list[float] = []
        """When each number was sent, by the clock of the stamps [s]."""
        self._publisher = peer.node.create_publisher(String, TOPIC, QoSProfile(depth=1000))
        described = peer.node.create_publisher(String, DESCRIPTION, LATCHED)
        described.publish(String(data=URDF))
        peer.node.create_timer(0.005, self._send)

    def _send(self) -> None:
        if self._publisher.get_subscription_count():
            self.sent += 1
            self.times.append(time.time())
            self._publisher.publish(String(data=f"{self.sent} "))


def numbers_in(path: Path) -> list[int]:
    """Numbers of all files, in file order."""
    found = []
    for file in files_of(path):
        names = {}
        for record in records_of(file, []):
            if hasattr(record, "topic"):
                names[record.id] = record.topic
            elif isinstance(record, Message) and names[record.channel_id] == TOPIC:
                found.append(int(deserialize_message(record.data, String).data.split()[0]))
    return found


def test_messages_before_a_recording_are_no_loss(peer, start):
    logger = Logger(peer, start, name="bag")
    ticker = Ticker(peer)
    peer.until(lambda: logger.recorded() > 50)
    assert logger.ask("stop").success
    received = ticker.sent
    started = logger.ask("start")
    assert started.success
    peer.until(lambda: logger.status[-1].file == started.message and logger.recorded())
    status = logger.status[-1]
    before = status.before[list(status.topics).index(TOPIC)]
    assert before == logger.lost() >= received
    seen = len(logger.reports)
    peer.until(lambda: len(logger.reports) > seen + 1)
    assert all(report.level == DiagnosticStatus.OK for report in logger.reports)


def test_a_kill_loses_one_flush_period_at_most(peer, start, tmp_path):
    """By stamps, however late the timers of the logger are."""
    period = 0.5
    logger = Logger(peer, start, name="bag", flush_period=period)
    ticker = Ticker(peer)
    peer.until(lambda: logger.recorded() > 20)
    safe, stamp = logger.recorded(), logger.status[-1].header.stamp
    late = seconds(stamp) + period
    # Sent later than the first ones were received by more than the period, and received.
    peer.until(lambda: ticker.times[logger.recorded() - 1] > late)
    logger.process.kill()
    logger.process.wait(LONG)
    assert logger.lost() == 0
    numbers = numbers_in(tmp_path / "recordings/bag")
    assert numbers == list(range(1, len(numbers) + 1))
    assert safe <= len(numbers) <= ticker.sent


def test_recordings_start_split_and_end_on_request(peer, start, tmp_path):
    logger = Logger(peer, start, name="bag", compression="lz4")
    ticker = Ticker(peer)
    peer.until(lambda: logger.recorded() > 50)
    logger.refuses("start", "already recording into")
    logger.refuses("snapshot", "snapshot_duration = 0")
    split = logger.ask("split")
    assert split.success and "bag_0.mcap" in split.message and "bag_1.mcap" in split.message
    before = logger.recorded()
    peer.until(lambda: logger.recorded() > before + 50)
    stopped = logger.ask("stop")
    assert stopped.success and stopped.message.endswith("bag_1.mcap")
    at_most = ticker.sent
    logger.refuses("stop", "nothing is being recorded")
    logger.refuses("split", "nothing is being recorded")
    peer.until(lambda: logger.status[-1].file == "")
    folder = tmp_path / "recordings/bag"
    numbers = numbers_in(folder)
    assert numbers == list(range(numbers[0], numbers[-1] + 1))
    assert numbers[0] == 1 and before + 50 < numbers[-1] <= at_most
    assert counts(folder)[TOPIC] == len(numbers)
    assert read_info(folder).topics[TOPIC].lost == 0
    for file in files_of(folder):
        with file.open("rb") as stream:
            reader = make_reader(stream)
            attached = {a.name: a.data.decode() for a in reader.iter_attachments()}
            noted = {record.name: record.metadata for record in reader.iter_metadata()}
            topics = {channel.topic for _, channel, _ in reader.iter_messages()}
        assert attached == {"robot_description.urdf": URDF}
        assert {"system", "steady", "ros"} <= set(noted["planetary_twin_clocks"])
        assert {"python", "mcap", "planetary_twin"} <= set(noted["planetary_twin_software"])
        assert DESCRIPTION in topics

    started = logger.ask("start")
    assert started.success
    peer.until(lambda: logger.recorded() > 20)
    logger.process.terminate()
    assert logger.process.wait(LONG) == 0
    second = Path(tmp_path / started.message)
    assert second.parent != folder
    assert len(numbers_in(second.parent)) > 20
    assert counts(second.parent)[DESCRIPTION] == 1


def test_a_snapshot_writes_the_last_seconds(peer, start, tmp_path):
    logger = Logger(peer, start, name="bag", snapshot_duration=0.5)
    ticker = Ticker(peer)
    peer.until(lambda: logger.recorded() > 300)
    for service in ("start", "stop", "split"):
        logger.refuses(service, "memory" if service == "start" else "nothing is being recorded")
    assert not (tmp_path / "recordings").exists()
    files = []
    for _ in range(2):
        known = logger.recorded()
        answer, sent = logger.ask("snapshot"), ticker.sent
        assert answer.success
        files.append(tmp_path / answer.message)
        numbers = numbers_in(files[-1].parent)
        assert numbers == list(range(numbers[0], numbers[-1] + 1))
        assert numbers[0] > 1 and known <= numbers[-1] <= sent
        info = read_info(files[-1]).topics
        assert info[TOPIC].last - info[TOPIC].first <= 5e8
        assert info[DESCRIPTION].recorded == 1
        assert info[TOPIC].lost == 0
    assert files[0].parent != files[1].parent


def test_a_managed_logger_goes_to_its_error_state_and_recovers(peer, start, tmp_path):
    logger = Logger(peer, start, autostart="false", flush_period=0.1)
    Ticker(peer)
    node = f"{TWIN}/logger"
    logger.refuses("start", "the logger is not active")
    peer.change_state(node, "configure")
    peer.change_state(node, "activate")
    peer.until(lambda: logger.recorded() > 20)
    (tmp_path / "recordings").rename(tmp_path / "elsewhere")
    peer.until(lambda: any(s.level == DiagnosticStatus.ERROR for s in logger.reports))
    assert "deleted or moved away" in logger.reports[-1].message
    peer.change_state(node, "configure")
    peer.change_state(node, "activate")
    peer.until(lambda: logger.reports[-1].level == DiagnosticStatus.OK and logger.recorded() > 20)
    logger.process.terminate()
    assert logger.process.wait(LONG) == 0
    (folder,) = (tmp_path / "recordings").iterdir()
    assert len(numbers_in(folder)) > 20


def test_a_full_disk_ends_the_logger_with_one_line(peer, start, small_disk, count):
    given = {"compression": "none", "flush_period": 0.05}
    logger = Logger(peer, start, directory=small_disk, **given)
    count(200.0, 10_000, 10_000, 100)
    peer.until(lambda: logger.process.poll() is not None)
    logger.ends_with("No space left on device; flushed messages are readable")
    (folder,) = small_disk.iterdir()
    numbers = numbers_in(folder)
    assert numbers == list(range(1, len(numbers) + 1))
    assert len(numbers) > 30


def test_recorded_plus_lost_equals_published_under_overload(peer, start, tmp_path, count):
    """The logger stands still, as on an overloaded machine, until all is sent."""
    logger = Logger(peer, start, name="bag", topics=f"['{TOPIC}']")
    sender = count(4000.0, 20_000, 100, 1)
    assert sender.stdin and sender.stdout
    peer.until(logger.recorded)
    logger.process.send_signal(signal.SIGSTOP)
    assert sender.stdout.readline() == "sent\n"
    logger.process.send_signal(signal.SIGCONT)
    reported = len(logger.status)
    peer.until(lambda: len(logger.status) > reported + 2 and logger.recorded())
    before = logger.recorded()
    sender.stdin.write("\n")
    sender.stdin.flush()
    assert sender.stdout.readline() == "last\n"
    peer.until(lambda: logger.recorded() > before)
    peer.until(lambda: any(s.level == DiagnosticStatus.WARN for s in logger.reports))
    recorded, lost = logger.recorded(), logger.lost()
    assert lost > 0
    assert recorded + lost == 20_001
    logger.process.terminate()
    _, errors = logger.process.communicate(timeout=LONG)
    assert f"lost {TOPIC} {lost}" in errors
    numbers = numbers_in(tmp_path / "recordings/bag")
    assert len(numbers) == len(set(numbers)) == recorded
    assert numbers[-1] == 20_001
    reported = read_info(tmp_path / "recordings/bag").topics[TOPIC]
    assert (reported.recorded, reported.lost) == (recorded, lost)


def test_a_later_publisher_with_weaker_qos_is_recorded(peer, start):
    logger = Logger(peer, start, name="bag", topics=f"['{TOPIC}']")

    def publish_until_received(qos: QoSProfile) -> None:
        publisher = peer.node.create_publisher(String, TOPIC, qos)
        timer = peer.node.create_timer(0.01, lambda: publisher.publish(String(data="1 ")))
        before = logger.recorded()
        peer.until(lambda: logger.recorded() > before)
        peer.node.destroy_timer(timer)
        peer.node.destroy_publisher(publisher)

    publish_until_received(QoSProfile(depth=10))
    publish_until_received(QoSProfile(depth=10, reliability=ReliabilityPolicy.BEST_EFFORT))
