"""Says in Markdown what the table of the study holds, for the README; run by the Snakefile."""

import numpy as np

from contrast.adapted import BY_MODES, WAYS, before_of, best_level, cases_of, level_of
from contrast.morphologies import COMPOSITE, fold, groups_of, paired, rank_correlation, spread
from slipscale.reports.publish import bullets, failures, folded, publish
from slipscale.running.studies import started_by_snakemake
from slipscale.running.table import markdown, read_csv

GIGA, KILO = 1e-9, 1e-3
RUN = ("young", "diameter", "size", "seed", "model")
ELSE = [way for way in WAYS if way != "time" and way not in BY_MODES]
MODULI = ("C11", "C22", "C12", "C66")


def column(pairs, name, which=0):
    return [pair[which][name] for pair in pairs]


def span(values, form, factor=1):
    return f"{factor * min(values):{form}}–{factor * max(values):{form}}"


def percent(value):
    return f"{100 * value:.1f} %"


def title(key, block):
    diameter, young = key
    return [f"{block / diameter:g}", f"{young:g}"]


def scatter_table(groups, block):
    header = ["block / disc", "inclusions [GPa]", "morphologies", "spread of C11, C22, C12, C66", "amplitude",
              "highest / lowest", "spread", "of the blocks: amplitude", "highest / lowest", "spread",
              "rank correlation"]
    lines = []
    for key, pairs in groups.items():
        own, block_s = column(pairs, "amplitude"), column(pairs, "amplitude", 1)
        lines.append([*title(key, block), len(pairs),
                      ", ".join(percent(spread(column(pairs, name, 1))) for name in MODULI),
                      span(own, ".3f"), f"{fold(own):.1f}", percent(spread(own)), span(block_s, ".3f"),
                      f"{fold(block_s):.1f}", percent(spread(block_s)), f"{rank_correlation(own, block_s):.2f}"])
    return markdown(header, lines)


def behaviour_table(groups, block):
    header = ["block / disc", "inclusions [GPa]", "frequency [kHz]", "of the blocks", "T / N", "of the blocks",
              "never stick", "of the blocks", "power ratio", "of the blocks", "distance of the spectra, median (range)"]
    lines = []
    for key, pairs in groups.items():
        both = [part for name, form, factor in (("frequency", ".0f", KILO), ("friction", ".3f", 1))
                for part in (span(column(pairs, name, k), form, factor) for k in (0, 1))]
        still = [sum("stick" not in regime for regime in column(pairs, "regime", k)) for k in (0, 1)]
        distances = column(pairs, "spectrum_distance", 1)
        lines.append([*title(key, block), *both, *still,
                      *(span(column(pairs, "power_ratio", k), ".3f") for k in (0, 1)),
                      f"{np.median(distances):.2f} ({span(distances, '.2f')})"])
    return markdown(header, lines)


def bounds_table(groups, rows, block):
    """Blocks of both stiffnesses beside the morphologies for which both were run: means of frequencies, distances."""
    softer = {tuple(row[name] for name in COMPOSITE): row for row in rows
              if row["model"] == "homogeneous_subc" and row["status"] == "ok"}
    lines = []
    for key, pairs in groups.items():
        three = [(*pair, softer[of]) for pair in pairs if (of := tuple(pair[0][name] for name in COMPOSITE)) in softer]
        if three:
            stiffness = [GIGA * np.mean(column(three, "C22", k)) for k in (1, 2)]
            frequency = [f"{KILO * np.median(column(three, 'frequency', k)):.0f}" for k in (0, 1, 2)]
            distance = [f"{np.median(column(three, 'spectrum_distance', k)):.2f}" for k in (1, 2)]
            nearer = sum(soft["spectrum_distance"] < stiff["spectrum_distance"] for _, stiff, soft in three)
            lines.append([*title(key, block), len(three), *(f"{value:.1f}" for value in stiffness), *frequency,
                          *distance, nearer])
    return markdown(["block / disc", "inclusions [GPa]", "morphologies", "C22, linear displacement [GPa]",
                     "uniform traction", "median frequency [kHz]", "linear displacement", "uniform traction",
                     "median distance, linear displacement", "uniform traction", "nearer with it"], lines)


def mesh_table(pairs):
    composites = [tuple(own[name] for name in ("young", "diameter", "seed")) for own, _ in pairs]
    lines = []
    for composite in dict.fromkeys(composites):
        same = [pair for pair, of in zip(pairs, composites) if of == composite]
        for own, block in sorted(same, key=lambda pair: -pair[0]["size"]) if len(same) > 1 else []:
            lines.append([f"{composite[0]:g}", f"{composite[1]:g}", composite[2], f"{own['size']:g}",
                          *(f"{row['amplitude']:.3f}, {KILO * row['frequency']:.0f}, {row['friction']:.3f}"
                            for row in (own, block)), f"{block['spectrum_distance']:.2f}"])
    return markdown(["inclusions [GPa]", "discs [mm]", "morphology", "h [mm]", "amplitude, kHz, T / N",
                     "of the block", "distance"], lines)


def said(row):
    """What a level of an adaptation found: its value and the distances."""
    if row is None:
        return "-"
    if row["after_spectrum_distance"] is None:
        return f"no: {row['reason'].split(':')[0]}"
    mark = f" by {row['match']}" if row["match"] else ""
    return f"{row['value']:.3g}{mark}: {row['after_spectrum_distance']:.2f}"


def time_table(cases):
    header = ["inclusions [GPa]", "morphology", "before", "ωT kept", "one frequency", "search", "nearest tried",
              "amplitude, nearest level", "frequency"]
    lines = []
    for name, case in cases.items():
        best = best_level(case, "time")
        off = [f"{100 * best['before_' + what]:+.0f} → {100 * best['after_' + what]:+.0f} %"
               for what in ("amplitude", "frequency")] if best else ["-", "-"]
        lines.append([f"{name[0]:g}", name[3], f"{before_of(case):.2f}",
                      *(said(case.get(("time", level))) for level in ("scaling", "frequency", "search", "nearest")),
                      *off])
    return markdown(header, lines)


def other_table(cases):
    header = ["inclusions [GPa]", "morphology", "before", *(WAYS[way] for way in ELSE)]
    lines = []
    for name, case in cases.items():
        others = {way: (case.get((way, level_of(way))), case.get((way, "nearest"))) for way in ELSE}
        if any(search for search, _ in others.values()):
            lines.append([f"{name[0]:g}", name[3], f"{before_of(case):.2f}",
                          *(f"{said(search)} (nearest {said(nearest)})" if search else "-"
                            for search, nearest in others.values())])
    return markdown(header, lines)


def modes_table(cases):
    """Of the levels of modes: their own misfit, and what that does to the spectrum."""
    lines = []
    for name, case in cases.items():
        for way in BY_MODES:
            if row := case.get((way, "modes")):
                misfit, distance = ([row[f"misfit_{when}"] for when in ("before", "after")],
                                    [row[f"{when}_spectrum_distance"] for when in ("before", "after")])
                lines.append([f"{name[0]:g}", name[3], WAYS[way],
                              *(" → ".join("-" if value is None else f"{value:.2f}" for value in pair)
                                for pair in (misfit, distance)),
                              row["changes"] or "-", "yes" if row["status"] == "ok" else "no"])
    return markdown(["inclusions [GPa]", "morphology", "adapted", "misfit of the growing modes", "distance of the spectrum",
                     "to", "counts as adapted"], lines)


def adapted_lines(cases):
    """How often a way counts as adapted, and what it leaves."""
    for way, words in WAYS.items():
        for level in ("scaling", "frequency", "search") if way == "time" else (level_of(way),):
            rows = [case[way, level] for case in cases.values() if (way, level) in case]
            if not rows:
                continue
            ran = [row for row in rows if row["after_spectrum_distance"] is not None]
            good = [row for row in rows if row["status"] == "ok"]
            changed = (f"; of the {len(ran)} that gave a value the median distance goes from "
                       f"{np.median([row['before_spectrum_distance'] for row in ran]):.2f} to "
                       f"{np.median([row['after_spectrum_distance'] for row in ran]):.2f}") if ran else ""
            yield f"adapting {words}, by {level}: {len(good)} of {len(rows)} adapted{changed}."


def same_frequency_lines(cases, near=0.03):
    """Whether T helps where the frequency is right."""
    for right in (True, False):
        rows = [best for case in cases.values() if (best := best_level(case, "time"))
                and (abs(best["before_frequency"]) < near) == right]
        if rows:
            left = ", ".join(f"{row['before_spectrum_distance']:.2f} to {row['after_spectrum_distance']:.2f}"
                             for row in rows)
            yield (f"frequency {'within' if right else 'off by more than'} {100 * near:g} % before ({len(rows)} of "
                   f"them): the nearest level of T takes the distance from {left}.")


def seen_line(cases):
    seen = [(row["time_seen_heterogeneous"], row["time_seen_homogeneous"]) for case in cases.values()
            if (row := case.get(("time", "frequency"))) and row.get("time_seen_homogeneous")]
    if seen:
        both = [[1e6 * time for time in times if time] for times in zip(*seen)]
        yield ("the law of one frequency, asked for the T of the run whose own motion and power it is given (all have "
               f"the same T): {span(both[0], '.2f')} µs of the composites, {span(both[1], '.2f')} µs of the blocks.")


def run_table(rows):
    header = [*RUN, "amplitude", "frequency [kHz]", "T / N", "stick", "open", "power ratio", "amplitude ratio",
              "regime", "C11, C22, C66 [GPa]", "distance"]
    return markdown(header, [
        [*(row[name] for name in RUN), f"{row['amplitude']:.3f}", f"{KILO * row['frequency']:.0f}",
         f"{row['friction']:.4f}", f"{row['stick']:.3f}", f"{row['open']:.3f}", f"{row['power_ratio']:.3f}",
         f"{row['amplitude_ratio']:.2f}", row["regime"],
         ", ".join(f"{GIGA * row[name]:.2f}" for name in ("C11", "C22", "C66")) if row["C11"] else "",
         f"{row['spectrum_distance']:.2f}" if row["spectrum_distance"] else ""]
        for row in rows if row["model"] != "adapted" and row["status"] == "ok"])


def reasons(rows):
    return bullets([f"{row['young']:g} GPa, morphology {row['seed']}, {row['way']}, {row['level']}: {row['reason']}"
                    for row in rows if row["model"] == "adapted" and row["level"] and row["reason"]])


def report(rows, block):
    pairs = paired(rows)
    groups, cases = groups_of(pairs), cases_of(rows)
    broken = [row for row in rows if row["status"] != "ok" and not row.get("level")]
    lines = [*same_frequency_lines(cases), *adapted_lines(cases), *seen_line(cases), *failures(broken, (*RUN, "way"))]
    return f"""Scatter of the amplitude (standard deviation of T over mean N) over morphologies; spread is the standard
deviation over the mean; the rank correlation is that of morphologies and their own homogenised blocks:

{scatter_table(groups, block)}
{behaviour_table(groups, block)}
Blocks of the stiffness under linear displacement (as everywhere else) and under uniform traction:

{bounds_table(groups, rows, block)}
The mesh:

{mesh_table(pairs)}
Adapting T of the homogenised block to one morphology: the value in s and the distance of the spectrum it leaves
(1 is that of a block at rest), and by how much amplitude and frequency are off, before → after:

{time_table(cases)}
Adapting something else (`density` the frequency by the density in kg/m³, `then T` goes on from there):

{other_table(cases)}
Bringing the growing modes of the block to those of the composite, which `modes` finds in seconds; misfit 0 is the same growth
and frequency of each, 1 or so that none grows or none is near:

{modes_table(cases)}
{bullets(lines)}
{folded("Why adaptations failed", reasons(rows))}
{folded("All runs", run_table(rows))}"""


job = started_by_snakemake(globals())
publish(report(read_csv(job.input.table), 1e3 * float(job.params.block)), job.output[0], job.params.readme,
        [job.input.scatter, job.input.adapted])
