"""The runs of the study, from its study.yaml: every knob of every case, their references, and the extremes."""

from slipscale.running.table import grid, run_name


def run_of(config, options):
    """All options of a run."""
    if unknown := options.keys() - config["defaults"].keys():
        raise ValueError(f"unknown option {sorted(unknown)[0]!r} of a run: known are {', '.join(config['defaults'])}")
    return {**config["defaults"], **options}


def reference_of(config, run):
    """The run that one is compared with: the same case, phases and drawing, with the options of `reference`."""
    return {**run, **config["reference"]}


def turned(config, case, knob):
    """The runs of a knob of a case."""
    base = {"case": case, **(config["of_cases"].get(case) or {})}
    return [run_of(config, {**base, **options}) for options in grid(config["knobs"][knob])]


def groups_of(config):
    """Names of runs by (case, knob), the extremes as (their case, `extreme`): pairs of name and options."""
    found = {}
    for case in config["of_cases"]:
        for knob in config["knobs"]:
            if knob not in (config.get("left_out") or {}).get(case, []):
                found[case, knob] = turned(config, case, knob)
    for name, options in (config.get("extremes") or {}).items():
        found[str(options["case"]), name] = [run_of(config, one) for one in grid(options)]
    return found


def runs_of(config):
    """All runs by name, references included; a run that several knobs ask for is there once."""
    found = {}
    for (_, knob), runs in groups_of(config).items():
        for run in runs:
            found[run_name(run)] = run
            if knob in config["knobs"]:
                reference = reference_of(config, run)
                found[run_name(reference)] = reference
    return found


if __name__ == "__main__":
    raise SystemExit("tradeoff.knobs is a library, no command: snakemake --snakefile runs/tradeoff/Snakefile runs the "
                     "study.")
