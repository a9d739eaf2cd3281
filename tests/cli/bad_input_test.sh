#!/bin/bash
# Bad input on the command line: exit status 1 and one line on stderr that says what was wrong.
#   bad_input_test.sh REDMAP_BINARY
set -u
redmap=$1
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
failures=0

# refuses PART ARGUMENTS...: `redmap ARGUMENTS` must complain about PART.
refuses() {
  local part=$1 status
  shift
  "$redmap" "$@" >"$folder/stdout" 2>"$folder/stderr"
  status=$?
  if [ $status -ne 1 ] || [ "$(wc -l <"$folder/stderr")" -ne 1 ] || ! grep -q '^redmap: ' "$folder/stderr" ||
    ! grep -qF -- "$part" "$folder/stderr"; then
    echo "redmap $*: expected status 1 and one line with \"$part\", found status $status and:"
    cat "$folder/stderr"
    failures=$((failures + 1))
  fi
}

# accepts PART ARGUMENTS...: `redmap ARGUMENTS` must succeed in silence and print PART.
accepts() {
  local part=$1
  shift
  if ! "$redmap" "$@" >"$folder/stdout" 2>"$folder/stderr" || [ -s "$folder/stderr" ] ||
    ! grep -qF -- "$part" "$folder/stdout"; then
    echo "redmap $*: expected success and \"$part\", found:"
    cat "$folder/stdout" "$folder/stderr"
    failures=$((failures + 1))
  fi
}

accepts "redmap 0." --version
accepts "redmap bake" --help
for command in bake render compare inspect list mesh unwrap; do accepts "--threads" $command --help; done
accepts "quality" bench --help
accepts "noise" list
accepts "checker" list shaders
accepts "[0.1, 1000]" list noise
accepts "[0.1, 1000]" list parameters noise
accepts "Vulkan 1." list devices
VK_ICD_FILENAMES=/nowhere accepts "no device" list devices
accepts "noise" list noise --json "$folder/noise.json"
python3 -c 'import json, sys; assert json.load(open(sys.argv[1]))["name"] == "noise"' "$folder/noise.json" || failures=$((failures + 1))

# Names in old files may be in no encoding that JSON knows.
printf 'g K\xf6rper\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n' >"$folder/latin.obj"
accepts "L2 stretch" unwrap "$folder/latin.obj" -o "$folder/latin.ply" --json "$folder/latin.json" --size 64
python3 -c 'import json, sys; assert json.load(open(sys.argv[1]))["atlas"]["charts"] == 1' "$folder/latin.json" || failures=$((failures + 1))

refuses "subcommand"
refuses "nonsense" nonsense
refuses "see redmap list --help" list --nonsense
refuses "noise" list nois
refuses "expected the name of a shader" list parameters
refuses "expected nothing after it" list noise marble
refuses "expected nothing after it" list devices marble
refuses "threads" list --threads many
refuses "$folder/no/such/folder" list --json "$folder/no/such/folder/list.json"
[ ! -e "$folder/no" ] || failures=$((failures + 1))

printf '[camera]\nposition = [0, 0, 5]\n[object.ball]\nsurface = "sphere"\nshader = "noise"\nsacle = 2\n' >"$folder/broken.toml"
refuses "$folder/missing.toml" bake "$folder/missing.toml"
refuses "$folder/missing.toml" render "$folder/missing.toml" -o "$folder/out.png"
refuses "broken.toml:6:9: object.ball.sacle: unknown key (did you mean \"scale\"?)" bake "$folder/broken.toml"
refuses "broken.toml:6:9: object.ball.sacle" render "$folder/broken.toml" -o "$folder/out.png"
refuses "$folder/missing.exr" inspect "$folder/missing.exr"
refuses "missing" compare "$folder/missing.exr" "$folder/missing.exr"
[ ! -e "$folder/out.png" ] || failures=$((failures + 1))

# Objects may share a map where they are alike; -o keeps only the file's name. -D and --object leave the scene alone.
printf '[camera]\nposition = [0, 0, 5]\n' >"$folder/shared.toml"
for name in left right; do
  printf '[object.%s]\nsurface = "sphere"\nshader = "checker"\nmap = "%s/m.exr"\nmap_size = 16\n' $name $name >>"$folder/shared.toml"
done
accepts "right: shares $folder/out/m.exr" bake -D left.scale=4 -D right.scale=4 "$folder/shared.toml" -o "$folder/out"
refuses "found \"left\" and \"right\", which differ in shader parameters" bake -D left.scale=3 "$folder/shared.toml" -o "$folder/no"
refuses "differ in map_size" bake -D object.left.map_size=8 "$folder/shared.toml" -o "$folder/no"
accepts "left: checker" bake --object left "$folder/shared.toml" -D left.scale=3 -o "$folder/out"
[ ! -e "$folder/no" ] || failures=$((failures + 1))

[ $failures -eq 0 ]
