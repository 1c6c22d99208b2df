"""Workers of a Dask cluster, which see the folder of the sweep under the same name."""

import warnings
from collections.abc import Sequence
from contextlib import suppress
from typing import TYPE_CHECKING, Any

from vasc.errors import ConfigError, RunError
from vasc.sweeps.folder import SweepFolder
from vasc.sweeps.work import perform, result_of
from vasc.sweeps.workforce import Workforce

if TYPE_CHECKING:
    from dask.distributed import Client

SECONDS_TO_CONNECT = 15.0


class ClusterWorkers(Workforce):
    """The workers of a Dask cluster.

    The scheduler gives the run of a worker that is lost to another one, and gives it up
    when several are lost with it.

    Parameters
    ----------
    address : str
        Of the scheduler, as ``tcp://10.0.0.1:8786``.

    Raises
    ------
    ConfigError
        If there is no scheduler, or a worker has another version of vasc or none.
    """

    def __init__(self, address: str) -> None:
        super().__init__()
        self.address = address
        self._client = _connected(address)
        self._left: dict[int, Any] = {}
        try:
            _check_versions(self._client, address)
        except BaseException:
            self._client.close()
            raise

    def start(self, folder: SweepFolder, numbers: Sequence[int]) -> None:
        """Hand all runs to the scheduler."""
        path = str(folder.path.resolve())
        for number in numbers:
            # equal names are one task, also when a killed sweep had begun it
            future = self._client.submit(perform, path, number, key=f"vasc-{path}-{number}")
            self._left[number] = future

        def report(number: int) -> Any:
            return lambda future: self._report(folder, number, future)

        for number, future in list(self._left.items()):
            future.add_done_callback(report(number))

    def stop(self) -> None:
        """Withdraw the runs that have not begun; those under way come to their end there."""
        withdrawn = list(self._left.values())
        # first of all, so that none of them is taken for lost
        self._left.clear()
        with suppress(Exception):
            self._client.cancel(withdrawn)

    def close(self) -> None:
        """Leave the cluster, which goes on."""
        self._left.clear()
        with suppress(Exception):
            self._client.close(timeout=5)

    @property
    def n_running(self) -> int:
        """Runs that are being made now: as many as the cluster has threads, or are left."""
        return min(len(self._left), sum(self._client.nthreads().values()))

    def _report(self, folder: SweepFolder, number: int, future: Any) -> None:
        """Put aside what came of a run."""
        if self._left.pop(number, None) is None:
            return  # withdrawn
        if future.status == "finished":
            self.results.put(future.result())
        elif future.status == "error":
            error = future.exception()
            result = result_of(number, {}, [_reason(error)])
            with suppress(OSError):
                folder.write_result(result)
            self.results.put(result)
        else:
            self.results.put(RunError(f"--scheduler {self.address}: the scheduler is gone"))


def _connected(address: str) -> "Client":
    """Connect to a scheduler."""
    try:
        from dask.distributed import Client
    except ImportError as error:
        raise ConfigError(
            '--scheduler: needs dask.distributed; `pip install "vasc[cluster]"` brings it'
        ) from error
    try:
        return Client(address, timeout=SECONDS_TO_CONNECT, set_as_default=False)
    except (OSError, ValueError, TypeError) as error:
        reason = " ".join(str(error).split()) or type(error).__name__
        raise ConfigError(f"--scheduler {address}: cannot be reached: {reason}") from error


def _check_versions(client: "Client", address: str) -> None:
    """Refuse workers that would make other runs."""
    import vasc

    try:
        found = client.run(worker_version)
    except Exception as error:
        raise ConfigError(
            f"--scheduler {address}: a worker has no vasc with sweeps: {_reason(error)}"
        ) from error
    for worker, version in found.items():
        if version != vasc.__version__:
            raise ConfigError(
                f"--scheduler {address}: the worker {worker} has vasc {version},"
                f" and here is {vasc.__version__}"
            )
    if not found:
        warnings.warn(f"{address} has no workers yet; runs begin when some come", stacklevel=2)


def worker_version() -> str:
    """Give the version of vasc that a worker has."""
    import vasc

    return vasc.__version__


def _reason(error: BaseException) -> str:
    """Put an error of the cluster on one line."""
    if type(error).__name__ == "KilledWorker":
        return "several workers were lost while they made it"
    return f"{type(error).__name__}: {' '.join(str(error).split())}"
