#!/usr/bin/env bash
# Runs a command on an X display of its own, and passes on its exit code.
#   with_display.sh [-s WIDTHxHEIGHT] COMMAND…
# The command sees the environment as it was, a DISPLAY, in MEANDER_XVFB_PID the server's process id, for a test that
# ends it early, and in MEANDER_SCREEN the file in which the server keeps what it shows, in xwd's format. Without Xvfb the exit code is 77.
set -euo pipefail

own_screen=1920x1200
while getopts s: own_option; do
  case $own_option in
    s) own_screen=$OPTARG ;;
    *) exit 2 ;;
  esac
done
shift $((OPTIND - 1))
(($# > 0)) || { printf 'usage: with_display.sh [-s WIDTHxHEIGHT] COMMAND...\n' >&2; exit 2; }
command -v Xvfb >/dev/null || { printf 'with_display.sh: no Xvfb here\n' >&2; exit 77; }

own_folder=$(mktemp -d)
own_server=
finish() {
  [[ -z $own_server ]] || { kill "$own_server" 2>/dev/null && wait "$own_server" 2>/dev/null; } || true
  rm -rf -- "$own_folder"
}
trap finish EXIT

# It picks a number that is free and writes it when it listens. It stays as it is when the last window closes.
Xvfb -displayfd 3 -screen 0 "${own_screen}x24" -nolisten tcp -noreset -fbdir "$own_folder" \
  +extension GLX 3>"$own_folder/number" \
  >"$own_folder/log" 2>&1 &
own_server=$!
for ((i = 0; i < 300; i++)); do
  [[ -s $own_folder/number ]] && break
  kill -0 "$own_server" 2>/dev/null || break
  sleep 0.1
done
[[ -s $own_folder/number ]] || { cat "$own_folder/log" >&2; printf 'with_display.sh: Xvfb does not start\n' >&2; exit 3; }

own_status=0
DISPLAY=:$(<"$own_folder/number") MEANDER_XVFB_PID=$own_server MEANDER_SCREEN=$own_folder/Xvfb_screen0 "$@" || own_status=$?
exit "$own_status"
