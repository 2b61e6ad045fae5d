"""What a step would take on more parts than this machine has cores, from measured parts: a table and a picture.

    /usr/bin/python3 tests/bench/scale.py --step step.txt --parts parts.csv [parts.csv …] --picture scale.png

`--step` is what bench_step printed (squares; each size gives the time per node where rows repeat and where every pair is
visited), `--parts` what bench_parts printed. A step takes as long as its slowest part: its inner nodes at the first rate,
the nodes beside other parts at the second, then the exchange, which nothing hides:

    2 m overhead + latency + bytes / bandwidth,    m messages received and as many sent, 16 bytes a node

`--memory` bounds the rate of parts that do not fit into `--cache` by what memory gives a core whose neighbours are as
busy; without it each core has what it had when it was measured, alone. Where a grid was not cut by METIS, the figures of
the next smaller grid are taken for as many parts: nodes grow with it, borders with its square root.
"""

import argparse
import csv
import re
import sys
from dataclasses import dataclass, replace

import numpy as np

BYTES = 16  # of a displacement
WAYS = {"metis": "METIS", "strips": "strips", "rectangles": "rectangles"}
SHOWN = (2, 16, 64, 256, 1024, 4096)
HALF = 0.5
SIZE = re.compile(r"^(\d+) nodes, .*?$", re.M)
RATE = re.compile(r"^  (step|step, pairs) +[\d.]+ ns per node \(least +([\d.]+)\)", re.M)


@dataclass
class Machine:
    """s and B/s; `sizes` [n] nodes with `repeat` and `pairs` [n], s per node and step."""

    sizes: np.ndarray
    repeat: np.ndarray
    pairs: np.ndarray
    latency: float
    overhead: float
    bandwidth: float
    memory: float
    cache: float
    moved: float

    def rate(self, nodes, measured):
        """Between the sizes measured by the logarithm; a part below them costs as much as the smallest."""
        if nodes < self.sizes[0]:
            return measured[0] * self.sizes[0] / nodes
        own = float(np.interp(np.log(nodes), np.log(self.sizes), measured))
        return max(own, self.moved / self.memory) if self.memory and nodes * self.moved > self.cache else own


@dataclass
class Cut:
    """One line of bench_parts: the largest of each over the parts."""

    nodes: float
    way: str
    parts: int
    owned: float
    border: float
    ghosts: float
    needed: float
    senders: float
    scaled: bool = False


@dataclass
class Step:
    """Where the time of a step goes, s."""

    inner: float
    border: float
    messages: float
    latency: float
    transfer: float

    def compute(self):
        return self.inner + self.border

    def exchange(self):
        return self.messages + self.latency + self.transfer

    def total(self):
        return self.compute() + self.exchange()

    def hidden(self):
        """Were the inner nodes summed while the halo travels."""
        return max(self.inner, self.latency + self.transfer) + self.border + self.messages


def read_rates(text):
    """Sizes, rate where rows repeat, rate by pairs: the least of the repetitions, s."""
    found = []
    blocks = SIZE.split(text)[1:]
    for nodes, block in zip(blocks[::2], blocks[1::2]):
        rates = dict(RATE.findall(block))
        found.append((int(nodes), 1e-9 * float(rates["step"]), 1e-9 * float(rates["step, pairs"])))
    return (np.array(column, dtype=float) for column in zip(*sorted(found)))


def read_cuts(paths):
    cuts = []
    for path in paths:
        with open(path, newline="", encoding="utf-8") as file:
            cuts += [Cut(float(row["nodes"]), row["way"], int(row["parts"]),
                         *(float(row[name]) for name in ("owned", "border", "ghosts", "needed", "senders")))
                     for row in csv.DictReader(file)]
    return cuts


def larger(cut, nodes):
    """The same number of parts of a larger grid."""
    longer = np.sqrt(nodes / cut.nodes)
    return replace(cut, nodes=nodes, owned=cut.owned * nodes / cut.nodes, border=cut.border * longer,
                   ghosts=cut.ghosts * longer, needed=cut.needed * longer, scaled=True)


def completed(cuts):
    """With what METIS would do to a grid where it was not tried: as the next smaller grid tells."""
    cuts = list(cuts)
    sizes = sorted({cut.nodes for cut in cuts})
    for small, large in zip(sizes, sizes[1:]):
        found = {(cut.nodes, cut.parts): cut for cut in cuts if cut.way == "metis"}
        wanted = {cut.parts for cut in cuts if cut.nodes == large}
        cuts += [larger(found[small, parts], large) for parts in sorted(wanted)
                 if (large, parts) not in found and (small, parts) in found]
    return cuts


def checked_scaling(cuts):
    """Largest relative difference in ghosts between METIS's cut of a grid and that scaled from the next smaller one."""
    metis = sorted((cut for cut in cuts if cut.way == "metis"), key=lambda cut: cut.nodes)
    found = {(cut.nodes, cut.parts): cut for cut in metis}
    sizes = sorted({cut.nodes for cut in metis})
    return [abs(larger(found[small, cut.parts], large).ghosts / cut.ghosts - 1)
            for small, large in zip(sizes, sizes[1:]) for cut in metis
            if cut.nodes == large and (small, cut.parts) in found]


def step_of(cut, machine, halo="ghosts"):
    return Step(inner=(cut.owned - cut.border) * machine.rate(cut.owned, machine.repeat),
                border=cut.border * machine.rate(cut.owned, machine.pairs),
                messages=2 * cut.senders * machine.overhead, latency=machine.latency,
                transfer=BYTES * getattr(cut, halo) / machine.bandwidth)


def alone(nodes, machine):
    """A step of the whole grid on one core."""
    return nodes * machine.rate(nodes, machine.repeat)


def efficiency(cut, machine, time):
    return alone(cut.nodes, machine) / (cut.parts * time)


def in_short(nodes):
    return f"{nodes / 1e6:.3g} M"


def microseconds(seconds):
    """With three digits."""
    return f"{1e6 * seconds:.{max(0, 2 - int(np.floor(np.log10(1e6 * seconds))))}f}"


def beside(values, digits):
    return " / ".join(f"{value:{digits}}" for value in values)


def table(cuts, machine):
    """Lines of Markdown; three figures in a field are those of METIS, strips and rectangles."""
    yield ("| nodes | parts | nodes a part | most over mean | neighbours | halo [nodes] | step [µs] | efficiency |")
    yield "|---|---|---|---|---|---|---|---|"
    found = {(cut.nodes, cut.parts, cut.way): cut for cut in cuts}
    for nodes in sorted({cut.nodes for cut in cuts}):
        for parts in SHOWN:
            three = [found[nodes, parts, way] for way in WAYS if (nodes, parts, way) in found]
            if len(three) < len(WAYS):
                continue
            steps = [step_of(cut, machine) for cut in three]
            share = nodes / parts
            yield " | ".join([
                f"| {in_short(nodes)}", str(parts), f"{share:.0f}",
                beside([cut.owned / share for cut in three], ".2f"), beside([cut.senders for cut in three], ".0f"),
                beside([cut.ghosts for cut in three], ".0f"), " / ".join(microseconds(step.total()) for step in steps),
                beside([efficiency(cut, machine, step.total()) for cut, step in zip(three, steps)], ".2f")]) + " |"


def where(cuts, machine):
    """Of METIS's cuts into most parts: where the time goes, and what could be done."""
    yield ("| nodes, 4096 parts | inner nodes | beside others | messages | latency | transfer | efficiency | smaller halo "
           "| hidden too | and rectangles |")
    yield "|---|---|---|---|---|---|---|---|---|---|"
    found = {(cut.nodes, cut.way): cut for cut in cuts if cut.parts == SHOWN[-1]}
    for nodes in sorted({cut.nodes for cut in cuts}):
        cut, squares = found.get((nodes, "metis")), found.get((nodes, "rectangles"))
        if not cut or not squares:
            continue
        step, small, best = (step_of(cut, machine), step_of(cut, machine, "needed"),
                             step_of(squares, machine, "needed"))
        parts = (step.inner, step.border, step.messages, step.latency, step.transfer)
        gains = (step.total(), small.total(), small.hidden(), best.hidden())
        yield " | ".join([f"| {in_short(nodes)}", *(f"{1e6 * part:.2f} µs" for part in parts),
                          *(f"{efficiency(cut, machine, time):.2f}" for time in gains)]) + " |"


def half(cuts, machine):
    """Parts, and nodes a part, at which the efficiency falls to a half: the three ways beside each other."""
    yield "| nodes | parts up to which the efficiency is a half or more | nodes a part there |"
    yield "|---|---|---|"
    for nodes in sorted({cut.nodes for cut in cuts}):
        ends = []
        for way in WAYS:
            line = sorted((cut for cut in cuts if (cut.nodes, cut.way) == (nodes, way)), key=lambda cut: cut.parts)
            values = [efficiency(cut, machine, step_of(cut, machine).total()) for cut in line]
            last = next((k for k, value in enumerate(values) if value < HALF), None)
            if last:  # between two numbers of parts, by logarithms
                share = np.log(values[last - 1] / HALF) / np.log(values[last - 1] / values[last])
                ends.append((line[last - 1].parts * (line[last].parts / line[last - 1].parts) ** share, ""))
            elif line:
                ends.append((line[-1].parts, "over "))
        yield " | ".join([f"| {in_short(nodes)}", " / ".join(f"{more}{end:.0f}" for end, more in ends),
                          " / ".join(f"{'below ' if more else ''}{nodes / end:.0f}" for end, more in ends)]) + " |"


def draw(cuts, machine, path):
    import matplotlib
    matplotlib.use("Agg")
    from matplotlib import pyplot as plt

    colours = {"metis": "#0072B2", "strips": "#D55E00", "rectangles": "#009E73"}
    sizes = sorted({cut.nodes for cut in cuts})
    figure, axes = plt.subplots(1, len(sizes) + 1, figsize=(4.6 * (len(sizes) + 1), 4.2), layout="constrained")
    for panel, nodes in zip(axes, sizes):
        for way, name in WAYS.items():
            line = sorted((cut for cut in cuts if (cut.nodes, cut.way) == (nodes, way)), key=lambda cut: cut.parts)
            values = [efficiency(cut, machine, step_of(cut, machine).total()) for cut in line]
            panel.semilogx([cut.parts for cut in line], values, marker="o", markersize=4, base=2, color=colours[way],
                           linestyle="--" if any(cut.scaled for cut in line) else "-", label=name)
        panel.axhline(1, color="0.7", linewidth=0.8)
        panel.set(title=f"{in_short(nodes)} nodes", xlabel="parts", ylabel="efficiency", ylim=(0, None))
        panel.grid(alpha=0.25)
        panel.legend(fontsize="small")
    line = sorted((cut for cut in cuts if (cut.nodes, cut.way) == (sizes[0], "metis")), key=lambda cut: cut.parts)
    steps = [step_of(cut, machine) for cut in line]
    parts = [cut.parts for cut in line]
    for name, label, colour in (("inner", "inner nodes", "#0072B2"), ("border", "nodes beside others", "#56B4E9"),
                                ("messages", "messages", "#E69F00"), ("latency", "latency", "#CC79A7"),
                                ("transfer", "transfer", "0.4")):
        axes[-1].loglog(parts, [1e6 * getattr(step, name) for step in steps], "o-", markersize=4, color=colour,
                        label=label)
    axes[-1].loglog(parts, [1e6 * step.total() for step in steps], "k-", linewidth=2, label="a step")
    axes[-1].set_xscale("log", base=2)
    axes[-1].set(title=f"{in_short(sizes[0])} nodes by METIS: where a step goes", xlabel="parts", ylabel="µs")
    axes[-1].grid(alpha=0.25)
    axes[-1].legend(fontsize="small")
    figure.savefig(path, dpi=90)


def main(words=None):
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--step", required=True, help="what bench_step printed")
    parser.add_argument("--parts", required=True, nargs="+", help="what bench_parts printed")
    parser.add_argument("--picture", help="where to draw")
    parser.add_argument("--latency", type=float, default=2e-6, help="of the network, s (%(default)g)")
    parser.add_argument("--overhead", type=float, default=0.3e-6, help="of a message on a core, s (%(default)g)")
    parser.add_argument("--bandwidth", type=float, default=1e9, help="of the network for each part, B/s (%(default)g)")
    parser.add_argument("--memory", type=float, help="bandwidth of memory for each core, B/s")
    parser.add_argument("--cache", type=float, default=2e6, help="B that a core has for itself (%(default)g)")
    parser.add_argument("--moved", type=float, default=100, help="B a node that a step moves (%(default)g)")
    given = parser.parse_args(words)
    with open(given.step, encoding="utf-8") as file:
        machine = Machine(*read_rates(file.read()), given.latency, given.overhead, given.bandwidth, given.memory,
                          given.cache, given.moved)
    counted = read_cuts(given.parts)
    cuts = completed(counted)
    print("ns a node and step, rows that repeat / every pair visited: " + ", ".join(
        f"{size:.0f} nodes {1e9 * repeat:.1f} / {1e9 * pairs:.1f}"
        for size, repeat, pairs in zip(machine.sizes, machine.repeat, machine.pairs)))
    print()
    print("\n".join(table(cuts, machine)), end="\n\n")
    print("\n".join(half(cuts, machine)), end="\n\n")
    print("\n".join(where(cuts, machine)), end="\n\n")
    if followed := [cut for cut in cuts if cut.scaled]:
        print("METIS by the next smaller grid: " + ", ".join(
            f"{in_short(cut.nodes)} in {cut.parts} parts" for cut in followed) + ".")
    if differences := checked_scaling(counted):
        print(f"Halos of METIS scaled from the next smaller grid: {max(differences):.0%} off at most, "
              f"{np.median(differences):.0%} in the middle.")
    if given.picture:
        draw(cuts, machine, given.picture)
    return 0


if __name__ == "__main__":
    sys.exit(main())
