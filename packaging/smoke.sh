#!/usr/bin/env bash
# Builds the Debian packages, installs them into a bare Debian 12 that it makes, and uses them there: the program from
# its data to a temperature and a picture, the libraries through find_package. Root and debootstrap; about five minutes.
#   packaging/smoke.sh [ROOT]     ROOT: a folder for the bare system, kept; else a temporary one, removed
set -euo pipefail
cd "$(dirname "$0")/.."
[ "$(id -u)" -eq 0 ] || { echo "smoke.sh: chroot needs root" >&2; exit 1; }
command -v debootstrap >/dev/null || { echo "smoke.sh: debootstrap is missing (apt-get install debootstrap)" >&2; exit 1; }

cmake --preset release >/dev/null
cmake --build --preset release --target diurna pages
(cd build/release && cpack >/dev/null)

root=${1:-$(mktemp -d)}
[ $# -gt 0 ] || trap 'rm -rf "$root"' EXIT
[ -d "$root/usr" ] || debootstrap --variant=minbase bookworm "$root" >/dev/null
inside() { chroot "$root" env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin HOME=/root DEBIAN_FRONTEND=noninteractive "$@"; }

cp build/release/packages/diurna_*.deb build/release/packages/diurna-dev_*.deb "$root/tmp/"
inside apt-get update -qq
inside sh -c 'apt-get install -y -qq --no-install-recommends --reinstall /tmp/diurna_*.deb >/tmp/apt.log 2>&1' ||
    { tail -5 "$root/tmp/apt.log" >&2; exit 1; }

echo "-- the program"
inside diurna doctor | grep '^data  *  /usr/share/diurna/materials (found)'
inside sh -c 'ldd /usr/bin/diurna | grep "not found"' && exit 1
inside diurna sun --latitude-deg 39.742476 --longitude-deg -105.1786 --time 2003-10-17T12:30:30-07:00 |
    grep '^194\.340' # NREL's SPA example: azimuth 194.34024 degrees
inside diurna check /usr/share/diurna/scenes/jacksboro/scene.toml 2>/dev/null
inside rm -rf /srv/first /srv/out /srv/consumer
inside diurna new /srv/first --dem /usr/share/diurna/scenes/jacksboro/elevation.tif
inside diurna run /srv/first/scene.toml --out /srv/out --set time.duration_h=2 >/dev/null 2>"$root/tmp/run.log" ||
    { tail -5 "$root/tmp/run.log" >&2; exit 1; }
inside diurna verify /srv/out
inside diurna pages --man | sed -n 1p # reads to the end: no broken pipe

echo "-- the libraries"
inside sh -c 'apt-get install -y -qq --no-install-recommends --reinstall /tmp/diurna-dev_*.deb cmake ninja-build g++ \
    >/tmp/apt.log 2>&1' || { tail -5 "$root/tmp/apt.log" >&2; exit 1; }
mkdir -p "$root/srv/consumer"
cp tests/packaging/consumer/* "$root/srv/consumer/"
inside cmake -S /srv/consumer -B /srv/consumer/build -G Ninja -DCMAKE_BUILD_TYPE=Release >/dev/null
inside cmake --build /srv/consumer/build >/dev/null
inside /srv/consumer/build/consumer
echo "smoke.sh: passed"
