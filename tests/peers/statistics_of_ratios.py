"""Ratios with intervals, and the comparison of two sets of pictures. Only Python's own library."""

import functools
import math
from dataclasses import dataclass


# Relative difference of the mean radiance.
DETECTED = 0.01


@dataclass(frozen=True)
class Ratio:
    value: float
    low: float
    high: float
    rounds: int


def ratio_of(ours, theirs, confidence=0.95):
    """The geometric mean of the ratios within each round, and Student's t-interval of the logarithm. With one
    round there is no interval: its ends are NaN."""
    logs = [math.log(a / b) for a, b in zip(ours, theirs, strict=True)]
    mean = sum(logs) / len(logs)
    half = math.nan
    if len(logs) > 1:
        variance = sum((each - mean) ** 2 for each in logs) / (len(logs) - 1)
        half = t_quantile(0.5 + confidence / 2, len(logs) - 1) * math.sqrt(variance / len(logs))
    return Ratio(math.exp(mean), math.exp(mean - half), math.exp(mean + half), len(logs))


def median(values):
    ordered = sorted(values)
    middle = len(ordered) // 2
    return ordered[middle] if len(ordered) % 2 else (ordered[middle - 1] + ordered[middle]) / 2


def mean_and_variance(values):
    """The mean, and the variance of that mean."""
    mean = sum(values) / len(values)
    return mean, sum((each - mean) ** 2 for each in values) / (len(values) - 1) / len(values)


def t_tail(t, freedom):
    """The probability of a value above t >= 0: the integral of the density over x = t + tan(a), by Simpson's rule."""
    log_scale = (math.lgamma((freedom + 1) / 2) - math.lgamma(freedom / 2) - 0.5 * math.log(freedom * math.pi))

    def integrand(angle):
        x = t + math.tan(angle)
        density = math.exp(log_scale - (freedom + 1) / 2 * math.log1p(x * x / freedom))
        return density / math.cos(angle) ** 2
    steps = 600
    end = math.pi / 2 - 1e-9
    width = end / steps
    inner = sum((4 if i % 2 else 2) * integrand(i * width) for i in range(1, steps))
    return width / 3 * (integrand(0) + inner + integrand(end))


@functools.lru_cache
def t_quantile(probability, freedom):
    """For probabilities above one half, by bisection."""
    low, high = 0.0, 1.0
    while t_tail(high, freedom) > 1 - probability:
        high *= 2
    for _ in range(60):
        middle = (low + high) / 2
        low, high = (middle, high) if t_tail(middle, freedom) > 1 - probability else (low, middle)
    return (low + high) / 2


@dataclass(frozen=True)
class Difference:
    """Of two sets of pictures. `largest`: of all means, in standard errors, at `where`. `relative`: that of the
    whole picture, mean of the channels; `resolution`: its standard error in the noisiest channel."""
    largest: float
    where: int
    limit: float
    relative: float
    resolution: float

    @property
    def verdict(self):
        """"same" only if a difference of DETECTED of the whole picture would have been seen."""
        if self.largest > self.limit:
            return "differ"
        return "same" if self.limit * self.resolution <= DETECTED else "inconclusive"


def compare_means(ours, theirs, false_alarm=0.001):
    """`ours`, `theirs`: a list of means (blocks.block_means) for each picture. Welch's t of each mean; the limit
    is that of Bonferroni for all of them together. Standard errors have a floor: a block that is black, or shows
    nothing but an emitter, differs by rounding alone."""
    count = len(ours[0])
    freedom = min(len(ours), len(theirs)) - 1
    limit = t_quantile(1 - false_alarm / (2 * count), freedom)
    largest, where, relative, variance = 0.0, 0, [], 0.0
    for i in range(count):
        mean, own = mean_and_variance([each[i] for each in ours])
        other, their = mean_and_variance([each[i] for each in theirs])
        floor = 1e-5 * max(abs(mean), abs(other)) + 1e-12
        distance = abs(mean - other) / math.sqrt(own + their + floor * floor)
        if distance > largest:
            largest, where = distance, i
        if i < 3 and other > 0:
            relative.append(mean / other - 1)
            variance = max(variance, (own + their) / (other * other))
    return Difference(largest, where, limit, sum(relative) / max(len(relative), 1), math.sqrt(variance))
