#!/bin/bash
# The include file of `redmap export --to glsl` in the programs of docs/examples/export: OpenGL, WebGL2 and Vulkan draw
# the CPU's picture. Skipped where scripts/export/install_tools.sh has not run.
#   export_glsl_test.sh REDMAP_BINARY SOURCE_FOLDER
set -u
redmap=$1
source=$2
tools=$source/build/export
[ -f "$tools/installed" ] || exit 77
. "$(dirname "$0")/run_redmap.sh"
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder" || exit 1

# The camera and light of the examples, 8 away.
cat >scene.toml <<'END'
background = [0.125, 0.25, 0.5]
[camera]
position = [0, 0, 8]
fov = 40
width = 256
height = 256
[light.key]
type = "directional"
to_light = [0.4, 0.5, 0.7]
intensity = 3
shadows = false
[object.ball]
surface = "sphere"
radius = 1
shader = "noise"
map_size = 128
END
runs bake scene.toml
runs render scene.toml --quality fast -o cpu.exr
runs export maps/ball.exr --scene scene.toml --to glsl -o glsl
[ $failures -eq 0 ] || exit 1
oiiotool cpu.exr -d float --compression none -o cpu.tif

# near PICTURE MOST: an RMSE of MOST at most from the CPU's picture.
near() {
  node "$source/scripts/export/compare_pictures.mjs" "$1" cpu.tif "$2" 0.125 0.25 0.5 || fail "expected an RMSE of at most $2"
}

c++ -std=c++20 -O1 "$source/docs/examples/export/opengl.cpp" -o opengl -lEGL -lOpenGL || fail "expected opengl.cpp to compile"
numbers=$(python3 -c '
import json
m = json.load(open("glsl/manifest.json"))
w = m["weights"]
print(w["width"], w["height"], w["layers"], w["levels"], int(w["wraps_u"]), m["words"]["height"], m["mesh"]["vertices"],
      m["mesh"]["indices"])')
# shellcheck disable=SC2086
./opengl glsl $numbers 8 256 opengl.pfm && near opengl.pfm 0.004 || fail "expected a picture by OpenGL"

node "$source/scripts/export/run_webgl2.mjs" "$tools" "$source/docs/examples/export/webgl2.html" glsl 8 256 webgl2.pfm &&
  near webgl2.pfm 0.004 || fail "expected a picture by WebGL2"

# Vulkan, under its validation layer, which says what it finds on stdout.
for stage in vert frag; do
  glslangValidator -V -Iglsl "$source/docs/examples/export/vulkan.$stage" -o vulkan.$stage.spv >vulkan.log &&
    spirv-val vulkan.$stage.spv || fail "expected GLSL for Vulkan, found: $(cat vulkan.log)"
done
c++ -std=c++20 -O1 "$source/docs/examples/export/vulkan.cpp" -o vulkan -lvulkan || fail "expected vulkan.cpp to compile"
# shellcheck disable=SC2086
VK_INSTANCE_LAYERS=VK_LAYER_KHRONOS_validation ./vulkan glsl $numbers 8 256 vulkan.pfm >vulkan.log 2>&1
[ ! -s vulkan.log ] || fail "expected nothing of Vulkan's validation layer, found: $(cat vulkan.log)"
near vulkan.pfm 0.004 || fail "expected a picture by Vulkan"
exit $((failures > 0))
