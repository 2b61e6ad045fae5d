"""run.yaml and summary.yaml of a run."""

from pathlib import Path

from slipscale.reading.files import UnreadableRun, read_yaml


class Summary:
    """What run.yaml (the options in effect) and summary.yaml (the headline numbers) say; both dicts may be empty."""

    def __init__(self, folder):
        self.options = read_yaml(Path(folder) / "run.yaml")
        self.headline = read_yaml(Path(folder) / "summary.yaml")

    def number(self, option):
        """An option as a float, or None. YAML reads 30e9 as text, hence the conversion."""
        try:
            return float(self.options.get(option))
        except (TypeError, ValueError):
            return None

    def measured_boundary(self, history):
        """The boundary where the load is measured: option history_boundary, else `top` as `slide` takes it, else the
        first one recorded."""
        for name in (self.options.get("history_boundary"), "top"):
            if name in history.boundary:
                return name
        if not history.boundary:
            raise UnreadableRun("history.h5 records no boundary force: name one with -history_boundary.")
        return next(iter(history.boundary))
