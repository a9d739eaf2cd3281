#!/bin/bash
# The include file of `redmap export --to glsl` in the programs of docs/examples/export: OpenGL and WebGL2 draw the CPU's
# picture, and it is GLSL for Vulkan. Skipped where scripts/export/install_tools.sh has not run.
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

# As Vulkan takes it.
{
  printf '#version 450\n'
  cat glsl/redmap.glsl
  cat <<'END'
layout(location = 0) in vec3 position; layout(location = 1) in vec3 normal; layout(location = 2) in vec3 tangent;
layout(location = 3) in vec2 uv; layout(location = 4) flat in uint triangle; layout(location = 0) out vec4 color;
void main() {
  RedmapHit hit = redmap_seen(position, normal, tangent, uv, normalize(-position), triangle);
  color = vec4(redmap_shade(hit, vec3(0.0, 0.0, 1.0), vec3(1.0)), 1.0);
}
END
} >vulkan.frag
glslangValidator -V vulkan.frag -o vulkan.spv >vulkan.log && spirv-val vulkan.spv ||
  fail "expected GLSL for Vulkan, found: $(cat vulkan.log)"
exit $((failures > 0))
