"""Ratios, intervals and the comparison of pictures, on known numbers."""

import math
import random
import unittest

from blocks import block_means, name_of
from embree_trees import rows_of
from statistics_of_ratios import compare_means, median, ratio_of, t_quantile


class Quantiles(unittest.TestCase):
    def test_are_those_of_the_tables(self):
        for probability, freedom, expected in [(0.975, 1, 12.7062), (0.975, 6, 2.44691), (0.975, 30, 2.04227),
                                               (0.95, 4, 2.13185), (0.9995, 10, 4.58689)]:
            self.assertAlmostEqual(t_quantile(probability, freedom), expected, delta=1e-4)


class Ratios(unittest.TestCase):
    def test_of_equal_rounds_have_no_width(self):
        ratio = ratio_of([3.0, 6.0, 1.5], [2.0, 4.0, 1.0])
        self.assertAlmostEqual(ratio.value, 1.5)
        self.assertAlmostEqual(ratio.low, 1.5)
        self.assertAlmostEqual(ratio.high, 1.5)

    def test_have_students_interval_of_the_logarithm(self):
        ratio = ratio_of([math.e, 1.0, 1 / math.e], [1.0, 1.0, 1.0])
        # Logarithms 1, 0, -1: mean 0, standard deviation 1; the quantile for two degrees of freedom is 4.30265.
        self.assertAlmostEqual(ratio.value, 1.0)
        self.assertAlmostEqual(math.log(ratio.high), 4.30265 / math.sqrt(3), delta=1e-4)
        self.assertAlmostEqual(ratio.low * ratio.high, 1.0)

    def test_of_one_round_have_no_interval(self):
        self.assertTrue(math.isnan(ratio_of([2.0], [1.0]).low))

    def test_exchange_sides_to_the_inverse(self):
        a, b = [1.0, 1.3, 0.9], [2.0, 2.1, 2.4]
        one, other = ratio_of(a, b), ratio_of(b, a)
        self.assertAlmostEqual(one.low, 1 / other.high)

    def test_intervals_cover_the_truth_as_often_as_they_say(self):
        source = random.Random(7)
        inside = 0
        for _ in range(400):
            ours = [2.0 * math.exp(source.gauss(0, 0.1)) for _ in range(4)]
            theirs = [math.exp(source.gauss(0, 0.1)) for _ in range(4)]
            ratio = ratio_of(ours, theirs)
            inside += ratio.low <= 2.0 <= ratio.high
        # 380 expected; the binomial standard deviation is 4.4. The seed is fixed.
        self.assertTrue(362 <= inside <= 398, inside)

    def test_median(self):
        self.assertEqual(median([3, 1, 2]), 2)
        self.assertEqual(median([4, 1, 2, 3]), 2.5)


class Pictures(unittest.TestCase):
    def test_blocks_begin_at_the_top_left(self):
        width, height = 8, 4
        values = [float(y) if channel == 0 else 0.5 for y in range(height) for _ in range(width) for channel in range(3)]
        means = block_means(values, width, height, top_first=True)
        self.assertEqual(means[:3], [1.5, 0.5, 0.5])
        self.assertEqual(means[3::3], [0.0] * 4 + [1.0] * 4 + [2.0] * 4 + [3.0] * 4)
        self.assertEqual(block_means(values, width, height, top_first=False)[3::3],
                         [3.0] * 4 + [2.0] * 4 + [1.0] * 4 + [0.0] * 4)
        self.assertEqual(name_of(4), "block 1 of row 1, green")

    def pictures(self, source, mean):
        return [[mean + source.gauss(0, 0.004) for _ in range(51)] for _ in range(32)]

    def test_with_the_same_mean_are_the_same(self):
        source = random.Random(1)
        difference = compare_means(self.pictures(source, 1.0), self.pictures(source, 1.0))
        self.assertEqual(difference.verdict, "same", difference)

    def test_with_a_brighter_block_differ(self):
        source = random.Random(1)
        ours, theirs = self.pictures(source, 1.0), self.pictures(source, 1.0)
        for picture in ours:
            picture[20] += 0.02
        difference = compare_means(ours, theirs)
        self.assertEqual(difference.verdict, "differ")
        self.assertEqual(difference.where, 20)

    def test_without_noise_may_differ_by_rounding(self):
        self.assertEqual(compare_means([[1.0] * 3] * 4, [[1.0 + 1e-6] * 3] * 4).verdict, "same")
        self.assertEqual(compare_means([[1.0] * 3] * 4, [[1.01] * 3] * 4).verdict, "differ")

    def test_that_are_too_noisy_decide_nothing(self):
        source = random.Random(1)
        noisy = [[[1 + source.gauss(0, 0.3) for _ in range(51)] for _ in range(8)] for _ in range(2)]
        self.assertEqual(compare_means(*noisy).verdict, "inconclusive")


class Embree(unittest.TestCase):
    def test_ratios_are_of_rates_within_repetitions(self):
        def run(name, repetition, milliseconds):
            return {"name": name, "run_name": name, "run_type": "iteration", "repetition_index": repetition,
                    "cpu_time": milliseconds}
        rows = rows_of({"benchmarks": [
            run("diffuse/sphere-1e5/hploc-wide", 0, 20.0), run("diffuse/sphere-1e5/hploc-wide", 1, 22.0),
            run("diffuse/sphere-1e5/embree-low", 1, 11.0), run("diffuse/sphere-1e5/embree-low", 0, 10.0),
            {"name": "diffuse/sphere-1e5/embree-low_mean", "run_name": "diffuse/sphere-1e5/embree-low",
             "run_type": "aggregate", "cpu_time": 1.0}]})
        self.assertEqual(len(rows), 1)
        self.assertAlmostEqual(rows[0]["ratio"], 0.5)
        self.assertEqual(rows[0]["rounds"], 2)

    def test_threads_are_compared_by_the_clock(self):
        def run(name, cpu, real):
            return {"name": name, "run_name": name, "repetition_index": 0, "cpu_time": cpu, "real_time": real}
        rows = rows_of({"benchmarks": [
            run("build/sphere-1e6/hploc/1", 30.0, 32.0), run("build/sphere-1e6/hploc/2/real_time", 29.0, 16.0),
            run("build/sphere-1e6/embree-low/1", 15.0, 99.0)]})
        self.assertEqual([(row["what"], row["ours"], row["theirs"], row["ratio"]) for row in rows],
                         [("build, 1 thread", "hploc", "embree-low", 0.5),
                          ("build, 2 threads / 1 thread", "hploc", "hploc", 2.0)])


if __name__ == "__main__":
    unittest.main()
