"""The options of a program as its -help lists them, and values drawn from their ranges."""

import re
from dataclasses import dataclass

OPTION = re.compile(r"^  -(\S+)  (.+?)(?:; (required|no default|default .*))?$", re.MULTILINE)
BOUND = re.compile(r"(>=|>|<=|<|in \[|\|x\| <) ?([-\d.e+]+)(?:, ([-\d.e+]+)\])?")
LEAST_STEP = 1e-3  # of an open range, from its ends


@dataclass
class Option:
    """`kind`: words, number, whole, numbers or text; `words` that may stand for or beside a number; the range."""

    name: str
    kind: str
    words: tuple
    least: float
    most: float
    closed: tuple  # whether `least` and `most` themselves may be taken

    def is_bounded(self):
        return self.least > -1e90 and self.most < 1e90

    def inside(self, value):
        return (self.least <= value if self.closed[0] else self.least < value) and (
            value <= self.most if self.closed[1] else value < self.most)

    def word(self, chance):
        return chance.choice(self.words)

    def number(self, chance, scale=None):
        """Of the range: now and then an end of it, else evenly where it has two ends and no `scale` is given, else
        within a decade of `scale`, of either sign where the range has both."""
        ends = [end for end, closed in zip((self.least, self.most), self.closed) if closed and abs(end) < 1e90]
        if ends and chance.random() < 0.1:
            return chance.choice(ends)
        if scale is None:
            assert self.is_bounded(), f"-{self.name}: draw it about a scale"
            margin = LEAST_STEP * (self.most - self.least)
            return rounded(chance.uniform(self.least + margin, self.most - margin))
        sign = chance.choice((-1, 1)) if self.least < 0 else 1
        value = rounded(sign * scale * 10 ** chance.uniform(-0.5, 0.5))
        assert self.inside(value), f"-{self.name} {value}"
        return value


def rounded(value):
    """With so few digits that a scene is easy to read."""
    return float(f"{value:.4g}")


def option_of(name, said):
    """From the words between the name and the default, as 'a number > -1 and < 0.5 (ratio)'."""
    least, most, closed = -1e100, 1e100, [False, False]
    for how, value, second in BOUND.findall(said):
        if how == "in [":
            least, most, closed = float(value), float(second), [True, True]
        elif how == "|x| <":
            least, most = -float(value), float(value)
        elif how[0] == ">":
            least, closed[0] = float(value), how == ">="
        else:
            most, closed[1] = float(value), how == "<="
    kind = ("numbers" if said.startswith("numbers") else "whole" if "whole number" in said
            else "number" if "a number" in said else "text" if said.startswith(("a text", "anything")) else "words")
    choices = re.split(r", | or ", re.sub(r"(, | or )?(a|a whole) number.*", "", said))
    words = tuple(word for word in choices if re.fullmatch(r"\w+", word)) if kind in ("words", "number", "whole") else ()
    return Option(name, kind, words, least, most, tuple(closed))


def read(manual):
    """{name: Option} of what -help says; <region>, <boundary> and <entry> stand in names as they do there."""
    found = {name: option_of(name, said) for name, said, _ in OPTION.findall(manual)}
    assert len(found) == len(re.findall(r"^  -\w", manual, re.MULTILINE)), "-help is not understood"
    return found
