"""Runs every test below this folder, from `runs`: python3 -m tests. None found, or a file not found, is a failure."""

import sys
import unittest
from pathlib import Path

here = Path(__file__).parent
suite = unittest.defaultTestLoader.discover(str(here), top_level_dir=str(here.parent))


def modules_of(tests):
    """Files of the tests in a suite of suites."""
    if not isinstance(tests, unittest.TestSuite):
        return {getattr(sys.modules.get(type(tests).__module__), "__file__", None)}
    return set().union(*map(modules_of, tests))


if unittest.defaultTestLoader.errors:
    sys.exit("".join(unittest.defaultTestLoader.errors))
found = modules_of(suite) | {None}
if missed := sorted({str(path) for path in here.rglob("test_*.py")} - found):
    sys.exit(f"not found by unittest, for want of an __init__.py beside it or of tests in it: {', '.join(missed)}")
if not suite.countTestCases():
    sys.exit("no test was found")
sys.exit(not unittest.TextTestRunner().run(suite).wasSuccessful())
