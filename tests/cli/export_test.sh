#!/bin/bash
# What `redmap export` writes, read back by programs of others: Khronos' glTF validator, ktx-parse, OpenImageIO and
# MaterialX' validator. Skipped where scripts/export/install_tools.sh has not run.
#   export_test.sh REDMAP_BINARY SOURCE_FOLDER
set -u
redmap=$1
source=$2
tools=$source/build/export
[ -f "$tools/installed" ] || exit 77
. "$(dirname "$0")/run_redmap.sh"
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder" || exit 1

cat >scene.toml <<'END'
[camera]
position = [0, 0, 4]
width = 64
height = 64
[light.key]
type = "point"
position = [2, 3, 4]
intensity = 40
[object.ball]
surface = "sphere"
radius = 1
shader = "chrome_rubber"
[object.bumpy]
surface = "cylinder"
radius = 0.6
shader = "hammered_metal"
END
runs bake scene.toml --size 64
[ $failures -eq 0 ] || exit 1

for name in ball bumpy; do
  for kind in gltf ktx2 tx mtlx; do
    runs export maps/$name.exr --scene scene.toml --to $kind --materials k -o $name/$kind
    says "fit error"
    [ -s $name/$kind/manifest.json ] || fail "expected a manifest of $name/$kind"
  done
  node "$source/scripts/export/read_back.mjs" "$tools" $name/gltf || fail "expected a valid glTF of $name"
  node "$source/scripts/export/read_back.mjs" "$tools" $name/ktx2 || fail "expected KTX2 textures of $name"
  "$tools/python/bin/python" "$source/scripts/export/validate_mtlx.py" $name/mtlx/$name.mtlx ||
    fail "expected a valid MaterialX document of $name"
  for texture in $name/tx/*.tx; do
    oiiotool --info -v "$texture" >info || fail "expected a texture in $texture"
    for field in 'textureformat: "Plain Texture"' 'MIP-map levels:' 'tile size: 64 x 64' 'AverageColor' 'wrapmodes'; do
      grep -qF "$field" info || fail "$texture: expected '$field', found: $(cat info)"
    done
  done
done
python3 -c '
import json
manifest = json.load(open("ball/gltf/manifest.json"))
assert manifest["basis"] == len(manifest["masks"]) == len(manifest["materials"]) == 2, manifest
gltf = json.load(open("ball/gltf/ball.gltf"))
assert gltf["extras"]["redmap"] == manifest and len(gltf["materials"]) == 3, gltf["materials"]
assert "normalTexture" in json.load(open("bumpy/gltf/bumpy.gltf"))["materials"][0]
' || fail "expected masks and materials in the manifest"

# The same bytes for any number of threads, and nothing but whole exports.
runs export maps/ball.exr --scene scene.toml --to gltf --materials k --threads 1 -o again
diff -r ball/gltf again || fail "expected the same export for any number of threads"
runs export maps/ball.exr --to ktx2 -o again
[ ! -e again/ball.gltf ] || fail "expected the earlier export to be replaced"
mkdir precious && touch precious/file
refuses "precious: expected no such folder" export maps/ball.exr --to ktx2 -o precious
refuses "found no scene: name it with --scene" export maps/ball.exr --to gltf -o none
refuses "none.exr" export none.exr --to ktx2 -o none
[ ! -e none ] && [ -z "$(find . -name '.*.??????')" ] || fail "expected nothing to be left of an export that failed"

# A tile of a mesh whose uv spread over several: the document names them all.
cp maps/ball.exr maps/ball.1001.exr
runs export maps/ball.1001.exr --to mtlx -o tile
[ -s tile/ball.1001.mask01.png ] && grep -qF 'value="ball.&lt;UDIM&gt;.mask01.png"' tile/ball.mtlx ||
  fail "expected ball.1001.mask01.png, and ball.mtlx naming its pattern, found: $(ls tile)"
"$tools/python/bin/python" "$source/scripts/export/validate_mtlx.py" tile/ball.mtlx || fail "expected a valid document"

# Killed at any moment, an export leaves the earlier one whole, or is whole itself; interrupted, it also leaves nothing else.
runs export maps/ball.exr --scene scene.toml --to gltf --materials one -o one
runs export maps/ball.exr --scene scene.toml --to gltf --materials one -o victim
for signal in KILL INT; do
  for delay in 0.03 0.1 0.2 0.3 0.45; do
    # Python asks for SIGINT anew, which a shell turns off for what it starts in the background.
    python3 -c '
import signal, subprocess, sys, time
export = subprocess.Popen(sys.argv[3:], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
                          preexec_fn=lambda: signal.signal(signal.SIGINT, signal.SIG_DFL))
time.sleep(float(sys.argv[2]))
export.send_signal(getattr(signal, "SIG" + sys.argv[1]))
export.wait()' $signal $delay "$redmap" export maps/ball.exr --scene scene.toml --to gltf --materials k -o victim
    diff -r victim one >/dev/null || diff -r victim ball/gltf >/dev/null ||
      fail "SIG$signal after $delay s: expected a whole export, found: $(ls -a victim)"
    [ $signal = KILL ] || [ -z "$(find . -name '.victim.*')" ] || fail "SIGINT after $delay s: expected nothing to be left"
  done
  rm -rf .victim.*
  runs export maps/ball.exr --scene scene.toml --to gltf --materials one -o victim
done
exit $((failures > 0))
