"""Damages scenes, recipes, command lines and pictures, and looks at what the programs make of them.

    fuzz_scenes.py [--seconds 60 | --minutes 500] [--seed 1] [--keep FOLDER] [--only NAME]

Damage is done where the format has a place for it (an option renamed, moved, doubled or given another kind of value, a
number that hurts; a field of a picture's header, a chunk of a PNG with its checksum made good) and anywhere else (lines,
bytes). A program may take it or refuse it with one sentence and exit code 2; it fails when it crashes, takes longer than
`--hang` seconds or more memory than `--memory` MB before its first step, says something else, or takes a picture that is
cut short or whose checksums are wrong. Failing input is kept. The same seed makes the same damage.

`--seed 13 --seconds 900`, on two cores with thirty other processes: 129 tried, 118 refused, 0 failed.

The environment says where the programs are, as for tests/programs: SLIPSCALE_SLIDE and so on.
"""

import argparse
import copy
import os
import random
import re
import shutil
import struct
import sys
import tempfile
import time
import zlib
from dataclasses import dataclass
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "programs"))

from damage import NUMBERS, damage_bytes, damage_lines, watched  # noqa: E402
from scenes import SQUEAL, block  # noqa: E402

PROGRAMS = {name: os.environ["SLIPSCALE_" + name.upper()] for name in ("slide", "homogenize", "morphology")}
# What they say before the work begins, whose length is the user's affair.
READY = {"slide": " steps to ", "morphology": " cells are drawn and meshed"}

SCENE = {**SQUEAL, "time_end": "1.0e-6", "damping": {"stiffness": "2.0e-9"}, "fields": {"times": "[0, 5.0e-7]"},
         "statistics_from": "2.0e-7", "history_momentum": "true", "output": {"folder": "out"}}
SCENE = {name: value for name, value in SCENE.items() if not name.startswith("damping_")}
CELL = {"mesh_file": "torus.msh", "material": {"all": {"young": "30e9", "poisson": ".25", "density": 1800}},
        "cell": {"boundary": "kubc", "estimate_error": "false"}, "mesh": {"refine": 0}, "output_folder": "out"}
BLOCK = {"block": {"width": "1.0e-3", "height": "1.0e-3"}, "size": "1.0e-4", "output_folder": "out"}
DISCS = {**BLOCK, "shape": "disc", "fraction": 0.2, "diameter": "3.0e-4", "diameter_deviation": 0.1, "seed": 3, "gap": "2.0e-5",
         "periodic": "x", "edge": "cut", "size_interface": "8.0e-5", "cell": "triangle"}
FAMILIES = {**BLOCK, "families": {"tow": {"shape": "rectangle", "fraction": 0.1, "diameter": "4.0e-4", "aspect": 2},
                                  "fibre": {"shape": "disc", "fraction": 0.1, "diameter": "2.0e-4"}}}
LAMINATE = {**BLOCK, "shape": "laminate", "fraction": 0.4, "layer_period": "5.0e-4", "angle": 30, "periodic": "x"}
PICTURE = {"shape": "image", "image": {"file": "picture", "levels": "[0.5]", "pixel": "1.0e-5", "median": 1, "despeckle": 3},
           "periodic": "x", "output_folder": "out"}
WORDS = ["true", "no", "on", "~", "''", "auto", "free", "fixed", "rigid", "out", "block.msh", "1,2", "[1, 2]", "[]", "{a: 1}",
         "[[1], 2]", "'5'", "30:00", "2026-01-31", "*a", "&a 1", "!!int 3", "1_000", "0o17", "\u2028", "µ", "-", "-x", "--x=1",
         "a b", "%", "@", "picture", "1e-30", "1e30", "out/../out"]


def text_of(options, level=0):
    """As YAML; keys that are doubled stand one after the other, which is why these are pairs."""
    lines = []
    for name, value in options:
        if isinstance(value, list):
            lines += [f"{'  ' * level}{name}:", *text_of(value, level + 1).split("\n")]
        else:
            lines.append(f"{'  ' * level}{name}: {value}")
    return "\n".join(lines)


def pairs_of(options):
    return [(name, pairs_of(value) if isinstance(value, dict) else value) for name, value in options.items()]


def maps_of(pairs):
    """All maps of a scene, itself first."""
    return [pairs, *(inner for _, value in pairs if isinstance(value, list) for inner in maps_of(value))]


def harmful(chance, old):
    """A value in the place of another: of no kind, of another kind, or near it."""
    kind = chance.random()
    if kind < 0.4:
        return chance.choice(NUMBERS[:-3]).replace("\0", "")
    if kind < 0.7:
        return chance.choice(WORDS)
    try:
        return f"{float(old) * chance.choice((-1, 0.6, 1.7, 1e3, 1e-3)):g}"
    except (TypeError, ValueError):
        return "" if kind < 0.85 else str(old)[:-1]


def damage_options(pairs, chance):
    """One change of a scene's structure, in place. `size` and what it makes are left large enough to end soon."""
    here = chance.choice(maps_of(pairs))
    if not here:
        return
    at = chance.randrange(len(here))
    other = copy.deepcopy(chance.choice(chance.choice(maps_of(pairs)) or pairs))  # or it might come to hold itself
    name, value = here[at]
    kind = chance.randrange(9)
    if kind < 4 and not isinstance(value, list):
        here[at] = (name, harmful(chance, value))
    elif kind == 4:
        del here[at]
    elif kind == 5:
        here.insert(chance.randrange(len(here) + 1), other)
    elif kind == 6:
        place = chance.randrange(len(name))
        here[at] = (name[:place] + chance.choice(("", "x", "_", name[place].upper(), " ", ":")) + name[place + 1:], value)
    elif kind == 7:
        here[at] = (name, [("value", value)] if not isinstance(value, list) else harmful(chance, None))
    else:
        here[at] = (other[0], value)


def damaged_scene(scene, chance, path):
    pairs = pairs_of(scene)
    for _ in range(chance.choice((1, 1, 2, 4))):
        damage_options(pairs, chance)
    data = (text_of(pairs) + "\n").encode()
    if chance.random() < 0.3:
        data = (damage_lines if chance.random() < 0.7 else damage_bytes)(data, chance) or b"\n"
    path.write_bytes(data)


def flat(pairs, before=""):
    for name, value in pairs:
        if isinstance(value, list):
            yield from flat(value, f"{before}{name}_")
        else:
            yield f"-{before}{name}", re.sub(r"[][' ]", "", str(value))


def damaged_line(scene, chance):
    """A command line."""
    pairs = pairs_of(scene)
    for _ in range(chance.choice((0, 1, 2))):
        damage_options(pairs, chance)
    words = [word for pair in flat(pairs) for word in pair]
    for _ in range(chance.choice((1, 1, 3))):
        at, kind = chance.randrange(len(words)), chance.randrange(5)
        if kind == 0:
            del words[at]
        elif kind == 1:
            words.insert(at, chance.choice(words))
        elif kind == 2:
            words[at] = chance.choice((words[at].upper(), "-" + words[at], words[at] + "=1", words[at][:-1], ""))
        else:
            words[at] = harmful(chance, words[at])
        words = words or ["-"]
    return [word.replace("\0", "") for word in words]


def png(columns, rows, bits, colour, lines, extra=()):
    channels = {0: 1, 2: 3, 3: 1, 4: 2, 6: 4}[colour]
    assert all(len(line) == (columns * bits * channels + 7) // 8 for line in lines)
    return [(b"IHDR", struct.pack(">IIBBBBB", columns, rows, bits, colour, 0, 0, 0)), *extra,
            (b"IDAT", zlib.compress(b"".join(b"\0" + line for line in lines))), (b"IEND", b"")]


def file_of(chunks):
    return b"\x89PNG\r\n\x1a\n" + b"".join(
        struct.pack(">I", len(data)) + name + data + struct.pack(">I", zlib.crc32(name + data)) for name, data in chunks)


def pictures():
    """Sound ones: a bright disc on dark ground, as PNG of several kinds and as PGM."""
    n = 24
    grey = [[200 if (i - 12) ** 2 + (k - 12) ** 2 < 50 else 40 for i in range(n)] for k in range(n)]
    palette = (b"PLTE", bytes((0, 0, 0, 255, 255, 255)))
    return {
        "grey8.png": png(n, n, 8, 0, [bytes(line) for line in grey]),
        "grey16.png": png(n, n, 16, 0, [bytes(byte for x in line for byte in (x, 0)) for line in grey]),
        "colour.png": png(n, n, 8, 2, [bytes(byte for x in line for byte in (x, x, x)) for line in grey]),
        "palette.png": png(n, n, 8, 3, [bytes(x > 100 for x in line) for line in grey], (palette,)),
        "raw.pgm": f"P5\n# drawn\n{n} {n}\n255\n".encode() + bytes(x for line in grey for x in line),
        "plain.pgm": ("P2\n%d %d\n255\n" % (n, n) + "\n".join(" ".join(map(str, line)) for line in grey) + "\n").encode(),
    }


def damaged_png(chunks, chance):
    """Returns the bytes and whether they must be refused."""
    chunks = list(chunks)
    kind, at = chance.randrange(7), chance.randrange(len(chunks))
    name, data = chunks[at]
    fatal = False
    if kind == 0:  # the header, with its checksum made good
        header = bytearray(chunks[0][1])
        place = chance.choice((0, 4))
        header[place:place + 4] = struct.pack(">I", chance.choice((0, 1, 23, 25, 30000, 1 << 20, (1 << 31) - 1, 1 << 31)))
        chunks[0] = (b"IHDR", bytes(header))
    elif kind == 1:
        header = bytearray(chunks[0][1])
        header[chance.randrange(8, 13)] = chance.randrange(256)
        chunks[0] = (b"IHDR", bytes(header))
    elif kind == 2:
        del chunks[at]
    elif kind == 3:
        chunks.insert(chance.randrange(len(chunks) + 1), chunks[at])
    elif kind == 4:
        chunks[at] = (chance.choice((name, b"tEXt", b"gAMA", b"PLTE", b"tRNS", b"XXXX")), damage_bytes(data or b"\0", chance))
    whole = file_of(chunks)
    if kind == 5:
        cut = chance.randrange(len(whole) - 12)  # before the mark of the end
        return whole[:cut], True
    if kind == 6:
        place = chance.randrange(8, len(whole) - 12)
        fatal = True  # a checksum stands over each byte
        whole = whole[:place] + bytes([whole[place] ^ 1 << chance.randrange(8)]) + whole[place + 1:]
    return whole, fatal


def damaged_pgm(data, chance):
    kind = chance.randrange(4)
    if kind == 0:
        numbers = list(re.finditer(rb"\d+", data[:30]))[1:4]  # behind the P5
        at = chance.choice(numbers)
        return data[:at.start()] + chance.choice(NUMBERS).encode() + data[at.end():], False
    if kind == 1:
        return data[:chance.randrange(len(data) - 1 - len(data) // 20)], True
    return (damage_lines if kind == 2 and b"P2" in data[:2] else damage_bytes)(data, chance) or b"\n", False


@dataclass
class Target:
    """A program and what it is given."""

    program: str
    scene: dict
    kind: str = "scene"  # or line, or picture


TARGETS = {
    "scene": Target("slide", SCENE), "line": Target("slide", SCENE, "line"),
    "cell": Target("homogenize", CELL), "cell-line": Target("homogenize", CELL, "line"),
    "discs": Target("morphology", DISCS), "families": Target("morphology", FAMILIES), "laminate": Target("morphology", LAMINATE),
    "discs-line": Target("morphology", DISCS, "line"), "picture-scene": Target("morphology", PICTURE),
    "picture": Target("morphology", PICTURE, "picture"), "picture-again": Target("morphology", PICTURE, "picture"),
}


def damaged(target, chance, folder):
    """The arguments, and whether they must be refused."""
    arguments, fatal = ["-options_file_yaml", "scene.yaml"], False
    if target.kind == "line":
        arguments = damaged_line(target.scene, chance)
        (folder / "scene.txt").write_text("\n".join(arguments))
    elif target.kind == "scene":
        damaged_scene(target.scene, chance, folder / "scene.yaml")
    else:
        (folder / "scene.yaml").write_text(text_of(pairs_of(target.scene)) + "\n")
        name, sound = chance.choice(sorted(pictures().items()))
        data, fatal = (damaged_pgm if name.endswith("pgm") else damaged_png)(sound, chance)
        (folder / "picture").write_bytes(data)
    return arguments, fatal


def fault(target, outcome, fatal, limits):
    """What is wrong with the answer; None where nothing is."""
    code, said, err, seconds, memory = outcome
    if seconds > limits.hang:
        return f"{seconds:.1f} s; {said[-200:]}"
    if memory > limits.memory:
        return f"{memory:.0f} MB"
    if code == 2:
        return None if re.fullmatch(rf"{target.program}: [^\n]+\n", err) else f"no sentence: {err[-300:]}"
    if code != 0 or err:
        return f"exit code {code}: {err[-300:]}"
    return "taken without a word" if fatal else None


def check_sound(folder, limits):
    """What is not damaged is taken."""
    for name, target in TARGETS.items():
        (folder / "scene.yaml").write_text(text_of(pairs_of(target.scene)) + "\n")
        for picture, sound in pictures().items() if target.kind == "picture" else [("grey8.png", pictures()["grey8.png"])]:
            (folder / "picture").write_bytes(sound if isinstance(sound, bytes) else file_of(sound))
            arguments = [word for pair in flat(pairs_of(target.scene)) for word in pair] if target.kind == "line" else [
                "-options_file_yaml", "scene.yaml"]
            outcome = watched([PROGRAMS[target.program], *arguments], folder, 60)
            if outcome[0] != 0:
                sys.exit(f"{name}, {picture}: what is not damaged is not taken: {outcome[2]}")


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0])
    parser.add_argument("--seconds", type=float, default=60)
    parser.add_argument("--minutes", type=float)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--keep", type=Path, default=Path("fuzz_scenes_failures"))
    parser.add_argument("--only", choices=sorted(TARGETS))
    parser.add_argument("--hang", type=float, default=10, help="s")
    parser.add_argument("--memory", type=float, default=500, help="MB")
    parser.add_argument("--check", action="store_true", help="only see that what is not damaged is taken")
    limits = parser.parse_args()
    names = [limits.only] if limits.only else list(TARGETS)
    tried, refused, failed = 0, 0, 0
    with tempfile.TemporaryDirectory() as scratch:
        base = Path(scratch) / "sound"
        base.mkdir()
        block(base / "block.msh")
        block(base / "torus.msh", cells="triangles")
        if limits.check:
            return check_sound(base, limits)
        (base / "picture").write_bytes(file_of(pictures()["grey8.png"]))
        end = time.monotonic() + (60 * limits.minutes if limits.minutes else limits.seconds)
        environment = {**{name: value for name, value in os.environ.items() if not name.startswith("PETSC_OPTIONS")},
                       "HOME": scratch}
        while time.monotonic() < end:
            name = names[tried % len(names)]
            target, chance = TARGETS[name], random.Random(f"{limits.seed}/{name}/{tried}")
            folder = Path(scratch) / "mutant"
            shutil.copytree(base, folder)
            arguments, fatal = damaged(target, chance, folder)
            outcome = watched([PROGRAMS[target.program], *arguments], folder, limits.hang, environment,
                              READY.get(target.program))
            refused += outcome[0] == 2
            if wrong := fault(target, outcome, fatal, limits):
                failed += 1
                kept = limits.keep / f"{name}-{limits.seed}-{tried}"
                kept.mkdir(parents=True, exist_ok=True)
                for file in ("scene.yaml", "scene.txt", "picture"):
                    if (folder / file).is_file():
                        shutil.copy(folder / file, kept)
                print(f"{kept}: {wrong}", flush=True)
            tried += 1
            shutil.rmtree(folder)
    print(f"seed {limits.seed}: {tried} damaged scenes, command lines and pictures, {refused} refused, {failed} failures")
    return 1 if failed or tried == 0 else 0


if __name__ == "__main__":
    sys.exit(main())
