"""Dask.distributed as the engine of driver.py. The only file that imports Dask."""

import contextlib
import itertools
import logging
import os
import pathlib
import pickle
import queue
import shlex
import sys
import threading
import time
import warnings

os.environ.setdefault("DASK_CONFIG", str(pathlib.Path(__file__).parent / "dask.yaml"))  # read by the import of dask

import cloudpickle  # noqa: E402
import distributed  # noqa: E402

import task as task_module  # noqa: E402
from connection import EngineLost  # noqa: E402
from flight import Event  # noqa: E402
from job import JobError  # noqa: E402

FETCHERS = 4  # threads that wait for results
NEWS_SECONDS = 1  # between questions to the scheduler for its workers

# Scheduler and workers have no copy of farm/: its functions travel with the tasks.
cloudpickle.register_pickle_by_value(task_module)
cloudpickle.register_pickle_by_value(sys.modules[__name__])

# What goes wrong is an event or an error here, in one line.
warnings.filterwarnings("ignore", module="distributed")
for name in list(logging.root.manager.loggerDict):
    if name.partition(".")[0] in ("distributed", "tornado", "asyncio"):
        logging.getLogger(name).setLevel(logging.CRITICAL + 1)


def _at_worker(task):
    return distributed.get_worker().address, task_module.run(task)


class _Call:
    """What becomes the answer to a task where it is unpickled: at the worker. (Of a function of farm/, as Dask sends them, the
    scheduler would want the module.)"""

    def __init__(self, task):
        self._task = task

    def __reduce__(self):
        return _at_worker, (self._task,)


class DaskEngine:
    """`open_cluster`: makes a cluster of this driver's own, or None with the `address` of a scheduler elsewhere."""

    def __init__(self, address=None, open_cluster=None):
        self._numbers = itertools.count()
        self._cluster = open_cluster() if open_cluster else None
        self._address = self._cluster or address
        self._client = None
        self.connect()

    def connect(self):
        self._leave()
        self._futures, self._ended, self._to_fetch = {}, queue.Queue(), queue.Queue()
        self._workers, self._asked = {}, 0.0
        try:
            self._client = distributed.Client(self._address, timeout="10 s", set_as_default=False)
        except (OSError, TimeoutError, ValueError) as error:
            raise EngineLost(f"there is no scheduler at {self._address} ({type(error).__name__})") from None
        for _ in range(FETCHERS):
            threading.Thread(target=_fetch, args=(self._to_fetch, self._ended), daemon=True).start()

    def workers(self):
        if time.monotonic() - self._asked >= NEWS_SECONDS:
            self._workers = self._ask(lambda: self._client.nthreads())
            self._asked = time.monotonic()
        return self._workers

    def submit(self, task, allowed):
        number = next(self._numbers)
        only = None if allowed >= self._workers.keys() else sorted(allowed)
        call, key = cloudpickle.dumps(_Call(task)), f"batches-{number}-{os.urandom(4).hex()}"
        future = self._ask(lambda: self._client.submit(pickle.loads, call, key=key, pure=False, workers=only))
        self._futures[number] = future
        future.add_done_callback(lambda done, to=self._to_fetch: to.put((number, done)))
        return number

    def wait(self, seconds):
        if self._client.status != "running" or any(future.status == "lost" for future in self._futures.values()):
            raise EngineLost("the scheduler is lost")
        events = []
        with contextlib.suppress(queue.Empty):
            events.append(self._ended.get(timeout=seconds))
            while True:
                events.append(self._ended.get_nowait())
        known = [event for event in events if self._futures.pop(event.attempt, None) is not None]
        if any(event.answer["message"] == CANCELLED for event in known if event.answer["kind"] == "lost"):
            raise EngineLost("the scheduler is lost")  # nobody else cancels tasks
        return known

    def where(self, number):
        key = self._futures[number].key
        processing = self._ask(lambda: self._client.processing())
        return next((worker for worker, keys in processing.items() if key in keys), None)

    def cancel(self, numbers):
        futures = [self._futures.pop(number) for number in numbers if number in self._futures]
        if futures:
            self._ask(lambda: self._client.cancel(futures))

    def close(self):
        self._leave()
        if self._cluster is not None:
            with contextlib.suppress(Exception):
                self._cluster.close(timeout=5)

    def _ask(self, question):
        try:
            return question()
        except (OSError, TimeoutError, RuntimeError, distributed.client.FutureCancelledError) as error:
            raise EngineLost(f"the scheduler is lost ({type(error).__name__})") from None

    def _leave(self):
        if self._client is None:
            return
        for _ in range(FETCHERS):
            self._to_fetch.put(None)
        with contextlib.suppress(Exception):
            self._client.cancel(list(self._futures.values()))
        with contextlib.suppress(Exception):
            self._client.close(timeout=2)
        self._client = None


CANCELLED = "cancelled"


def _fetch(futures, ended):
    """A thread that turns futures into events. (A result whose worker is lost meanwhile is computed again, which takes long.)"""
    while (item := futures.get()) is not None:
        number, future = item
        try:
            worker, answer = future.result()
        except distributed.KilledWorker as killed:
            worker, answer = None, {"kind": "lost", "message": f"lost with its worker, the last time {killed.last_worker.address}"}
        except distributed.client.FutureCancelledError:
            worker, answer = None, {"kind": "lost", "message": CANCELLED}
        except Exception as error:  # of the engine, in any task
            worker, answer = None, {"kind": "lost", "message": _one_line(error)}
        ended.put(Event(number, worker, answer))


def _one_line(error):
    lines = str(error).strip().splitlines()
    return f"{type(error).__name__}: {lines[0]}" if lines else type(error).__name__


def local(workers):
    """Makes a cluster of processes of this machine."""
    return lambda: distributed.LocalCluster(
        n_workers=workers, threads_per_worker=1, processes=True, dashboard_address=":0", memory_limit=0,
        silence_logs=logging.CRITICAL,
    )  # fmt: skip


# Class of dask-jobqueue, its word for an account, and how it is asked for processors.
BATCH_SYSTEMS = {
    "slurm": ("SLURMCluster", "account", lambda cores, memory: {"job_cpu": cores}),
    "pbs": ("PBSCluster", "account", lambda cores, memory: {"resource_spec": f"select=1:ncpus={cores}:mem={memory}"}),
    "lsf": ("LSFCluster", "project", lambda cores, memory: {"ncpus": cores}),
    "sge": ("SGECluster", "project", lambda cores, memory: {}),  # by a directive, as "-pe smp 4": its name is the site's
}


def batch_system(kind, jobs, cores, memory, walltime, queue_name, account, directives):
    """Makes jobs of SLURM, PBS and others, with dask-jobqueue: one worker a job, which runs one task at a time."""

    def make():
        try:
            import dask_jobqueue
        except ImportError:
            raise JobError("dask-jobqueue is not installed: run farm/install.sh build/farm/venv jobqueue") from None
        class_name, account_word, processors = BATCH_SYSTEMS[kind]
        cluster = getattr(dask_jobqueue, class_name)(
            cores=1, processes=1, memory=memory, walltime=walltime, queue=queue_name, job_extra_directives=directives,
            job_script_prologue=[f"export DASK_CONFIG={shlex.quote(os.environ['DASK_CONFIG'])}"],
            scheduler_options={"dashboard_address": ":0"}, **{account_word: account}, **processors(cores, memory),
        )  # fmt: skip
        cluster.scale(jobs=jobs)
        return cluster

    return make
