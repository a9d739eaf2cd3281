#!/usr/bin/env bash
# Installs a build to a temporary place and uses it as a stranger would: the sample of README.md, which is the block of
# cpp code after the line "<!-- sample -->", is compiled through find_package(redmap) and run.
# usage: check_install.sh BUILD_DIR
set -euo pipefail
cd "$(dirname "$0")/.."
root=$PWD
build=$(realpath "$1")
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

cmake --install "$build" --prefix "$work/prefix" >"$work/install.log" || { cat "$work/install.log"; exit 1; }

[[ -f README.md ]] || { echo "README.md: expected it with the sample of the library, found no such file"; exit 1; }
mkdir "$work/sample"
awk '/^<!-- sample -->$/ { marked = 1; next }
     marked && /^```cpp$/ { inside = 1; next }
     inside && /^```$/ { exit }
     inside' README.md >"$work/sample/sample.cpp"
if [[ ! -s $work/sample/sample.cpp ]]; then
  echo "README.md: expected a block of cpp code after the line <!-- sample -->, found none"
  exit 1
fi
cat >"$work/sample/CMakeLists.txt" <<'END'
cmake_minimum_required(VERSION 3.25)
project(sample LANGUAGES CXX)
find_package(redmap REQUIRED)
add_executable(sample sample.cpp)
target_link_libraries(sample PRIVATE redmap::redmap)
END
cmake -S "$work/sample" -B "$work/build" -G Ninja -DCMAKE_BUILD_TYPE=Release -DCMAKE_PREFIX_PATH="$work/prefix" \
  >"$work/configure.log" || { cat "$work/configure.log"; exit 1; }
cmake --build "$work/build"

# The sample finds the scenes and models of the repository, and what it writes goes away with it.
mkdir "$work/run"
for folder in scenes models; do [[ -e $root/$folder ]] && ln -s "$root/$folder" "$work/run/$folder"; done
(cd "$work/run" && "$work/build/sample")

# The plug-in of docs/bring_your_shader.md, which the installed program bakes and renders.
cmake -S docs/examples/plugin -B "$work/plugin" -G Ninja -DCMAKE_BUILD_TYPE=Release \
  -DCMAKE_PREFIX_PATH="$work/prefix" >"$work/configure.log" || { cat "$work/configure.log"; exit 1; }
cmake --build "$work/plugin"
cp docs/examples/plugin/candy.toml "$work/plugin/"
"$work/prefix/bin/redmap" bake "$work/plugin/candy.toml"
"$work/prefix/bin/redmap" render "$work/plugin/candy.toml" -o "$work/plugin/candy.png"
echo "install: the sample of README.md and the plug-in were compiled against the installed library and ran"
