#!/usr/bin/env bash
# Installs what redmap is built and checked with, from Debian's packages. Does nothing where all of it is there.
set -euo pipefail

packages=(cmake ninja-build pkg-config g++ ccache mold libembree-dev libopenexr-dev libopenimageio-dev libtbb-dev
  libeigen3-dev libcli11-dev libtomlplusplus-dev nlohmann-json3-dev libfmt-dev libtinygltf-dev libdraco-dev libstb-dev
  libgtest-dev libbenchmark-dev libmeshoptimizer-dev mesa-vulkan-drivers libvulkan-dev vulkan-validationlayers
  libglfw3-dev libimgui-dev libgl-dev xvfb glslang-dev glslang-tools spirv-tools clang-format clang-tidy clang-16
  libclang-rt-16-dev valgrind git python3 python3-dev python3-venv libceres-dev
  openimageio-tools chromium libegl-dev libopengl-dev zlib1g-dev libtiff-dev libcpp-httplib-dev)
command -v npm >/dev/null || packages+=(nodejs npm)

missing=()
for package in "${packages[@]}"; do
  [[ $(dpkg-query -W -f '${Status}' "$package" 2>/dev/null) == "install ok installed" ]] || missing+=("$package")
done
if ((${#missing[@]} == 0)); then
  echo "setup: all ${#packages[@]} packages are installed"
  exit 0
fi

as_root=()
((EUID == 0)) || as_root=(sudo)
echo "setup: installing ${missing[*]}"
"${as_root[@]}" apt-get update -q
DEBIAN_FRONTEND=noninteractive "${as_root[@]}" apt-get install -y -q --no-install-recommends "${missing[@]}"
echo "setup: installed ${#missing[@]} packages"
