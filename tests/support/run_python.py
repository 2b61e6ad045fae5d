"""Runs the unittest cases of one file, or those named.

    python3 run_python.py test_file.py [Case | Case.test_one …]

Exit code 0 when at least one case ran and none failed: a file without cases, and one whose cases are all skipped, are
failures, which unittest itself (before Python 3.12) takes for success.
"""

import importlib
import sys
import unittest
from pathlib import Path


def main():
    if len(sys.argv) < 2 or not (file := Path(sys.argv[1]).resolve()).is_file():
        sys.exit(__doc__)
    sys.path.insert(0, str(file.parent))  # where the modules stand that it imports
    module, names, loader = importlib.import_module(file.stem), sys.argv[2:], unittest.TestLoader()
    suite = loader.loadTestsFromNames(names, module) if names else loader.loadTestsFromModule(module)
    result = unittest.TextTestRunner(stream=sys.stdout).run(suite)
    if result.testsRun == len(result.skipped):
        print(f"{file}: no test was run", file=sys.stderr)
        return 1
    return 0 if result.wasSuccessful() else 1


if __name__ == "__main__":
    sys.exit(main())
