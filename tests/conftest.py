"""What many tests share."""

import os
import signal

import pytest

# Matrices are small: on a busy machine the threads of BLAS, which reads this as it loads, wait for one another.
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")


def pytest_make_parametrize_id(val):
    """What has a name or a type, as solvers and parts of a scene have, is shown by it."""
    name = getattr(val, "name", getattr(val, "type", None))
    return name if isinstance(name, str) else None


@pytest.fixture(scope="module")
def in_this_process():
    """Solves of a module in this process, where what it tests is no worker: to start one takes seconds."""
    from stand_in_solver import Here

    from compare.solving import runner
    from compare.solving.executors import Workers

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(runner, "_workers", lambda *_: Workers(Here(), 1))
        yield


@pytest.fixture
def heeded():
    """Signals raise, also where the tests run in the background of a shell, which ignores interrupts there."""
    before = {each: signal.signal(each, signal.default_int_handler) for each in (signal.SIGINT, signal.SIGTERM)}
    yield
    for each in before.items():
        signal.signal(*each)
