"""Who runs the points: this thread, a pool, a cluster."""

from __future__ import annotations

import multiprocessing
import os
import threading
from collections.abc import Iterator
from concurrent.futures import Executor, ProcessPoolExecutor, ThreadPoolExecutor
from contextlib import contextmanager
from typing import Any

NAMES = ("threads", "processes", "dask")


@contextmanager
def opened(given: Any, workers: int | None) -> Iterator[Executor | None]:
    """The executor that is meant; `None` runs one point after the other. What is made here is closed at the end."""
    many = workers or os.cpu_count() or 1
    if given is None and workers is None:
        yield None
    elif given is None or given == "threads":
        with ThreadPoolExecutor(many) as pool:
            yield pool
    elif given == "processes":
        # Spawned, not forked: a fork of a process with threads may hang.
        with ProcessPoolExecutor(many, multiprocessing.get_context("spawn"), _end_with_parent) as pool:
            yield pool
    elif given == "dask":
        with _local(many) as cluster, cluster.get_client() as client:
            yield client.get_executor()
    elif hasattr(given, "get_executor"):  # a Dask client
        yield given.get_executor()
    elif hasattr(given, "get_client"):  # a Dask cluster, as that of dask-jobqueue
        with given.get_client() as client:
            yield client.get_executor()
    elif isinstance(given, Executor):
        yield given
    else:
        raise ValueError(f"executor is one of {', '.join(NAMES)}, a concurrent.futures.Executor, a Dask client or cluster, "
                         f"not {given!r}")


def _end_with_parent() -> None:
    """Workers whose parent was killed would wait for more for ever."""
    def wait() -> None:
        if (parent := multiprocessing.parent_process()) is not None:
            parent.join()
            os._exit(1)

    threading.Thread(target=wait, daemon=True).start()


def _local(workers: int) -> Any:
    try:
        import distributed
    except ModuleNotFoundError as error:
        raise ModuleNotFoundError("executor=\"dask\" needs Dask: pip install 'pycav[dask]'") from error
    cluster: Any = distributed.LocalCluster
    return cluster(n_workers=workers, threads_per_worker=1, processes=True, dashboard_address=None)
