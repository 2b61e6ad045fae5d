"""Makes good a file whose process was killed in the moment in which it changed it.

A run of `slide` or `relocalize` writes what changes a file that grows into <file>.journal first, then into the file
(src/files/journaled_file.hpp). A journal that is whole, and that nobody holds locked, is what such a kill left.
"""

import fcntl
import struct

MARK = b"slipscale log 1\0"
HEADER = struct.Struct("=16s4Q")  # mark, places, bytes, size of the file, checksum
PLACE = struct.Struct("=2Q")  # offset in the file, length


def changes_of(journal):
    """[(offset, bytes)] and the size of the file they belong to; None where the journal is not whole."""
    if len(journal) < HEADER.size:
        return None
    mark, places, count, size, checksum = HEADER.unpack_from(journal)
    begin = HEADER.size + places * PLACE.size
    end = begin + count
    if mark != MARK or end > len(journal) or sum_of((places, count, size), journal[HEADER.size:end]) != checksum:
        return None
    found = []
    for at, length in PLACE.iter_unpack(journal[HEADER.size:begin]):
        found.append((at, journal[begin:begin + length]))
        begin += length
    return found, size


def sum_of(numbers, rest):
    """FNV-1a of eight bytes at a time."""
    rest += bytes(-len(rest) % 8)
    total = 14695981039346656037
    for word in (*numbers, *struct.unpack(f"={len(rest) // 8}Q", rest)):
        total = (total ^ word) * 1099511628211 % 2**64
    return total


def make_good(path):
    """Whether there was something to make good, and it is. Leaves alone what it may not write, or a run is at work
    on."""
    journal = path.with_name(path.name + ".journal")
    try:
        with open(journal, "rb") as file:
            fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
            found = changes_of(file.read())
            if found is None or path.stat().st_size < found[1]:
                return False
            with open(path, "r+b") as data:
                for at, what in found[0]:
                    data.seek(at)
                    data.write(what)
            journal.unlink()
            return True
    except OSError:
        return False


if __name__ == "__main__":
    raise SystemExit("slipscale.reading.recovery is a library, no command: slipscale -h lists the commands.")
