#!/usr/bin/env bash
# capture.sh MEANDER SOURCE_DIR: every way to capture a picture of the previewer, without a display; each gives a PNG
# of the size that was asked for, and wrong ones give a line, exit code 2 and no file.
set -uo pipefail
meander=$1 source=$2
unset DISPLAY WAYLAND_DISPLAY
dir=$(mktemp -d)
trap 'rm -rf "$dir"' EXIT
cd "$dir" || exit 1
mkdir out
sed '$a\[film]\nwidth = 48\nheight = 27' "$source/scenes/wax_knot.toml" >scene.toml
failures=0
fail() { echo "FAILED: $*"; failures=$((failures + 1)); }

# size FILE: width and height, from the PNG's header.
size() { od -An -tu1 -j16 -N8 "$1" | { read -r a b c d e f g h; echo "$((((a * 256 + b) * 256 + c) * 256 + d)) $((((e * 256 + f) * 256 + g) * 256 + h))"; }; }

# picture SIZE NAME ARGS…: out/NAME.png must appear, of that size, with nothing said.
picture() {
  local wanted=$1 name=$2 message
  shift 2
  message=$("$meander" capture scene.toml --spp 2 --quiet -o "out/$name.png" "$@" 2>&1) || fail "$*: exit code $?, $message"
  [[ -z $message ]] || fail "$*: says $message"
  [[ -f out/$name.png ]] || { fail "$*: writes nothing"; return; }
  [[ $(size "out/$name.png") == "$wanted" ]] || fail "$*: is $(size "out/$name.png"), not $wanted"
}

# refuse WANTED ARGS…: one line that contains WANTED, exit code 2, and no file.
refuse() {
  local wanted=$1 status=0 message
  shift
  message=$("$meander" capture scene.toml --spp 2 --quiet -o out/refused.png "$@" 2>&1) || status=$?
  [[ $status -eq 2 ]] || fail "$*: exit code $status: $message"
  [[ $message == *"$wanted"* && $(wc -l <<<"$message") -eq 1 ]] || fail "$*: says $message"
  [[ ! -e out/refused.png && ! -e out/step.png ]] || { fail "$*: wrote a file"; rm -f out/refused.png out/step.png; }
}

# differ NAMES…: no two of these pictures are the same.
differ() {
  local different
  different=$(for name in "$@"; do cksum <"out/$name.png"; done | sort -u | wc -l)
  [[ $different -eq $# ]] || fail "$*: only $different different pictures"
}

picture "48 27" film
picture "1280 720" ui --ui
picture "640 400" small --ui --window 640,400
picture "700 500" large --ui --window 700,500 --ui-scale 2
picture "64 64" tiny --ui --window 64,64
panels=(preset material light camera render statistics coefficients)
for panel in "${panels[@]}"; do picture "340 720" "panel-$panel" --panel "$panel"; done
differ ui "${panels[@]/#/panel-}"
views=(image noise samples scatterings length normals luminance clipping)
for view in "${views[@]}"; do
  picture "48 27" "view-$view" --view "$view"
  picture "640 400" "ui-$view" --ui --window 640,400 --view "$view"
done
differ "${views[@]/#/view-}"
differ "${views[@]/#/ui-}"

# The same picture twice gives the same film, and a script plays what a user does.
picture "48 27" again
cmp -s out/film.png out/again.png || fail "the same film is another picture"
cat >script.txt <<'SCRIPT'
wait-image
set material.wax.color=[0.2, 0.4, 0.9]
drag left 100 100 180 120
key 6
wait-spp 1
snapshot out/normals.png
key 1
click 1200 618    # a heading of the panel
snapshot out/unfolded.png
SCRIPT
picture "1280 720" script --ui --script script.txt
[[ -f out/normals.png && -f out/unfolded.png ]] || fail "a script's snapshots are missing"
differ ui script normals

refuse 'glowing' --view glowing
refuse 'kitchen' --panel kitchen
refuse '32' --ui --window 32,32
refuse '--window' --ui --window 640
refuse '--ui-scale' --ui --ui-scale 9
refuse 'nothing.txt' --script nothing.txt
printf 'wait-image\nsnapshoot out/step.png\n' >wrong.txt
refuse "wrong.txt:2:1: there is no command 'snapshoot'; did you mean 'snapshot'?" --script wrong.txt
printf 'wait-image\nset material.jade.g=0\nsnapshot out/step.png\n' >edit.txt
refuse 'edit.txt:2: ' --script edit.txt
printf 'wait-spp 3\n' >late.txt
refuse 'late.txt:1: rendering ends before' --script late.txt
printf 'key Space\n' >paused.txt
picture "1280 720" paused --ui --script paused.txt
# What the scene gives cause to warn of is said as by every other verb.
said=$("$meander" capture scene.toml --spp 1 --ui --set material.wax.mean_free_path=1e-7 -o out/warned.png 2>&1)
[[ $(grep -c 'meander: warning: .*is finite but not accurate' <<<"$said") -eq 1 ]] || fail "--ui of too short a mean free path says: $said"
refuse '--crop' --ui --crop 0,0,8,8
refuse '--stats' --panel light --stats out/stats.json

[[ $failures -eq 0 ]] || { echo "$failures failures"; exit 1; }
echo "every picture was captured, and every wrong one refused in one line"
