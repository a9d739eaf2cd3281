#!/usr/bin/env bash
# Every library shader twice, compiled in and as a file of the user's own (docs/bring_your_shader.md): seconds to bake,
# and how far the two pictures are apart, each rendered with its own map.
# usage: compare_user_shaders.sh [PROGRAM [SIZE [DEVICE]]]
set -euo pipefail
cd "$(dirname "$0")/.."
program=$(realpath "${1:-build/release/redmap}")
size=${2:-512}
device=${3:-}
texts=$PWD/src/shader/library
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"

scene() { # file, shader
  cat >"$1" <<END
[camera]
position = [0, 1, 6]
fov = 24
width = 256
height = 256
[light.key]
type = "point"
position = [4, 5, 6]
intensity = 220
[object.ball]
surface = "sphere"
shader = "$2"
map_size = $size
END
}
number() { python3 -c 'import json, sys; print(eval(sys.argv[2], {"j": json.load(open(sys.argv[1]))}))' "$1" "$2"; }

printf '%-20s %9s %9s %6s %6s %10s %12s\n' shader compiled own ratio basis "map rmse" "original rmse"
for text in "$texts"/*.glsl; do
  name=$(basename "$text" .glsl)
  scene library.toml "$name"
  scene own.toml "$text"
  for which in library own; do
    "$program" bake $which.toml -o maps_$which --device "$device" --json $which.json >/dev/null
    sed -i "/^map = /d" $which.toml && echo "map = \"maps_$which/ball.exr\"" >>$which.toml
    "$program" render $which.toml -o $which.exr >/dev/null
    "$program" render $which.toml -o original_$which.exr --method original >/dev/null
  done
  "$program" compare own.exr library.exr --json map.json >/dev/null
  "$program" compare original_own.exr original_library.exr --json original.json >/dev/null
  a=$(number library.json 'j["maps"][0]["bake_seconds"]') b=$(number own.json 'j["maps"][0]["bake_seconds"]')
  printf '%-20s %9.3f %9.3f %6.2f %3d/%-3d %10.6f %12.6f\n' "$name" "$a" "$b" \
    "$(python3 -c "print($b / $a)")" "$(number library.json 'j["maps"][0]["basis"]')" \
    "$(number own.json 'j["maps"][0]["basis"]')" "$(number map.json 'j["rmse"]')" "$(number original.json 'j["rmse"]')"
done
