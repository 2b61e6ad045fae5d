"""What the modes of steady sliding let expect, and how that compares with what was seen.

All rules are stated here, before the counting: a vibration is expected where a mode grows; the squeal, where the
fastest has no rival; equivalence, where composites and homogenised block have the same fastest mode, of like growth,
and none has a rival.
"""

import numpy as np

NEAR = 0.05  # of a frequency: within it two are the same, as in equivalence.verdict
RIVAL = 0.5  # of the growth rate of the fastest mode: from it on another one competes
LIKE = 0.25  # of a growth rate: within it, beyond the spread of the morphologies, it is alike
STILL = 0.01  # amplitude of friction below which nothing vibrates, as in equivalence.verdict

EQUIVALENT, QUIET, ONE_ONLY, COMPETE, FREQUENCY, GROWTH = EXPECTED = (
    "equivalent", "nothing grows", "only one grows", "modes compete", "frequency differs", "growth differs")
ALIKE = {EQUIVALENT, QUIET}  # composites and block do the same
SEEN_ALIKE = {"equivalent", "nothing vibrates"}


def growing(modes):
    """[(frequency Hz, growth 1/s)] of a list of Mode that grow, fastest first."""
    return sorted(((mode.frequency, mode.growth_rate) for mode in modes if mode.growth_rate > 0), key=lambda each: -each[1])


def rival(grow):
    """The growth of the second over that of the fastest mode of another frequency; 0 without."""
    others = [rate for frequency, rate in grow[1:] if abs(frequency / grow[0][0] - 1) > NEAR]
    return others[0] / grow[0][1] if others else 0.0


def expected(composites, homogenised):
    """One of EXPECTED for lists of `growing`, one for each morphology and each block: the first that applies."""
    bodies = [*composites, *homogenised]
    if not any(bodies):
        return QUIET
    if not all(bodies):
        return ONE_ONLY
    frequencies = [grow[0][0] for grow in composites]
    if np.ptp(frequencies) > 2 * NEAR * np.mean(frequencies) or any(rival(grow) >= RIVAL for grow in bodies):
        return COMPETE
    own, others = np.median([grow[0][0] for grow in homogenised]), np.mean(frequencies)
    if abs(own / others - 1) > NEAR:
        return FREQUENCY
    rates, rate = [grow[0][1] for grow in composites], np.median([grow[0][1] for grow in homogenised])
    if not (1 - LIKE) * min(rates) <= rate <= (1 + LIKE) * max(rates):
        return GROWTH
    return EQUIVALENT


def cycle_takes(frequency, grow, most=4):
    """Which of the growing modes the frequency (Hz) of a limit cycle is: 1 for the fastest, 2 …; 0 for none; a negative
    number -k for a multiple of the k-th."""
    for k, (own, _) in enumerate(grow, 1):
        if abs(frequency / own - 1) <= NEAR:
            return k
    for k, (own, _) in enumerate(grow, 1):
        times = round(frequency / own)
        if 2 <= times <= most and abs(frequency / (times * own) - 1) <= NEAR / times:
            return -k
    return 0


def counted(pairs):
    """{(expected, seen): how often} of pairs of bools."""
    found = {(one, other): 0 for one in (True, False) for other in (True, False)}
    for pair in pairs:
        found[pair] += 1
    return found


if __name__ == "__main__":
    raise SystemExit("stability.predicted is a library, no command: snakemake --snakefile runs/stability/Snakefile runs "
                     "the study.")
