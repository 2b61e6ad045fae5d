#!/usr/bin/env bash
# Every check of a fresh clone on Debian 12: dependencies, formatting, build, tests.
#   tests/run.sh [ctest arguments, e.g. -L unit]
set -euo pipefail
cd "$(dirname "$0")/.."

cmake/install-dependencies.sh
git ls-files -z -- '*.cpp' '*.hpp' | xargs -0 clang-format --dry-run --Werror
cmake --preset release
cmake --build build/release
ctest --test-dir build/release --output-on-failure --parallel "$(nproc)" "$@"
