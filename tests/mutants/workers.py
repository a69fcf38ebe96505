"""Several workers, each with its own copy of the sources, try mutants until none is left."""

import collections
import queue
import threading

import processes
from sources import Digests
from trial import try_mutant
from unchanged import Unusable


class Line:
    """The mutants that wait. Those that change the same file and need the same program are a group: a worker tries them one
    after the other, since between them little is built. A worker that has no group takes one for which it has built the
    program before, or else the largest; if none is left, it shares the largest of the others."""

    def __init__(self, mutants):
        groups = collections.defaultdict(collections.deque)
        for mutant in mutants:
            groups[mutant.preset, mutant.programs[0], (mutant.files or [""])[0]].append(mutant)
        self.waiting, self.taken, self.built = dict(groups), {}, collections.defaultdict(set)
        self.lock = threading.Lock()

    def next(self, worker):
        with self.lock:
            key = self.taken.get(worker)
            if key is None or not self.waiting[key]:
                key = self._choose(worker)
            if key is None:
                return None
            self.taken[worker] = key
            self.built[worker].add(key[:2])
            return self.waiting[key].popleft()

    def _choose(self, worker):
        others = {key for other, key in self.taken.items() if other != worker}
        rest = [key for key, mutants in self.waiting.items() if mutants]
        if not rest:
            return None
        return max(rest, key=lambda key: (key not in others, key[:2] in self.built[worker], len(self.waiting[key]), key))


def side_by_side(count, work):
    """Runs work(number, put) in `count` threads and yields what they put, as it comes. An exception in one of them ends all,
    and so does one in the loop over what this yields; then it is raised here."""
    results, ended = queue.Queue(), object()

    def thread(number):
        try:
            work(number, results.put)
            results.put(ended)
        except BaseException as error:
            results.put(error)

    threads = [threading.Thread(target=thread, args=(number,)) for number in range(count)]
    for t in threads:
        t.start()
    try:
        while count:
            result = results.get()
            if isinstance(result, BaseException):
                raise result
            if result is ended:
                count -= 1
            else:
                yield result
    except BaseException:
        processes.stop_all()
        raise
    finally:
        for t in threads:
            t.join()
        processes.allow()


def measure(project, unchanged, mutants, workers, say):
    """Measures what is missing of the unchanged sources for these mutants."""
    missing = list(unchanged.missing(mutants).items())
    if not missing:
        return
    # In one copy, since two cannot share what they compile before it is compiled. Here every processor helps.
    copy = project.copy(0)
    copy.bring_up_to_date()
    builders, project.builders = project.builders, workers
    for (preset, program), _ in missing:
        say(f"unchanged sources: building {program} ({preset})")
        unchanged.build(copy, preset, program)
    project.builders = builders
    waiting = collections.deque(missing)  # its methods are safe in threads

    def work(number, put):
        while True:
            try:
                (preset, program), tests = waiting.popleft()
            except IndexError:
                return
            put(f"unchanged sources: running {program} ({preset})")
            unchanged.measure(copy, preset, program, tests)

    for text in side_by_side(min(workers, len(missing)), work):
        say(text)


def try_all(project, unchanged, mutants, workers, idle=None):
    """Yields (mutant, result) as they come. `idle`: see try_mutant."""
    line = Line(mutants)

    def work(number, put):
        copy, built = project.copy(number), set()
        copy.bring_up_to_date()
        if Digests(copy.folder).of_all() != unchanged.digests.of_all():
            raise Unusable("the sources have changed since the start: start again")
        while mutant := line.next(number):
            # So that the time of the build is that of the mutant, and its errors are the mutant's.
            for key in unchanged.wanted([mutant]).keys() - built:
                unchanged.build(copy, *key)
                built.add(key)
            put((mutant, try_mutant(project, copy, unchanged.times, mutant, idle)))

    yield from side_by_side(max(1, min(workers, len(mutants))), work)
