"""Options as words of a command line."""

import shlex


def word(value):
    """A value as the programs read it: lists with commas, yes and no as true and false."""
    if isinstance(value, (list, tuple)):
        return ",".join(map(word, value))
    return str(value).lower() if isinstance(value, bool) else str(value)


def pairs_of(options):
    """Pairs of name and value, names joined with '_', as in a scene: {time: {end: 1}} is time_end 1."""
    for name, value in options.items():
        if isinstance(value, dict):
            yield from pairs_of({f"{name}_{inner}": deeper for inner, deeper in value.items()})
        else:
            yield name, value


def flat(options):
    """A dict of options without nesting; of a name that is there several times the last."""
    return dict(pairs_of(options))


def words(options):
    """A dict of options, nested or not, as words for a shell."""
    return " ".join(f"-{name} {shlex.quote(word(value))}" for name, value in flat(options).items())


def settings(options):
    """A dict of options as name=value for a shell."""
    return " ".join(shlex.quote(f"{name}={word(value)}") for name, value in options.items())


if __name__ == "__main__":
    raise SystemExit("slipscale.running.commands is a library, no command: slipscale -h lists the commands.")
