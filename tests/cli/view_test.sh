#!/bin/bash
# redmap view under a display of its own: the window shows what redmap render writes, side by side too, and a parameter
# that is changed gets another map while the window stays open.
#   view_test.sh REDMAP_BINARY
set -u
redmap=$1
. "$(dirname "$0")/run_redmap.sh"
command -v xvfb-run >/dev/null || exit 77
"$redmap" view --help >/dev/null 2>&1 || exit 77
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder" || exit 1
program=$redmap
cat >scene.toml <<END
background = [0.2, 0.3, 0.4]
[camera]
position = [0, 1, 5]
width = 160
height = 120
[light.key]
type = "point"
position = [2, 3, 4]
intensity = 40
[object.ball]
surface = "sphere"
map_size = 64
shader = "checker"
END
runs bake scene.toml
runs render scene.toml -o map.png --device 0
runs render scene.toml -o original.png --device 0 --method original

# Everything below has a display.
shows() { # keys, frames, picture
  xvfb-run -a -s "-screen 0 640x480x24" "$program" view scene.toml --device 0 --keys "p$1" --frames "$2" \
    --screenshot "$3" >stdout 2>stderr || fail "view --keys $1: expected success, found: $(cat stderr)"
}
rmse() {
  runs compare "$1" "$2" --json compare.json
  python3 -c 'import json; print(json.load(open("compare.json"))["rmse"])'
}
below() { python3 -c 'import sys; sys.exit(not float(sys.argv[1]) < float(sys.argv[2]))' "$1" "$2"; }
shows 2 2 shown.png
below "$(rmse shown.png map.png)" 0.004 || fail "expected the window to show the map's picture"
shows 1 2 shown.png
below "$(rmse shown.png original.png)" 0.004 || fail "expected the window to show the shader itself"
shows 6 2 split.png
below "$(rmse split.png original.png)" 0.2 || fail "expected half of each picture"
below "$(rmse split.png shown.png)" 0.004 && fail "expected the other half from the map, and a line"
runs render scene.toml -o parameters.png --device 0 --method parameters
shows 4 2 shown.png
below "$(rmse shown.png parameters.png)" 0.004 || fail "expected the window to show averaged parameters"
runs render scene.toml -o paper.png --method paper
shows 5 2 shown.png
below "$(rmse shown.png paper.png)" 0.004 || fail "expected the window to show the paper's method"
shows p2 2 panel.png
below "$(rmse panel.png map.png)" 0.02 && fail "expected a panel over the picture"
# The first parameter is the scale: cubes of another size, once they are baked.
shows "2====" 60 changed.png
below "$(rmse changed.png map.png)" 0.03 && fail "expected another pattern after another bake"
DISPLAY= WAYLAND_DISPLAY= refuses "expected a display" view scene.toml --device 0 --frames 1

[ $failures -eq 0 ]
