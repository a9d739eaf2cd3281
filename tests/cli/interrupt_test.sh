#!/bin/bash
# A bake that is interrupted says so, exits with 130 and leaves nothing behind.
#   interrupt_test.sh REDMAP_BINARY
set -u
redmap=$1
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cat >"$folder/long.toml" <<'SCENE'
[camera]
position = [0, 0, 5]
[object.ball]
surface = "sphere"
shader = "layered_rock"
map_size = 16384   # minutes, if nobody stops it
SCENE
failures=0

for signal in INT TERM; do
  "$redmap" bake "$folder/long.toml" >"$folder/stdout" 2>"$folder/stderr" &
  bake=$!
  # What a shell starts in the background ignores SIGINT until it asks for it, which takes a while on a busy machine.
  until [ $((0x$(sed -n 's/^SigCgt:\s*//p' /proc/$bake/status) & 2)) -ne 0 ]; do sleep 0.1; done
  sleep 1
  kill -$signal $bake
  wait $bake
  status=$?
  left=$(find "$folder/maps" -type f 2>/dev/null)
  if [ $status -ne 130 ] || [ "$(cat "$folder/stderr")" != interrupted ] || [ -n "$left" ]; then
    echo "SIG$signal: expected status 130, \"interrupted\" and no files, found status $status, files \"$left\" and:"
    cat "$folder/stderr"
    failures=$((failures + 1))
  fi
done

[ $failures -eq 0 ]
