"""Checkpoints of `slide` that are changed on purpose, with a seal that is right."""

from contextlib import contextmanager

import h5py

SEAL = 33  # bytes: "slipscale fnv1a:0123456789abcdef\n"


def checksum(data):
    """FNV-1a, 64 bit."""
    value = 14695981039346656037
    for byte in data:
        value = (value ^ byte) * 1099511628211 % 2**64
    return value


@contextmanager
def unsealed(path):
    """The checkpoint as an h5py file that may be written to; sealed again behind the block."""
    path.write_bytes(path.read_bytes()[:-SEAL])
    with h5py.File(path, "r+") as file:
        yield file
    data = path.read_bytes()
    path.write_bytes(data + f"slipscale fnv1a:{checksum(data):016x}\n".encode())
