"""Damage to the files that programs read of each other: to what the format means, and to bytes without a thought of it.

`damaged_hdf5` and `damaged_yaml` take (random.Random, path), damage that file and return the `Damage`.
"""

import re
from dataclasses import dataclass

import numpy as np
from running import h5py

# What `relocalize` reads; damage elsewhere may pass.
READ = {
    "localization.h5": ("mesh/coordinates", "mesh/cells", "mesh/region", "cell/localisation", "region/stiffness",
                        "effective/stiffness"),
    "fields.h5": ("mesh/coordinates", "mesh/cells", "mesh/region", "time", "frames/00000/strain",
                 "frames/00001/strain"),
    "statistics.h5": ("mesh/coordinates", "mesh/cells", "mesh/region", "statistics/strain/mean",
                      "statistics/strain/covariance"),
}
ATTRIBUTES = {
    "localization.h5": (("mesh/region", "names"), ("region/stiffness", "names"), ("effective/stiffness", "boundary"),
                        ("effective/stiffness", "cell_area")),
    "fields.h5": (("mesh/region", "names"),),
    "statistics.h5": (("mesh/region", "names"),
                      *(("statistics", name) for name in ("from", "to", "samples", "quantile"))),
}


@dataclass
class Damage:
    """What was done to a file, and whether a reader must refuse it."""

    text: str
    fatal: bool = False


def replaced(file, name, values, **how):
    """Another content of a dataset, with the attributes it had."""
    attributes = dict(file[name].attrs)
    del file[name]
    made = file.create_dataset(name, data=values, **how)
    made.attrs.update(attributes)


# Each takes (chance, file, dataset name) and returns the damage, or None where it does not apply.

def entry(chance, file, name):
    values = file[name][()]
    if values.dtype.kind != "f":
        return None
    wrong = chance.choice([np.nan, np.inf, -np.inf, 1e308])
    values.flat[chance.randrange(values.size)] = wrong
    file[name][...] = values
    return Damage(f"{wrong} in {name}", fatal=not np.isfinite(wrong))


def all_equal(chance, file, name):
    value = chance.choice([0, 1, -1])
    file[name][...] = np.full_like(file[name][()], value)
    harmless = name == "time" or name.startswith("frames") or name.startswith("statistics") or name == "mesh/region"
    return Damage(f"{name} is {value} everywhere", fatal=not harmless)


def negated(chance, file, name):
    values = file[name][()]
    file[name][...] = -values
    wrong = name in ("cell/localisation", "region/stiffness", "effective/stiffness", "statistics/strain/covariance")
    return Damage(f"{name} negated", fatal=wrong and bool(np.any(values)))


def scaled(chance, file, name):
    values = file[name][()]
    if values.dtype.kind != "f":
        return None
    row = chance.randrange(len(values))
    values[row] *= 1 + 10.0 ** chance.uniform(-3, 3)
    file[name][...] = values
    return Damage(f"row {row} of {name} scaled", fatal=name in ("cell/localisation", "region/stiffness"))


def index(chance, file, name):
    values = file[name][()]
    if values.dtype.kind != "i":
        return None
    wrong = chance.choice([-1, 2**31 - 1, -2**31, 10**6])
    values.flat[chance.randrange(values.size)] = wrong
    file[name][...] = values
    return Damage(f"{wrong} in {name}", fatal=True)


def size(chance, file, name):
    values = file[name][()]
    other = chance.choice([values[:-1], values[:0], np.concatenate([values, values[:1]]), values.reshape(-1)[:-1],
                           values.reshape(1, *values.shape)])
    replaced(file, name, other)
    return Damage(f"{name} of shape {other.shape} for {values.shape}")


def declared(chance, file, name):
    values = file[name][()]
    rows = 10 ** chance.randrange(8, 13)
    kept = dict(file[name].attrs)
    del file[name]
    made = file.create_dataset(name, shape=(rows, *values.shape[1:]), maxshape=(None, *values.shape[1:]),
                               chunks=(1024, *values.shape[1:]), dtype=values.dtype)
    if chance.random() < 0.5:
        made[:len(values)] = values
    made.attrs.update(kept)
    return Damage(f"{name} declares {rows} rows", fatal=True)


def kind(chance, file, name):
    values = file[name][()]
    other = chance.choice([np.full(values.shape, b"word"), values.astype("f4"), values.astype("i8"),
                           values.astype("complex128"), np.array(3.0)])
    replaced(file, name, other)
    return Damage(f"{name} as {other.dtype}, shape {other.shape}")


def gone(chance, file, name):
    del file[name]
    return Damage(f"{name} is gone", fatal=True)


def group(chance, file, name):
    del file[name]
    file.create_group(name)
    return Damage(f"{name} is a group", fatal=True)


def attribute(chance, file, owner, name):
    made = chance.choice(["gone", "list", "empty", "number", "nan", "bytes", "group"])
    attributes = file[owner].attrs
    if name not in attributes:
        return None
    if made == "group":
        return None
    del attributes[name]
    if made == "list":
        attributes[name] = np.arange(chance.choice([0, 2, 100000 // 16]), dtype=float)
    elif made == "empty":
        attributes[name] = h5py.Empty("S8")
    elif made == "number":
        attributes[name] = chance.choice([0.0, -1.0, 1e300])
    elif made == "nan":
        attributes[name] = np.nan
    elif made == "bytes":
        attributes[name] = np.array([b"\xff\xfe"] * chance.choice([1, 3]))
    # Of a text that is gone there is no other; numbers may be those of another run.
    texts = name in ("names", "boundary")
    return Damage(f"{owner}'s attribute {name}: {made}", fatal=(texts or made in ("list", "nan")) and made != "gone"
                  or name == "names")


DATASETS = (entry, all_equal, negated, scaled, index, size, declared, kind, gone, group)


def raw(chance, path):
    """Bytes, without a thought of what they mean."""
    data = bytearray(path.read_bytes())
    made = chance.choice(["flip", "flip", "flip", "cut", "zero", "copy"])
    at = chance.randrange(len(data))
    if made == "flip":
        for _ in range(chance.choice([1, 1, 8, 64])):
            at = chance.randrange(len(data)) if chance.random() < 0.5 else chance.randrange(min(4096, len(data)))
            data[at] ^= 1 << chance.randrange(8)
    elif made == "cut":
        del data[at:]
    elif made == "zero":
        data[at:at + 64] = bytes(len(data[at:at + 64]))
    else:
        other = chance.randrange(len(data))
        data[at:at + 64] = data[other:other + len(data[at:at + 64])]
    path.write_bytes(data)
    return Damage(f"bytes: {made} at {at}")


def damaged_hdf5(chance, path):
    if chance.random() < 0.35:
        return raw(chance, path)
    with h5py.File(path, "r+") as file:
        while True:
            if chance.random() < 0.3:
                done = attribute(chance, file, *chance.choice(ATTRIBUTES[path.name]))
            else:
                done = chance.choice(DATASETS)(chance, file, chance.choice(READ[path.name]))
            if done:
                return done


def damaged_record(chance, path):
    """Of a run that is to go on: any dataset or bytes. What matters then is whether its rows are still the same."""
    if chance.random() < 0.5:
        return raw(chance, path)
    with h5py.File(path, "r+") as file:
        names = []
        file.visititems(lambda name, item: names.append(name) if isinstance(item, h5py.Dataset) and not item.is_virtual
                        else None)
        while True:
            done = chance.choice(DATASETS)(chance, file, chance.choice(names))
            if done:
                return Damage(done.text)


def damaged_checkpoint(chance, path):
    """Its seal tells; the older one is taken."""
    return raw(chance, path)


def damaged_yaml(chance, path):
    lines = path.read_text().split("\n")
    at = chance.randrange(len(lines))
    made = chance.choice(["drop", "double", "cut", "bytes", "nan", "nest", "tab"])
    if made == "drop":
        del lines[at]
    elif made == "double":
        lines.insert(at, lines[at])
    elif made == "cut":
        lines = lines[:at] + [lines[at][:chance.randrange(len(lines[at]) + 1)]]
    elif made == "nan":
        lines = [re.sub(r"\d\.\d+e[+-]\d+", chance.choice([".nan", "nan", ".inf", "-1.0e+300", "word", "[1, 2]"]), line,
                        count=1) if line.startswith(("stiffness", "density")) else line for line in lines]
    elif made == "nest":
        lines.insert(at, "a: " + "[" * 1000)
    elif made == "tab":
        lines[at] = "\t" + lines[at]
    text = "\n".join(lines).encode()
    if made == "bytes":
        text = bytes(byte ^ (1 << chance.randrange(8)) if chance.random() < 0.01 else byte for byte in text)
    path.write_bytes(text)
    return Damage(f"effective.yaml: {made} at line {at + 1}", fatal=made == "nan")
