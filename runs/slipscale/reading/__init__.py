"""The files of a run, as numpy arrays."""

from slipscale.reading.files import UnreadableRun, open_hdf5, read_dataset, read_yaml
from slipscale.reading.history import OPEN, SLIP, STICK, ContactHistory, History, Point
from slipscale.reading.on_mesh import SAME_TIME, Fields, LocalPoint, OnMesh, Statistics
from slipscale.reading.summary import Summary

__all__ = ["OPEN", "SAME_TIME", "SLIP", "STICK", "ContactHistory", "Fields", "History", "LocalPoint", "OnMesh", "Point",
           "Statistics", "Summary", "UnreadableRun", "open_hdf5", "read_dataset", "read_yaml"]
