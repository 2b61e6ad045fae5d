#!/usr/bin/env bash
# The first study from a fresh clone on Debian 12: dependencies, build, composite, run, picture.
#   runs/first/run.sh [ranks]
set -euo pipefail
cd "$(dirname "$0")/../.."
ranks=${1:-2}
out=out/first

cmake/install-dependencies.sh
cmake --preset release
cmake --build build/release --target morphology slide

build/release/morphology -options_file_yaml runs/first/block.yaml -output_folder "$out/mesh"

if [ "$(id -u)" = 0 ]; then # as in a container
  export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 OMPI_MCA_btl_vader_single_copy_mechanism=none
fi
cores=$(lscpu --parse=CORE,SOCKET | grep -v '^#' | sort -u | wc -l) # Open MPI counts cores, not threads
if [ "$ranks" -gt "$cores" ] || [ "$ranks" -gt "$(nproc)" ]; then
  export OMPI_MCA_rmaps_base_oversubscribe=1
fi
export OMP_NUM_THREADS=1 OPENBLAS_NUM_THREADS=1
mpirun -n "$ranks" build/release/slide -options_file_yaml runs/first/scene.yaml -output_folder "$out"

build/release/slipscale picture "$out" "$out/picture.png"
build/release/slipscale report "$out" > /dev/null

cat <<END

The picture:  $out/picture.png
On one page:  $out/report.html
The block:    $out/mesh/morphology.png and morphology.yaml
In numbers:   $out/summary.yaml
In ParaView:  $out/fields.xdmf
The rest:     $out/history.h5 and contact.h5; every option in effect: $out/run.yaml
END
