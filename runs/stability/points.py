"""The points of other studies at which modes are found, as options of this one."""

from slipscale.running.table import run_name
from stability import outcomes


def allowed(row, config, **names):
    """Whether a row has one of the values that study.yaml may name, all if it names none."""
    return all(name not in config or row[column] in [type(row[column])(value) for value in config[name]]
               for name, column in names.items())


def swept(config, defaults, find):
    """Rows of the study `sweep`, each with the `options` of its modes. Raises Mistake."""
    rows = outcomes.swept(find(config["seen"]))
    if "sizes" in config:  # on coarser meshes, for trials: what was seen on the coarsest
        coarsest = max(row["size"] for row in rows)
        rows = [{**row, "size": float(size)} for size in config["sizes"] for row in rows if row["size"] == coarsest]
    rows = [row for row in rows if allowed(row, config, coefficients="coefficient", speeds="speed", only="size")]
    for row in rows:
        time = float(config["length"]) / float(row["speed"])
        row["options"] = {**defaults, "model": "plain", "size": row["size"], "coefficient": row["coefficient"],
                          "time": float(f"{time:.9g}")}
    return rows


def judged(config, defaults, find):
    """Rows of the study `equivalence`, each with lists of options, `composites` and `homogenised`. Raises Mistake."""
    rows = [row for row in outcomes.verdicts(find(config["seen"]))
            if config["seeds"].get(row["block"]) and allowed(row, config, coefficients="coefficient", memory="memory")]
    for row in rows:
        memory = config["memories"][row["memory"]]
        time = float(memory["time"] if "time" in memory else float(memory["length"]) / float(row["speed"]))
        point = {**defaults, "block": row["block"], "coefficient": row["coefficient"], "time": float(f"{time:.9g}")}
        row["composites"] = [{**point, "model": "composite", "seed": seed} for seed in config["seeds"][row["block"]]]
        row["homogenised"] = [{**point, "model": "homogenised", "seed": seed} for seed in config["blocks"]]
    return rows


def options_of(rows):
    for row in rows:
        yield from [row["options"]] if "options" in row else [*row["composites"], *row["homogenised"]]


def named(rows):
    """The options of all rows by their names."""
    return {run_name(options): options for options in options_of(rows)}


if __name__ == "__main__":
    raise SystemExit("stability.points is a library, no command: snakemake --snakefile runs/stability/Snakefile runs the "
                     "study.")
