#!/bin/bash
# Shaders of the user's own through the program: the examples of docs/bring_your_shader.md are baked and rendered by
# every method, mistakes are named by file, line and column, and no Vulkan is needed where no such shader is.
#   user_shader_test.sh REDMAP_BINARY EXAMPLES_FOLDER
set -u
redmap=$1
examples=$2
. "$(dirname "$0")/run_redmap.sh"
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cp -r "$examples" "$folder/examples"
cd "$folder" || exit 1
small=(-D camera.width=96 -D camera.height=40)

# The examples, small. Their maps are the same for any number of threads.
runs bake examples/examples.toml --size 64 --json bake.json
for name in lava tiles velvet metal leather; do [ -s examples/maps/$name.exr ] || fail "expected a map of $name"; done
runs bake examples/examples.toml --size 64 --threads 1 --object tiles -o examples/threads1
cmp -s examples/threads1/tiles.exr examples/maps/tiles.exr || fail "expected the same map for any number of threads"
python3 -c '
import json
maps = {m["object"]: m for m in json.load(open("bake.json"))["maps"]}
assert maps["tiles"]["basis"] >= 2 and maps["velvet"]["basis"] == 2, maps
assert maps["leather"]["verdict"] == "does-not-reduce" or maps["leather"]["basis"] == 1, maps
' || fail "expected the basis of the examples"
for method in original supersample map paper; do
  runs render examples/examples.toml -o $method.exr --method $method "${small[@]}"
done
# The same, rendered on the device. Some pixels lie on edges, where both decide for themselves.
for method in original map; do
  runs render examples/examples.toml -o device.exr --method $method "${small[@]}" --device 0 --force
  runs compare device.exr $method.exr --json device.json
  python3 -c 'import json; assert json.load(open("device.json"))["rmse"] < 0.05' || fail "expected $method as on the CPU"
done
refuses "render it without --device" render examples/examples.toml -o other.exr --method paper --device 0
refuses "'lava.glsl' does not declare material()" render examples/examples.toml -o other.exr --method parameters "${small[@]}"
runs compare map.exr supersample.exr --json compare.json
python3 -c 'import json; assert json.load(open("compare.json"))["rmse"] < 0.2' || fail "expected map near supersample"
runs inspect examples/maps/tiles.exr --pictures pictures
runs compare pictures/basis00.png pictures/basis00.png
runs list examples/lava.glsl
says "how much of the rock glows"

# Maps know their shader's version.
echo "// changed" >>examples/velvet.glsl
refuses "another version of shader 'velvet.glsl'" render examples/examples.toml -o other.exr "${small[@]}"
refuses "another version" inspect examples/maps/velvet.exr --pictures pictures
rm examples/velvet.glsl
refuses "velvet.glsl: expected a shader file, found none" inspect examples/maps/velvet.exr --pictures pictures
refuses "examples.toml" render examples/examples.toml -o other.exr "${small[@]}"

# A scene of one ball.
scene() {
  printf '[camera]\nposition = [0, 0, 4]\nwidth = 8\nheight = 8\n[light.key]\ntype = "point"\nposition = [0, 0, 4]\n' >scene.toml
  printf '[object.ball]\nsurface = "sphere"\nmap_size = 16\nshader = "%s"\n' "$1" >>scene.toml
}
shader() { # the expression of its colour
  printf 'struct Parameters {\n  float a;  // 1 [0, 2]: a\n};\nstruct Pattern { vec3 c; };\n'
  printf 'Pattern pattern(Surface at, Parameters p) {\n  %s\n}\n' "$1"
  printf 'vec3 radiance(Pattern m, vec3 l, vec3 v) { return m.c * l.z; }\n'
}
scene mine.glsl
shader 'return Pattern(vec3(p.a * foo));' >mine.glsl
refuses "scene.toml:11:10: object.ball.shader: mine.glsl:6:29: 'foo': undeclared identifier" bake scene.toml
shader 'float x = p.a; while (x > 0.0) x += 1.0; return Pattern(vec3(x));' >mine.glsl
refuses 'shader "mine.glsl": pattern(): expected loops that end' bake scene.toml
refuses 'shader "mine.glsl": pattern(): expected loops that end' render scene.toml -o other.exr --method original
shader 'return Pattern(vec3(sqrt(-1.0 - at.position.x * at.position.x)));' >mine.glsl
refuses 'shader "mine.glsl": radiance(): expected finite numbers' bake scene.toml
refuses 'shader "mine.glsl": radiance(): expected finite numbers' render scene.toml -o other.exr --method original
shader 'return Pattern(vec3(fwidth(at.uv.x)));' >mine.glsl
refuses "mine.glsl:6:23: 'fwidth': there is no screen" bake scene.toml
shader 'return Pattern(at.normal * 0.5 + 0.5);' >mine.glsl
refuses 'expected a parameter of shader mine.glsl, found "b"' bake scene.toml -D ball.b=3
refuses 'must be in [0, 2], found 3' bake scene.toml -D ball.a=3
refuses 'expected images to be none, found "wood"' bake scene.toml -D object.ball.images.wood=examples/painting.png
refuses 'found no file' bake scene.toml -D object.ball.images.wood=nowhere.png
refuses 'device "no such thing": expected the number or part of the name of one of' bake scene.toml --device "no such thing"
runs bake scene.toml -D object.ball.map=here.exr
runs inspect here.exr --pictures pictures
[ ! -e other.exr ] || fail "expected no picture of what was refused"

# Without Vulkan, only such shaders cannot run.
VK_ICD_FILENAMES=/nowhere refuses "Vulkan: expected a driver" bake scene.toml
VK_ICD_FILENAMES=/nowhere runs bake scene.toml -D object.ball.shader=white
VK_ICD_FILENAMES=/nowhere refuses "expected only for a shader of your own" bake scene.toml -D object.ball.shader=white \
  -D object.ball.images.wood=examples/painting.png

[ $failures -eq 0 ]
