"""What is built and run: the test programs of a copy of the sources. The self test has a smaller project, with the same methods."""

import hashlib
import os
import pathlib
import re
import signal

import gtest
import parts
import processes
from mutant import ROOT
from sources import Copy

BUILD_SECONDS = 1800  # of a program from nothing, on a slow processor; a change of one file takes a minute or less
TIMES, MORE_SECONDS = 10, 20  # a run may take ten times as long as without a mutant, and 20 seconds (a machine that is busy)
LINES_OF_ERROR = 3


class Project:
    """`root`: the sources. `place`: where copies and what was measured are kept. `builders`: compilers at once in a copy."""

    def __init__(self, root=ROOT, place=None, builders=1):
        self.root, self.place, self.builders = root, place or root / "build" / "mutants", builders
        self._objects = {}

    def copy(self, number):
        return Copy(self.root, self.place / str(number))

    def commands_to_build(self, folder, preset, program):
        built = folder / "build" / preset
        # The build does not ask a program for its tests: with a mutant it may crash, which is a kill and no error of the build.
        listing = "-DCMAKE_GTEST_DISCOVER_TESTS_DISCOVERY_MODE=PRE_TEST"
        # The kernels are the same text for each instruction set, and take half a minute to compile for each.
        kernels = "-DPLUMBLINE_QUICK_KERNELS=ON"
        # Each source file of tests for itself, so that few of them are compiled for a part of a program (parts.py).
        groups = "-DPLUMBLINE_TEST_GROUPS=OFF"
        # A mistake may leave a variable without use. The tests are to notice it, and not the compiler's warnings.
        warnings = "-DPLUMBLINE_WARNINGS_AS_ERRORS=OFF"
        configure = ["cmake", "--preset", preset, "-DPLUMBLINE_CUDA=OFF", kernels, groups, warnings, listing]
        compile_program = ["cmake", "--build", str(built), "--target", program, "-j", str(self.builders)]
        # Once it is configured so, ninja configures again by itself when it must.
        stamp = built / f"configured_{hashlib.sha256(repr(configure).encode()).hexdigest()[:8]}"
        return [compile_program] if stamp.is_file() else [configure, ["cmake", "-E", "touch", str(stamp)], compile_program]

    def path_of(self, folder, preset, program):
        """Where a program that was built is; None if the target is no program."""
        built = folder / "build" / preset
        candidates = [built / program, *(built / "tests").rglob(program)]
        return next((path for path in candidates if path.is_file() and os.access(path, os.X_OK)), None)

    def build(self, folder, preset, program):
        """Builds a program of a copy. Returns an empty text, or what is wrong in a few lines."""
        for command in self.commands_to_build(folder, preset, program):
            if error := _built(command, folder, folder, program):
                return error
        return "" if self.path_of(folder, preset, program) else f"{program} is no program that the build makes"

    def build_unchanged(self, folder, preset, program):
        """Builds a program of a copy that has no mutant, and looks at what it is made of (objects)."""
        if error := self.build(folder, preset, program):
            return error
        self._objects.pop((folder, preset, program), None)
        if is_test_program(program) and preset == "release" and (path := self.path_of(folder, preset, program)):
            built = folder / "build" / preset
            if (built / "build.ninja").is_file():
                self._objects[folder, preset, program] = parts.read_objects(built, str(path.relative_to(built)))
        return ""

    def objects(self, folder, preset, program):
        """The object files of a program that was built without a mutant; None where no parts of it can be built."""
        return self._objects.get((folder, preset, program))

    def build_part(self, folder, preset, part):
        """Compiles what a part of a program needs. Returns an empty text, or what is wrong in a few lines."""
        return _built(["ninja", "-j", str(self.builders), *part.targets], folder, folder / "build" / preset, part.file)

    def link_part(self, folder, preset, part):
        """Makes the program of a part that is compiled. Returns whether that is possible: with a mutant, it may need more."""
        return processes.run(part.link, folder / "build" / preset, BUILD_SECONDS).status == 0

    def run(self, folder, preset, program, arguments, seconds):
        """Runs a program of a copy, for at most this time."""
        scratch = pathlib.Path(f"{folder}.tmp")  # each copy has its own: tests in another one write files of the same names
        scratch.mkdir(parents=True, exist_ok=True)
        # Properties draw the same inputs in every run. ThreadSanitizer needs an address space without a limit.
        environment = {"RC_PARAMS": "seed=1", "TMPDIR": str(scratch), "TEST_TMPDIR": str(scratch), "GTEST_COLOR": "no"}
        megabytes = 0 if preset == "tsan" else _megabytes_of_machine() // 4
        path = self.path_of(folder, preset, program)
        # Another program than one with tests may name files of the sources.
        place = path.parent if is_test_program(program) else folder
        ended = processes.run([path, *arguments], place, seconds, environment, megabytes)
        if ended.status == -signal.SIGKILL:
            raise RuntimeError(f"something else ended {program}: is there too little memory for so many workers?")
        return ended


def _built(command, folder, place, program):
    """Runs a command that builds, in `place`. Returns an empty text, or what is wrong in a few lines."""
    # Copies share what they compile: paths below the folder count as relative ones.
    environment = {
        "CCACHE_BASEDIR": str(folder),
        "CCACHE_NOHASHDIR": "1",
        "CCACHE_SLOPPINESS": "pch_defines,time_macros",
    }
    ended = processes.run(command, place, BUILD_SECONDS, environment)
    if ended.status is None:
        return f"the build of {program} was stopped after {BUILD_SECONDS} seconds"
    if ended.status == 0:
        return ""
    _refuse_a_full_machine(program, ended.output)
    lines = [line for line in ended.output.splitlines() if "error" in line.lower()] or ended.output.splitlines()
    return "\n".join(line[:300] for line in lines[:LINES_OF_ERROR]) or f"exit status {ended.status}"


def _refuse_a_full_machine(program, output):
    """A build that fails for want of memory or of room on the disk says nothing about the mutant."""
    if found := re.search(r"No space left on device|Killed signal terminated program \w+", output):
        raise RuntimeError(f"the build of {program} failed: {found[0]}")


def _megabytes_of_machine():
    return os.sysconf("SC_PHYS_PAGES") * os.sysconf("SC_PAGE_SIZE") // 2**20


def is_test_program(program):
    return program.startswith("test_")


def arguments_of(program, tests):
    """The arguments for these tests: names of gtest, or of another program the arguments themselves."""
    return [gtest.filter_argument(tests)] if is_test_program(program) else tests[0].split()


def most_seconds(measured):
    return TIMES * measured + MORE_SECONDS
