"""Says in Markdown what the table of the study holds, for the README; run by the Snakefile."""

from slipscale.reports.publish import bullets, failures, folded, publish
from slipscale.running.studies import started_by_snakemake
from slipscale.running.table import markdown, read_csv

KIND = ("shape", "period", "seed", "phases", "pair", "regime")
RUN = (*KIND, "model")
MODELS = ("effective", "mean")


def shown(value, form, factor=1):
    return "-" if value is None else f"{factor * value:{form}}"


def cases_of(rows):
    """Runs by what they stand for: {kind: {model: row}}."""
    cases = {}
    for row in rows:
        cases.setdefault(tuple(row[name] for name in KIND), {})[row["model"]] = row
    return {kind: models for kind, models in cases.items() if len(models) == 1 + len(MODELS)}


def what(kind):
    shape, period, seed, phases, *_ = kind
    return f"{shape} of {period:g} mm" if period else f"{shape}, seed {seed}"


def case_table(cases):
    lines = []
    for kind, models in cases.items():
        composite = models["composite"]
        lines.append([what(kind), *kind[3:], f"{composite['friction']:.4f} ± {composite['friction_error']:.4f}",
                      *(f"{models[model]['coefficient']:.4f} ({models[model]['friction_off']:+.4f})" for model in MODELS),
                      composite["regime_seen"], f"{1e-3 * composite['frequency']:.0f}",
                      *(shown(models[model].get("frequency_off"), "+.1f", 100) for model in MODELS),
                      *(shown(models[model].get("spectrum_distance"), ".2f") for model in MODELS)])
    return markdown(["composite", "elasticity", "coefficients", "regime", "T / N", "μ effective (T/N off)", "μ mean (off)",
                     "what it does", "frequency [kHz]", "effective off [%]", "mean off [%]", "spectrum, effective", "mean"], lines)


def nearer_lines(cases):
    """How often each coefficient is the nearer one, by regime."""
    for regime in dict.fromkeys(kind[-1] for kind in cases):
        own = {kind: models for kind, models in cases.items() if kind[-1] == regime}
        off = {model: [abs(models[model]["friction_off"]) for models in own.values()] for model in MODELS}
        wins = sum(one < other for one, other in zip(*off.values()))
        told = sum(abs(models["effective"]["coefficient"] - models["mean"]["coefficient"]) >
                   models["composite"]["friction_error"] + models["effective"]["friction_error"] for models in own.values())
        yield (f"{regime}: friction is off by at most {max(off['effective']):.4f} with the effective coefficient and "
               f"{max(off['mean']):.4f} with the mean; the effective one is nearer in {wins} of {len(own)} cases (in {told} "
               "the two coefficients differ by more than the errors of the averages).")


def run_table(rows):
    return markdown([*RUN, "μ", "T / N", "±", "frequency [kHz]", "amplitude", "stick", "open", "what it does", "nodes"],
                    [[*(row[name] for name in RUN), shown(row["coefficient"], ".4f"), f"{row['friction']:.4f}",
                      f"{row['friction_error']:.4f}", f"{1e-3 * row['frequency']:.1f}", f"{row['amplitude']:.3f}",
                      f"{row['stick']:.3f}", f"{row['open']:.3f}", row["regime_seen"], row["nodes"]] for row in rows])


def report(rows):
    good = [row for row in rows if row["status"] == "ok"]
    cases = cases_of(good)
    return f"""Friction T/N of each composite, with its standard error, and of the homogenised block with either coefficient; in
brackets, and for frequency and spectrum, what that is off by.

{case_table(cases)}
{bullets([*nearer_lines(cases), *failures(rows, RUN)])}
{folded("All runs", run_table(good))}"""


job = started_by_snakemake(globals())
publish(report(read_csv(job.input.table)), job.output[0], job.params.readme, [job.input.picture])
