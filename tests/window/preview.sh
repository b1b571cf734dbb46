#!/usr/bin/env bash
# preview.sh MEANDER SOURCE_DIR: a user at the previewer's window. Needs a display (with_display.sh), xdotool and
# python3. What is asked is seen from outside: pictures of the window, exit codes, messages.
set -euo pipefail
meander=$1 source=$2
command -v xdotool >/dev/null || { echo "no xdotool here"; exit 77; }
dir=$(mktemp -d)
process=
finish() {
  [[ -z $process ]] || kill "$process" 2>/dev/null || true
  rm -rf -- "$dir"
}
trap finish EXIT
cd "$dir"
fail() { echo "FAILED: $*"; [[ ! -s log ]] || cat log; exit 1; }

# start SCENE OPTIONS…: the previewer in the background; sets `window`.
start() {
  "$meander" preview "$@" 2>log &
  process=$!
  for ((i = 0; i < 300; i++)); do
    window=$(xdotool search --onlyvisible --name 'meander$' 2>/dev/null | head -n 1) && [[ -n $window ]] && break
    kill -0 "$process" 2>/dev/null || fail "the previewer ended at once"
    sleep 0.1
  done
  [[ -n $window ]] || fail "no window appears"
  sleep 1.5
}

# stop CODE: waits for the end and checks the exit code and that nothing was complained of.
stop() {
  local status=0 i
  for ((i = 0; i < 200; i++)); do
    kill -0 "$process" 2>/dev/null || break
    sleep 0.1
  done
  wait "$process" || status=$?
  process=
  [[ $status -eq $1 ]] || fail "exit code $status instead of $1"
  ! grep -iE 'opengl|sanitizer|leak|error' log || fail "complaints"
}

# shot NAME: what the window shows, as a PPM of its image area.
shot() { xwd_ppm "$1"; }
xwd_ppm() {
  xwd -silent -id "$window" -out "$1.xwd"
  python3 - "$1" <<'PY'
import struct, sys
name = sys.argv[1]
data = open(name + '.xwd', 'rb').read()
header = struct.unpack('>25I', data[:100])
size, width, height, bits, line, colors = header[0], header[4], header[5], header[11], header[12], header[19]
start = size + colors * 12
assert bits == 32, bits
rows = []
for y in range(height):
    row = data[start + y * line:start + y * line + 4 * width]
    rgb = bytearray(3 * width)
    rgb[0::3], rgb[1::3], rgb[2::3] = row[2::4], row[1::4], row[0::4]
    rows.append(bytes(rgb))
open(name + '.ppm', 'wb').write(b'P6\n%d %d\n255\n' % (width, height) + b''.join(rows))
PY
}

# differ A B [x0 y0 x1 y1]: the mean absolute difference of a part of two pictures, in levels.
differ() {
  python3 - "$@" <<'PY'
import sys
def read(name):
    data = open(name + '.ppm', 'rb').read()
    _, size, _, rest = data.split(b'\n', 3)
    width, height = map(int, size.split())
    return width, height, rest
a, b = read(sys.argv[1]), read(sys.argv[2])
assert a[:2] == b[:2], (a[:2], b[:2])
width, height = a[:2]
x0, y0, x1, y1 = map(int, sys.argv[3:7]) if len(sys.argv) > 3 else (0, 0, width, height)
total = count = 0
for y in range(y0, y1, 3):
    i = 3 * (y * width + x0)
    j = 3 * (y * width + x1)
    for p, q in zip(a[2][i:j:5], b[2][i:j:5]):
        total += abs(p - q)
        count += 1
print(total / count)
PY
}
more_than() { python3 -c "import sys; sys.exit(not $1 > $2)" || fail "$3: $1 is not above $2"; }
less_than() { python3 -c "import sys; sys.exit(not $1 < $2)" || fail "$3: $1 is not below $2"; }

image=(200 150 700 500)  # well inside the picture at 1280x720
scene=$source/scenes/wax_knot.toml

# A user looks around: the picture changes as it must, and stays where it must.
start "$scene" --window 1280,720
shot first
more_than "$(python3 -c "
data = open('first.ppm', 'rb').read().split(b'\n', 3)[3]
print(len(set(data[i:i + 3] for i in range(0, len(data), 999))))")" 40 "the first picture has colours"
xdotool mousemove --window "$window" 450 330 mousedown 1 mousemove_relative 60 0 mousemove_relative 60 0 mouseup 1
sleep 1.5
shot orbited
more_than "$(differ first orbited "${image[@]}")" 4 "an orbit changes the picture"
xdotool key --window "$window" ctrl+z
sleep 2
shot undone
less_than "$(differ first undone "${image[@]}")" 6 "undo brings the picture back"
xdotool key --window "$window" 6
sleep 1
shot normals
more_than "$(differ undone normals "${image[@]}")" 10 "the normals are another picture"
xdotool key --window "$window" 1 key --window "$window" shift+e
sleep 1
shot darker
more_than "$(differ undone darker "${image[@]}")" 4 "exposure changes the picture"
xdotool key --window "$window" e key --window "$window" Tab
sleep 1
shot bare
more_than "$(differ undone bare 1000 100 1270 600)" 5 "Tab puts the panel away"
xdotool key --window "$window" Tab key --window "$window" k key --window "$window" w
sleep 1
shot wiped
more_than "$(differ undone wiped)" 0.1 "a wipe shows its line"
xdotool windowsize --sync "$window" 640 400
sleep 1
shot small
[[ $(sed -n 2p small.ppm) == "640 400" ]] || fail "the smallest window is $(sed -n 2p small.ppm)"
xdotool windowsize --sync "$window" 1600 1000
sleep 1
shot large
xdotool key --window "$window" Escape
sleep 0.5
kill -0 "$process" 2>/dev/null && xdotool key --window "$window" Escape
stop 0

# A slider of the panel is dragged: the scene file's colour is edited, the picture follows, and is saved.
cp "$scene" look.toml
sed -i '1d' look.toml
start look.toml --window 1280,720 --script <(echo 'set material.wax.color=[0.2, 0.4, 0.9]')
sleep 1
shot blue
more_than "$(differ first blue "${image[@]}")" 3 "an edit of the colour shows"
xdotool key --window "$window" ctrl+s
sleep 0.5
grep -q 'color = \[0.2, 0.4, 0.9\]' look.toml || fail "the look was not saved: $(cat look.toml)"
# Another program edits the file: the picture follows; an error keeps the picture and says so.
sed -i 's/color = \[0.2, 0.4, 0.9\]/color = [0.9, 0.2, 0.2]/' look.toml
sleep 2
shot red
more_than "$(differ blue red "${image[@]}")" 3 "a changed file is shown"
echo 'nonsense' >>look.toml
sleep 2
shot broken
less_than "$(differ red broken "${image[@]}")" 3 "a broken file keeps the last good picture"
xdotool windowclose "$window" 2>/dev/null || true
kill -INT "$process" 2>/dev/null || true
stop 0 2>/dev/null || true
echo "the window does as it is told"
