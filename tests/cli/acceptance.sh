#!/usr/bin/env bash
# acceptance.sh MEANDER SOURCE_DIR: the commands that users and scripts rely on, end to end.
set -euo pipefail
meander=$1 source=$2
dir=$(mktemp -d)
trap 'rm -rf "$dir"' EXIT
cd "$dir"
fail() { echo "FAILED: $*"; exit 1; }

# The furnace: every pixel of sphere and background is 1.
"$meander" render "$source/scenes/sphere_furnace.toml" -o f.exr --spp 4 --stats f.json --quiet
python3 - <<'PY' || fail "the statistics of the furnace"
import json
s = json.load(open('f.json'))
keys = '''version scene seed first_sample threads isa width height spp seconds walks steps rays walks_per_second
steps_per_second mean relative_noise noise_standard_error noise_reliable ended_by leaked_walks non_finite peak_memory_bytes model estimator'''.split()
assert sorted(s) == sorted(keys), sorted(s)
assert s['spp'] == 4 and s['leaked_walks'] == 0 and s['non_finite'] == 0 and s['steps'] > s['walks'] > 0, s
assert all(abs(m - 1) < 1e-6 for m in s['mean']), s['mean']
PY
# White everywhere, as a PFM, is what the furnace is compared with.
python3 - <<'PY'
import struct
open('white.pfm', 'wb').write(b'PF\n256 256\n-1.0\n' + struct.pack('<f', 1.0) * (256 * 256 * 3))
PY
"$meander" compare f.exr white.pfm --max-relmse 1e-10 > furnace.txt || fail "the furnace is not white"
awk '$1 == "max_abs" { exit !($2 < 1e-5) }' furnace.txt || fail "a furnace pixel is off by more than 1e-5"

# Threads do not show in the bytes; the seed does.
scene=$source/scenes/wax_knot.toml
small=(--spp 3 --width 96 --height 54 --quiet)
"$meander" render "$scene" -o one.exr "${small[@]}" --threads 1
"$meander" render "$scene" -o two.exr "${small[@]}" --threads 2
"$meander" render "$scene" -o other.exr "${small[@]}" --seed 1
cmp one.exr two.exr || fail "the bytes depend on the threads"
"$meander" compare one.exr two.exr --quiet || fail "equal images compare as different"
status=0
"$meander" compare one.exr other.exr --quiet || status=$?
[ $status -eq 1 ] || fail "another seed gives the same image (exit code $status)"
"$meander" compare one.exr other.exr --quiet --max-relmse 1000 || fail "--max-relmse does not allow a difference"

# A captured picture carries where it came from.
"$meander" capture "$scene" -o wax.png "${small[@]}" --exposure -1
head -c 8 wax.png | od -An -tx1 | grep -q '89 50 4e 47' || fail "wax.png is not a PNG"
for attribute in meander/scene meander/spp meander/seed meander/version; do
  grep -aq "$attribute" wax.png || fail "the PNG does not carry $attribute"
  grep -aq "$attribute" one.exr || fail "the EXR does not carry $attribute"
done

# The tone curve is the scene's, unless the command line says another.
"$meander" capture "$scene" -o plain.png "${small[@]}"
"$meander" capture "$scene" -o filmic.png "${small[@]}" --tone filmic
"$meander" capture "$scene" -o scene.png "${small[@]}" --set display.tone=filmic
"$meander" capture "$scene" -o told.png "${small[@]}" --set display.tone=filmic --tone srgb
python3 - <<'PY' || fail "the tone curve"
import zlib
def pixels(name):
    data, at, packed = open(name, 'rb').read(), 8, b''
    while at < len(data):
        size = int.from_bytes(data[at:at + 4], 'big')
        if data[at + 4:at + 8] == b'IDAT':
            packed += data[at + 8:at + 8 + size]
        at += 12 + size
    return zlib.decompress(packed)
plain, filmic, scene, told = (pixels(name + '.png') for name in ('plain', 'filmic', 'scene', 'told'))
assert plain == told and filmic == scene and plain != filmic
PY

# A bare mesh is shown in the studio.
"$meander" capture "$source/scenes/soap.ply" -o soap.png "${small[@]}"

# Measurements agree with adding-doubling within four standard errors.
for estimator in implicit analog; do
  "$meander" measure slab --tau 2 --albedo 0.9 --g 0.75 --incidence normal --walks 1000000 --json --estimator $estimator > slab.json
  python3 - <<'PY' || fail "the slab, $estimator"
import json
m = json.load(open('slab.json'))
for name, exact in (('reflectance', 0.0973946), ('transmittance', 0.6609577)):
    q = m[name]
    z = (q['value'] - exact) / q['standard_error']
    assert abs(z) < 4, (name, q, z)
PY
done
"$meander" measure sphere --tau-radius 10 --albedo 1 --incidence diffuse --json > sphere.json
python3 - <<'PY' || fail "the mean path of the sphere"
import json
q = json.load(open('sphere.json'))['mean_path_length']
assert abs(q['value'] - 40 / 3) < 4 * q['standard_error'], q
PY
[ "$("$meander" measure slab --albedo 0.1:0.9:9 --walks 1000 | wc -l)" -eq 10 ] || fail "a range is not a table"

# A colour is a half-space's in uniform light: nothing else is held to it.
color() { "$meander" measure "$@" --color 0.5 --walks 2000; }
color halfspace | grep -q '^color asked 0.5' || fail "a colour asked for is not shown"
! color slab | grep -q '^color' || fail "a slab is held to the colour of a half-space"
! color sphere | grep -q '^color' || fail "a sphere is held to the colour of a half-space"
! color halfspace --incidence normal | grep -q '^color' || fail "a beam is held to the colour of uniform light"
color halfspace --csv | python3 -c '
import csv, sys
(row,) = csv.DictReader(sys.stdin)
asked, delivered, difference = (float(row["color_" + name]) for name in ("asked", "delivered", "difference"))
assert asked == 0.5 and abs(delivered - asked - difference) < 1e-8, row' || fail "the colour in CSV"

# The mean paths of reflected and transmitted light are in every form of the path-resolved output.
paths=(measure slab --sigma-s 10 --sigma-a 0.1 --thickness 0.5 --path-bins 4 --path 2 --walks 20000)
"$meander" "${paths[@]}" --json > paths.json
"$meander" "${paths[@]}" --csv > paths.csv
"$meander" "${paths[@]}" | sed '1,/^$/d' | cmp - paths.csv || fail "the bins in the text differ from CSV"
python3 - <<'PY' || fail "the mean paths"
import csv, json
means = json.load(open('paths.json'))
rows = {row['quantity']: row for row in csv.DictReader(open('paths.csv'))}
for name in ('mean_path_reflected', 'mean_path_transmitted'):
    for key in ('value', 'standard_error'):
        assert abs(float(rows[name][key]) / means[name][key] - 1) < 1e-8, (name, key)
PY

# An interrupt ends the pass, keeps what was complete, and is no failure.
"$meander" render "$scene" -o stopped.exr --spp 1000000 --width 96 --height 54 2> stopped.txt &
process=$!
for ((i = 0; i < 600; ++i)); do
  [ -s stopped.txt ] && break  # the first line of progress
  sleep 0.1
done
kill -INT $process
status=0
wait $process || status=$?
[ $status -eq 0 ] || fail "an interrupt gives exit code $status: $(cat stopped.txt)"
grep -q interrupted stopped.txt || fail "an interrupt goes unmentioned"
[ -s stopped.exr ] || fail "an interrupt loses the image"
[ -z "$(find . -name '*.partial-*')" ] || fail "a partial file is left"
echo "all commands keep their promises"
