#!/usr/bin/env bash
# A display that is missing, wrong, without OpenGL, or gone while the window is open: one line that names capture, exit
# code 3.
#   display_loss_test.sh OPEN_WINDOW
set -euo pipefail

readonly program=$1
readonly here=$(cd -- "$(dirname -- "${BASH_SOURCE[0]}")" && pwd -P)
failures=0

# expect NAME STATUS ERRORS PATTERN: what the last run gave.
expect() {
  local lines
  lines=$(grep -c '^meander: ' <<<"$3" || true)
  if [[ $2 != 3 || $lines != 1 || $3 != *"meander capture"* || $3 != *$4* ]]; then
    printf '%s: exit code %s, message: %s\n' "$1" "$2" "$3"
    failures=$((failures + 1))
  fi
}

missing() {
  local status=0 errors
  errors=$(env -u DISPLAY -u WAYLAND_DISPLAY "$program" 2>&1 >/dev/null) || status=$?
  expect "no display" "$status" "$errors" "DISPLAY"
  status=0
  errors=$(env -u WAYLAND_DISPLAY DISPLAY=:65533 "$program" 2>&1 >/dev/null) || status=$?
  expect "a wrong display" "$status" "$errors" ":65533"
}

# lost NAME COMMAND PATTERN: the command ends the window from outside; it is eval'ed beside an open window.
lost() {
  local folder status=0 errors i
  folder=$(mktemp -d)
  export program folder command=$2
  "$here/with_display.sh" bash -c '
    "$program" 30 >"$folder/out" 2>"$folder/errors" &
    window=$!
    for ((i = 0; i < 300; i++)); do grep -q open "$folder/out" && break; sleep 0.1; done
    eval "$command"
    status=0
    wait "$window" || status=$?
    printf "%s" "$status" >"$folder/status"' >/dev/null 2>&1 || true
  status=$(cat "$folder/status" 2>/dev/null || true)
  errors=$(cat "$folder/errors" 2>/dev/null || true)
  rm -rf -- "$folder"
  expect "$1" "$status" "$errors" "$3"
}

without_opengl() {
  local folder status=0 errors
  folder=$(mktemp -d)
  Xvfb -displayfd 3 -screen 0 800x600x24 -nolisten tcp -extension GLX 3>"$folder/number" >/dev/null 2>&1 &
  local server=$!
  for ((i = 0; i < 300; i++)); do [[ -s $folder/number ]] && break; sleep 0.1; done
  errors=$(DISPLAY=:$(<"$folder/number") "$program" 5 2>&1 >/dev/null) || status=$?
  kill "$server"
  wait "$server" 2>/dev/null || true
  rm -rf -- "$folder"
  expect "a display without OpenGL" "$status" "$errors" "OpenGL 3.3"
}

missing
command -v Xvfb >/dev/null || { printf 'no Xvfb here: the rest is skipped\n'; exit $((failures == 0 ? 77 : 1)); }
without_opengl
lost "the server ends" 'kill "$MEANDER_XVFB_PID"' "lost"
if command -v xdotool >/dev/null; then
  lost "the client is cut off" 'xdotool search --name meander windowkill' "lost"
  lost "the window is destroyed" 'xdotool search --name meander windowclose' "destroyed"
fi
((failures == 0))
