#!/usr/bin/env bash
# Builds apps/web: checks types and format, the npm package in dist/ and the viewer page in page/, below a folder of its own.
# What npm installs there, each at its locked version, stays for the next time.
#   build_web.sh FOLDER [check]    check: builds nothing
set -euo pipefail
source_folder=$(cd "$(dirname "$0")/../apps/web" && pwd)
command -v npm >/dev/null || { echo "web: expected npm, found none: scripts/setup.sh installs it"; exit 1; }
mkdir -p "$1"
cd "$1"

lock=$(sha256sum <"$source_folder/package-lock.json")
if [[ ! -f installed || $(<installed) != "$lock" ]]; then
  cp "$source_folder/package.json" "$source_folder/package-lock.json" .
  npm ci --ignore-scripts --no-audit --no-fund --loglevel=error >&2
  echo "$lock" >installed
fi
# The sources as they are now, and nothing that was there before.
rm -rf src test dist page
tar -C "$source_folder" --exclude=./node_modules --exclude=./dist --exclude=./page -cf - . | tar -xf -
npm run --silent check
[[ ${2:-} != check ]] || exit 0
npm run --silent build -- --logLevel warn
