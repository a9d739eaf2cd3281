#!/bin/bash
# The whole way through the program on a small scene: bake, render by every method, compare, inspect, list, bench.
# Every file asked for exists and can be read, finished frames are skipped until the scene changes, the number of
# threads changes no byte, and what cannot be written leaves nothing behind.
#   end_to_end_test.sh REDMAP_BINARY
set -u
redmap=$1
. "$(dirname "$0")/run_redmap.sh"
folder=$(mktemp -d)
trap 'umount "$folder/small" 2>/dev/null; rm -rf "$folder"' EXIT
cd "$folder" || exit 1
# holds FILE CONDITION: the JSON in FILE, as the variable j, fulfils a Python condition.
holds() {
  python3 -c 'import json, sys; j = json.load(open(sys.argv[1])); sys.exit(0 if eval(sys.argv[2]) else 1)' "$1" "$2" ||
    fail "$1: expected $2"
}

cat >scene.toml <<'SCENE'
[camera]
position = [0, 0, 4]
fov = 40
width = 48
height = 40
[light.key]
type = "point"
position = [4, 5, 6]
intensity = 60
[object.ball]
surface = "sphere"
shader = "noise"
map_size = 64
SCENE

# Baking. Another number of threads changes no byte of the map.
for threads in 1 2 7; do runs bake scene.toml -o maps$threads --threads $threads --json bake.json; done
cmp -s maps1/ball.exr maps2/ball.exr && cmp -s maps1/ball.exr maps7/ball.exr ||
  fail "expected the same map for 1, 2 and 7 threads"
runs bake scene.toml
cmp -s maps/ball.exr maps1/ball.exr || fail "expected maps/ball.exr to be the map"
holds maps/ball.json 'j["shader"] == "noise" and j["bake_seconds"] > 0 and j["peak_bytes"] > 0'

# Rendering, by every method.
for method in original supersample parameters paper map; do
  runs render scene.toml -o $method.exr --method $method --json render.json
  holds render.json 'len(j["frames"]) == 1 and j["frames"][0]["rays_per_pixel"] > 0'
done
runs render scene.toml -o fast.png --quality fast
runs render scene.toml -o decisions.png --show decisions --method paper
says "mean normal"
for threads in 1 2 7; do runs render scene.toml -o threads$threads.exr --threads $threads; done
cmp -s threads1.exr threads2.exr && cmp -s threads1.exr threads7.exr ||
  fail "expected the same frame for 1, 2 and 7 threads"

# A rerun renders nothing, until the scene or its map changes.
runs render scene.toml -o map.exr --json render.json
holds render.json 'j["skipped"] == 1 and j["frames"] == []'
runs render scene.toml -o map.exr -D light.key.intensity=61 --json render.json
holds render.json 'j["skipped"] == 0 and len(j["frames"]) == 1'
runs bake scene.toml --size 32
runs render scene.toml -o map.exr -D light.key.intensity=61 --json render.json
holds render.json 'j["skipped"] == 0'

# Measuring.
runs compare supersample.exr supersample.exr --json compare.json
holds compare.json 'j["rmse"] == 0 and j["flip"] == 0'
runs compare fast.png supersample.exr --difference difference.png --json compare.json
holds compare.json '0 < j["rmse"] < .5 and j["psnr"] > 0 and {"relative_mse", "flip", "flicker"} <= set(j)'
runs compare difference.png difference.png
runs inspect maps/ball.exr --pictures pictures --json inspect.json
holds inspect.json 'j["shader"] == "noise" and j["size"] == [64, 32] and j["levels"] == 7 and j["bytes_in_memory"] > 0'
for picture in coverage basis00 basis01 weight00 weight01 level00 level06; do
  runs compare pictures/$picture.png pictures/$picture.png
done
runs list
says noise
runs bench quality --objects sphere --shaders noise --minifications 4 --methods supersample,map --reference-spp 16 \
  --size 64 --views 1 --flicker-frames 0 --json quality.json
holds quality.json '{row["method"] for row in j["rows"]} == {"supersample", "map"} and j["machine"]'
holds quality.json 'all(row["rmse_interior"] > 0 for row in j["rows"])'

runs bench normals --objects plane --bumps fbm.25 --glosses phong20 --minifications 4 --size 64 --pixels 16 \
  --reference-spp 32 --views 1 --json normals.json --pictures cases
holds normals.json '{row["method"] for row in j["rows"]} == {"map", "paper", "parameters", "supersample"}'
holds normals.json '{"object", "bump", "gloss", "minification", "method", "spp", "relative_rmse", "flicker", "flicker_slow",
  "shader_calls_per_lookup", "microseconds_per_pixel"} <= set(j["rows"][0])'
holds normals.json '{"map_over_64spp_rmse", "map_over_paper_rmse", "map_over_parameters_rmse", "map_over_64spp_flicker",
  "calls_single_basis", "win_rate_against_64spp", "worst_over_64spp"} <= set(j["summary"])'
holds normals.json '[s["minification"] for s in j["summary"]["by_minification"]] == [4]'
runs compare cases/plane_fbm.25_phong20_4.png cases/plane_fbm.25_phong20_4.png

# Verifying: the same for any number of threads, a verdict, and a certificate that the map keeps.
for threads in 1 2 7; do
  runs verify scene.toml --pixels 20 --spp 64 --minifications 1,4 --threads $threads --json verify$threads.json -o error.png
  says "most of it from"
done
holds verify1.json 'all(o["by_minification"][i]["bound"] > 0 and o["by_level"] and len(o["stages"]) == 4
  for o in j["objects"] for i in (0, 1))'
for threads in 2 7; do
  python3 -c 'import json, sys; a, b = (json.load(open(f))["objects"] for f in sys.argv[1:]); sys.exit(a != b)' \
    verify1.json verify$threads.json || fail "expected the same report for 1 and $threads threads"
done
runs compare error.png error.png
runs verify scene.toml --pixels 20 --spp 64 --minifications 1,4 --max-error 10 --max-flip 1 --store
says "verdict: passes"
runs inspect maps/ball.exr --json inspect.json
says "certificate"
holds inspect.json 'len(j["certificate"]["rows"]) == 2'
for limit in "--max-error 1e-7" "--max-flip 1e-7"; do
  "$redmap" verify scene.toml --pixels 20 --spp 64 --minifications 4 $limit >stdout 2>stderr && fail "expected $limit to fail"
  grep -q "ball" stderr || fail "expected the object's name, found: $(cat stderr)"
done

# The smallest map that keeps an error, or none.
runs bake scene.toml -o smallest --max-error 0.3 --size 256
holds smallest/ball.json 'j["search"]["steps"] and j["certificate"]["rows"] and j["size"][1] <= 256'
refuses "no map of up to 16 texels" bake scene.toml -o none --max-error 1e-6 --size 16
refuses "keeps a FLIP error of 1e-06" bake scene.toml -o none --max-flip 1e-6 --size 16
[ ! -e none ] || fail "expected no map of what was refused"

# Maps that do not belong to the scene, or are none.
mkdir kept && cp maps/ball.exr kept/
refuses "marble" render scene.toml -o other.exr -D ball.shader=marble
refuses "cylinder" render scene.toml -o other.exr -D ball.surface=cylinder
head -c 2000 kept/ball.exr >maps/ball.exr
refuses "maps/ball.exr" render scene.toml -o other.exr
refuses "maps/ball.exr" inspect maps/ball.exr
sed -E 's/("format_version": ?)[0-9]/\19/' kept/ball.exr >maps/ball.exr
refuses "format_version" inspect maps/ball.exr
cp supersample.exr maps/ball.exr
refuses "maps/ball.exr" render scene.toml -o other.exr
rm maps/ball.exr
refuses "maps/ball.exr" render scene.toml -o other.exr
head -c 1000 supersample.exr >truncated.exr
refuses "truncated.exr" compare truncated.exr supersample.exr

# Broken meshes and keys.
printf 'v 0 0 0\nv nan 0 0\nv 0 1 0\nf 1 2 3\n' >nan.obj
printf 'ply\nformat ascii 1.0\nelement vertex 3\n' >truncated.ply
for mesh in nan.obj truncated.ply missing.obj; do
  printf '[camera]\nposition = [0, 0, 4]\n[object.thing]\nmesh = "%s"\nshader = "noise"\n' $mesh >mesh.toml
  refuses $mesh bake mesh.toml
  refuses $mesh render mesh.toml -o other.exr
  refuses $mesh mesh $mesh -o other.obj
done
refuses "noise" bake scene.toml -D ball.shader=nose
refuses "scale" bake scene.toml -D ball.scael=3
refuses "ball" bake scene.toml --object bal
head -c 100 scene.toml >truncated.toml
refuses "truncated.toml" bake truncated.toml
refuses "fbm.3" bench normals --bumps fbm.3
refuses "marbel" bench quality --objects sphere --shaders marbel
[ ! -e other.exr ] && [ ! -e other.obj ] || fail "expected no output of what was refused"

# A full disk: no room for the map or for the frame, and nothing of them is left. Mounting takes root.
mkdir small
if mount -t tmpfs -o size=8k tmpfs small 2>/dev/null; then
  refuses "small" bake scene.toml -o small/maps --size 256
  refuses "small" render scene.toml -o small/frame.exr --method original -D camera.width=200 -D camera.height=200
  [ -z "$(find small -type f)" ] || fail "expected nothing on the full disk, found: $(find small -type f)"
fi

[ $failures -eq 0 ]
