"""Commands of a resting twin are served in the thread that gives them."""

import threading
import time

import pytest
from planetary_twin.simulation.live.turns import Turns


class Own:
    """The thread of a twin that serves, rests, and stops when `stop` is set."""

    def __init__(self, serve, rest):
        self.turns, self.rest = Turns(serve), rest
        self.stop, self.resting = threading.Event(), threading.Event()
        self.rounds, self.defect = 0, None
        self.thread = threading.Thread(target=self._run)
        self.thread.start()

    def _run(self):
        try:
            with self.turns:
                while not self.stop.is_set():
                    self.resting.set()
                    self.turns.rest(self.rest)
                    self.rounds += 1
        except RuntimeError as defect:
            self.defect = defect

    def end(self):
        self.stop.set()
        self.turns.wake()
        self.thread.join()


@pytest.fixture
def served():
    return []


def serving(served, runs):
    def serve():
        served.append(threading.current_thread())
        return runs

    return serve


def test_a_command_is_served_in_its_own_thread(served):
    own = Own(serving(served, runs=False), rest=60.0)
    own.resting.wait()
    while not served:  # until the thread has given up the turn
        own.turns.call()
    assert served == [threading.current_thread()]
    own.end()


def test_a_defect_in_a_command_ends_the_thread_of_the_twin():
    def serve():
        raise RuntimeError("broken")

    own = Own(serve, rest=60.0)
    while own.thread.is_alive():
        own.turns.call()
        time.sleep(1e-3)
    assert str(own.defect) == "broken" and own.turns.ended
