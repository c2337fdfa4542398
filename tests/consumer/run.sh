#!/usr/bin/env bash
# Installs the built library into an empty prefix and builds a stranger's project against it, found by
# CMake and by pkg-config: run.sh BUILD_DIR CONSUMER_DIR
set -euo pipefail
build=$1 consumer=$2
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cmake --install "$build" --prefix "$work/prefix" > /dev/null
cmake -S "$consumer" -B "$work/build" -G Ninja -DCMAKE_PREFIX_PATH="$work/prefix" > /dev/null
cmake --build "$work/build" > "$work/log" || { cat "$work/log"; exit 1; }
"$work/build/consumer" "$work/tetrahedron.pstrip"
"$work/build/viewer" "$work/tetrahedron.pstrip"

if command -v pkg-config > /dev/null; then
  PKG_CONFIG_PATH=$(dirname "$(find "$work/prefix" -name pstrips.pc)")
  export PKG_CONFIG_PATH
  # Flags are words.
  # shellcheck disable=SC2046
  c++ -std=c++20 "$consumer/viewer.cpp" -o "$work/viewer" $(pkg-config --cflags --libs pstrips-decoder)
  "$work/viewer" "$work/tetrahedron.pstrip"
  pkg-config --exists --print-errors pstrips
fi
