#!/usr/bin/env bash
# From a fresh Debian 12 to pictures: installs missing packages, builds the program, renders the default scene into out/demo.
# Says before each step what it does and how long that takes, and shows the first picture as soon as it is there.
set -euo pipefail
cd "$(dirname "$0")"

program=build/release/diurna
scene=scenes/jacksboro/scene.toml
out=out/demo
cores=$(nproc)
core_minutes=14 # of a first build: measured 11.5 on two cores; a slower machine takes longer
begin=$SECONDS

step="the start"
trap 'echo "demo.sh: $step failed; the lines above say why. ./demo.sh continues from there." >&2' ERR

# say N TEXT: announces a step.
say() {
    step="step $1"
    printf '\n[%s/4] %s\n' "$1" "$2"
}

# show FILE: prints its path, and opens it where there is a display.
show() {
    printf '      %s\n' "$PWD/$1"
    if [ -n "${DISPLAY:-}${WAYLAND_DISPLAY:-}" ] && command -v xdg-open >/dev/null; then
        xdg-open "$1" >/dev/null 2>&1 &
    fi
}

say 1 "Packages: compiler and libraries of Debian; 2 minutes if they are missing, else a second."
./setup.sh

if [ -x $program ]; then
    say 2 "Build: only what has changed since the last build."
else
    say 2 "Build: about $(((core_minutes + cores - 1) / cores)) minutes on $cores processors, once. The counter shows the files compiled."
fi
jobs=$(packaging/configure.sh)
cmake --build --preset release --parallel "$jobs" --target diurna

if [ -f $out/report.html ]; then
    say 3 "First picture: there from an earlier demo."
else
    say 3 "First picture: terrain, shadows and the heat balance of a day; about $((60 / cores + 10)) seconds."
    $program run $scene --out $out --resume --only observer=east --only band=8-12 --only frames=14:00..14:00
fi
echo "      14 h, 8 to 12 um, apparent temperature:"
show $out/frames/east_8-12_20260715T180000Z.png

say 4 "All 48 pictures of the day, labels and the report; about $((30 / cores + 5)) seconds."
$program run $scene --out $out --resume
echo "      Report with a slider through the day:"
show $out/report.html

cat <<END

Done in $((SECONDS - begin)) seconds. Try next (each takes a minute or two on two processors):
  a place of your own      $program new my_place --dem YOUR_ELEVATION.tif && $program run my_place/scene.toml --out out/my_place
  when things look alike   $program crossover scenes/crossover/scene.toml --out out/crossover
  cameras with noise       $program run scenes/instruments/scene.toml --out out/instruments
The tutorial is docs/tutorial.md; every page is listed in docs/index.md.
END
