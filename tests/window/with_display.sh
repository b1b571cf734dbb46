#!/usr/bin/env bash
# Runs a command on an X display of its own, and passes on its exit code.
#   with_display.sh [-s WIDTHxHEIGHT] [-d DPI] COMMAND…
# MEANDER_XVFB_PID is the server's process id, for a test that ends it early. Without Xvfb the exit code is 77.
set -euo pipefail

screen=1920x1200
dpi=96
while getopts s:d: option; do
  case $option in
    s) screen=$OPTARG ;;
    d) dpi=$OPTARG ;;
    *) exit 2 ;;
  esac
done
shift $((OPTIND - 1))
(($# > 0)) || { printf 'usage: with_display.sh [-s WIDTHxHEIGHT] [-d DPI] COMMAND...\n' >&2; exit 2; }
command -v Xvfb >/dev/null || { printf 'with_display.sh: no Xvfb here\n' >&2; exit 77; }

folder=$(mktemp -d)
server=
finish() {
  [[ -z $server ]] || { kill "$server" 2>/dev/null && wait "$server" 2>/dev/null; } || true
  rm -rf -- "$folder"
}
trap finish EXIT

# It picks a number that is free and writes it when it listens.
Xvfb -displayfd 3 -screen 0 "${screen}x24" -dpi "$dpi" -nolisten tcp +extension GLX 3>"$folder/number" \
  >"$folder/log" 2>&1 &
server=$!
for ((i = 0; i < 300; i++)); do
  [[ -s $folder/number ]] && break
  kill -0 "$server" 2>/dev/null || break
  sleep 0.1
done
[[ -s $folder/number ]] || { cat "$folder/log" >&2; printf 'with_display.sh: Xvfb does not start\n' >&2; exit 3; }

status=0
DISPLAY=:$(<"$folder/number") MEANDER_XVFB_PID=$server "$@" || status=$?
exit "$status"
