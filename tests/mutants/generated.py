"""The generated mutants (generate.py) as the runner takes them."""

import generate
import judged
from mutant import Mutant


def mutants(names=(), sample=None, seed=None):
    """Those with these names, in this order, or a sample. Raises KeyError for an unknown name, ValueError for a sample that is
    larger than what there is."""
    found = generate.candidates()
    every = [candidate for folder in found.values() for candidate in folder]
    if names:
        known = {candidate.name: candidate for candidate in every}
        taken = [known[name] for name in names]
    else:
        size = generate.SAMPLE if sample is None else sample
        if not 1 <= size <= len(every):
            raise ValueError(f"--sample {size}: there are {len(every)} generated mutants")
        taken = generate.sample(found, size, generate.SEED if seed is None else seed)
    reasons = judged.equivalent()
    return [Mutant(c.name, c.title, c.diff, tuple(c.programs), equivalent=reasons.get(c.name, "")) for c in taken]
