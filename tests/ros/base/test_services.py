"""Services that execute a command say why it was not."""

from concurrent.futures import Future

from planetary_twin.base.services import answer, executed
from std_srvs.srv import Trigger


def test_a_command_that_takes_too_long_is_refused_with_the_time():
    response = answer(Trigger.Response(), lambda: f"{executed(Future(), 0.01)} s")
    assert not response.success
    assert response.message == "not executed within 0.01 s; it may follow"
