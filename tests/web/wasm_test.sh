#!/usr/bin/env bash
# Compiles the decoder for WebAssembly, decodes files with it in Node and wants what the native decoder
# gives: wasm_test.sh SOURCE_DIR LIST_OF_SOURCES EXPECTED_INCLUDE_DIR PRINT_LEVELS
set -euo pipefail
source=$1 list=$2 expected=$3 print_levels=$4

for tool in clang++-19 wasm-ld-19 node; do
  if ! command -v "$tool" > /dev/null; then
    echo "SKIPPED: $tool is not installed (scripts/packages-check)"
    exit 77
  fi
done
compiler=(clang++-19 --target=wasm32-wasi -stdlib=libc++ -std=c++20 -Oz -flto -fno-exceptions -fno-rtti)
if ! "${compiler[@]}" -fsyntax-only -x c++ - <<< '#include <vector>' 2> /dev/null; then
  echo "SKIPPED: no C++ library for wasm32-wasi (scripts/packages-check)"
  exit 77
fi

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
mkdir -p "$work/include"
# The system's own headers must stay out of reach.
cp -r "$expected/tl" "$work/include/tl"
mapfile -t sources < "$list"
"${compiler[@]}" -mexec-model=reactor -Wl,--no-entry,--strip-all -DNDEBUG -DPSTRIPS_WITHOUT_ZLIB \
  -I"$source" -isystem "$work/include" "${sources[@]}" "$source/web/decoder.cpp" -o "$work/decoder.wasm"
if command -v wasm-opt > /dev/null; then
  wasm-opt -Oz --enable-bulk-memory --enable-sign-ext --enable-nontrapping-float-to-int \
    "$work/decoder.wasm" -o "$work/decoder.wasm"
fi
echo "decoder.wasm: $(stat -c %s "$work/decoder.wasm") bytes, $(gzip -9 < "$work/decoder.wasm" | wc -c) under gzip -9"

files=("$source"/tests/data/golden/*.pstrip "$source"/tests/data/valid/*.pstrip)
node "$source/tests/web/print_levels.mjs" "$work/decoder.wasm" "${files[@]}" > "$work/wasm"
"$print_levels" "${files[@]}" > "$work/native"
cmp "$work/wasm" "$work/native"
echo "${#files[@]} files, $(grep -c '^packets' "$work/native") levels: the same as native"
