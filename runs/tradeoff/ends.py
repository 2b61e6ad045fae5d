"""What a knob changes from one of its ends to the other, mesh and drawing being the same."""

from tradeoff.errors import BULK, CONTACT

SHARES = ("stick", "open")
NO_SHARE = 5e-3  # a part of the contact that counts as none
# Knob: the column that it turns, the setting that others are compared with, and which settings are looked at (None: all).
ENDS = {"steps": ("safety", 0.2, None), "storage": ("storage", "double", None),
        "models": ("model", "homogeneous-kubc", ("homogeneous-subc", "homogeneous-periodic"))}


def changes(row, other, names):
    """[(size, name, change, scatter)] of `names` from `other` to `row`, relative, largest first."""
    found = []
    for name in names:
        value, base = row.get(name), other.get(name)
        if value is None or not base or (name in SHARES and max(value, base) < NO_SHARE):
            continue
        scatter = ((row.get(f"{name}_scatter") or 0)**2 + (other.get(f"{name}_scatter") or 0)**2)**0.5 / abs(base)
        found.append((abs(value / base - 1), name, value / base - 1, scatter))
    return sorted(found, reverse=True)


def ends_of(rows):
    """Dicts of case, knob, `from` and `to`; most: of the contact's quantities that which changes most, changes and scatters
    being relative; frequency, and bulk, the largest change of the bulk's."""
    for case in dict.fromkeys(row["case"] for row in rows):
        for knob, (option, base, chosen) in ENDS.items():
            of = {row[option]: row for row in rows if (row["case"], row["knob"]) == (case, knob)}
            for setting, row in of.items():
                if base not in of or setting == base or (chosen and setting not in chosen):
                    continue
                contact, bulk = (changes(row, of[base], names) for names in (CONTACT, BULK))
                if not contact or not bulk:
                    continue
                frequency = next((change for _, name, change, _ in contact if name == "frequency"), None)
                _, name, change, scatter = contact[0]
                beyond = [f"{name} {100 * change:+.2g}" for _, name, change, scatter in contact if abs(change) > 2 * scatter]
                yield {"case": case, "knob": knob, "from": base, "to": setting, "most": name, "change": change,
                       "scatter": scatter, "frequency": frequency, "bulk": bulk[0][2], "beyond": ", ".join(beyond),
                       "seconds": row["seconds"] / of[base]["seconds"]}


if __name__ == "__main__":
    raise SystemExit("tradeoff.ends is a library, no command: snakemake --snakefile runs/tradeoff/Snakefile runs the study.")
