"""What all tests share: no display, no models of other packages, properties that repeat."""

import os
import signal

from hypothesis import HealthCheck, settings

from vasc.config import schema

os.environ["MPLBACKEND"] = "Agg"
# threads of small matrix products only wait for each other on a busy machine
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

# No deadline: the first call of a kernel compiles it. Derandomized: a failure is the
# change's, not the day's.
settings.register_profile(
    "house",
    deadline=None,
    derandomize=True,
    suppress_health_check=[HealthCheck.too_slow],
)
settings.load_profile("house")

# Whoever has installed the packages of the how-to pages has more models and growths; what is
# tested here is vasc's own.
schema.entry_points = lambda group: ()

# Signals that whoever started the tests has ignored, as `nohup` and `&` in a script do, would
# be ignored by all that they start.
for name in ("SIGINT", "SIGHUP"):
    number = getattr(signal, name, None)
    if number is not None and signal.getsignal(number) == signal.SIG_IGN:
        signal.signal(number, signal.default_int_handler if name == "SIGINT" else signal.SIG_DFL)


def pytest_addoption(parser):
    """Let the tests of faults be run as often as a release asks for."""
    parser.addoption(
        "--tier",
        choices=("nightly", "release"),
        default="nightly",
        help="how much the tests marked `faults` try",
    )
