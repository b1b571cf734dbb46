#!/usr/bin/env bash
# compare.sh MEANDER SOURCE_DIR: every metric, limit, format and message of `meander compare`, against images whose
# numbers are worked out by hand, and the z-test on renders.
set -euo pipefail
meander=$1 source=$2
here=$(cd -- "$(dirname -- "${BASH_SOURCE[0]}")" && pwd -P)
export PYTHONPATH=$here PYTHONDONTWRITEBYTECODE=1
dir=$(mktemp -d)
trap 'rm -rf "$dir"' EXIT
cd "$dir"
fail() { echo "FAILED: $*"; exit 1; }

# expect STATUS MESSAGE ARGS…: `compare ARGS` ends with STATUS and says exactly MESSAGE on standard error; its
# standard output is in out.txt.
expect() {
  local wanted=$1 message=$2 status=0
  shift 2
  "$meander" compare "$@" >out.txt 2>err.txt || status=$?
  [ $status -eq "$wanted" ] || fail "compare $*: exit code $status, not $wanted: $(cat err.txt)"
  [ "$(cat err.txt)" = "$message" ] || fail "compare $*: says '$(cat err.txt)', not '$message'"
  [ "$wanted" -ne 2 ] || [ ! -s out.txt ] || fail "compare $*: prints in spite of the error: $(cat out.txt)"
}

# value NAME FIELD NUMBER: what out.txt holds, to 6 digits.
value() {
  awk -v name="$1" -v field="$2" -v x="$3" \
    '$1 == name { found = 1; d = $field - x; exit !(d * d <= 1e-12 * (x * x + 1e-9)) } END { if (!found) exit 1 }' \
    out.txt || fail "$1 (field $2) is not $3: $(grep "^$1 " out.txt)"
}

python3 - <<'PY'
from images import *
nan = float('nan')
# d = 0 1 / -1 2
write_pfm('a.pfm', grey([1, 2], [3, 4]))
write_pfm('b.pfm', grey([1, 1], [4, 2]))
write_pfm('wide.pfm', grey([1, 1, 4, 2]))
write_pfm('nan.pfm', (2, 2, [[(1, 1, 1), (nan, 2, 2)], [(3, 3, 3), (4, 4, float('inf'))]]))
names = ('R', 'G', 'B', 'variance.R', 'variance.G', 'variance.B')
variances = lambda image, rows: (image[0], image[1], [[p + v for p, v in zip(*r)] for r in zip(image[2], rows)])
va = [[(0.09, 0, 0), (0.16, 0, 0)], [(0.0, 0, 0), (0.0, 0, 0)]]
vb = [[(0.24, 0, 0.04), (0.51, 0, 0)], [(0.0, 0, 0), (0.0, 0, 0)]]
write_exr('a.exr', variances(grey([1, 2], [3, 4]), va), names)
write_exr('b.exr', variances(grey([1, 1], [4, 2]), vb), names)
# The second and the third pixel.
write_png('mask.png', (2, 2, [[(0, 0, 0), (0, 0, 255)], [(9, 9, 9), (0, 0, 0)]]))
write_png('black.png', (2, 2, [[(0, 0, 0, 255)] * 2] * 2))
write_png('grey.png', (2, 1, [[(255,), (255,)]]))
PY

# Metrics. mean d^2 = 6/4, mean |b| = 2, mean |d| = 1, mean d = 1/2; the spread of d: variance 5/3, error sqrt(5/12).
unequal='failed: the images differ, at most by 2 (pixel 1,1 R), and no threshold allows it'
expect 1 "$unequal" a.pfm b.pfm
value pixels 2 4
value rmse 2 1.224744871
value relative_rmse 2 0.6123724357
value relmse 2 0.5155937  # (1/1.0001 + 1/16.0001 + 4/4.0001) / 4
value mae 2 1
value psnr 2 -1.76091
value mean_signed 2 0.5
value mean_signed 4 0.645
value mean_signed_G 4 0.645
value max_abs 2 2
value non_finite 2 0
grep -q '^mean_signed .*(spread over pixels)$' out.txt || fail "the origin of the error is not said"
grep -q '^result  *FAILED$' out.txt || fail "no result"
! grep -q noise out.txt || fail "noise without variances"
expect 0 '' a.pfm a.pfm --max-rmse 0 --min-psnr 1000
grep -q '^psnr  *inf dB$' out.txt || fail "the PSNR of equal images: $(grep psnr out.txt)"
value mean_signed 4 0
grep -q '^result  *passed$' out.txt || fail "no result of equal images"

# Variances. R: sqrt(0.09 + 0.16 + 0.24 + 0.51) / 4 = 1/4; B: sqrt(0.04) / 4. All: the pixels' sums of roots are
# sqrt(0.33) + 0.2 and sqrt(0.67), the root of the sum of their squares over 12 is 0.0939.
expect 1 "$unequal" a.exr b.exr
value mean_signed_R 4 0.25
value mean_signed_G 4 0
value mean_signed_B 4 0.05
value mean_signed 4 0.0939
grep -q '^mean_signed .*(variances of A and B)$' out.txt || fail "the origin of the error is not said"
# All four pixels are neighbours, of mean 2.5 and 2: sqrt((0.09 + 0.16) / 6.2501 / 12), sqrt((0.24 + 0.04 + 0.51) / 4.0001 / 12).
value relative_noise_a 2 0.0577346
value relative_noise_b 2 0.128288
expect 1 "$unequal" a.exr b.pfm
value mean_signed_R 4 0.125
grep -q '^mean_signed .*(variance of A alone)$' out.txt || fail "the variance of A alone is not said"
! grep -q relative_noise_b out.txt || fail "noise of an image without variances"

cp a.exr mine.exr
expect 2 'meander: mine.exr: --output would overwrite an input; use another name' mine.exr b.exr -o mine.exr
cmp -s a.exr mine.exr || fail "an input was overwritten"

# Every limit by its option: all of them a little beyond the value, then a little short of it. (tests/app tests each
# alone.)
expect 0 '' a.pfm b.pfm --max-mae 1 --max-rmse 1.225 --max-relative-rmse 0.613 --max-relmse 0.516 --min-psnr -1.77 \
  --fail 1 --fail-percent 25 --hard-fail 2 --warn 0 --warn-percent 75 --hard-warn 2
value beyond_fail 2 1
value beyond_warn 2 3
warnings='warning: 3 of 4 pixels (75 %) differ by more than --warn 0, above --warn-percent 74
warning: the largest difference is 2 (pixel 1,1 R), above --hard-warn 1'
expect 1 "failed: rmse is 1.22474487, above --max-rmse 1.224
failed: relative_rmse is 0.612372436, above --max-relative-rmse 0.612
failed: relmse is 0.515593655, above --max-relmse 0.515
failed: mae is 1, above --max-mae 0.999
failed: psnr is -1.76091259 dB, below --min-psnr -1.76
failed: 1 of 4 pixels (25 %) differ by more than --fail 1, above --fail-percent 24
failed: the largest difference is 2 (pixel 1,1 R), above --hard-fail 1.5
$warnings" a.pfm b.pfm --max-mae 0.999 --max-rmse 1.224 --max-relative-rmse 0.612 --max-relmse 0.515 --min-psnr -1.76 \
  --fail 1 --fail-percent 24 --hard-fail 1.5 --warn 0 --warn-percent 74 --hard-warn 1
# Warnings leave the exit code alone; --quiet silences them, but not what fails.
expect 0 "$warnings" a.pfm b.pfm --fail 2 --warn-percent 74 --hard-warn 1
expect 0 '' a.pfm b.pfm --fail 2 --hard-warn 1 -q
[ ! -s out.txt ] || fail "-q prints"
hard='failed: the largest difference is 2 (pixel 1,1 R), above --hard-fail 1.5'
expect 1 "$hard" a.pfm b.pfm --hard-fail 1.5 --hard-warn 1 --quiet
[ ! -s out.txt ] || fail "--quiet prints"

# JSON says the same.
expect 1 "$hard
warning: 1 of 4 pixels (25 %) differ by more than --warn 1, above --warn-percent 0" a.exr b.exr --json --hard-fail 1.5 --fail 1 --fail-percent 25 --warn 1
python3 - <<'PY' || fail "the JSON: $(cat out.txt)"
import json
j = json.load(open('out.txt'))
near = lambda x, y: abs(x - y) < 1e-6
assert list(j) == '''passed failures warnings pixels rmse relative_rmse relmse mae psnr mean_signed mean_signed_rgb max_abs
max_abs_at non_finite relative_noise_a relative_noise_b noise_a noise_b variance_a variance_b beyond_fail beyond_warn
z_test'''.split(), list(j)
assert j['passed'] is False and len(j['failures']) == len(j['warnings']) == 1 and '--hard-fail' in j['failures'][0]
assert near(j['rmse'], 1.5 ** 0.5) and j['mae'] == 1 and near(j['psnr'], -1.760912591) and j['pixels'] == 4
assert j['mean_signed']['value'] == 0.5 and j['mean_signed']['error_from'] == 'variances of A and B'
assert near(j['mean_signed_rgb'][0]['standard_error'], 0.25) and j['mean_signed_rgb'][2]['value'] == 0.5
assert j['max_abs_at'] == {'x': 1, 'y': 1, 'channel': 'R'} and j['z_test'] is None
assert j['noise_a'] == j['noise_b'] == {'over': 'all', 'pixels': 4}
assert j['variance_a'] == {'reliable': False, 'doubt': 'too few pixels to tell it within 10 %'}, j['variance_a']
assert near(j['relative_noise_a'], 0.05773457) and j['beyond_fail'] == j['beyond_warn'] == 1
PY

# The mask: d = 1 and -1 are left.
expect 0 '' a.pfm b.pfm --mask mask.png --hard-fail 1
value pixels 2 2
value mae 2 1
value mean_signed 2 0
value relative_rmse 2 0.4  # 1 / mean(1, 4)
expect 2 'meander: black.png: the mask is black everywhere: no pixel would be compared' a.pfm b.pfm --mask black.png
expect 2 'meander: grey.png: the mask has 2 x 1 pixels, but the images have 2 x 2' a.pfm b.pfm --mask grey.png

# What is not finite fails whatever else is allowed.
expect 1 'failed: values that are not finite in A or B: 2' nan.pfm a.pfm --max-relmse 1000
value non_finite 2 2

# Every format, against the PFM; RGBE and levels hold these values exactly.
python3 - <<'PY'
from images import *
exact = (3, 2, [[(1, 0.5, 0.25), (0, 0, 0), (4, 2, 1)], [(0.125, 0.25, 0.5), (3, 3, 3), (0.75, 0.5, 0.25)]])
for write, name in ((write_pfm, 'f.pfm'), (write_hdr, 'f.hdr'), (write_exr, 'f.exr'), (write_tiff, 'f.tiff')):
    write(name, exact)
levels = (3, 2, [[(255, 128, 0), (1, 2, 3), (10, 11, 12)], [(200, 100, 50), (77, 77, 77), (254, 5, 250)]])
decode = lambda v: v / 12.92 if v <= 0.04045 else ((v + 0.055) / 1.055) ** 2.4  # IEC 61966-2-1
write_pfm('levels.pfm', (3, 2, [[tuple(decode(v / 255) for v in p) for p in row] for row in levels[2]]))
write_png('levels.png', levels)
write_png('alpha.png', (3, 2, [[p + (7,) for p in row] for row in levels[2]]))
write_png('levels16.png', (3, 2, [[tuple(257 * v for v in p) for p in row] for row in levels[2]]), 16)
write_tiff('levels.tif', levels, 8)
write_pfm('one.pfm', (2, 1, [[(0.5,), (2,)]]))
write_pfm('three.pfm', grey([0.5, 2]))
PY
for name in f.hdr f.exr f.tiff; do expect 0 '' $name f.pfm; done
for name in levels.png alpha.png levels16.png levels.tif; do expect 0 '' $name levels.pfm --hard-fail 1e-6; done
expect 0 '' one.pfm three.pfm

# The difference, and its picture.
expect 1 "$unequal" a.pfm b.pfm -o d.exr
masked='failed: the images differ, at most by 1 (pixel 1,0 R), and no threshold allows it'
expect 1 "$masked" a.pfm b.pfm --output abs.exr --abs --scale 2 --mask mask.png
python3 - <<'PY'
from images import *
write_pfm('d.pfm', grey([0, 1], [-1, 2]))
write_pfm('abs.pfm', grey([0, 2], [2, 0]))
# The divisor |b| + 0.01 is 1: relative errors 0, +0.1, -0.05, -0.99, none.
write_pfm('pa.pfm', grey([0.99, 1.09, 0.94, 0, float('nan')]))
write_pfm('pb.pfm', grey([0.99] * 5))
write_png('left.png', (5, 1, [[(255, 255, 255)] * 3 + [(0, 0, 0)] * 2]))
PY
expect 0 '' d.exr d.pfm
expect 0 '' abs.exr abs.pfm
nan='failed: values that are not finite in A or B: 3'
expect 1 "$nan" pa.pfm pb.pfm -o signed.png --max-mae 9
grep -q '^picture .*full colour at 0.1;' out.txt || fail "the colours are not said: $(tail -1 out.txt)"
expect 1 "$nan" pa.pfm pb.pfm -o unsigned.png --max-mae 9 --abs --scale 1
expect 0 '' pa.pfm pb.pfm -o masked.png --max-mae 9 --mask left.png --scale 5
python3 - <<'PY' || fail "the colours of the pictures"
import math
from images import *


def levels(lightness, chroma, degrees):  # OKLab to sRGB, B. Ottosson 2020
    a, b = (chroma * f(math.radians(degrees)) for f in (math.cos, math.sin))
    l, m, s = ((lightness + p * a + q * b) ** 3 for p, q in (
        (0.3963377774, 0.2158037573), (-0.1055613458, -0.0638541728), (-0.0894841775, -1.2914855480)))
    linear = (4.0767416621 * l - 3.3077115913 * m + 0.2309699292 * s,
              -1.2684380046 * l + 2.6097574011 * m - 0.3413193965 * s,
              -0.0041960863 * l - 0.7034186147 * m + 1.7076147010 * s)
    return [255 * (12.92 * x if x <= 0.0031308 else 1.055 * x ** (1 / 2.4) - 0.055) for x in linear]


def near(found, wanted):
    assert all(abs(f - w) <= 1.5 for f, w in zip(found, wanted)), (found, wanted)


orange, blue = 45, 245
(row,), texts = read_png('signed.png')
for pixel, color in zip(row, (levels(0.20, 0, 0), levels(0.75, 0.13, orange), levels(0.475, 0.065, blue),
                              levels(0.75, 0.13, blue), (0, 255, 0))):
    near(pixel, color)
assert 'orange A brighter' in texts['meander/picture'] and 'full colour at 0.1;' in texts['meander/picture'], texts
(row,), texts = read_png('unsigned.png')
for pixel, t in zip(row, (0, 0.1, 0.05, 0.99)):
    near(pixel, levels(0.20 + 0.75 * t, 0.1 + 0.045 * t, 165 * t - 60))
assert row[4] == (0, 255, 0) and 'light yellow 1;' in texts['meander/picture'], texts
(row,), texts = read_png('masked.png')
near(row[1], levels(0.475, 0.065, orange))
assert row[3] == row[4] == (0, 0, 0), row
PY

# Wrong use: exit code 2, one line, nothing written.
help='(see: meander compare --help)'
expect 2 'meander: the images differ in size: a.pfm has 2 x 2 and wide.pfm 4 x 1 pixels; they must be equal' \
  a.pfm wide.pfm -o no.exr
expect 2 'meander: a.pfm: carries no variance channels, which --z-test needs' a.pfm b.exr --z-test -o no.exr
expect 2 "meander: --fail: is '-1', but must be a number, 0 or more $help" a.pfm b.pfm --fail -1
expect 2 "meander: --fail-percent: is '101', but must be a number from 0 to 100 $help" a.pfm b.pfm --fail-percent 101
expect 2 "meander: --scale: is '0', but must be a number greater than 0 $help" a.pfm b.pfm --scale 0 -o no.png
expect 2 "meander: --scale requires --output $help" a.pfm b.pfm --scale 2
expect 2 "meander: --json excludes --quiet $help" a.pfm b.pfm --json --quiet
expect 2 "meander: --output: is '', but must be the name of a file or folder $help" a.pfm b.pfm -o ''
expect 2 "meander: --mask: is '', but must be the name of a file or folder $help" a.pfm b.pfm --mask ''
# A report that cannot be printed is no success, of whatever verb.
for arguments in 'compare a.pfm a.pfm' 'compare a.pfm a.pfm --json' 'compare --help' 'measure slab --tau 1 --walks 100' \
  "convert $source/scenes/wax_knot.toml --to cycles"; do
  status=0
  "$meander" $arguments >/dev/full 2>err.txt || status=$?
  [ $status -eq 3 ] && [ "$(cat err.txt)" = 'meander: cannot write to standard output' ] ||
    fail "$arguments to a full device: exit code $status, $(cat err.txt)"
done
cp a.pfm a.jpg
status=0
"$meander" compare a.jpg b.pfm >out.txt 2>err.txt || status=$?
[ $status -eq 2 ] && [ "$(wc -l <err.txt)" -eq 1 ] && grep -q '\.exr, \.hdr, \.pfm, \.png, \.tif' err.txt ||
  fail "a.jpg: exit code $status, $(cat err.txt)"
status=0
"$meander" compare a.pfm b.pfm -o no.jpg >out.txt 2>err.txt || status=$?
[ $status -eq 2 ] && grep -q '\.exr.*\.png' err.txt || fail "no.jpg: exit code $status, $(cat err.txt)"
[ -z "$(find . -name 'no.*')" ] || fail "wrong use has written $(find . -name 'no.*')"

# The z-test on renders of 8 samples a pixel: the same lights pass, lights that are 3 % brighter fail by the whole image
# though every value alone passes, whether or not the two share their random numbers.
scene=$source/scenes/wax_knot.toml
small=(--spp 8 --width 160 --height 90 --quiet)
brighter=(--set 'environment.radiance=[0.0927, 0.1133, 0.1545]' --set 'light.back.radiance=[45.32, 39.14, 30.9]'
  --set 'light.key.radiance=[2.678, 2.884, 3.296]')
"$meander" render "$scene" -o base.exr "${small[@]}"
"$meander" render "$scene" -o other.exr "${small[@]}" --seed 1
"$meander" render "$scene" -o bright.exr "${small[@]}" "${brighter[@]}"
"$meander" render "$scene" -o bright_other.exr "${small[@]}" --seed 1 "${brighter[@]}"
expect 0 '' other.exr base.exr --z-test
for name in bright bright_other; do
  status=0
  "$meander" compare $name.exr base.exr --z-test >out.txt 2>err.txt || status=$?
  [ $status -eq 1 ] || fail "$name: lights 3 % brighter pass: exit code $status"
  grep -q '^  values  *passed: 0.0000 %' out.txt || fail "$name: a value alone shows it: $(cat out.txt)"
  grep -q '^  image  *FAILED' out.txt || fail "$name: the image's mean does not show it: $(cat out.txt)"
  grep -q '^failed: z-test: the whole image is brighter in A, z ' err.txt || fail "$name: says $(cat err.txt)"
done

# A single sample has no variance.
"$meander" render "$scene" -o single.exr --spp 1 --width 24 --height 16 --quiet
expect 2 'meander: single.exr: carries no variance channels, which --z-test needs' single.exr single.exr --z-test

# One noise metric: inside the knot, where every pixel counts, compare's is that of the render's statistics.
"$meander" render "$scene" -o crop.exr --spp 8 --width 240 --height 135 --crop 110,12,120,20 --stats crop.json --quiet
expect 0 '' crop.exr crop.exr
python3 - <<'PY' || fail "compare's noise is not the render's: $(grep noise out.txt)"
import json
noise = json.load(open('crop.json'))['relative_noise']
found = [float(line.split()[1]) for line in open('out.txt') if line.startswith('relative_noise')]
assert len(found) == 2 and all(abs(f / noise - 1) < 2e-5 for f in found), (found, noise)
PY

# Of the whole film, the render's noise is the object's; its file carries that, and a mask asks for its own pixels.
"$meander" render "$scene" -o film.exr "${small[@]}" --stats film.json
write_mask='from images import *; write_png("half.png", (160, 90, [[(255 * (x < 80),) * 3 for x in range(160)]] * 90))'
python3 -c "$write_mask"
expect 0 '' film.exr base.exr --json
cp out.txt whole.json
expect 0 '' film.exr base.exr --json --mask half.png
python3 - <<'PY' || fail "the noise of a film: $(cat whole.json)"
import json
stats, whole, half = (json.load(open(name)) for name in ('film.json', 'whole.json', 'out.txt'))
assert whole['relative_noise_a'] == whole['relative_noise_b'] == stats['relative_noise'], stats['relative_noise']
assert whole['noise_a']['over'] == 'object' and 1000 < whole['noise_a']['pixels'] < 14400, whole['noise_a']
assert half['noise_a'] == {'over': 'mask', 'pixels': 7200} and half['relative_noise_a'] != stats['relative_noise']
assert whole['variance_a'] == {'reliable': True, 'doubt': None}
PY

# Caustics: the variances say little, which the verdict says.
glass=$source/scenes/glass_ball.toml
"$meander" render "$glass" -o glass.exr "${small[@]}"
"$meander" render "$glass" -o glass64.exr --spp 64 --width 160 --height 90 --quiet --seed 1
expect 0 '' glass.exr glass64.exr --z-test
grep -q '^variance_a  *not reliable: rare bright samples carry it' out.txt || fail "no doubt of caustics: $(cat out.txt)"
grep -q '^z_test  *passed, p .*, by variances that rare bright samples carry$' out.txt || fail "the verdict: $(cat out.txt)"
