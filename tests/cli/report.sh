#!/usr/bin/env bash
# report.sh MEANDER SOURCE_DIR: what report writes, what it says of a bias, and what it refuses.
set -euo pipefail
meander=$1
source=$2
dir=$(mktemp -d)
trap 'rm -rf "$dir"' EXIT
cd "$dir"
fail() { echo "FAILED: $*"; exit 1; }
[ "$(nproc)" -ge 2 ] || fail "this test needs two processors, to tell numbers of threads apart"

cat > ball.toml <<'TOML'
[camera]
look_from = [0, 0, 5]
look_at = [0, 0, 0]
vertical_fov = 28
[film]
width = 24
height = 24
[environment]
radiance = 0.3
[[light]]
name = "key"
type = "rectangle"
center = [2, 3, 3]
look_at = [0, 0, 0]
width = 3
height = 3
radiance = 6
[[material]]
name = "wax"
albedo = [0.9, 0.8, 0.7]
mean_free_path = 0.3
boundary = "diffuse"
[[object]]
name = "ball"
shape = "sphere"
material = "wax"
TOML

"$meander" report ball.toml -o deep/one --spp 64 --thread-counts 1,2 > table.txt 2> messages.txt || fail "report: $(cat messages.txt)"
for file in report.csv report.json report.png index.html reference.exr implicit-1t.exr implicit-2t.exr analog-1t.exr analog-2t.exr; do
  [ -s "deep/one/$file" ] || fail "there is no $file"
done
[ -z "$(find . -name '*.partial-*')" ] || fail "a partial file is left"
cmp deep/one/implicit-1t.exr deep/one/implicit-2t.exr || fail "the bytes depend on the threads"

# Each row is what a render of that budget gives; the last one's image shows it.
"$meander" render ball.toml -o alone.exr --spp 64 --estimator analog --quiet
"$meander" compare alone.exr deep/one/analog-1t.exr --quiet || fail "the last row is not the render of its budget"

python3 - <<'PY' || fail "the table as CSV and JSON"
import csv, json, math
rows = list(csv.DictReader(open('deep/one/report.csv')))
assert len(rows) == 4 * 7, len(rows)
report = json.load(open('deep/one/report.json'))
assert report['reference']['spp'] == 1024 and not report['interrupted'] and report['object_pixels'] > 100
assert [run['name'] for run in report['runs']] == ['implicit-1t', 'implicit-2t', 'analog-1t', 'analog-2t']
for run in report['runs']:
    of_run = [row for row in rows if row['run'] == run['name']]
    assert [int(row['spp']) for row in of_run] == [1, 2, 4, 8, 16, 32, 64]
    assert run['threads'] == int(of_run[0]['threads']) and run['walk'].startswith('batch grey' if run['estimator'] == 'implicit' else 'scalar grey'), run
    for row, again in zip(of_run, run['rows']):
        assert set(again) < set(row) and float(row['error']) == again['error'], (row, again)
        assert float(row['error_low']) < float(row['error']) < float(row['error_high'])
        assert float(row['reference_error']) > 0 and row['reference_suffices'] == 'true'
        # Nothing subtracted, it is larger by the reference's own; it divides by the pixel's square alone, which
        # in this smooth picture is near its neighbours'.
        whole = float(row['error']) ** 2 + float(row['reference_error']) ** 2
        assert abs(float(row['relmse']) / whole - 1) < 0.05, (row['relmse'], whole)
        assert row['error_is'] == 'reliable' or int(row['spp']) < 8, row
        assert math.isclose(float(row['efficiency']), 1 / (float(row['error']) ** 2 * float(row['seconds'])), rel_tol=1e-9)
        assert math.isclose(float(row['walks_per_second']), int(row['walks']) / float(row['seconds']), rel_tol=1e-9)
    assert of_run[-1]['noise_is'] == 'reliable' == of_run[-1]['bias_test_is'] and of_run[0]['noise_is'] == ''
    assert of_run[0]['noise'] == '' and run['rows'][0]['noise'] is None
    assert all(float(a['seconds']) < float(b['seconds']) for a, b in zip(of_run, of_run[1:]))
    # The error falls as the root of the samples: eight times less at 64, within the scatter of 300 pixels.
    ratio = float(of_run[0]['error']) / float(of_run[-1]['error'])
    assert 6 < ratio < 10.7, ratio
    assert 0.7 < float(of_run[-1]['noise']) / float(of_run[-1]['error']) < 1.4
    assert run['bias_test'] == 'passed' and of_run[-1]['bias_test'] == 'passed' and of_run[0]['bias_test'] == ''
    assert run['contribution_p99_99'] is None and run['leaked_walks'] == 0  # too few samples for a tail
table = open('table.txt').read()
assert table.count('passed, p') == 4 and '1024 samples a pixel, seed 1' in table, table
PY

# Both codes of the walk, in one report: the same samples, other seconds.
"$meander" report ball.toml -o walks --spp 8 --walks batch,scalar --estimators implicit --quiet > walks.txt || fail "report --walks"
[ -s walks/implicit.exr ] && [ -s walks/implicit-scalar.exr ] || fail "the images of both walks"
"$meander" compare walks/implicit.exr walks/implicit-scalar.exr --z-test --quiet || fail "both walks agree"
grep -q 'scalar grey' walks.txt && grep -q 'batch grey' walks.txt || fail "the table names the walks"

# The page holds its pictures and asks for nothing beside itself.
python3 - <<'PY' || fail "the page"
import base64, re, struct, zlib
from html.parser import HTMLParser
page = open('deep/one/index.html').read()
class Tags(HTMLParser):
    def __init__(self):
        super().__init__()
        self.open, self.images, self.cells = [], [], 0
    def handle_starttag(self, tag, attributes):
        if tag not in ('meta', 'img', 'br'):
            self.open.append(tag)
        for name, value in attributes:
            assert name not in ('href', 'srcset', 'data', 'action'), (tag, name, value)
            if name == 'src':
                assert tag == 'img' and value.startswith('data:image/png;base64,'), value[:60]
                self.images.append(base64.b64decode(value.split(',', 1)[1], validate=True))
        self.cells += tag == 'td'
    def handle_endtag(self, tag):
        assert self.open.pop() == tag, tag
tags = Tags()
tags.feed(page)
tags.close()
assert not tags.open and not re.search('https?:|url\\(|@import', page)
# The plot, the reference, and an image and its error for either estimator: other threads give the same.
assert len(tags.images) == 6
for image in tags.images:
    assert image[:8] == b'\x89PNG\r\n\x1a\n'
    width, height, bits, kind = struct.unpack('>IIBB', image[16:26])
    data, at = b'', 8
    while at < len(image):
        size, name = struct.unpack('>I4s', image[at:at + 8])
        assert zlib.crc32(image[at + 4:at + 8 + size]) == struct.unpack('>I', image[at + 8 + size:at + 12 + size])[0]
        data += image[at + 8:at + 8 + size] if name == b'IDAT' else b''
        at += 12 + size
    assert name == b'IEND' and (bits, kind) == (8, 2)
    assert len(zlib.decompress(data)) == height * (1 + 3 * width)
assert tags.images[0] == open('deep/one/report.png', 'rb').read()
assert tags.cells == 28 * 11 + 4 * 8, tags.cells
PY

# The same seed gives the same errors; another does not.
columns='estimator spp noise error error_low error_high reference_error rmse relmse mean_signed walks steps bias_p'
same_columns() { python3 -c '
import csv, sys
read = lambda name: [[row[c] for c in sys.argv[3].split()] for row in csv.DictReader(open(name + "/report.csv"))]
sys.exit(read(sys.argv[1]) != read(sys.argv[2]))' "$1" "$2" "$columns"; }
short=(--spp 16 --estimators implicit --quiet)
"$meander" report ball.toml -o two "${short[@]}" --threads 1 > /dev/null
"$meander" report ball.toml -o three "${short[@]}" > /dev/null
"$meander" report ball.toml -o four "${short[@]}" --seed 5 > /dev/null
same_columns two three || fail "the same seed gives other errors"
! same_columns two four || fail "another seed gives the same errors"
[ -s two/implicit.exr ] && [ ! -e two/analog.exr ] || fail "--estimators is not heeded"

# Without an object in view every pixel counts.
"$meander" report ball.toml -o away "${short[@]}" --set 'camera.look_at=[9, 0, 5]' > /dev/null
grep -q '"object_pixels": "all"' away/report.json || fail "no object: $(grep object_pixels away/report.json)"

# Enough samples have a tail.
"$meander" report ball.toml -o tail --spp 512 --reference-spp 64 --estimators implicit --quiet > tail.txt
python3 - <<'PY' || fail "the tail"
import json
(run,) = json.load(open('tail/report.json'))['runs']
assert run['contribution_samples'] >= 1e5 and 1 < run['contribution_p99_99'] <= run['contribution_largest'], run
assert run['rows'][-1]['reference_suffices'] is False and '?' in open('tail.txt').read()
PY

# So few samples of the reference that its pixels are no measure: every error is marked, and a line says so.
"$meander" report ball.toml -o rough --spp 16 --reference-spp 2 --estimators implicit --quiet > rough.txt
python3 - <<'PY' || fail "a reference of two samples is relied upon"
import json
report = json.load(open('rough/report.json'))
(run,) = report['runs']
assert report['reference']['spp'] == 2 and run['bias_test'] is None, report
assert all(row['reference_suffices'] is False and row['error_is'] != 'reliable' for row in run['rows']), run
rows = [line.split() for line in open('rough.txt') if line.startswith('implicit ')][:5]
assert all(row[5].endswith('?') and row[8].endswith('?') for row in rows), rows
PY
grep -q "^error?: the reference's own" rough.txt || fail "it goes unmentioned: $(cat rough.txt)"

# In a furnace the first noise is far below 1 %: nothing is extrapolated backwards.
"$meander" report "$source/scenes/sphere_furnace.toml" -o furnace --width 32 --height 32 --spp 4 --quiet > furnace.txt
[ "$(grep -c '  <= [0-9.]*  ' furnace.txt)" -eq 2 ] || fail "the time to 1 % in a furnace: $(cat furnace.txt)"

# What is not a terminal hears of the end as soon as it is foreseen.
"$meander" render ball.toml -o foreseen.exr --error 0.0001 --time 2 2> foreseen.txt
[ "$(grep -c 'to go (time)' foreseen.txt)" -eq 1 ] || fail "two seconds pass in silence: $(cat foreseen.txt)"
"$meander" render ball.toml -o brief.exr --spp 1 2> brief.txt
! grep -q 'to go' brief.txt || fail "what is done at once is foreseen: $(cat brief.txt)"
grep -q 'noise ?,' brief.txt || fail "one sample has a noise: $(cat brief.txt)"

# A reference that is given: its own error is subtracted where it is known.
"$meander" render ball.toml -o given.exr --spp 256 --seed 9 --quiet
"$meander" report ball.toml -o given "${short[@]}" --reference given.exr > given.txt
grep -q 'given.exr, 256 samples' given.txt || fail "the reference is not named"
python3 -c '
import struct
open("plain.pfm", "wb").write(b"PF\n24 24\n-1.0\n" + struct.pack("<f", 0.5) * (24 * 24 * 3))'
"$meander" report ball.toml -o plain "${short[@]}" --reference plain.pfm > plain.txt
grep -q 'its own error is unknown' plain.txt || fail "a reference without variance goes unmentioned"
python3 - <<'PY' || fail "a reference without variance"
import json
(run,) = json.load(open('plain/report.json'))['runs']
assert run['bias_test'] is None and run['rows'][0]['reference_error'] is None, run
PY

# A report's own reference, given to another, is written again with what it says of itself.
"$meander" report ball.toml -o again "${short[@]}" --reference given/reference.exr > again.txt
grep -q 'given/reference.exr, 256 samples' again.txt || fail "a reference loses its samples: $(cat again.txt)"
status=0
"$meander" report ball.toml -o same "${short[@]}" --reference again/reference.exr --seed 9 2> said.txt || status=$?
[ $status -eq 2 ] && grep -q 'use another --seed' said.txt || fail "a reference loses its seed"

# A reference 3 % brighter than the truth: the bias test must see it.
"$meander" render ball.toml -o bright.exr --spp 1024 --seed 9 --quiet --set light.key.radiance=6.18 --set environment.radiance=0.309
"$meander" report ball.toml -o bright --spp 512 --estimators implicit,analog --quiet --reference bright.exr > bright.txt
[ "$(grep -c 'FAILED, p' bright.txt)" -eq 2 ] || fail "a bias of 3 % goes unseen: $(cat bright.txt)"

# Bad input: one line, exit code 2, nothing written.
refuse() {
  local wanted=$1 status=0 message
  shift
  message=$("$meander" "$@" 2>&1 > out.txt) || status=$?
  [ $status -eq 2 ] || fail "meander $*: exit code $status, not 2: $message"
  [ "$(printf '%s\n' "$message" | wc -l)" -eq 1 ] || fail "meander $*: not one line: $message"
  case $message in *"$wanted"*) ;; *) fail "meander $*: says '$message', not '$wanted'" ;; esac
  [ ! -e bad ] && [ ! -s out.txt ] || fail "meander $*: wrote something"
}
report=(report ball.toml -o bad --spp 4)
refuse 'the reference has 24 x 24 pixels, but the report' "${report[@]}" --reference given.exr --width 32
refuse 'none.exr' "${report[@]}" --reference none.exr
refuse 'use another --seed' "${report[@]}" --reference given.exr --seed 9
mkdir inside && cp given.exr inside/implicit.exr
refuse 'use another -o' report ball.toml -o inside --spp 4 --reference inside/implicit.exr
ln -s inside/implicit.exr link.exr
refuse 'use another -o' report ball.toml -o inside --spp 4 --reference link.exr
cmp -s given.exr inside/implicit.exr || fail "the reference was overwritten"
python3 -c '
import struct
open("nan.pfm", "wb").write(b"PF\n24 24\n-1.0\n" + struct.pack("<f", 1) * 1727 + struct.pack("<f", float("nan")))'
refuse 'all must be finite' "${report[@]}" --reference nan.pfm
refuse 'guided' "${report[@]}" --estimators implicit,guided
refuse 'this machine has' "${report[@]}" --thread-counts 1,1000
refuse '--reference-spp' "${report[@]}" --reference given.exr --reference-spp 8
refuse 'none.toml: cannot open' report none.toml -o bad
refuse 'it is not a folder' report ball.toml -o ball.toml
refuse 'is not a folder' report ball.toml -o ball.toml/bad
refuse '/proc/bad: the folder cannot be made' report ball.toml -o /proc/bad
refuse "is '', but must be the name of a file or folder" report ball.toml -o ''
# Before the work, which would be endless.
mkdir -p taken/index.html
refuse 'taken/index.html: it is a directory' report ball.toml -o taken --spp 2000000000
rmdir taken/index.html && rmdir taken || fail "a refusal left something behind"
refuse 'required' report ball.toml

# Without OpenGL there is all but the plot, an earlier one's, too, and one line says so.
[ -s two/report.png ] || fail "there is no plot to lose"
MESA_GL_VERSION_OVERRIDE=2.1 "$meander" report ball.toml -o two "${short[@]}" --threads 1 > /dev/null 2> said.txt || fail "no OpenGL: $(cat said.txt)"
[ "$(wc -l < said.txt)" -eq 1 ] && grep -q 'warning: there is no plot' said.txt || fail "no OpenGL: $(cat said.txt)"
[ ! -e two/report.png ] || fail "the plot of an earlier report is left"
[ -s two/implicit.exr ] && [ -s two/reference.exr ] && [ -s two/report.csv ] && [ -s two/report.json ] || fail "no OpenGL, no report"
[ "$(grep -c '<img' two/index.html)" -eq 3 ] || fail "the page without a plot"

# A folder that is spoilt during the work: the table is there, the exit code is 3, and no page tells of it.
"$meander" report ball.toml -o late --time 2 --estimators implicit --reference given.exr > late.txt 2> late_said.txt &
process=$!
until grep -q '^implicit' late_said.txt || ! kill -0 $process; do sleep 0.05; done
mkdir -p late/report.csv/full
status=0
wait $process || status=$?
[ $status -eq 3 ] || fail "a folder spoilt during the work gives exit code $status: $(cat late_said.txt)"
[ "$(grep -c '^meander: ' late_said.txt)" -eq 1 ] && grep -q '^meander: .*late/report.csv' late_said.txt || fail "it is not said: $(cat late_said.txt)"
grep -q '^implicit' late.txt || fail "the table is lost"
[ ! -e late/index.html ] && [ ! -e late/report.json ] || fail "a report that is not complete seems to be"

# An interrupt keeps what is complete.
"$meander" report ball.toml -o stopped --spp 100000000 --reference given.exr > stopped.txt 2> stopping.txt &
process=$!
# Before its own handling begins, a background process of this shell is deaf to interrupts.
until grep -q '^implicit' stopping.txt || ! kill -0 $process; do sleep 0.05; done
sleep 1
kill -INT $process
status=0
wait $process || status=$?
[ $status -eq 0 ] || fail "an interrupt gives exit code $status: $(cat stopping.txt)"
grep -q interrupted stopping.txt || fail "an interrupt goes unmentioned"
python3 -c '
import json
report = json.load(open("stopped/report.json"))
assert report["interrupted"] and len(report["runs"]) == 1 and len(report["runs"][0]["rows"]) > 2, report' || fail "an interrupt loses the rows"
echo "the report keeps its promises"
