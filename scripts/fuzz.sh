#!/usr/bin/env bash
# Runs the fuzzer of every parser for some seconds each, from seeds that are made anew and from what earlier runs found.
# usage: fuzz.sh BUILD_DIR SECONDS [PARSER ...], where BUILD_DIR was built with the preset fuzz
set -euo pipefail
cd "$(dirname "$0")/.."
build=$1
seconds=$2
shift 2

parsers=("$@")
((${#parsers[@]})) || parsers=(scene overrides frame_spec obj ply stl gltf glb map map_description shader_text)
"$build"/fuzz/fuzz_make_seeds . "$build/fuzz/seeds"
failed=0
for parser in "${parsers[@]}"; do
  corpus=$build/fuzz/corpus/$parser
  log=$build/fuzz/$parser.log
  mkdir -p "$corpus"
  # Inputs larger than the largest seed say little that smaller ones do not.
  if "$build/fuzz/fuzz_$parser" -max_total_time="$seconds" -timeout=10 -rss_limit_mb=2048 -max_len=16384 -print_final_stats=1 \
    -artifact_prefix="$build/fuzz/found_${parser}_" "$corpus" "$build/fuzz/seeds/$parser" >"$log" 2>&1; then
    echo "fuzz: $parser: $(grep -o 'number_of_executed_units: .*' "$log" | grep -o '[0-9]*') inputs, nothing found"
  else
    echo "fuzz: $parser: $(grep -E 'ERROR|SUMMARY|terminate|what\(\)' "$log" | head -3), see $log"
    failed=1
  fi
done
exit $failed
