#!/usr/bin/python3 -SE
"""A program with the commands of plumbline that ./run farm uses, whose parts are text: one line for each batch, and a checksum.

Environment: FAKE_SECONDS for each batch; FAKE_VERSION; FAKE_FAIL, the message with which render and golden end.
"""

import os
import sys
import time
import zlib


def fail(message):
    print(message, file=sys.stderr)
    sys.exit(2)


def write(path, head, lines):
    text = "\n".join([head, *lines]) + "\n"
    with open(path + ".tmp", "w") as file:
        file.write(f"{text}checksum {zlib.crc32(text.encode())}\n")
    os.replace(path + ".tmp", path)


def content(path):
    with open(path, "rb") as file:
        return file.read()


def read(path):
    """(head, lines)"""
    text, mark, sum_ = content(path).decode().rpartition("checksum ")
    if not mark or sum_ != f"{zlib.crc32(text.encode())}\n":
        raise ValueError("the checksum is not that of the content")
    head, *lines = text.splitlines()
    return head, lines


def option(words, name, default=None):
    if name not in words:
        return default
    at = words.index(name)
    return words.pop(at) and words.pop(at)


def batches(lines):
    return [int(line.split()[1]) for line in lines]


def make(command, words):
    """render and golden"""
    if message := os.environ.get("FAKE_FAIL"):
        fail(message)
    begin, end = map(int, option(words, "--batches").split(".."))
    out, pilot, pilot_file = option(words, "-o"), int(option(words, "--pilot", 0)), option(words, "--pilot-file")
    batch = option(words, "--batch", "4")
    scene = zlib.crc32(content(words[0]))
    weights = ""
    if command == "golden" and begin >= pilot:
        if not pilot_file:
            fail("--batches: needs --pilot-file")
        weights = zlib.crc32("".join(read(pilot_file)[1]).encode())
    elif end > pilot > 0:
        fail(f"--batches {begin}..{end}: crosses the pilot")
    lines = []
    for number in range(begin, end):
        time.sleep(float(os.environ.get("FAKE_SECONDS", "0")))
        lines.append(f"batch {number} {zlib.crc32(f'{scene} {batch} {number} {weights}'.encode())}")
    try:
        write(out, f"{command} {scene} {batch}", lines)
    except OSError as error:
        fail(f"{out}: {error.strerror}")


def merge(words):
    out, samples, finish = option(words, "-o"), option(words, "-s"), "--finish" in words
    names = [word for word in words if not word.startswith("-")]
    all_lines, heads = [], set()
    for name in names:
        try:
            head, lines = read(name)
        except (OSError, ValueError) as error:
            fail(f"{name}: damaged: {error}")
        heads.add(head)
        all_lines += lines
    if len(heads) != 1:
        fail("foreign parts")
    all_lines.sort(key=lambda line: int(line.split()[1]))
    there = batches(all_lines)
    first = 0 if samples else there[0]
    end = int(samples) // int(head.split()[2]) if samples else there[-1] + 1
    if there != list(range(first, end)):
        fail(f"the parts have not exactly the batches {first}..{end}")
    write(out, f"finished {head}" if finish else head, all_lines)


def check(names):
    status = 0
    for name in names:
        try:
            head, lines = read(name)
            if head.startswith("finished"):
                raise ValueError("holds no state to go on from")
            there = batches(lines)
            print(f"{name}: batches {there[0]}..{there[-1] + 1}")
        except (OSError, ValueError) as error:
            print(f"{name}: damaged: {error}")
            status = 1
    sys.exit(status)


def main(words):
    if words == ["--version"]:
        print(os.environ.get("FAKE_VERSION", "fake 1.0") + "\nGPU: none")
    elif words[0] in ("render", "golden"):
        make(words[0], words[1:])
    elif words[:2] == ["merge", "--check"]:
        check(words[2:])
    elif words[0] == "merge":
        merge(words[1:])
    else:
        fail(f"no such command: {words[0]}")


if __name__ == "__main__":
    main(sys.argv[1:])
