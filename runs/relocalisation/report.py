"""Says in Markdown what the table of the study holds, for the README; run by the Snakefile."""

from slipscale.reports.publish import bullets, failures, folded, publish
from slipscale.running.studies import started_by_snakemake
from slipscale.running.table import markdown, read_csv

OPTIONS = ("case", "seed", "macro", "tensors", "recovery", "strip")
PARTS = ("all", "layer", "bulk", "matrix", "inclusion")
MEASURES = {"error": "single times", "error_mean": "time mean", "error_deviation": "standard deviation"}
MEGA = 1e-6


class Study:
    """What the table holds: runs (tuples of OPTIONS) in its order, `row` of each, and the rows of failed ones."""

    def __init__(self, rows):
        self.rows = rows
        self.failures = [row for row in rows if row["status"] != "ok"]
        self.row, self._found = {}, {}
        for row in rows:
            if row["status"] == "ok":
                run = tuple(row[name] for name in OPTIONS)
                self.row.setdefault(run, row)
                if row["time"] is None:
                    self._found[run, row["measure"], row["part"], row["component"]] = row
        self.runs = list(self.row)
        self.cases = list(dict.fromkeys(run[0] for run in self.runs))

    def found(self, run, part, component="yy", measure="error"):
        """The row where this was compared, or None."""
        return self._found.get((run, measure, part, component))

    def change(self, *what, **more):
        """Without and with relocalisation."""
        row = self.found(*what, **more)
        return f"{in_digits(row['homogeneous'])} → {in_digits(row['relocalised'])}" if row else "-"

    def relocalised(self, *what, **more):
        row = self.found(*what, **more)
        return in_digits(row["relocalised"]) if row else "-"

    def best_known(self, case):
        """First morphology and finest homogeneous mesh with the tensors of the whole block, uncorrected; or None."""
        return max((run for run in self.runs if run[:1] + run[3:] == (case, "kubc", "nodal", 0)), default=None,
                   key=lambda run: (-run[1], run[2]))

    def varied(self, run, name):
        """The runs that differ from `run` in one option at most."""
        others = [k for k, option in enumerate(OPTIONS) if option != name]
        return [] if run is None else [found for found in self.runs if all(found[k] == run[k] for k in others)]

    def measures(self, run):
        return [measure for measure in MEASURES if self.found(run, "all", measure=measure)]


def in_digits(error):
    return f"{error:.4f}" if error < 0.02 else f"{error:.3f}"


def cost_of(row):
    """Of homogeneous run and relocalisation together over the heterogeneous run."""
    return (row["homogeneous_seconds"] + row["relocalize_seconds"]) / row["heterogeneous_seconds"]


def case_table(study):
    lines = []
    for run in map(study.best_known, study.cases):
        for measure in study.measures(run):
            lines.append([run[0], MEASURES[measure], *(study.change(run, part, measure=measure) for part in PARTS)])
    return markdown(["case", "σ_yy", "all", "layer at the contact", "bulk", "matrix", "inclusions"], lines)


def both_scales(row, name, unit, form):
    values = [row[f"{scale}_{name}"] for scale in ("heterogeneous", "homogeneous")]
    return ", ".join(f"{unit * value:{form}}" if value is not None else "-" for value in values)


def morphology_table(study):
    """Where there are several."""
    lines = []
    for best in map(study.best_known, study.cases):
        runs = study.varied(best, "seed")
        for run in runs if len(runs) > 1 else []:
            row = study.row[run]
            lines.append([run[0], run[1], both_scales(row, "frequency", 1e-3, ".0f"),
                          both_scales(row, "deviation", MEGA, ".3g"), study.change(run, "all"),
                          *(study.change(run, part, measure=measure) for measure in ("error_mean", "error_deviation")
                            for part in ("all", "bulk"))])
    return markdown(["case", "seed", "frequency [kHz]", "deviation [MPa]", "σ_yy, single times, all", "time mean, all",
                     "bulk", "standard deviation, all", "bulk"], lines)


def correction_table(study):
    lines = []
    for best in map(study.best_known, study.cases):
        for run in sorted(study.varied(best, "strip"), key=lambda run: run[5]):
            lines.append([run[0], f"{1e3 * run[5]:g} mm" if run[5] else "none",
                          *(study.change(run, "layer", component) for component in ("yy", "xx", "xy")),
                          study.change(run, "layer", measure="error_mean"), study.change(run, "all")])
    return markdown(["case", "strip", "layer σ_yy", "σ_xx", "σ_xy", "σ_yy, time mean", "all σ_yy"], lines)


def mesh_table(study):
    lines = []
    for best in map(study.best_known, study.cases):
        for run in sorted(study.varied(best, "macro"), key=lambda run: -run[2]):
            row = study.row[run]
            lines.append([run[0], run[2], *(study.relocalised(run, part) for part in PARTS[:3]),
                          study.relocalised(run, "all", measure="error_deviation"),
                          *(f"{row[f'{name}_seconds']:.2f}" for name in ("heterogeneous", "homogeneous", "relocalize")),
                          f"{cost_of(row):.2f}"])
    return markdown(["case", "elements over the height", "σ_yy all", "layer", "bulk", "all, standard deviation",
                     "heterogeneous [s]", "homogeneous [s]", "relocalize [s]", "ratio"], lines)


def probe_table(study):
    lines = []
    for run in map(study.best_known, study.cases):
        parts = dict.fromkeys(row["part"] for row in study.rows if row["measure"] == "probe_error")
        for part in (part for part in parts if study.found(run, part, measure="probe_error")):
            lines.append([run[0], part, *(study.change(run, part, measure=f"probe_{kind}")
                                          for kind in ("error", "correlation", "slope"))])
    return markdown(["case", "σ_yy over time in", "relative L2 error", "correlation", "slope"], lines)


def phase_table(study):
    """σ_yy of a composite that is the same, and of another draw of it that was tiled."""
    lines = []
    best = study.best_known("stable")
    tiled = [run for run in study.runs if run[3] == "periodic"]
    for run in [best, *tiled] if best else []:
        for measure in ("average", "quantile_0.01", "quantile_0.99"):
            for phase in ("matrix", "inclusion"):
                row = study.found(run, phase, measure=measure)
                lines.append([run[0], run[3], phase, measure.replace("_", " "), *(
                    f"{MEGA * row[source]:.2f}" for source in ("reference", "relocalised", "homogeneous"))])
    return markdown(["case", "tensors", "phase", "σ_yy [MPa]", "heterogeneous", "relocalised", "homogeneous"], lines)


def choice_lines(study):
    run = study.best_known("stable")
    for name in ("recovery", "tensors"):
        runs = [found for found in study.varied(run, name) if study.found(found, "all")]
        if len(runs) > 1:
            said = [f"{found[OPTIONS.index(name)]} {', '.join(study.relocalised(found, part) for part in PARTS[:3])}"
                    for found in runs]
            yield f"Stable, {name}, relocalised σ_yy in {', '.join(PARTS[:3])}: {'; '.join(said)}."


def time_lines(study):
    """How the error at single times changes."""
    for run in map(study.best_known, study.cases):
        rows = [row for row in study.rows if row["measure"] == "frame_error" and row["component"] == "yy"
                and tuple(row[name] for name in OPTIONS) == run]
        if rows:
            shown = [rows[0], rows[len(rows) // 2], rows[-1]]
            said = [f"{1e6 * row['time']:.4g} µs {in_digits(row['homogeneous'])} → {in_digits(row['relocalised'])}"
                    for row in shown]
            errors = [row["relocalised"] for row in rows]
            yield (f"{run[0].capitalize()}, σ_yy all, at {'; '.join(said)}; of {len(rows)} times relocalised between "
                   f"{in_digits(min(errors))} and {in_digits(max(errors))}.")


def interface_table(study):
    """Tractions along the interfaces, and what debonds; the first morphology, finest homogeneous mesh, all strips."""
    lines = []
    for best in map(study.best_known, study.cases):
        for run in sorted(study.varied(best, "strip"), key=lambda run: run[5]):
            if study.found(run, "all", "normal", "interface_error"):
                lines.append([run[0], f"{1e3 * run[5]:g} mm" if run[5] else "none",
                              *(study.change(run, part, component, "interface_error")
                                for part in ("all", "layer", "bulk") for component in ("normal", "shear"))])
    return markdown(["case", "strip", "normal, all", "shear, all", "normal, layer", "shear, layer", "normal, bulk",
                     "shear, bulk"], lines)


def debonding_table(study):
    """Which inclusion is the first to have a debonding index of 1, where and when, by the three."""
    lines = []
    for best in map(study.best_known, study.cases):
        for run in [*study.varied(best, "strip"), *(other for other in study.varied(best, "seed") if other != best)]:
            if not study.found(run, "all", "index", "interface_index"):
                continue
            value = {name: study.found(run, "all", "index", name) or {} for name in (
                "interface_index", "debonded", "first_inclusion", "first_time", "first_x", "first_y", "same_inclusion")}
            for source in ("reference", "relocalised", "homogeneous"):
                if value["first_inclusion"].get(source) is None:
                    where = "none"
                else:
                    where = (f"{value['first_inclusion'][source]:.0f} at {1e3 * value['first_x'][source]:.2f}, "
                             f"{1e3 * value['first_y'][source]:.2f} mm, {1e6 * value['first_time'][source]:.4g} µs")
                same = value["same_inclusion"].get(source)
                lines.append([run[0], run[1], f"{1e3 * run[5]:g} mm" if run[5] else "none",
                              {"reference": "heterogeneous"}.get(source, source), where,
                              f"{value['interface_index'][source]:.3g}", f"{value['debonded'][source]:.0f}",
                              "-" if same is None else f"{same:.2f}"])
    return markdown(["case", "seed", "strip", "stress", "first inclusion", "largest index", "inclusions that reach 1",
                     "of those of the heterogeneous run"], lines)


def run_table(study):
    runs = [run for run in study.runs if study.found(run, "all")]
    header = [*OPTIONS, *(f"σ_yy {part}" for part in PARTS), "σ_xx layer", "time mean", "standard deviation", "ratio"]
    return markdown(header, [
        [*run, *(study.change(run, part) for part in PARTS), study.change(run, "layer", "xx"),
         study.change(run, "all", measure="error_mean"), study.change(run, "all", measure="error_deviation"),
         f"{cost_of(study.row[run]):.2f}"] for run in runs])


def report(rows):
    study = Study(rows)
    lines = [*time_lines(study), *choice_lines(study), *failures(study.failures, OPTIONS)]
    return f"""Relative L2 error of σ_yy against the heterogeneous run, homogeneous → relocalised, finest homogeneous
mesh:

{case_table(study)}
{bullets(lines)}
Other morphologies of the same composite; strongest frequency of friction, and standard deviation of σ_yy over time
(root mean square over the block), of the heterogeneous and the homogeneous run:

{morphology_table(study)}
Local σ_yy over time at points (when sliding is stable it hardly changes, and correlation and slope mean little):

{probe_table(study)}
Equilibrium restored in a strip next to the contact, errors over single times:

{correction_table(study)}
Tractions along the interfaces of the inclusions, relative L2 errors over single times, homogeneous → relocalised
(homogeneous: the homogeneous stress on the outline of the inclusion):

{interface_table(study)}
Debonding, (⟨σ_n⟩/σ_c)² + (τ/τ_c)² = 1 with the strengths of `study.yaml`, at the frames' times:

{debonding_table(study)}
Coarser homogeneous meshes (relocalised errors) and the price, in seconds that one core computed; the ratio is that of
homogeneous run and `relocalize`, its comparison included, to the heterogeneous run:

{mesh_table(study)}
Averages and quantiles by area (last time) of the phases; `periodic` is a cell of another draw, tiled:

{phase_table(study)}
{folded("All runs", run_table(study))}"""


job = started_by_snakemake(globals())
publish(report(read_csv(job.input.table)), job.output[0], job.params.readme, job.params.shown,
        others=job.input.pictures)
