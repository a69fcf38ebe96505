"""A project that is built in milliseconds, for the tests of the runner: its "test program" is a shell script that prints what
a GoogleTest program prints."""

import difflib
import os
import pathlib

from mutant import Mutant
from project import Project

FILES = {
    "ref/sum/sum.sh": "# What the tests look at.\nadd() {\n    echo $(($1 + $2))\n}\n",
    "tests/toy.sh": r"""
trap 'exit 0' USR1
status=0
count=0
patterns=${1#--gtest_filter=}
for name in Slow.Waits Sum.Adds Sum.TakesZero Sum.IsSmall; do
    chosen=
    set -f
    IFS=:
    for pattern in $patterns; do case $name in $pattern) chosen=1 ;; esac; done
    [ -n "$chosen" ] || continue
    echo "[ RUN      ] $name"
    case $name in
        Slow.Waits) right=$(add 7 1) expected=8 time=900 ;;
        Sum.Adds) right=$(add 2 3) expected=5 time=3 ;;
        Sum.TakesZero) right=$(add 2 0) expected=2 time=0 ;;
        Sum.IsSmall) right=1 expected=1 time=0 ;;
    esac
    count=$((count + 1))
    if [ "$right" = $expected ]; then echo "[       OK ] $name ($time ms)"; continue; fi
    echo "[  FAILED  ] $name ($time ms)"
    status=1
    [ "$2" = --gtest_fail_fast ] && break
done
echo "[==========] $count tests from 2 test suites ran. (1 ms total)"
exit $status
""",
    "build.sh": "echo built >>build/log\nsh -n ref/sum/sum.sh 2>build/errors || { echo \"error: $(cat build/errors ref/sum/sum.sh)\"; exit 1; }\n"
    "mkdir -p build/release\ncat ref/sum/sum.sh tests/toy.sh >build/release/test_toy\nchmod +x build/release/test_toy\n",
}


class Toy(Project):
    """The files above in `folder`. `ran`: (program, arguments) of each run."""

    def __init__(self, folder):
        super().__init__(pathlib.Path(folder))
        self.ran = []
        for name, text in FILES.items():
            path = self.root / name
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(text)

    def commands_to_build(self, folder, preset, program):
        os.makedirs(folder / "build", exist_ok=True)
        return [["sh", "build.sh"]]

    def run(self, folder, preset, program, arguments, seconds):
        self.ran.append((program, *arguments))
        return super().run(folder, preset, program, arguments, seconds)


def toy_mutant(name, line, fails=(), file="ref/sum/sum.sh", **more):
    """The mutant that has `line` in place of the line that adds."""
    before = FILES[file].splitlines(keepends=True)
    after = [f"    {line}\n" if "echo $((" in text else text for text in before]
    diff = "".join(difflib.unified_diff(before, after, f"a/{file}", f"b/{file}"))
    return Mutant(name, f"title of {name}", diff, ("test_toy",), tuple(fails), **more)
