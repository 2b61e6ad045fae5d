"""Runs the unittest cases of one file, or those that discovery finds in a folder.

    python3 run_python.py test_file.py | folder [top folder of its modules]

Exit code 0 when at least one case ran and none failed: a discovery that finds nothing, a file without cases and a file
whose cases are all skipped are failures, which unittest itself (before Python 3.12) takes for success.
"""

import importlib
import sys
import unittest
from pathlib import Path


def cases(where, top=None):
    """The suite of a file or folder. The folder of a file, or `top`, is put where its modules are looked for."""
    if where.is_dir():
        return unittest.TestLoader().discover(str(where), top_level_dir=str(top or where))
    sys.path.insert(0, str(where.parent))
    return unittest.TestLoader().loadTestsFromModule(importlib.import_module(where.stem))


def main():
    words = [Path(word).resolve() for word in sys.argv[1:]]
    if not 1 <= len(words) <= 2 or not words[0].exists():
        sys.exit(__doc__)
    result = unittest.TextTestRunner(stream=sys.stdout, verbosity=1).run(cases(*words))
    if result.testsRun == len(result.skipped):
        print(f"{words[0]}: no test was run", file=sys.stderr)
        return 1
    return 0 if result.wasSuccessful() else 1


if __name__ == "__main__":
    sys.exit(main())
