"""Command lines of the subcommands: `-h` is the manual, a mistake is one sentence and exit code 2."""

import argparse
import difflib
import re
import sys


class Window(argparse.Action):
    """Two times in s, the earlier first."""

    def __init__(self, option_strings, dest, **how):
        super().__init__(option_strings, dest, nargs=2, type=float, **how)

    def __call__(self, parser, namespace, values, option_string=None):
        from slipscale.measuring.window import backwards

        if wrong := backwards(values):
            raise argparse.ArgumentError(self, wrong)
        setattr(namespace, self.dest, tuple(values))


class Parser(argparse.ArgumentParser):
    """Of the subcommand `name`; `text` is its manual, as a rule the docstring of its module. What a study alone uses is
    started as `python3 -m name`."""

    def __init__(self, name, text, before="slipscale"):
        super().__init__(f"{before} {name}", description=text.strip(), allow_abbrev=False,
                         formatter_class=argparse.RawDescriptionHelpFormatter)

    def parse_args(self, args=None, namespace=None):
        found, unknown = self.parse_known_args(args, namespace)
        if unknown:
            self.error(self._unknown(unknown[0]))
        return found

    def _unknown(self, word):
        if not word.startswith("-"):
            return f"{word!r} is one word too many"
        known = [name for action in self._actions for name in action.option_strings]
        near = difflib.get_close_matches(word.partition("=")[0], known, 1)
        return f"{word} is not an option" + (f"; is {near[0]} meant?" if near else "")

    def error(self, message):
        message = re.sub(r"^argument (\S+): ", r"\1: ", message)
        self.exit(2, f"{self.prog}: {message} ({self.prog} -h says more)\n")


def say(name, error):
    """One sentence on stderr about what stops the subcommand `name`; gives the exit code, 2."""
    print(f"slipscale {name}: {' '.join(str(error).split())}", file=sys.stderr)
    return 2


if __name__ == "__main__":
    raise SystemExit("slipscale.parser is a library, no command: slipscale -h lists the commands.")
