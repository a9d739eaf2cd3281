#!/usr/bin/env bash
# The Python module as its users get it: a wheel, built and installed in a virtual environment of build/, its tests, and
# their types against its stubs. Everything it takes from PyPI is locked in python/requirements.txt.
# usage: check_python.sh BUILD_DIR, where BUILD_DIR holds the program of the same sources
set -euo pipefail
cd "$(dirname "$0")/.."
program=$(realpath "$1")/redmap
environment=build/python

if ! cmp -s python/requirements.txt "$environment/requirements.txt"; then
  rm -rf "$environment"
  python3 -m venv "$environment"
  "$environment/bin/pip" install -q --disable-pip-version-check -r python/requirements.txt
  cp python/requirements.txt "$environment/"
fi

# By the compiler that the presets use, so that ccache knows nearly all of it already.
export CXX=c++ CC=cc
command -v ccache >/dev/null && export CMAKE_CXX_COMPILER_LAUNCHER=ccache CMAKE_C_COMPILER_LAUNCHER=ccache
rm -rf build/wheels
"$environment/bin/pip" wheel -q --disable-pip-version-check --no-deps --no-build-isolation -w build/wheels .
"$environment/bin/pip" install -q --disable-pip-version-check --no-deps --force-reinstall build/wheels/redmap-*.whl

# Without a cache, which would remember an older package.
"$environment/bin/mypy" --cache-dir=/dev/null --config-file pyproject.toml tests/python
REDMAP_PROGRAM=$program "$environment/bin/pytest" -q -p no:cacheprovider tests/python
