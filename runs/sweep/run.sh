#!/usr/bin/env bash
# A sweep from the command line, as `slide` is started, with several values for what is varied; --help says more:
#   runs/sweep/run.sh -options_file_yaml runs/first/scene.yaml -friction_coefficient 0.1:0.1:0.8 -surface_speed 1,2,4
folder=$(cd "$(dirname "$0")" && pwd)
PYTHONPATH="$folder/.." exec /usr/bin/python3 -m slipscale.running.sweep_command "$folder" "$@"
