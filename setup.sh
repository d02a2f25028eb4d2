#!/usr/bin/env bash
# Installs the Debian packages that diurna is built from; with --tests also the programs that some tests drive, which they
# skip where they are missing; with --fuzz also clang, for .ci/fuzz; with --python what its Python module is built from and
# tested with; with --packages what packaging/smoke.sh makes and tries Debian packages by; with --slurm the cluster of
# tests/slurm; with --docs what docs/build.sh and docs/test.sh need.
# Without root it names what is missing and stops.
set -euo pipefail

packages=(
    # building
    cmake ninja-build g++ ccache pkg-config git clang-format
    # geometry, places, elevation, rays
    libcgal-dev libopenmesh-dev libembree-dev libeigen3-dev libgeographiclib-dev libgdal-dev
    libproj-dev proj-data liberfa-dev libtbb-dev
    # files, messages, pictures
    libtomlplusplus-dev nlohmann-json3-dev libcli11-dev libfmt-dev libnetcdf-dev libhdf5-dev libboost-dev
    libfftw3-dev libopenexr-dev libpng-dev libtiff-dev libssl-dev
    # tests and benches
    catch2 libsundials-dev libbenchmark-dev
)
[ "${1:-}" != --tests ] || packages+=(chromium ffmpeg python3)
[ "${1:-}" != --python ] || packages+=(python3-dev python3-venv pybind11-dev python3-numpy python3-pandas python3-netcdf4 python3-openimageio
    python3-xarray mypy)
[ "${1:-}" != --packages ] || packages+=(debootstrap dpkg-dev file)
[ "${1:-}" != --slurm ] || packages+=(slurm-wlm munge)
[ "${1:-}" != --docs ] || packages+=(mkdocs python3 ffmpeg)
[ "${1:-}" != --fuzz ] || packages+=(clang libclang-rt-14-dev)

missing=()
for package in "${packages[@]}"; do
    [ "$(dpkg-query -W -f='${db:Status-Status}' "$package" 2>/dev/null)" = installed ] ||
        missing+=("$package")
done
[ ${#missing[@]} -eq 0 ] && exit 0

if [ "$(id -u)" -ne 0 ]; then
    echo "setup.sh: these packages are missing: ${missing[*]}" >&2
    echo "setup.sh: run it once as root (sudo ./setup.sh), then again as yourself" >&2
    exit 1
fi
echo "setup.sh: installing ${missing[*]}" >&2
export DEBIAN_FRONTEND=noninteractive
apt-get update -qq
apt-get install -y -qq --no-install-recommends "${missing[@]}" >/dev/null
