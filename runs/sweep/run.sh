#!/usr/bin/env bash
# A sweep from the command line, as `slide` is started, with several values for what is varied; --help says more:
#   runs/sweep/run.sh -options_file_yaml runs/first/scene.yaml -friction_coefficient 0.1:0.1:0.8 -surface_speed 1,2,4
folder=$(cd "$(dirname "$0")" && pwd)
built="$folder/../../build/release/slipscale" installed="$folder/../../../../bin/slipscale"
for program in "${SLIPSCALE_COMMAND:-}" "$built" "$installed" slipscale; do
  if command -v "$program" >/dev/null; then
    exec "$program" sweep --study "$folder" "$@"
  fi
done
echo "run.sh: there is no slipscale in build/release: cmake --preset release && cmake --build build/release" >&2
exit 2
