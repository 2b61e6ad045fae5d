"""YAML as the programs read it: what it says twice, or what nobody means, is refused instead of guessed.

YAML 1.1 takes 010 for 8, 1:30 for 90, 1_000 for 1000 and 30e9 for a text. Here 30e9 is the number that it is for the
programs, and the others are refused, as are equal keys in one map, of which Python's yaml keeps the last silently.
"""

import re
from pathlib import Path

import yaml

from slipscale.mistakes import Mistake

INT, FLOAT, STR = (f"tag:yaml.org,2002:{name}" for name in ("int", "float", "str"))
MEANT = {INT: r"[-+]?(0|[1-9][0-9]*)", FLOAT: r"[-+]?([0-9]+\.?[0-9]*|\.[0-9]+)([eE][-+]?[0-9]+)?"}
ODD = {INT: "a number in base 2, 8, 16 or 60, or without its _", FLOAT: "a number in base 60, or none",
       "tag:yaml.org,2002:timestamp": "a date", "tag:yaml.org,2002:value": "a mark of its own"}


class Loader(yaml.SafeLoader):
    yaml_implicit_resolvers = {letter: list(pairs) for letter, pairs in yaml.SafeLoader.yaml_implicit_resolvers.items()}


Loader.add_implicit_resolver(FLOAT, re.compile(r"[-+]?([0-9]+\.?[0-9]*|\.[0-9]+)[eE][-+]?[0-9]+$"),
                             list("-+.0123456789"))


def _place(node):
    return f"near line {node.start_mark.line + 1}"


def _check(node, seen, written):
    """Raises Mistake for what is read otherwise than it is meant, in all of a tree; in a file that a program has
    `written`, for equal keys only."""
    if id(node) in seen:
        return
    seen.add(id(node))
    if isinstance(node, yaml.ScalarNode):
        odd = node.style is None and node.tag in ODD and not written
        if odd and not re.fullmatch(MEANT.get(node.tag, "(?!)"), node.value):
            raise Mistake(f"has {node.value!r} {_place(node)}, which YAML takes for {ODD[node.tag]}; write a decimal "
                          "number, or put it in quotes")
    elif isinstance(node, yaml.SequenceNode):
        for item in node.value:
            _check(item, seen, written)
    else:
        keys = set()
        for key, value in node.value:
            if not isinstance(key, yaml.ScalarNode):
                raise Mistake(f"has a key {_place(key)} that is no word; write `name: value`")
            if key.tag == "tag:yaml.org,2002:merge":
                _check(value, seen, written)
                continue
            if key.tag not in (STR, INT, FLOAT) and not written:
                raise Mistake(f"has a key, {key.value!r}, {_place(key)} that YAML does not take for a word; put it in "
                              "quotes")
            _check(key, seen, written)
            if key.value in keys:
                raise Mistake(f"gives {key.value!r} twice, again {_place(key)}; put what belongs to it under one key")
            keys.add(key.value)
            _check(value, seen, written)


def parse(text, name, written=False):
    """What a text in YAML says, `name` being the file's in messages; `written` by a program, so that a date or .nan is
    what it is. Raises Mistake."""
    loader = None
    try:
        loader = Loader(text)
        node = loader.get_single_node()
        if node is None:
            return None
        _check(node, set(), written)
        return loader.construct_document(node)
    except (yaml.YAMLError, ValueError) as error:
        raise Mistake(f"{name} is not valid YAML ({' '.join(str(error).split())})") from error
    except Mistake as mistake:
        raise Mistake(f"{name} {mistake}") from None
    finally:
        if loader:
            loader.dispose()


def load(path, written=False):
    """What a file says, as of `parse`. Raises Mistake, also where there is none."""
    try:
        text = Path(path).read_text(encoding="utf-8")
    except OSError as error:
        raise Mistake(f"{path} cannot be read ({error.strerror})") from error
    except UnicodeDecodeError as error:
        raise Mistake(f"{path} is no text in UTF-8 ({error.reason} at byte {error.start})") from error
    return parse(text, path, written)


def options(path):
    """The options that a file gives to a program, a dict that may be nested. Raises Mistake."""
    found = load(path)
    if not isinstance(found, dict):
        raise Mistake(f"{path} should hold options, as friction: {{coefficient: 0.3}}")
    return found
