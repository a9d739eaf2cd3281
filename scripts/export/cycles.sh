#!/usr/bin/env bash
# Exported materials in Blender's Cycles beside Cycles' own procedural checker, on the bunny (docs/export.md). Not part of ./check:
# it installs Blender as a Python module, 374 MB, in build/cycles. The picture is a strip of reference, exported and procedural.
#   cycles.sh REDMAP_BINARY [MINIFICATION]
set -euo pipefail
redmap=$(realpath "$1")
cd "$(dirname "$0")/../.."
minification=${2:-8}
work=build/cycles here=scripts/export/cycles
[[ -f models/bunny_10k.obj ]] || scripts/fetch_models.sh models
mkdir -p "$work/pictures"
if ! cmp -s "$here/requirements.txt" "$work/installed"; then
  python3 -m venv "$work/python"
  "$work/python/bin/pip" install -q --disable-pip-version-check --no-deps -r "$here/requirements.txt"
  cp "$here/requirements.txt" "$work/installed"
fi
cat >"$work/bunny.toml" <<END
[camera]
position = [0, 0, 4]
width = 64
height = 64
[light.key]
type = "directional"
to_light = [0.4, 0.5, 0.7]
intensity = 3
[object.bunny]
mesh = "$PWD/models/bunny_10k.obj"
shader = "$PWD/$here/checker.glsl"
map_size = 512
END
"$redmap" bake "$work/bunny.toml"
for kind in gltf tx; do
  "$redmap" export "$work/maps/bunny.exr" --scene "$work/bunny.toml" --to $kind --materials k -o "$work/$kind"
done
"$work/python/bin/python" "$here/compare.py" "$work/gltf" "$work/tx" "$minification" "$work/pictures" | grep -E 'samples +[0-9.]+$|pixels'
strip=()
for name in reference k4 one4 procedural4; do
  oiiotool "$work/pictures/$name.exr" --ch R,G,B --powc 0.4545 --resize:filter=box 236x236 -o "$work/pictures/$name.png"
  strip+=("$work/pictures/$name.png")
done
oiiotool "${strip[@]}" --mosaic:pad=4 4x1 -o "$work/pictures/strip.png"
echo "$work/pictures/strip.png"
