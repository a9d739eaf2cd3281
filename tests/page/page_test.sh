#!/usr/bin/env bash
# The report of a small `redmap bench paper`, opened in headless Chromium; an interrupted one leaves nothing.
#   page_test.sh REDMAP_BINARY FOLDER, where the report and screenshots go
set -euo pipefail
source_folder=$(cd "$(dirname "$0")" && pwd)
tools=$source_folder/../../build/export
redmap=$1
folder=$2
for program in node "${CHROMIUM:-/usr/bin/chromium}"; do
  command -v "$program" >/dev/null || { echo "there is no $program; scripts/setup.sh installs it"; exit 77; }
done
[[ -d $tools/node_modules/playwright-core ]] || { echo "there is no playwright-core; scripts/export/install_tools.sh fetches it"; exit 77; }

mkdir -p "$folder"
cd "$folder"

small=(bench paper --quick --object sphere --size 32)
rm -f report.json report.html report.txt
"$redmap" "${small[@]}" --json report.json --html report.html >report.txt 2>stderr &
bench=$!
# In the middle: after the first figure.
for ((i = 0; i < 600; ++i)); do
  [[ ! -s report.txt ]] || break
  sleep 0.1
done
kill -INT $bench
status=0
wait $bench || status=$?
[[ $status -eq 130 && $(cat stderr) == interrupted && ! -e report.json && ! -e report.html ]] ||
  { echo "interrupted: expected status 130 and no files, found status $status and: $(cat stderr)"; exit 1; }

"$redmap" "${small[@]}" --figures fig4,filters,flicker --json report.json --html report.html >report.txt
python3 - <<'PYTHON'
import json
report = json.load(open("report.json"))
assert [figure["id"] for figure in report["figures"]] == ["fig4", "flicker", "filters"], report["figures"]
assert report["machine"]["processor"] and report["machine"]["system"] and report["version"]
for figure in report["figures"]:
    assert figure["title"] in open("report.txt").read(), figure["title"]
    for table in figure["tables"]:
        keys = {column["key"] for column in table["columns"]}
        assert table["rows"] and all(set(row) == keys for row in table["rows"]), table["key"]
PYTHON
node "$source_folder/page_test.mjs" "$tools/node_modules" report.html .
