#!/usr/bin/env bash
# Every OBJ, PLY, STL, glTF and GLB file of Debian's assimp-testmodels (or of the folders given) is loaded and unwrapped,
# or refused in one line: prints a table, and fails if any file crashes the program, takes over a minute, or leaves an
# atlas with flips or overlap. Not part of ./check.
#
# Usage: scripts/torture_meshes.sh [PROGRAM [FOLDER...]]   PROGRAM: build/release/redmap by default; build/asan/redmap
#                                                          finds more
set -euo pipefail
cd "$(dirname "$0")/.."

program=${1:-build/release/redmap}
folders=("${@:2}")
((${#folders[@]})) || folders=(/usr/share/assimp/models)
for folder in "${folders[@]}"; do
  [[ -d $folder ]] || { echo "$folder: expected a folder of models (apt-get install assimp-testmodels)" >&2; exit 1; }
done
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

loaded=0 refused=0 failed=0
while IFS= read -r file; do
  status=0
  timeout 60 "$program" unwrap "$file" -o "$work/out.ply" --json "$work/out.json" \
    >"$work/stdout" 2>"$work/stderr" || status=$?
  if ((status == 0)); then
    row=$(python3 - "$work/out.json" <<'PYTHON'
import json, sys
result = json.load(open(sys.argv[1]))
atlas = result["atlas"]
print(f'{result["triangles"]:8} triangles {atlas["charts"]:5} charts  L2 {atlas["l2_stretch"]:.3f}  '
      f'{100 * atlas["packing"]:.0f} % packed  {atlas["seconds"]:.2f} s')
sys.exit(0 if atlas["flips"] == 0 and atlas["overlap_texels"] == 0 else 3)
PYTHON
    ) || { row="FLIPS OR OVERLAP  $row"; failed=$((failed + 1)); }
    loaded=$((loaded + 1))
  elif ((status == 1)) && [[ $(wc -l <"$work/stderr") -eq 1 ]]; then
    row=$(sed -e 's/^redmap: /refused: /' -e "s|$file|FILE|" "$work/stderr")
    refused=$((refused + 1))
  else
    row="CRASHED OR TOO SLOW, status $status: $(tail -1 "$work/stderr")"
    failed=$((failed + 1))
  fi
  printf '%-70s %s\n' "${file#/usr/share/assimp/models/}" "$row"
done < <(find "${folders[@]}" -type f -regextype posix-extended -iregex '.*\.(obj|ply|stl|gltf|glb)' | sort)

echo "$loaded loaded and unwrapped, $refused refused, $failed failed"
((failed == 0))
