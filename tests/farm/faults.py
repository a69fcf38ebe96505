"""./run farmfaults [FAULT...]: breaks workers, network and scheduler while a picture is rendered, and compares the bits with one render.

With --overhead: measures what a task costs besides the render, and two workers against one.
"""

import argparse
import contextlib
import filecmp
import os
import pathlib
import re
import shutil
import signal
import subprocess
import sys
import time

import lossy
import overhead
from site_of_processes import ROOT, Site, end_session, machine, parts_there, wait_until

SCENE = ROOT / "scenes/cornell_glass.dae"
OPTIONS = ["--size", "48x48"]
LONGEST = 400  # seconds that a driver may take


class Faults:
    """`program`: plumbline. Each fault is a function that returns what happened, in words."""

    def __init__(self, program, folder, samples):
        self.program, self.folder, self.samples = program, folder, samples
        self.single = folder / "single.exr"

    def render_alone(self):
        command = [self.program, "render", SCENE, "-s", str(self.samples), "--batch", "4", "-q", "-o", self.single, *OPTIONS]
        subprocess.run(list(map(str, command)), check=True, stdout=subprocess.DEVNULL)

    @contextlib.contextmanager
    def job(self, name, inside=(), address="127.0.0.1"):
        """A site, and a function that starts the driver on a new picture."""
        with Site(self.folder / name, address, inside) as site:
            site.start_scheduler()
            site.parts = self.folder / name / "parts"
            site.parts.mkdir()
            site.output = self.folder / name / "whole.exr"
            # -t 1: several workers share this machine, and a task should take a while.
            site.arguments = [SCENE, "-s", self.samples, "--batch", 4, "-o", site.output, "--parts", site.parts, "--scheduler", site.url,
                              "--task-batches", 4, "--patience", 120]  # fmt: skip
            site.options = ["--", "-t", "1", *OPTIONS]
            yield site

    def started(self, site, *more, parts=6):
        """The driver, when some parts are there."""
        driver = site.driver([*site.arguments, *more, *site.options])
        wait_until(lambda: parts_there(site.parts) >= parts or driver.poll() is not None, 180, "the first parts")
        if driver.poll() is not None:
            sys.exit(f"faults: the driver ended too early:\n{site.said()}")
        return driver

    def nothing(self):
        with self.job("nothing") as site:
            four(site)
            return site, ended(self.started(site), site)

    def killed(self):
        with self.job("killed") as site:
            four(site)
            driver = self.started(site)
            site.kill_worker(1)
            return site, ended(driver, site)

    def stopped(self):
        with self.job("stopped") as site:
            four(site)
            driver = self.started(site)
            site.signal_worker(1, signal.SIGSTOP)
            begin = time.monotonic()
            with contextlib.suppress(subprocess.TimeoutExpired):
                driver.wait(timeout=60)
            still = "" if driver.poll() is None else f" (done {time.monotonic() - begin:.0f} s after the stop)"
            site.signal_worker(1, signal.SIGCONT)
            return site, ended(driver, site) + still

    def full(self):
        with self.job("full") as site:
            for _ in range(3):
                site.start_worker()
            mount = f'mount -t tmpfs -o size=16k farm "{site.parts}" && exec "$@"'
            tried = subprocess.run(["unshare", "-m", "sh", "-c", mount, "sh", "true"], capture_output=True, text=True)
            if tried.returncode:
                raise lossy.Impossible(f"a small tmpfs needs root: {tried.stderr.strip()}")
            site.start_worker(["unshare", "-m", "sh", "-c", mount, "sh"])
            driver = self.started(site)
            return site, ended(driver, site)

    def scheduler(self):
        with self.job("scheduler") as site:
            four(site)
            driver = self.started(site)
            site.kill_scheduler()
            time.sleep(5)
            site.start_scheduler()
            return site, ended(driver, site)

    def interrupted(self):
        with self.job("interrupted") as site:
            four(site)
            driver = self.started(site)
            driver.send_signal(signal.SIGINT)
            status = driver.wait(timeout=60)
            there = parts_there(site.parts)
            again = site.driver([*site.arguments, *site.options])
            return site, f"exit {status} with {there} parts there; second start: {ended(again, site)}"

    def damaged(self):
        with self.job("damaged") as site:
            four(site)
            driver = self.started(site)
            part = sorted(site.parts.glob("batches_*.exr"))[1]
            content = bytearray(part.read_bytes())
            content[len(content) // 2] ^= 16
            part.write_bytes(content)
            return site, ended(driver, site)

    def loss(self):
        with lossy.namespaces(20) as how:
            inside = ["ip", "netns", "exec"]
            with self.job("loss", [*inside, lossy.HUB], lossy.HUB_ADDRESS) as site:
                for name in lossy.WORKERS:
                    site.start_worker([*inside, name])
                happened = ended(self.started(site, "--return-parts", parts=1), site)
                (site.folder / "dropped.txt").write_text(lossy.dropped())
                return site, f"{happened} (packets dropped by {how})"


FAULTS = {
    "nothing": "none",
    "killed": "one of 4 workers killed (SIGKILL, does not come back)",
    "stopped": "one of 4 workers stopped for a minute (SIGSTOP)",
    "full": "the disk of one of 4 workers is full",
    "scheduler": "the scheduler killed, and started again after 5 s",
    "interrupted": "Ctrl-C at the driver, and a second start",
    "damaged": "a bit of a part flipped",
    "loss": "2 workers, 20% of all packets lost, parts returned through the engine",
}


def four(site):
    for _ in range(4):
        site.start_worker()


def ended(driver, site):
    """Waits for the driver; its last line, without the file."""
    try:
        driver.wait(timeout=LONGEST)
    except subprocess.TimeoutExpired:
        end_session(driver)
        return f"NOT DONE after {LONGEST} s"
    last = site.said().strip().splitlines()[-1]
    return re.sub(r"^\S+: ", "", last) if driver.returncode == 0 else f"exit {driver.returncode}: {last}"


def parser():
    made = argparse.ArgumentParser(prog="./run farmfaults", description=__doc__.partition("\n")[0])
    made.add_argument("fault", nargs="*", metavar="FAULT", help=f"{', '.join(FAULTS)} (default: all)")
    made.add_argument("--samples", type=int, default=1024, help="samples per pixel, a multiple of 16 (1024)")
    made.add_argument("--overhead", action="store_true", help="measure overhead and two workers against one into JSON instead")
    made.add_argument("-o", "--out", type=pathlib.Path, help="the table (out/farm/faults.md; with --overhead out/farm/overhead.json)")
    return made


def main(argv):
    arguments = parser().parse_args(argv)
    if unknown := set(arguments.fault) - FAULTS.keys():
        parser().error(f"there is no fault {', '.join(sorted(unknown))} (there are {', '.join(FAULTS)})")
    if arguments.samples < 128 or arguments.samples % 16:
        parser().error("--samples: a multiple of 16, at least 128")
    program = os.environ.get("PLUMBLINE") or str(ROOT / "build/release/plumbline")
    folder = ROOT / "out/farm/faults"
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    if arguments.overhead:
        return overhead.measure(program, folder, arguments.out or ROOT / "out/farm/overhead.json")
    faults = Faults(program, folder, arguments.samples)
    faults.render_alone()
    lines = [machine(), "", "| fault | what happened | same bits |", "|---|---|---|"]
    wrong = 0
    for name in arguments.fault or FAULTS:
        try:
            site, happened = getattr(faults, name)()
            same = site.output.exists() and filecmp.cmp(site.output, faults.single, shallow=False)
            wrong += not same
            lines.append(f"| {FAULTS[name]} | {happened} | {'yes' if same else 'NO'} |")
        except lossy.Impossible as why:
            lines.append(f"| {FAULTS[name]} | not tried: {why} | - |")
        print(lines[-1], flush=True)
    out = arguments.out or ROOT / "out/farm/faults.md"
    out.write_text("\n".join(lines) + "\n")
    print(f"The table: {out}. Logs: {folder}")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
