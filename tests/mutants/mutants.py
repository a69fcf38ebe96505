"""./run mutants [NAME...]: makes each mistake in a copy of the sources, and sees whether a test notices it (docs/mutants.md).

What a mutant is: mutant.py. How one is tried: trial.py.
"""

import argparse
import datetime
import functools
import os
import pathlib
import signal
import sys
import time

import generate
import judged
import mutant as mutant_file
import tables
import workers
from keep import Kept, alone, write_whole
from machine import processor, processors
from processes import Stopped
from progress import Progress, line
from project import Project
from sources import Digests
from trial import Idle
from unchanged import Unchanged, Unusable

OK, NOT_FINE, USAGE, INTERRUPTED = 0, 1, 2, 130


def parser():
    made = argparse.ArgumentParser(
        prog="./run mutants",
        description="Makes each mistake of tests/mutants/patches/ in a copy of the sources, and sees which test notices it.",
        epilog="Example: ./run mutants roulette cosine. Exit status: 0 if all are killed, and by the tests that their heads name; "
        "1 if not; 2 for a usage error.",
    )
    made.add_argument("name", nargs="*", help="mutants (default: all)")
    made.add_argument("-j", "--jobs", type=int, default=processors(), help="workers (default: one per processor)")
    made.add_argument(
        "--weigh-tests", action="store_true", help="run more tests of the same files: which mutants one test alone notices, which tests notice none"
    )
    made.add_argument("--generated", action="store_true", help="the sample of generated mutants in place of the patches")
    made.add_argument("--sample", type=int, metavar="N", help="with --generated: how many")
    made.add_argument("--seed", type=int, metavar="S", help="with --generated: each seed has its own sample")
    made.add_argument("--again", action="store_true", help="try again what was tried with the same sources")
    made.add_argument("--list", action="store_true", help="print names and titles, and try nothing")
    made.add_argument("-o", "--out", type=pathlib.Path, metavar="FILE", help="the tables FILE.json and FILE.md (default: out/mutants)")
    return made


def chosen(arguments, error):
    """The mutants that the arguments name."""
    if arguments.jobs < 1:
        error(f"-j {arguments.jobs}: at least one worker is needed")
    if not arguments.generated and (arguments.sample is not None or arguments.seed is not None):
        error("--sample and --seed are for --generated")
    find = mutant_file.kept
    if arguments.generated:
        find = functools.partial(generate.mutants, size=arguments.sample, seed=arguments.seed)
    return found("mutant", find, arguments.name, error)


def found(what, find, names, error):
    """find(names). Names that are not there, and files that cannot be read, are usage errors."""
    try:
        return find(names)
    except KeyError as unknown:
        error(f"there is no {what} {unknown.args[0]} (./run mutants --list lists all mutants)")
    except ValueError as wrong:
        error(str(wrong))


def try_chosen(project, mutants, jobs, weigh=False, again=False, out=None, status=None):
    """(results in the order of `mutants`, Unchanged). Raises Unusable."""
    with alone(project.place):
        return _try_alone(project, mutants, jobs, weigh, again, out or sys.stdout, status or sys.stderr)


def _try_alone(project, mutants, jobs, weigh, again, out, status):
    digests = Digests(project.root)
    unchanged = Unchanged(project, digests)
    kept = Kept(project.place / "results.jsonl", digests)
    known = {} if again else {m.name: r for m in mutants if (r := kept.find(m, weigh))}
    waiting = [m for m in mutants if m.name not in known]
    width = max((len(m.name) for m in mutants), default=0)
    for result in known.values():
        print(line(result, width) + ", known", file=out, flush=True)
    idle = Idle(test for result in known.values() for test in result.killers) if weigh else None
    progress = Progress(len(waiting), len(mutants), width, out, status)
    try:
        workers.measure(project, unchanged, waiting, jobs, progress.say)
        for mutant, result in workers.try_all(project, unchanged, waiting, jobs, idle):
            kept.add(mutant, result)
            known[mutant.name] = result
            progress.result(result)
    finally:
        progress.end()
    return [known[m.name] for m in mutants], unchanged


def described(arguments, seconds, results):
    """What stands above the tables."""
    spent = sum(result.build_seconds + result.test_seconds for result in results)
    return {
        "command": " ".join(["./run mutants", *arguments]),
        "date": datetime.date.today().isoformat(),
        "processor": processor(),
        "seconds_of_this_start": round(seconds, 1),
        "seconds_of_builds_and_tests": round(spent, 1),
        "seconds_until_the_first_test_failed": round(sum(result.noticed_after for result in results), 1),
    }


def main(argv):
    arguments = parser().parse_args(argv)
    mutants = chosen(arguments, parser().error)
    if arguments.list:
        print("\n".join(f"{m.name}  {m.title}" for m in mutants))
        return OK
    begin = time.monotonic()
    results, unchanged = try_chosen(
        Project(builders=max(1, processors() // arguments.jobs)), mutants, arguments.jobs, arguments.weigh_tests, arguments.again
    )
    run = described(argv, time.monotonic() - begin, results)
    default = mutant_file.ROOT / "out" / ("mutants_generated" if arguments.generated else "mutants")
    base = arguments.out or default
    for ending, made in ((".json", tables.as_json), (".md", tables.as_markdown)):
        write_whole(base.with_name(base.name + ending), made(mutants, results, unchanged.times, run, judged.reasons()))
    killed, all_ = (sum(numbers[i] for numbers in tables.score(results).values()) for i in (0, 1))
    print(f"{killed} of {all_} mutants are killed. The tables: {base}.json and {base}.md")
    if wrong := [result.name for result in results if not result.fine]:
        print("Not as they should be: " + ", ".join(wrong))
    return NOT_FINE if wrong else OK


def _interrupted(number, frame):
    raise KeyboardInterrupt


def guarded(main_function, name):
    """Runs a main function; its errors become one line and an exit status."""
    signal.signal(signal.SIGTERM, _interrupted)
    try:
        return main_function(sys.argv[1:])
    except BrokenPipeError:  # of a list into `head`
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        return OK
    except (Unusable, RuntimeError, OSError) as error:
        print(f"{name}: {error}", file=sys.stderr)
        return NOT_FINE
    except (KeyboardInterrupt, Stopped):
        print(f"{name}: interrupted; a second start goes on from here", file=sys.stderr)
        return INTERRUPTED


if __name__ == "__main__":
    sys.exit(guarded(main, "mutants"))
