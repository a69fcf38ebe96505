"""Copies of the sources, in which mutants are tried: the sources themselves are never changed."""

import hashlib
import os
import pathlib
import subprocess

NO_SOURCES = ("docs/", "tests/mutants/", "build/", "out/")  # no test program depends on them


def listed(root):
    """The files of the sources, relative to `root`: what git knows or would add; in an unpacked archive, all but build/ and out/."""
    if (root / ".git").exists():
        command = ["git", "-c", "safe.directory=*", "ls-files", "-z", "--cached", "--others", "--exclude-standard"]
        result = subprocess.run(command, cwd=root, capture_output=True, text=True)
        if result.returncode != 0:
            raise RuntimeError(f"git cannot list the sources: {result.stderr.strip()}")
        names = sorted(set(filter(None, result.stdout.split("\0"))))
    else:
        names = sorted(_below(root))
    return [name for name in names if (root / name).is_file()]


def _below(root):
    for folder, folders, files in os.walk(root):
        if pathlib.Path(folder) == root:
            folders[:] = [name for name in folders if name not in ("build", "out", ".git")]
        yield from (pathlib.Path(folder, name).relative_to(root).as_posix() for name in files)


class Digests:
    """Hashes of the files at `root` on which test programs may depend."""

    def __init__(self, root):
        names = [name for name in listed(root) if not name.startswith(NO_SOURCES) and not name.endswith(".md")]
        self._files = {name: hashlib.sha256((root / name).read_bytes()).digest() for name in names}

    def of_all(self):
        return self._total(self._files)

    def of_programs(self, programs):
        """Of all but the tests of other programs: a program is made of the files *_test.cpp of its own folder. The list of them
        is in the folder's CMakeLists.txt."""
        own = tuple(f"{program}_" for program in programs)
        return self._total(name for name in self._files if not _is_of_one_program(name) or _program_of(name).startswith(own))

    def _total(self, names):
        total = hashlib.sha256()
        for name in names:
            total.update(name.encode() + b"\0" + self._files[name])
        return total.hexdigest()[:16]


def _is_of_one_program(name):
    return name.endswith("_test.cpp") or (name.startswith("tests/") and name.count("/") > 1 and name.endswith("/CMakeLists.txt"))


def _program_of(name):
    """"test_ref_trees_" of tests/ref/trees/aabb_test.cpp."""
    return "test_" + "_".join(name.split("/")[1:-1]) + "_"


def apply(diff, folder, *options):
    """Lets `git apply` change the files below `folder`. Returns what it complains about, or nothing."""
    # A working tree around the folder is not looked for: there, git takes paths as relative to that tree's root.
    environment = dict(os.environ, GIT_CEILING_DIRECTORIES=str(folder.resolve().parent))
    command = ["git", "-c", "safe.directory=*", "apply", "--whitespace=nowarn", *options]
    result = subprocess.run(command, cwd=folder, input=diff, text=True, capture_output=True, env=environment)
    return "" if result.returncode == 0 else result.stderr.strip() or f"git apply: exit status {result.returncode}"


class Copy:
    """A copy of the sources at `root` in `folder`."""

    def __init__(self, root, folder):
        self.root, self.folder = root, folder

    def bring_up_to_date(self):
        """Makes it equal to the sources. Files that did not change keep their time, so that nothing is built twice."""
        names = listed(self.root)
        for name in names:
            source, target = self.root / name, self.folder / name
            if not target.is_file() or target.read_bytes() != source.read_bytes():
                target.parent.mkdir(parents=True, exist_ok=True)
                target.write_bytes(source.read_bytes())  # the time is now: what depends on it is built again
                target.chmod(source.stat().st_mode)
        for name in set(_below(self.folder)) - set(names):
            (self.folder / name).unlink()

    def change(self, mutant):
        """Applies a mutant. Returns a function that takes it back, or a sentence that says why it does not apply."""
        before = {name: _bytes(self.folder / name) for name in mutant.files}
        if complaint := apply(mutant.diff, self.folder):
            return complaint.splitlines()[0]
        if all(_bytes(self.folder / name) == content for name, content in before.items()):
            return "the patch changes nothing"

        def take_back():
            for name, content in before.items():
                if content is None:
                    (self.folder / name).unlink(missing_ok=True)
                elif _bytes(self.folder / name) != content:
                    (self.folder / name).write_bytes(content)

        return take_back


def _bytes(path):
    return path.read_bytes() if path.is_file() else None
