#!/usr/bin/env bash
# Installs what reads back the files of `redmap export`, each at its locked version, in build/export: Khronos'
# gltf-validator, ktx-parse and playwright-core from npm, MaterialX from PyPI. What is there already stays.
set -euo pipefail
cd "$(dirname "$0")/../.."

work=build/export
hash=$(cat scripts/export/package-lock.json scripts/export/requirements.txt | sha256sum | cut -d ' ' -f 1)
if [[ -f $work/installed && $(<"$work/installed") == "$hash" ]]; then
  echo "export: the tools are installed"
  exit 0
fi
mkdir -p "$work"
cp scripts/export/package.json scripts/export/package-lock.json "$work/"
npm ci --prefix "$work" --ignore-scripts --no-audit --no-fund --loglevel=error >&2
python3 -m venv "$work/python"
"$work/python/bin/pip" install -q --disable-pip-version-check --no-deps --require-hashes -r scripts/export/requirements.txt
echo "$hash" > "$work/installed"
echo "export: installed the tools"
