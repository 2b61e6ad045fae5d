#!/usr/bin/env bash
# Installs what slipscale needs to build, test and plot, from Debian 12's own packages. Harmless to run again.
set -euo pipefail

packages=(
  g++ cmake ninja-build pkg-config git clang-format
  petsc-dev libpetsc-real-dev libslepc-real-dev libopenblas0-serial libopenmpi-dev openmpi-bin libhdf5-openmpi-dev libmetis-dev libfftw3-dev libyaml-dev libeigen3-dev libfmt-dev libmuparser-dev
  gmsh libgmsh-dev libpng-dev
  libgtest-dev
  python3 python3-numpy python3-h5py python3-matplotlib python3-yaml python3-markdown python3-meshio snakemake
)

if ! command -v apt-get >/dev/null || ! command -v dpkg-query >/dev/null; then
  echo "No apt here: install a C++20 compiler, CMake 3.25, Ninja, pkg-config, Open MPI, PETSc and SLEPc 3.18 (real numbers)," \
    "parallel HDF5, METIS, FFTW 3, libyaml, Eigen 3.4, fmt 9, muParser 2.3, gmsh 4.8 with its library, libpng, GoogleTest, and Python 3.11 with numpy," \
    "h5py, matplotlib, yaml and meshio, and Snakemake 7.21." >&2
  exit 1
fi

missing=()
for package in "${packages[@]}"; do
  [ "$(dpkg-query -W -f '${db:Status-Status}' "$package" 2>/dev/null)" = installed ] || missing+=("$package")
done
[ ${#missing[@]} -gt 0 ] || exit 0

as_root=()
if [ "$(id -u)" != 0 ]; then
  if ! command -v sudo >/dev/null; then
    echo "Neither root nor sudo: ask an administrator to install ${missing[*]}." >&2
    exit 1
  fi
  as_root=(sudo)
fi
echo "Installing ${missing[*]}"
"${as_root[@]}" apt-get update
"${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install --yes --no-install-recommends "${missing[@]}"
