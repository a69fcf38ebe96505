"""./run farm SCENE --samples N: one picture on many workers, with the bits of one machine (docs/farm.md)."""

import argparse
import contextlib
import os
import pathlib
import signal
import sys
import time

import whole
from connection import EngineLost
from driver import Driver
from job import Job, JobError, is_finished
from parts import Parts
from progress import Progress
from ranges import floor_power
from speed import Speed

ROOT = pathlib.Path(__file__).resolve().parent.parent
OK, USAGE, INTERRUPTED = 0, 2, 130


def parser():
    made = argparse.ArgumentParser(
        prog="./run farm",
        usage="./run farm SCENE --samples N [option...] [-- option of plumbline render or golden...]",
        description="Renders one picture on many workers. The result has the bits of a render by one machine.",
        epilog="Example: ./run farm scenes/cornell_glass.dae --samples 16384 --workers 8 -- --integrator bdpt --size 1920x1080",
    )
    made.add_argument("scene", type=pathlib.Path, help="COLLADA file")
    made.add_argument("-s", "--samples", type=positive, required=True, metavar="N", help="samples per pixel")
    made.add_argument("-o", "--output", action="append", metavar="FILE", help="picture, may be repeated (out/farm/SCENE.exr)")
    made.add_argument("--golden", action="store_true", help="make a golden (by default in golden/renders/)")
    made.add_argument("--batch", type=positive, default=4, metavar="N", help="samples in a batch (4)")
    made.add_argument("--pilot", type=positive, metavar="P", help="with --golden: batches of the pilot (32)")
    where = made.add_mutually_exclusive_group()
    where.add_argument("--scheduler", metavar="ADDRESS", help="use the workers of this Dask scheduler, tcp://host:8786")
    for kind in ("slurm", "pbs", "sge", "lsf"):
        where.add_argument(f"--{kind}", dest="system", action="store_const", const=kind, help=f"start workers as jobs of {kind.upper()}")
    made.add_argument("--workers", type=positive, metavar="K", help="processes of this machine, or jobs (as many as processors)")
    made.add_argument("--cores", type=positive, default=1, metavar="C", help="of each job (1)")
    made.add_argument("--memory", default="2GB", metavar="M", help="of each job (2GB)")
    made.add_argument("--walltime", metavar="T", help="of each job")
    made.add_argument("--queue", metavar="Q", help="of the jobs: queue or partition")
    made.add_argument("--account", metavar="A", help="of the jobs")
    made.add_argument("--directive", action="append", default=[], metavar="D", help="a further line of the jobs, may be repeated")
    size = made.add_mutually_exclusive_group()
    size.add_argument("--task-seconds", type=seconds, default=60.0, metavar="T", help="what a task should take, at least (60); in long jobs longer")
    size.add_argument("--task-batches", type=power_of_two, metavar="M", help="batches of a task, a power of two")
    made.add_argument("--parts", type=pathlib.Path, metavar="FOLDER", help="shared folder of the parts (beside the output)")
    made.add_argument("--return-parts", action="store_true", help="no shared folder: parts come back through the scheduler")
    made.add_argument("--remove-parts", action="store_true", help="remove the parts when the picture is there")
    made.add_argument("--program", metavar="PATH", help="plumbline on the workers (as on this machine)")
    made.add_argument("--patience", type=seconds, default=600.0, metavar="S", help="seconds without scheduler or workers (600)")
    made.add_argument("-q", "--quiet", action="store_true", help="no progress")
    return made


def positive(text):
    if (number := int(text)) < 1:
        raise argparse.ArgumentTypeError(f"{text}: must be at least 1")
    return number


def seconds(text):
    if not 0 < (number := float(text)) < 1e9:
        raise argparse.ArgumentTypeError(f"{text}: must be a number of seconds above 0")
    return number


def power_of_two(text):
    if (number := positive(text)) != floor_power(number):
        raise argparse.ArgumentTypeError(f"{text}: must be a power of two, so that a part holds one block of the film")
    return number


def parse(argv):
    """(arguments, options of the program)"""
    at = argv.index("--") if "--" in argv else len(argv)
    made = parser()
    arguments, options = made.parse_args(argv[:at]), argv[at + 1 :]
    if arguments.pilot and not arguments.golden:
        made.error("--pilot is for --golden")
    folder = ROOT / "golden/renders" if arguments.golden else ROOT / "out/farm"
    arguments.output = [pathlib.Path(name) for name in arguments.output or [folder / f"{arguments.scene.stem}.exr"]]
    first = arguments.output[0]
    arguments.parts = arguments.parts or (
        ROOT / "out/farm" / f"{first.stem}.golden.parts" if arguments.golden else first.with_name(first.name + ".parts")
    )
    arguments.workers = arguments.workers or len(os.sched_getaffinity(0))
    return arguments, options


def job_of(arguments, options):
    program = os.environ.get("PLUMBLINE") or str(ROOT / "build/release/plumbline")
    threads = arguments.cores if arguments.system else None
    if not (arguments.scheduler or arguments.system):  # the workers share this machine
        threads = max(1, len(os.sched_getaffinity(0)) // arguments.workers)
    return Job(
        program=str(pathlib.Path(program).resolve()) if "/" in program else program,
        scene=arguments.scene,
        samples=arguments.samples,
        batch=arguments.batch,
        golden=arguments.golden,
        pilot=arguments.pilot or 32,
        options=options,
        threads=threads,
        program_there=arguments.program or "",
    )


def dask_engine(arguments):
    """The engine that the arguments name."""
    try:
        import engine
    except ImportError as error:
        raise JobError(f"{error}: farm/install.sh build/farm/venv installs Dask, and ./run farm uses it") from None
    if arguments.scheduler:
        return engine.DaskEngine(address=arguments.scheduler)
    if arguments.system:
        a = arguments
        jobs = engine.batch_system(a.system, a.workers, a.cores, a.memory, a.walltime, a.queue, a.account, a.directive)
        return engine.DaskEngine(open_cluster=jobs)
    return engine.DaskEngine(open_cluster=engine.local(arguments.workers))


def farm(arguments, options, make_engine=dask_engine, out=None):
    """Raises JobError."""
    out = out or sys.stderr
    job = job_of(arguments, options)
    job.check()
    if job.golden and is_finished(job, arguments.output[0]):
        print(f"{arguments.output[0]}: is there", file=out)
        return
    for path in arguments.output:
        path.parent.mkdir(parents=True, exist_ok=True)
    with contextlib.closing(Parts(arguments.parts, job)) as parts:
        counts, seconds_taken = _make(arguments, job, parts, make_engine, out)
        print(f"{arguments.output[0]}: {counts}; {seconds_taken:.0f} s", file=out)
        if arguments.remove_parts:
            parts.remove_all()


def _make(arguments, job, parts, make_engine, out):
    """(what happened, seconds)"""
    progress = Progress(0, job.batches.size, out, arguments.quiet)
    before = whole.rendered_before(parts, job, progress)
    progress = Progress(before, job.batches.size, out, arguments.quiet)
    begin = time.monotonic()
    speed = Speed(arguments.task_seconds, arguments.task_batches, job.batches.size)
    driver = Driver(lambda: make_engine(arguments), job, parts, speed, progress, arguments.return_parts, arguments.patience)
    try:
        whole.make(driver, arguments.output)
    finally:
        progress.end()
        driver.close()
    return driver.counts, time.monotonic() - begin


def _interrupted(number, frame):
    raise KeyboardInterrupt


def main(argv, make_engine=dask_engine):
    signal.signal(signal.SIGTERM, _interrupted)
    try:
        farm(*parse(argv), make_engine)
        return OK
    except (JobError, EngineLost) as error:
        print(f"farm: {error}", file=sys.stderr)
    except OSError as error:
        print(f"farm: {error.filename}: {error.strerror}" if error.filename else f"farm: {error}", file=sys.stderr)
    except KeyboardInterrupt:
        print("farm: interrupted; the same command goes on from here", file=sys.stderr)
        return INTERRUPTED
    return USAGE


if __name__ == "__main__":
    status = main(sys.argv[1:])
    sys.stdout.flush()
    sys.stderr.flush()
    os._exit(status)  # threads of the engine that still wait for a lost scheduler are not waited for
