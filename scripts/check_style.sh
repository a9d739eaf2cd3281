#!/usr/bin/env bash
# Style that a machine can judge: formatting, the direction of includes, sizes of files, no loose ends.
set -euo pipefail
cd "$(dirname "$0")/.."

# Also files that are not added yet, but nothing that git ignores; without git, everything.
list_files() {
  if git rev-parse --is-inside-work-tree >/dev/null 2>&1; then
    git ls-files --cached --others --exclude-standard -- "$@" |
      while read -r file; do [[ ! -e $file ]] || echo "$file"; done
  else
    find src apps bench python tests scripts cmake -type f 2>/dev/null |
      while read -r file; do for pattern in "$@"; do [[ $file != $pattern ]] || echo "$file"; done; done
  fi
}
mapfile -t cpp < <(list_files '*.h' '*.cpp')
mapfile -t code < <(list_files '*.h' '*.cpp' '*.glsl' '*.py' '*.sh' '*.cmake' '*.in' '*CMakeLists.txt' '*.ts' '*.css' '*.mjs')
failed=0

echo "style: clang-format on ${#cpp[@]} files"
clang-format --dry-run -Werror "${cpp[@]}" || failed=1

echo "style: direction of includes"
python3 scripts/check_includes.py . || failed=1

echo "style: types and format of apps/web"
scripts/build_web.sh build/web check || failed=1

echo "style: no file over 500 lines, no loose ends"
for file in "${code[@]}"; do
  lines=$(wc -l <"$file")
  if ((lines > 500)); then
    echo "$file: expected at most 500 lines, found $lines"
    failed=1
  fi
done
if grep -nE '\b(TO[D]O|FI[X]ME)\b' "${code[@]}"; then
  echo "style: expected an issue for each of these, not a note in the code"
  failed=1
fi
exit $failed
