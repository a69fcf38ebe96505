"""The numbers of docs/derivations.md, section 9: variances of combined strategies over a few cells.

heuristics.py compares the tables of the page, and the bound of the balance heuristic with random cases. It prints what is
wrong, and exits with 1 if anything is.
"""

import random
import re
import sys

from source_text import ROOT

PAGE = "docs/derivations.md"
ROUNDING = 1e-9  # relative, of sums of at most 5 x 4 products; some 10^6 times their rounding


def variance(f, p, w):
    """Of one sample per strategy, in units of the square of the integral; f, p[i], w[i] are per cell."""
    total = 0.0
    for p_i, w_i in zip(p, w):
        terms = [(weight * value, density) for weight, value, density in zip(w_i, f, p_i) if weight * value > 0]
        total += sum(term**2 / density for term, density in terms) - sum(term for term, _ in terms) ** 2
    return total / sum(f) ** 2


def heuristic(p, exponent):
    sums = [sum(density**exponent for density in cell) for cell in zip(*p)]
    return [[density**exponent / total for density, total in zip(p_i, sums)] for p_i in p]


def constant(p, shares):
    return [[share] * len(p[0]) for share in shares]


def rows(f, p):
    table = {
        "first strategy alone": constant(p, [1, 0]),
        "balance": heuristic(p, 1),
        "power": heuristic(p, 2),
        "second strategy alone": constant(p, [0, 1]),
        "1/2 each": constant(p, [0.5, 0.5]),
    }
    return "".join(f"| {name} | {variance(f, p, w):.4f} |\n" for name, w in table.items())


def random_shares(draw, n, power=1):
    numbers = [draw.random() ** power + 1e-6 for _ in range(n)]
    return [x / sum(numbers) for x in numbers]


def faults_of_the_bound(rounds):
    draw = random.Random(1)
    faults = []
    for _ in range(rounds):
        strategies, cells = draw.randint(2, 4), draw.randint(2, 5)
        power = draw.choice([1, 8])  # 8: weights and densities close to 0 and 1
        f = random_shares(draw, cells, power)
        p = [random_shares(draw, cells, power) for _ in range(strategies)]
        w = list(zip(*(random_shares(draw, strategies, power) for _ in range(cells))))
        balance, other = heuristic(p, 1), variance(f, p, w)
        bound = other + 1 - 1 / strategies
        if variance(f, p, balance) > bound * (1 + ROUNDING):
            faults.append(f"the bound does not hold for f {f}, p {p}, w {w}")
        for x in range(cells):
            least = sum(b[x] ** 2 / q[x] for b, q in zip(balance, p))
            if sum(v[x] ** 2 / q[x] for v, q in zip(w, p)) < least * (1 - ROUNDING):
                faults.append(f"balance is not the least in cell {x} for p {p}, w {w}")
    return faults


def main():
    page = (ROOT / PAGE).read_text()
    examples = [([1, 0], [[1, 0], [0.1, 0.9]]), ([0.5, 0.5], [[0.6, 0.4], [0.3, 0.7]])]
    faults = faults_of_the_bound(2000)
    faults += [f"no table has\n{rows(f, p)}" for f, p in examples if rows(f, p) not in page]
    if len(re.findall(r"\| weights \| variance \|", page)) != len(examples):
        faults.append("a table of variances is not computed here")
    for fault in faults:
        print(f"{PAGE}: {fault}")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
