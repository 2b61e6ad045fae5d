"""Options as words of a command line."""


def word(value):
    """A value as the programs read it: lists with commas, yes and no as true and false."""
    if isinstance(value, (list, tuple)):
        return ",".join(map(word, value))
    return str(value).lower() if isinstance(value, bool) else str(value)


def words(options):
    """A dict of options as words; what is nested is joined with '_', as in a scene: {time: {end: 1}} is -time_end 1."""
    said = []
    for name, value in options.items():
        if isinstance(value, dict):
            said.append(words({f"{name}_{inner}": deeper for inner, deeper in value.items()}))
        else:
            said.append(f"-{name} {word(value)}")
    return " ".join(filter(None, said))
