"""Runs the jobs of a survey on the workers of a Dask cluster."""

from __future__ import annotations

import asyncio
import contextlib
import functools
import os
import threading
import time
from collections import Counter
from pathlib import Path
from typing import Any, NamedTuple

from ..core.errors import BareEarthError, Cancelled
from ..core.files import write_errors_told
from ..core.memory import free_memory
from ..core.progress import Progress
from ..core.temporary import make_temporary, remove_temporary
from ..core.threads import SharedThreads
from ..core.words import option
from ..las.backends import require
from .blockwise import JobProgress
from .jobs import Job, JobResult, Share, attempt
from .memory import Resources
from .workers import Running, Workers, scheduler_gone

_CONNECTING = "15s"
# Seconds between two checks of the workers.
_LOOKING = 2.0
# Seconds that a scheduler may take to answer.
_ANSWERING = 15.0
# Seconds after which a job checks whether its run is still there.
_LISTENING = 0.5
# Share of the free memory of a computer that jobs on it may use.
_SHARE = 0.5
# Jobs submitted for each thread of a worker, so that it need not wait for the next one.
_AHEAD = 2


class _Facts(NamedTuple):
    """What a worker reports about itself."""

    version: str
    sees_folder: bool
    free: int
    host: str


class Cluster(Workers):
    """The workers of a running Dask scheduler, with an address such as ``tcp://host:8786``; raises
    an error after `patience` seconds without workers.
    """

    # The workers need the same version of this package, and the same folders under the same names.
    # Each thread of a worker runs one job at a time. If a worker dies, another one does its jobs.
    # A job may use the memory of the resources; if these have no limit, half of the free memory of
    # its computer, divided by the threads there.

    are_local = False

    def __init__(
        self, address: str, resources: Resources = Resources(), patience: float = 60.0
    ) -> None:
        require("distributed")
        super().__init__(resources)
        self._address, self._patience = address, patience
        self._looked = self._seen = 0.0
        # A file that exists while the run is active. When it is removed, the jobs end.
        self._mark: Path | None = None
        self._client: Any = None  # of Dask; it is there between `start` and `stop`
        self._pool: Any = None

    def start(self, folder: Path, least: int, blocks: int, tiles: int) -> None:
        """Connect; raise an error if there is no scheduler or worker, or a worker is unsuitable."""
        from distributed import Client

        _check_encryption(self._address)
        try:
            self._client = Client(self._address, timeout=_CONNECTING, set_as_default=False)
        except (OSError, ValueError) as error:
            raise BareEarthError(
                f"No Dask scheduler answers at {self._address}. Start one with 'dask scheduler',"
                " and give the address that it prints. With TLS, all certificates must come from"
                " the same authority."
            ) from error
        try:
            with write_errors_told(folder):
                self._mark = make_temporary(folder / "run")  # exists while the run is active
            self._prepare(folder)
        except BaseException:
            self.stop()
            raise

    def _prepare(self, folder: Path) -> None:
        """Check the workers, and divide their threads and memory among jobs."""
        threads, self._seen = self._threads(), time.monotonic()
        facts = self._check(folder)
        memory = self.resources.bytes
        if self.resources.memory is None:
            # Several workers can be on one computer.
            on_host: Counter[str] = Counter()
            for address, worker in facts.items():
                on_host[worker.host] += threads.get(address, 1)
            memory = int(
                min(_SHARE * worker.free / on_host[worker.host] for worker in facts.values())
            )
        self.share = Resources.of(1, memory)
        self.at_once = self._room()
        # Dask must not take the result of an equal job of an earlier run.
        self._pool = self._client.get_executor(pure=False)

    def _room(self) -> int:
        return max(1, _AHEAD * sum(self._threads().values()))

    def _threads(self) -> dict[str, int]:
        """Return the number of threads of each worker; raise an error without a scheduler."""
        client = self._client
        try:
            return client.sync(client.scheduler.ncores, callback_timeout=_ANSWERING)
        except (OSError, asyncio.TimeoutError) as error:
            raise BareEarthError(scheduler_gone()) from error

    def _check(self, folder: Path) -> dict[str, _Facts]:
        """Return what the workers report about themselves; refuse unsuitable workers."""
        from ..core.version import __version__

        install = f"Install bare-earth {__version__} there."
        try:
            facts = self._client.run(_facts, str(self._mark), on_error="return")
        except OSError as error:
            raise BareEarthError(scheduler_gone()) from error
        except Exception as error:
            raise BareEarthError(
                f"The workers of {self._address} cannot load this package ({error}). {install}"
            ) from error
        if not facts:
            raise BareEarthError(
                f"The scheduler {self._address} has no workers. Start some with 'dask worker"
                f" {self._address}'."
            )
        for address, of_worker in facts.items():
            if isinstance(of_worker, OSError):  # it has just ended
                raise BareEarthError(f"The worker {address} does not answer. Run it again.")
            if not isinstance(of_worker, _Facts):
                raise BareEarthError(
                    f"The worker {address} cannot load this package ({of_worker}). {install}"
                )
            if of_worker.version != __version__:
                raise BareEarthError(
                    f"The worker {address} has version {of_worker.version} of bare-earth, and this"
                    f" computer {__version__}. Install the same version on all."
                )
            if not of_worker.sees_folder:
                raise BareEarthError(
                    f"The worker {address} does not see {folder}. Put inputs and outputs into a"
                    " folder that all computers have under the same name."
                )
        return facts

    def submit(self, job: Job) -> Running:
        try:
            # Without arguments, since Dask would search these for results of other jobs.
            future = self._pool.submit(
                functools.partial(_on_cluster, job, self.share, str(self._mark))
            )
            self.at_once = self._room()
        except OSError as error:
            raise BareEarthError(scheduler_gone()) from error
        return Running(future, JobProgress(threading.Event()))

    def check(self) -> None:
        now = time.monotonic()
        if now - self._looked < _LOOKING:
            return
        if self._threads():
            self._seen = now
        elif now - self._seen > self._patience:  # a worker that died may be started again
            raise BareEarthError(
                f"All workers of {self._address} are gone. Start some with 'dask worker"
                f" {self._address}', and continue with {option('resume', True)}."
            )
        self._looked = time.monotonic()

    def stop(self) -> None:
        """Cancel all jobs, also running ones, and disconnect from the scheduler."""
        if self._mark is not None:
            remove_temporary(self._mark)
        with contextlib.suppress(OSError):  # the scheduler is gone
            if self._pool is not None:
                self._pool.shutdown(wait=False)
        if self._client is not None:
            self._client.close()


def _check_encryption(address: str) -> None:
    """Refuse an address for which the configuration of Dask on this computer has no keys."""
    # Without keys Dask raises various errors, and leaves threads that never end.
    from distributed.security import Security

    problem = f"The scheduler {address} cannot be reached"
    where = "See 'distributed.comm' in the configuration of Dask on this computer."
    try:
        security = Security()
        has_keys = security.get_connection_args("client")["ssl_context"] is not None
    except (OSError, ValueError, ImportError) as error:
        raise BareEarthError(
            f"{problem}: the certificate or the key cannot be used ({error}). {where}"
        ) from error
    is_secret = address.startswith("tls://")
    if is_secret and not has_keys:
        raise BareEarthError(f"{problem}: TLS needs a certificate, a key and an authority. {where}")
    if security.require_encryption and not is_secret:
        raise BareEarthError(f"{problem}: encryption is required. {where}")


def _facts(marker: str) -> _Facts:
    import socket

    from ..core.version import __version__

    return _Facts(__version__, Path(marker).exists(), free_memory(), socket.gethostname())


class _Listening(Progress):
    """Ends a job after its run has ended or was killed, so that the next run is not disturbed."""

    def __init__(self, mark: str) -> None:
        self._mark, self._looked = mark, 0.0

    def report(self, fraction: float) -> None:
        now = time.monotonic()
        if fraction >= 1.0 or now - self._looked > _LISTENING:
            self._looked = now
            if not os.path.exists(self._mark):
                raise Cancelled


def _on_cluster(job: Job, share: Resources, mark: str) -> JobResult:
    return attempt(job, Share(share, SharedThreads(1)), _Listening(mark))
