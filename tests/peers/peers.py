"""Measures Plumbline's fast path beside Mitsuba 3, LuxCore and Embree: ./run peers. See docs/peers.md."""

import datetime
import json
import os
import shlex
import signal
import sys
import tempfile

import embree_trees
import machine
import measure
import options as command_line
import report
from contestants import contestants_of, pairs_of, start_peers
from plumbline import Plumbline
from problem import Problem

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))


def say(text):
    print(text, file=sys.stderr, flush=True)


def scene_files(names):
    """Pairs (path, whether it is framed). The course scenes are not part of Plumbline."""
    shared = os.path.join(os.environ.get("PLUMBLINE_SHARED", ""), "scenes")
    files = []
    for name in names:
        if name in command_line.OURS:
            files.append((os.path.join(ROOT, "scenes", name + ".dae"), False))
        elif os.path.isfile(os.path.join(shared, name + ".dae")):
            files.append((os.path.join(shared, name + ".dae"), True))
        else:
            say(f"{name}: skipped: a course scene, expected in $PLUMBLINE_SHARED/scenes")
    return files


def collect(options, plumbline, peers, folder):
    """All entries, and a line for each contestant that cannot take part on a scene."""
    entries, absent = [], []
    for path, frame in scene_files(options.scenes) if peers else ():
        found, missing = contestants_of(path, frame, options.size, plumbline, peers, folder)
        entries += [measure.Entry(each) for each in found]
        absent += [f"{name}: not measured: {why}" for name, why in missing.items()]
    return entries, absent


def main(arguments):
    options = command_line.parse(arguments)
    logs = os.path.join(ROOT, "build", "peers")
    os.makedirs(logs, exist_ok=True)
    plumbline_version = Plumbline(options.plumbline, logs).version()
    result = {"date": datetime.datetime.now().astimezone().isoformat(timespec="seconds"),
              "command": shlex.join(["./run", "peers", *arguments]), "machine": machine.processor(),
              "before": machine.load(), "options": vars(options)}
    if not machine.is_quiet(result["before"]):
        say(f"WARNING: the machine is not quiet ({machine.describe(result['before'])}): "
            "the figures are indications only")
    peers, versions, missing = start_peers(options.python, logs, options.only)
    result["versions"] = {"plumbline": plumbline_version, **versions}
    result["not_measured"] = [f"{name}: not measured: {why}" for name, why in missing.items()]
    with tempfile.TemporaryDirectory(prefix="plumbline_peers_") as folder:
        entries, absent = collect(options, Plumbline(options.plumbline, folder), peers, folder)
        result["not_measured"] += absent
        for line in result["not_measured"]:
            say(line)
        interrupted = False
        trees, differences = [], {}
        try:
            measure.prepare(entries, options, options.size[0] * options.size[1])
            differences = measure.compare_pictures(entries)
            measure.measure_rounds(entries, options)
            if "embree" in options.only:
                say(f"trees beside Embree, {options.repetitions} repetitions")
                trees = trees_beside_embree(options, folder, result)
        except KeyboardInterrupt:
            interrupted = True
            say("\ninterrupted: what follows was measured before")
        finally:
            for peer in peers.values():
                peer.stop()
    if not differences and any(entry.pictures for entry in entries):
        differences = measure.compare_pictures(entries)
    finish(result, entries, differences, trees, options, interrupted)
    return 130 if interrupted else 0


def trees_beside_embree(options, folder, result):
    try:
        return embree_trees.measure(options.bench, options.repetitions, folder)
    except Problem as problem:
        result["not_measured"].append(f"embree: not measured: {problem}")
        say(result["not_measured"][-1])
        return []


def finish(result, entries, differences, trees, options, interrupted):
    result["after"] = machine.load()
    result["interrupted"] = interrupted
    result["ratios"] = report.ratios_of(entries, differences, pairs_of(options.only))
    result["rates"] = report.rates_of(entries)
    result["embree"] = trees
    result["runs"] = [{"scene": entry.contestant.scene, "contestant": entry.contestant.name, "threads": threads,
                       "round": number, **{key: run[key] for key in ("samples", "seconds", "cpu_seconds")}}
                      for entry in entries for threads, runs in entry.runs.items() for number, run in runs.items()]
    os.makedirs(os.path.dirname(options.output) or ".", exist_ok=True)
    with open(options.output, "w", encoding="utf-8") as file:
        json.dump(result, file, indent=1)
        file.write("\n")
    print_markdown(result, entries, options)


def print_markdown(result, entries, options):
    few, runs = report.disturbed(entries)
    print(f"Command: `{result['command']}`\n\nDate: {result['date']}. Machine: {result['machine']}; before: "
          f"{machine.describe(result['before'])}; after: {machine.describe(result['after'])}. "
          f"{few} of {runs} runs with one thread had less than 95% of a processor. "
          f"{'' if machine.is_quiet(result['before']) else 'The machine was not quiet: indications only. '}"
          f"Versions: {'; '.join(dict.fromkeys(result['versions'].values()))}.\n")
    if entries:
        print("Ratios of rates (samples per second), geometric mean over the rounds with its 95% interval; above 1, "
              "the first one is faster:\n")
        print(report.markdown_ratios(result["ratios"], options.threads))
        print("\nThousand samples per second, median over the rounds:\n")
        print(report.markdown_rates(result["rates"], options.threads))
    if result["embree"]:
        print("\nBeside Embree:\n")
        print(embree_trees.markdown(result["embree"]))
    for line in result["not_measured"]:
        print(f"\n{line}")
    say(f"in full: {options.output}")


if __name__ == "__main__":
    signal.signal(signal.SIGTERM, signal.default_int_handler)  # like Ctrl-C
    try:
        sys.exit(main(sys.argv[1:]))
    except (Problem, OSError) as error:
        say(f"./run peers: {error}")
        sys.exit(2)
    except KeyboardInterrupt:
        sys.exit(130)
