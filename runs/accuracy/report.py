"""Says in Markdown what the table of the study holds, for the README; run by the Snakefile."""

from accuracy.work_precision import MEGA, OPTIONS, Study, change, column, meshes_of, power_of
from slipscale.measuring.convergence import observed_order, orders_from_errors, richardson
from slipscale.reports.publish import bullets, failures, folded, publish
from slipscale.running.studies import started_by_snakemake
from slipscale.running.table import markdown, read_csv

GIGA = 1e-9
MODULI = ("C11", "C12", "C66")


def numbers(values, digits):
    return ", ".join(f"{value:{digits}}" for value in values)


def order_lines(study, reference):
    for element in study.elements:
        rows = study.over_size(element)
        h = [1 / size for size in column(rows, "size")]
        if len(h) < 3:
            continue
        orders = [f"{name} {numbers(orders_from_errors(h, column(rows, f'error_{name}')), '.2f')}" for name in MODULI]
        blind = observed_order(h[-3:], column(rows, "C11")[-3:])
        limit = richardson(h, column(rows, "C11"), order=2)
        yield (f"{meshes_of(element)}: order between successive sizes {'; '.join(orders)}. From the three finest C11 alone, "
               f"without the reference, {blind:.2f}; their Richardson limit for order 2 is "
               f"{GIGA * limit.limit:.6f} GPa, {limit.limit / float(reference['C11']) - 1:.1e} from the reference, "
               f"and its error bar {abs(limit.error) / limit.limit:.1e} where the error is "
               f"{abs(rows[-1]['error_C11']):.1e}.")


def cost_lines(study):
    for element in study.elements:
        rows = study.iterative(element)
        if time := power_of(rows, "seconds"):
            solver = [row["set_up_seconds"] + row["solve_seconds"] for row in rows]
            memory = power_of(rows, "memory", study.least_memory())
            yield (f"{meshes_of(element)}, multigrid, {rows[0]['unknowns']} to {rows[-1]['unknowns']} unknowns: time grows like "
                   f"the size to the power {time.exponent:.2f}, memory above the program's own "
                   f"{MEGA * study.least_memory():.0f} MB to the power {memory.exponent:.2f}. Iterations "
                   f"{numbers(column(rows, 'iterations'), 'd')}. At the finest, set-up and three solves take "
                   f"{solver[-1]:.2f} s of {rows[-1]['seconds']:.2f} s; the rest reads the mesh and writes the files.")
        direct = study.over_size(element, "direct")
        if rows and direct and direct[-1]["size"] == rows[-1]["size"]:
            yield (f"{meshes_of(element)}, factorisation at {direct[-1]['unknowns']} unknowns: {direct[-1]['seconds']:.2f} s and "
                   f"{MEGA * direct[-1]['memory']:.0f} MB, multigrid {rows[-1]['seconds']:.2f} s and "
                   f"{MEGA * rows[-1]['memory']:.0f} MB.")


def tolerance_lines(study):
    rows = study.over_tolerance()
    if len(rows) > 1:
        found = [f"{row['rtol']:.0e}: {change(row, rows[-1]):.0e} in {row['seconds']:.2f} s" for row in rows[:-1]]
        yield (f"Solver tolerance at {rows[-1]['size']} across, largest change of a modulus against "
               f"{rows[-1]['rtol']:.0e} ({rows[-1]['seconds']:.2f} s): {'; '.join(found)}. "
               f"The error of C11 from the mesh is {abs(rows[-1]['error_C11']):.1e}.")


def orientation_lines(study, orientation):
    for known in orientation:
        good = [row for row in study.rows
                if row["rtol"] == study.tightest and abs(row["error_C11"]) <= known["error"][-1]]
        if good:
            row = min(good, key=lambda row: row["seconds"])
            yield (f"{known['name']}: {known['seconds'][-1]:g} s for an error of {known['error'][-1]:g}. Here "
                   f"{row['seconds']:.2g} s for {abs(row['error_C11']):.1e} ({meshes_of(row['element'])}, {row['size']} across, "
                   f"{row['method']}).")


def table(study):
    header = ["element", "across", "solver", "tolerance", "unknowns", "iterations", "set-up [s]", "solves [s]",
              "in all [s]", "memory [MB]", "C11, C12, C66 [GPa]", "relative errors"]
    return markdown(header, [
        [row["element"], row["size"], f"{row['solver']} ({row['method']})", f"{row['rtol']:.0e}", row["unknowns"],
         row["iterations"], f"{row['set_up_seconds']:.3f}", f"{row['solve_seconds']:.3f}", f"{row['seconds']:.3f}",
         f"{MEGA * row['memory']:.0f}", numbers([GIGA * row[name] for name in MODULI], ".6f"),
         numbers([row[f"error_{name}"] for name in MODULI], ".1e")]
        for row in sorted(study.rows, key=lambda row: (row["element"], row["solver"], row["size"], -row["rtol"]))])


def report(rows, reference, orientation):
    study = Study(rows)
    lines = [*order_lines(study, reference), *cost_lines(study), *tolerance_lines(study),
             *orientation_lines(study, orientation), *failures(rows, OPTIONS)]
    return f"{bullets(lines)}\n{folded('All runs', table(study))}"


job = started_by_snakemake(globals())
publish(report(read_csv(job.input.table), job.params.reference, job.params.orientation), job.output[0],
        job.params.readme, [job.input.picture])
