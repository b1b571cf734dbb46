#!/usr/bin/env bash
# budgets.sh MEANDER SOURCE_DIR: time limits are kept on scenes that are hard on them, and films of one pixel and of 4096 x 4096.
# With --large the whole of the large film, which takes some gigabytes.
set -uo pipefail
meander=$1 source=$2 large=${3:-}
dir=$(mktemp -d)
trap 'rm -rf "$dir"' EXIT
cd "$dir" || exit 1
mkdir out
failures=0
fail() { echo "FAILED: $*"; failures=$((failures + 1)); }

# scene FREE_PATH SIZE: a white ball of radius 1 in a furnace.
scene() {
  cat <<TOML
[camera]
look_from = [0, 0, 5]
look_at = [0, 0, 0]
orthographic_height = 2.5
[film]
width = $2
height = $2
[environment]
radiance = 1
[[material]]
name = "m"
albedo = 1
mean_free_path = $1
[[object]]
name = "ball"
shape = "sphere"
material = "m"
TOML
}
scene 0.0002 64 >dense.toml
scene 0.000002 64 >denser.toml
# A path that a glass cube never lets out, from a camera within it; it has a collision in 10^12 walks.
scene 1e12 64 | sed -e 's/look_from.*/look_from = [0.1, 0.2, 0.3]/' -e 's/look_at.*/look_at = [1.1, 1.2, 1.3]/' \
  -e 's/orthographic.*/vertical_fov = 10/' -e 's/"sphere"/"box"/' -e 's/^albedo.*/&\nboundary = "dielectric"\nior = 1.5/' >trap.toml
# A path that goes to and fro between the walls of a white room and a ball in it, in short walks.
{
  scene 1e6 64 | sed -e 's/look_from.*/look_from = [0.9, 0.9, 0.9]/' -e 's/orthographic.*/vertical_fov = 40/'
  echo 'transform = { scale = 0.9 }'
  printf '[[material]]\nname = "white"\ntype = "diffuse"\ncolor = 1\n[[object]]\nname = "room"\nshape = "box"\nmaterial = "white"\n'
} >room.toml
scene 0.5 1 >pixel.toml
scene 0.5 4096 >large.toml

# value FILE.json KEY
value() { python3 -c 'import json, sys; print(json.load(open(sys.argv[1]))[sys.argv[2]])' "$1" "$2"; }

# kept SCENE LIMIT MORE ARGS…: the limit ends the run within 1 % or one pass, a pass being a twentieth of the limit or one sample a
# pixel, and what is written is what a run of as many samples writes. The last pass may be broken off and count for nothing, so that the
# passes of the image are no longer than that; the program, MORE milliseconds aside (as below), ends then, and no sooner.
kept() {
  local input=$1 limit=$2 more=$3 spp status=0 begin passed
  shift 3
  rm -f out/*
  begin=$(date +%s%N)
  timeout 120 "$meander" render "$input" "$@" --quiet --time "$limit" -o out/timed.exr --stats timed.json || status=$?
  passed=$((($(date +%s%N) - begin) / 1000000))
  [[ $status -eq 0 ]] || { fail "$input --time $limit $*: exit code $status"; return; }
  spp=$(value timed.json spp)
  python3 - "$limit" "$more" "$passed" <<'PY' || fail "$input --time $limit $*: $(value timed.json seconds) s for $spp samples a pixel, $passed ms in all"
import json, sys
run, (limit, more, passed) = json.load(open('timed.json')), map(float, sys.argv[1:])
a_pass = max(limit / 20, run['seconds'] / run['spp'])
ok = run['spp'] > 0 and run['seconds'] <= 1.01 * limit + a_pass
ok = ok and limit - a_pass <= passed / 1000 <= 1.01 * limit + a_pass + more / 1000
sys.exit(not (ok and run['non_finite'] == 0 and run['leaked_walks'] == 0))
PY
  "$meander" render "$input" "$@" --quiet --spp "$spp" -o out/counted.exr || fail "$input --spp $spp"
  cmp -s out/timed.exr out/counted.exr || fail "$input: --time $limit and --spp $spp are not the same bytes"
}

# too_short SCENE LIMIT MORE ARGS…: no pass ends in it; a line says so, with exit code 3, at the limit, and nothing is written.
# MORE milliseconds are for the start of the program, the making of the film and a machine that does other things.
too_short() {
  local input=$1 limit=$2 more=$3 status=0 message begin passed
  shift 3
  rm -f out/*
  begin=$(date +%s%N)
  message=$(timeout 120 "$meander" render "$input" "$@" --quiet --time "$limit" -o out/a.exr 2>&1) || status=$?
  passed=$((($(date +%s%N) - begin) / 1000000))
  [[ $status -eq 3 ]] || fail "$input --time $limit: exit code $status"
  [[ $message == *"no pass was complete within --time $limit (seconds)"* && $(wc -l <<<"$message") -eq 1 ]] || fail "$input --time $limit says: $message"
  [[ -z $(ls -A out) ]] || fail "$input --time $limit left $(ls -A out)"
  [[ $passed -lt $(python3 -c "print(int(1010 * $limit + $more))") ]] || fail "$input --time $limit took $passed ms"
}

for walk in batch scalar; do
  kept dense.toml 2 1500 --walk $walk --width 16 --height 16
  too_short denser.toml 0.3 1500 --walk $walk
  too_short trap.toml 0.3 1500 --walk $walk
  too_short room.toml 0.3 1500 --walk $walk
done

# One pixel, and a corner and the middle of 4096 x 4096, by both doors; the furnace is 1.
"$meander" render pixel.toml --quiet --spp 64 -o out/pixel.exr --stats pixel.json || fail "a film of one pixel"
"$meander" capture pixel.toml --quiet --spp 64 -o out/pixel.png || fail "a picture of one pixel"
python3 - pixel.json <<'PY' || fail "one pixel: $(cat pixel.json)"
import json, sys
run = json.load(open(sys.argv[1]))
sys.exit(not (run['width'] == run['height'] == 1 and all(abs(v - 1) < 1e-5 for v in run['mean']) and run['non_finite'] == 0))
PY
for crop in 2040,2040,2056,2056 4080,4080,4096,4096; do
  "$meander" render large.toml --quiet --spp 16 --crop $crop -o out/crop.exr --stats crop.json || fail "--crop $crop of 4096 x 4096"
  python3 -c "import json; run = json.load(open('crop.json')); assert all(abs(v - 1) < 1e-5 for v in run['mean']), run" || fail "--crop $crop"
done
# What cannot be right is said in one line, and the image is there.
says() {
  local wanted=$1 message
  shift
  message=$("$meander" "$@" --spp 4 --width 8 --height 8 -o out/said.exr --stats said.json 2>&1) || fail "$*: $message"
  [[ $(grep -c 'meander: warning: ' <<<"$message") -eq 1 && $message == *"meander: warning: $wanted"* ]] || fail "$* says: $message"
  [[ $(value said.json non_finite) == 0 && -s out/said.exr ]] || fail "$*: $(cat said.json)"
}
says "object 'ball': a mean free path of 2e-06 of its half size is finite but not accurate" render denser.toml
{
  cat dense.toml
  printf '[[object]]\nname = "kernel"\nshape = "sphere"\nmaterial = "m"\ntransform = { scale = 0.5 }\n'
} >nested.toml
says "objects 'ball' and 'kernel' overlap" render nested.toml --set material.m.mean_free_path=0.5
says "objects 'ball' and 'kernel' overlap" render nested.toml --set material.m.mean_free_path=0.5 --set object.kernel.transform.translate=[1.2,0,0] --walk scalar
status=0
message=$("$meander" render dense.toml --spp 1 --width 8 --height 8 -o out/said.exr 2>&1) || status=$?
[[ $status -eq 0 && $message != *warning* ]] || fail "a mean free path of 2e-4: $message"

said="a film of one pixel and crops of 4096 x 4096"

if [[ $large == --large ]]; then
  too_short large.toml 0.05 60000  # half the 4 GiB that a film of this size takes are made before the clock starts
  kept large.toml 12 60000
  "$meander" render large.toml --quiet --spp 1 -o out/large.exr --stats large.json || fail "4096 x 4096"
  python3 -c "import json; run = json.load(open('large.json')); assert all(abs(v - 1) < 1e-5 for v in run['mean']), run" || fail "4096 x 4096 is not white"
  "$meander" capture large.toml --quiet --spp 1 -o out/large.png || fail "a picture of 4096 x 4096"
  said="4096 x 4096: $(($(value large.json peak_memory_bytes) >> 20)) MiB, $(value large.json seconds) s a sample a pixel"
fi
[[ $failures -eq 0 ]] || { echo "$failures failures"; exit 1; }
echo "time limits are kept; $said"
