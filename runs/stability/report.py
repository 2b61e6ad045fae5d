"""Says in Markdown what the tables of the study hold, for the README; run by the Snakefile."""

from collections import Counter

import numpy as np

from slipscale.reports.publish import bullets, failures, folded, publish
from slipscale.running.studies import started_by_snakemake
from slipscale.running.table import is_true, markdown, read_csv
from stability.predicted import ALIKE, EXPECTED, RIVAL, SEEN_ALIKE, STILL, counted

KILO = 1e-3
OPTIONS = ("model", "seed", "coefficient", "time")


def kilo(value, form=".1f"):
    return "-" if value is None else f"{KILO * value:{form}}"


def micro(value):
    return f"{value * 1e6:g}"


def apart(row, quantity, names):
    return abs(row[f"{quantity}_seen"] / row[f"{quantity}_{names}"] - 1)


def growth_lines(rows):
    seen = [row for row in rows if row["status"] == "ok" and row.get("growth_seen") is not None]
    yield f"(a) {len(rows)} runs of slide, {len(seen)} with a stretch in which their motion is linear"
    if not seen:
        return
    for names, said in (("modes", "in continuous time"), ("scheme", "the scheme's")):
        growth, frequency = ([apart(row, quantity, names) for row in seen] for quantity in ("growth", "frequency"))
        yield (f"growth of the strongest vibration against modes, {said}: {np.median(growth):.1e} apart in the median, "
               f"{max(growth):.1e} at most; frequency {np.median(frequency):.1e}, {max(frequency):.1e}")
    first = sum(row["fastest"] == 1 for row in seen)
    yield f"the strongest vibration is the fastest mode in {first} of {len(seen)}, another one that modes lists in the rest"
    states = sum(row["closed"] == row["closed_seen"] for row in seen)
    yield (f"as many nodes touch as the static solution says in {states} of {len(seen)}; some are open in "
           f"{sum(row['opened'] > 0 for row in seen)}")


def growth_table(rows):
    lines = [[row["model"], row["seed"] if row["model"] != "plain" else "", row["coefficient"], micro(row["time"]),
              f"{row['closed']} of {row['closed'] + row['opened']}", row["growing"], row["fastest"],
              *(f"{kilo(row[f'growth_{name}'], '.4f')}" for name in ("seen", "scheme", "modes")),
              *(f"{kilo(row[f'frequency_{name}'], '.3f')}" for name in ("seen", "scheme", "modes"))]
             for row in rows if row["status"] == "ok" and row.get("growth_seen") is not None]
    return markdown(["body", "seed", "coefficient", "T [µs]", "closed", "grow", "rank", "growth seen [1/ms]", "scheme",
                     "modes", "frequency seen [kHz]", "scheme", "modes"], lines)


def map_lines(rows):
    known = [row for row in rows if row["status"] == "ok"]
    yield f"(b) {len(known)} points of the sweep"
    pairs = counted((bool(row["growing"]), row["amplitude"] > STILL) for row in known)
    yield (f"a mode grows and it vibrates: {pairs[True, True]}; neither: {pairs[False, False]}; a mode grows but nothing "
           f"vibrates: {pairs[True, False]}; it vibrates though no mode grows: {pairs[False, True]}")
    quiet = [row for row in known if row["growing"] and row["amplitude"] <= STILL]
    if quiet:
        slow = max(row["growth"] for row in quiet)
        yield f"where a mode grows but nothing vibrates it grows by {slow / 1e3:.2f}/ms at most"
    squeals = [row for row in known if row["growing"] and row["amplitude"] > STILL]
    takes = Counter("fastest" if row["takes"] == 1 else "other" if row["takes"] > 1 else
                    "multiple" if row["takes"] < 0 else "none" for row in squeals)
    if squeals:
        yield (f"of {len(squeals)} squeals the limit cycle has the frequency, within a twentieth, of the fastest mode in "
               f"{takes['fastest']}, of another one that grows in {takes['other']}, of a multiple of one in "
               f"{takes['multiple']}, of none in {takes['none']}")
    for name, chosen in ((f"without a rival of {RIVAL:g} of its growth", lambda row: row["rival"] < RIVAL),
                         ("with one", lambda row: row["rival"] >= RIVAL)):
        own = [row for row in squeals if chosen(row)]
        if own:
            yield (f"the fastest mode, where it is {name}, is taken in {sum(row['takes'] == 1 for row in own)} of "
                   f"{len(own)}")
    settled = [row for row in squeals if is_true(row["settled"])]
    if settled:
        yield f"of the {len(settled)} that had settled in {sum(row['takes'] == 1 for row in settled)}"


def map_table(rows):
    lines = [[row["coefficient"], micro(row["time"]), f"{row['size'] * 1e3:g}", row["growing"],
              kilo(row["growth"] if row["growth"] is not None else row["least_damped"]), kilo(row["fastest"], ".0f"),
              "-" if row["rival"] is None else f"{row['rival']:.2f}", row["regime"], kilo(row["frequency"], ".0f"),
              f"{row['amplitude']:.3g}", "-" if row["takes"] is None or row["amplitude"] <= STILL else row["takes"]]
             for row in rows if row["status"] == "ok"]
    return markdown(["coefficient", "T [µs]", "h [mm]", "grow", "growth [1/ms]", "frequency [kHz]", "rival", "seen",
                     "frequency seen", "amplitude", "takes"], lines)


def judged_lines(rows):
    known = [row for row in rows if row["status"] == "ok"]
    pairs = counted((row["expected"] in ALIKE, row["verdict"] in SEEN_ALIKE) for row in known)
    right = pairs[True, True] + pairs[False, False]
    yield (f"(c) {len(known)} points of the study of equivalence: alike as expected {pairs[True, True]}, apart as expected "
           f"{pairs[False, False]}, expected alike but apart {pairs[True, False]}, expected apart but alike "
           f"{pairs[False, True]}: {right} of {len(known)} are right")
    if known:
        usual = max(sum(row["verdict"] in SEEN_ALIKE for row in known), sum(row["verdict"] not in SEEN_ALIKE for row in known))
        yield f"who says the more frequent of the two everywhere is right at {usual}"
    for name in EXPECTED:
        own = Counter(row["verdict"] for row in known if row["expected"] == name)
        if own:
            yield f"expected {name}: seen " + ", ".join(f"{verdict} {count}" for verdict, count in own.most_common())
    groups = {(row["block"], row["coefficient"], row["time"]) for row in known}
    torn = sum(len({row["verdict"] in SEEN_ALIKE for row in known
                    if (row["block"], row["coefficient"], row["time"]) == group}) > 1 for group in groups)
    yield (f"modes do not know the load: of {len(groups)} sets of block, coefficient and T {torn} have points of both "
           "kinds, which no such rule can tell apart")


def judged_table(rows):
    lines = [[row["coefficient"], row["load"], row["speed"], row["memory"], row["block"], row["verdict"], row["expected"],
              row["composite_modes"], row["homogenised_modes"]] for row in rows if row["status"] == "ok"]
    return markdown(["coefficient", "load", "speed", "memory", "block", "seen", "expected",
                     "modes that grow: composites [kHz (1/ms)]", "homogenised"], lines)


def pair_lines(rows):
    rows = [row for row in rows if row.get("frequency") is not None]
    partners = [row for row in rows if row["frequency_homogenised"] is not None]
    yield f"{len(rows)} modes of composites grow; {len(partners)} have a partner of like shape in the homogenised block"
    if partners:
        frequency = [row["frequency_homogenised"] / row["frequency"] - 1 for row in partners]
        both = [row for row in partners if row["growth_homogenised"] > 0]
        ratio = [row["growth_homogenised"] / row["growth"] for row in both]
        yield (f"their frequencies are {100 * np.median(frequency):+.1f} % from the composite's in the median, "
               f"{100 * min(frequency):+.1f} to {100 * max(frequency):+.1f} %")
        if both:
            yield (f"{len(both)} partners grow, {np.median(ratio):.2f} times as fast in the median, {min(ratio):.2f} to "
                   f"{max(ratio):.2f}; {len(partners) - len(both)} do not")


def pair_table(rows):
    lines = [[row["block"], row["seed"], row["coefficient"], micro(row["time"]), kilo(row["frequency"]), kilo(row["growth"]),
              f"{row['likeness']:.2f}", kilo(row["frequency_homogenised"]), kilo(row["growth_homogenised"])]
             for row in rows if row.get("frequency") is not None]
    return markdown(["block", "seed", "coefficient", "T [µs]", "frequency [kHz]", "growth [1/ms]", "likeness",
                     "homogenised: frequency", "growth"], lines)


job = started_by_snakemake(globals())
growth, swept, judged, pairs = (read_csv(job.input[name]) for name in ("growth", "swept", "judged", "pairs"))
text = f"""{bullets([*growth_lines(growth), *failures(growth, OPTIONS)])}
{bullets([*map_lines(swept), *failures(swept, ("coefficient", "time", "size"))])}
{bullets([*judged_lines(judged), *pair_lines(pairs), *failures(judged, ("coefficient", "load", "memory", "block"))])}
{folded("Growth and frequency, seen and predicted", growth_table(growth))}
{folded("All points of the sweep", map_table(swept))}
{folded("All points of the study of equivalence", judged_table(judged))}
{folded("Modes of composites that grow, and their partners in the homogenised block", pair_table(pairs))}"""
publish(text, job.output[0], job.params.readme, job.input.pictures)
