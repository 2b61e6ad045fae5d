"""What a kill leaves in the middle of a change. That slide writes such journals tests/faults shows."""

import fcntl
import struct
import tempfile
import unittest
from pathlib import Path

from slipscale.reading.recovery import make_good


def checksum(words):
    total = 14695981039346656037
    for word in words:
        total = (total ^ word) * 1099511628211 % 2**64
    return total


class Recovery(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.file = Path(folder.name) / "history.h5"
        self.journal = Path(folder.name) / "history.h5.journal"
        self.file.write_bytes(b"abcdefgh")
        # "AB" at 0, "E" at 4 of a file of 8 bytes; the bytes fill up to a word of eight.
        numbers = (2, 3, 8)
        table = (0, 2, 4, 1)
        total = checksum((*numbers, *table, int.from_bytes(b"ABE", "little")))
        self.whole = b"slipscale log 1\0" + struct.pack("<4Q", *numbers, total) + struct.pack("<4Q", *table) + b"ABE"

    def test_a_whole_journal_is_made_good(self):
        for rest in (b"", b"of a longer one before it"):
            self.file.write_bytes(b"Abcdefgh")
            self.journal.write_bytes(self.whole + rest)
            self.assertTrue(make_good(self.file))
            self.assertEqual(self.file.read_bytes(), b"ABcdEfgh")
            self.assertFalse(self.journal.exists())
            self.assertFalse(make_good(self.file))

    def test_a_torn_one_changes_nothing(self):
        torn = [self.whole[:length] for length in range(len(self.whole))]
        torn += [self.whole[:k] + bytes([self.whole[k] ^ 64]) + self.whole[k + 1:] for k in range(len(self.whole))]
        for journal in torn:
            self.journal.write_bytes(journal)
            self.assertFalse(make_good(self.file))
            self.assertEqual(self.file.read_bytes(), b"abcdefgh")

    def test_of_a_run_that_goes_on_or_of_another_file(self):
        self.journal.write_bytes(self.whole)
        with open(self.journal, "rb") as held:
            fcntl.flock(held, fcntl.LOCK_EX)
            self.assertFalse(make_good(self.file))
        self.file.write_bytes(b"abc")
        self.assertFalse(make_good(self.file))
        self.assertEqual(self.file.read_bytes(), b"abc")


if __name__ == "__main__":
    unittest.main()
