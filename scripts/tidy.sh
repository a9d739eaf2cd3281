#!/usr/bin/env bash
# clang-tidy on all public headers and on the modules that everything stands on; on every file with --all.
# usage: tidy.sh BUILD_DIR [--all], where BUILD_DIR holds compile_commands.json
set -euo pipefail
cd "$(dirname "$0")/.."

files=(src/redmap.h src/base/*.cpp src/map/*.cpp src/metrics/*.cpp)
[[ ${2:-} == --all ]] && files=(src/redmap.h src/*/*.cpp apps/*/*.cpp)
echo "tidy: ${#files[@]} files"
# Without the closing statistics of suppressed warnings, which are about other people's headers.
printf '%s\0' "${files[@]}" |
  xargs -0 -n 1 -P "$(nproc)" clang-tidy -p "$1" --quiet 2> >(grep -vE '^[0-9]+ warnings? generated' >&2)
