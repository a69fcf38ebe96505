"""Ranges of batches cover each batch once, are aligned, and have the size that the speed asks for."""

import pathlib
import random
import sys
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "farm"))

from ranges import Gaps, Range, missing, without_overlap  # noqa: E402
from speed import Speed  # noqa: E402

SEED = random.randrange(1 << 32)


class Ranges(unittest.TestCase):
    def setUp(self):
        self.random = random.Random(SEED)

    def test_each_batch_once_in_aligned_ranges_of_a_power_of_two(self):
        for _ in range(100):
            begin = self.random.choice([0, self.random.randrange(1000)])
            whole = Range(begin, begin + self.random.randrange(1, 600))
            gaps, taken, most = Gaps([whole]), [], self.random.choice([1, 2, 64, 1024])
            while (batches := gaps.take(self.random.randrange(1, 2 * most))) is not None:
                taken.append(batches)
                self.assertEqual(batches.size & (batches.size - 1), 0, f"seed {SEED}: {batches}")
                self.assertEqual(batches.begin % batches.size, 0, f"seed {SEED}: {batches}")
                self.assertEqual(gaps.batches, whole.end - batches.end)
            numbers = [number for batches in taken for number in range(*batches)]
            self.assertEqual(numbers, list(range(*whole)), f"seed {SEED}")

    def test_large_ranges_are_taken_where_they_fit(self):
        gaps, taken = Gaps([Range(0, 200)]), []
        while (batches := gaps.take(64)) is not None:
            taken.append(str(batches))
        self.assertEqual(taken, ["0..64", "64..128", "128..192", "192..200"])

    def test_what_is_missing_and_what_is_there_make_the_whole(self):
        for _ in range(100):
            whole = Range(0, self.random.randrange(1, 200))
            there = []
            for _ in range(self.random.randrange(6)):
                begin = self.random.randrange(220)
                there.append(Range(begin, begin + self.random.randrange(1, 60)))
            kept = without_overlap(whole, there)
            numbers = [number for part in kept + missing(whole, kept) for number in range(*part)]
            self.assertEqual(sorted(numbers), list(range(*whole)), f"seed {SEED}: {there}")

    def test_the_largest_of_overlapping_parts_is_kept(self):
        self.assertEqual(without_overlap(Range(0, 16), [Range(0, 1), Range(0, 8), Range(4, 8), Range(8, 32)]), [Range(0, 8)])


class Sizes(unittest.TestCase):
    def test_the_first_task_is_one_batch(self):
        self.assertEqual(Speed().batches(1000, 4), 1)

    def test_a_task_takes_about_the_time_wanted(self):
        speed = Speed(task_seconds=60)
        speed.add(1, 1.5)
        self.assertEqual(speed.batches(100000, 4), 16)  # 40 would take 60 s, but from one batch it grows by 16 at most
        speed.add(16, 8.0)
        self.assertEqual(speed.batches(100000, 4), 64)  # of 0.5 s each: the program's start was in the first task

    def test_the_last_tasks_are_smaller_but_not_tiny(self):
        speed = Speed(task_seconds=64)
        speed.add(64, 64.0)
        self.assertEqual([speed.batches(remaining, 4) for remaining in (10000, 256, 64, 1)], [64, 32, 8, 8])

    def test_a_long_job_has_about_sixteen_tasks_for_each_worker(self):
        speed = Speed(task_seconds=60, all_batches=4096)
        speed.add(16, 16 * 66.0)
        self.assertEqual(speed.batches(4096, 10), 16)  # and not 1 batch: 4,096 parts
        self.assertEqual(speed.batches(4096, 1000), 1)

    def test_one_slow_task_does_not_count(self):
        speed = Speed(task_seconds=8)
        for seconds in (1.0, 1.0, 500.0):
            speed.add(1, seconds)
        self.assertEqual(speed.expected(2), 2.0)
        self.assertEqual(speed.batches(10000, 1), 8)

    def test_a_batch_that_takes_longer_than_a_task_should(self):
        speed = Speed(task_seconds=1)
        speed.add(1, 100.0)
        self.assertEqual(speed.batches(10, 1), 1)

    def test_a_size_that_is_given(self):
        speed = Speed(task_batches=8)
        speed.add(8, 1000.0)
        self.assertEqual(speed.batches(1, 100), 8)


if __name__ == "__main__":
    unittest.main()
