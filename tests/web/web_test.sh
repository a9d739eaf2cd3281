#!/bin/bash
# `redmap view --web`: its server, the folder that it writes, and the page in headless Chromium.
#   web_test.sh REDMAP_BINARY FOLDER [short]    FOLDER: where screenshots go; short: no more than a picture of the page
set -u
source_folder=$(cd "$(dirname "$0")" && pwd)
redmap=$1
tools=$source_folder/../../build/export
for program in node curl "${CHROMIUM:-/usr/bin/chromium}"; do
  command -v "$program" >/dev/null || { echo "there is no $program; scripts/setup.sh installs it"; exit 77; }
done
[[ -d $tools/node_modules/playwright-core ]] || { echo "there is no playwright-core; scripts/export/install_tools.sh fetches it"; exit 77; }
. "$source_folder/../cli/run_redmap.sh"
mkdir -p "$2"
cd "$2" || exit 1
rm -rf site maps ./*.png ./*.toml address

cat >scene.toml <<'END'
background = [0.125, 0.25, 0.5]
[camera]
position = [0, 0, 12]
fov = 40
width = 256
height = 256
[light.key]
type = "directional"
to_light = [0.4, 0.5, 0.7]
intensity = 3
shadows = false
[light.side]
type = "point"
position = [-4, 1, 2]
intensity = [6, 12, 18]
shadows = false
[object.ball]
surface = "sphere"
shader = "noise"
map_size = 128
translate = [0.25, 0.125, -0.5]
rotate = [0, 40, 10]   # the poles, where u of a grid is not the sphere's, stay at the silhouette
scale = 1.5
END
runs bake scene.toml
runs render scene.toml --quality fast -o map.png
runs render scene.toml --quality fast --method original -o original.png
runs render scene.toml --method supersample --spp 64 -o supersampled.png

# A folder for a server of static files; an earlier one is replaced, nothing else is.
runs view --web scene.toml -o site
runs view --web scene.toml -o site
[ -f site/index.html ] && [ -f site/scene/scene.json ] && [ -f site/scene/0_ball/weights.bin.gz ] ||
  fail "expected a page and a scene, found: $(find site)"
mkdir -p other && touch other/precious
refuses "expected no such folder" view --web scene.toml -o other
# A map that is missing is baked for the view, and not written.
sed 's/shader = "noise"/shader = "checker"\nmap = "none.exr"/' scene.toml >unbaked.toml
"$redmap" view --web unbaked.toml -o unbaked >stdout 2>stderr && grep -q "ball: baked for this view" stderr && [ ! -e none.exr ] ||
  fail "expected a bake, found: $(cat stderr)"
sed 's/shader = "noise"/shader = "transparent"/; s/^map_size.*/map = "none.exr"\nmap_size = 32/' scene.toml >glass.toml
"$redmap" view --web glass.toml -o glass >stdout 2>stderr && fail "expected no page of what lets light through"
grep -q "object 'ball': export: expected an opaque shader" stderr || fail "expected the object named, found: $(cat stderr)"
cp "$redmap" lonely
LD_LIBRARY_PATH= ./lonely view --web scene.toml >stdout 2>stderr
grep -q "expected the page in" stderr || fail "expected to hear where the page is missing, found: $(cat stderr)"
rm -f lonely

# Served until it is interrupted, which is how it ends: nothing stays behind. A shell turns SIGINT off for what runs beside it.
export TMPDIR=$PWD/temporary
mkdir -p "$TMPDIR"
python3 -c 'import os, signal, sys; signal.signal(signal.SIGINT, signal.default_int_handler); os.execv(sys.argv[1], sys.argv[1:])' \
  "$redmap" view --web scene.toml >address 2>complaints &
server=$!
for ((i = 0; i < 600; ++i)); do
  [[ ! -s address ]] || break
  sleep 0.1
done
address=$(cat address)
answer() { curl -s --path-as-is -o /dev/null -w '%{http_code}' "$@"; }
[ "$(answer "$address")" = 200 ] || fail "expected a page at $address"
[ "$(answer "${address}scene/0_ball/manifest.json")" = 200 ] || fail "expected the export of the object"
[ "$(answer "${address}../scene.toml")" = 404 ] || fail "expected nothing from outside the page"
[ "$(answer "${address}scene/")" = 404 ] || fail "expected no listing"
[ "$(answer -X POST -d x "$address")" = 404 ] || fail "expected nothing but GET"
port=${address##*:}
refuses "expected port ${port%/} of 127.0.0.1 to be free" view --web scene.toml --port "${port%/}"
node "$source_folder/web_test.mjs" "$tools" "$address" . ${3:+short} || fail "expected the page to work"
kill -INT $server
status=0
wait $server || status=$?
[ $status -eq 0 ] && [ ! -s complaints ] ||
  fail "expected Ctrl-C to end it with status 0, found $status and: $(cat complaints)"
[ -z "$(ls "$TMPDIR")" ] || fail "expected nothing left behind, found $(ls "$TMPDIR")"
exit $((failures > 0))
