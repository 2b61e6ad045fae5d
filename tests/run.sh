#!/usr/bin/env bash
# Every check of a fresh clone on Debian 12: dependencies, formatting, rooms, build, tests.
#   tests/run.sh           each piece of physics, file and program once, one study
#   tests/run.sh --full    that, the same on other numbers of ranks (label nightly), and every study (label studies)
# What follows goes to ctest: tests/run.sh -L unit
set -euo pipefail
cd "$(dirname "$0")/.."

left_out=(--label-exclude '^(nightly|studies)$')
if [ "${1:-}" = --full ]; then
  left_out=()
  shift
fi

cmake/install-dependencies.sh
git ls-files -z -- '*.cpp' '*.hpp' | xargs -0 -n 40 -P "$(nproc)" clang-format --dry-run --Werror
python3 tests/rooms.py
cmake --preset release
cmake --build build/release
ctest --test-dir build/release --no-tests=error --output-on-failure --parallel "$(nproc)" "${left_out[@]}" "$@"
