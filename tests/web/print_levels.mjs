// Feeds files in slices to the decoder in WebAssembly and prints each level, positions as bits; the
// native print_levels does the same: node print_levels.mjs DECODER.wasm FILE…

import { readFileSync } from "node:fs";

import { Decoder, compile } from "../../web/decoder.mjs";

const kSlice = 100;

function printLevel(decoder) {
  console.log(`packets ${decoder.packets()}`);
  for (let mesh = 0; mesh < decoder.meshes(); ++mesh) {
    const bits = new Uint32Array(decoder.positions(mesh).buffer);
    console.log(`positions ${bits.join(" ")}`);
    console.log(`strips ${decoder.strips(mesh).join(" ")}`);
    console.log(`triangles ${decoder.triangles(mesh).join(" ")}`);
  }
}

const [wasm, ...files] = process.argv.slice(2);
const compiled = await compile(readFileSync(wasm));
for (const file of files) {
  const bytes = readFileSync(file);
  const decoder = await Decoder.create(compiled);
  for (let at = 0; at < bytes.length; at += kSlice) {
    decoder.feed(bytes.subarray(at, at + kSlice));
    if (decoder.update()) printLevel(decoder);
  }
  console.log(`end ${decoder.error()}`);
  decoder.close();
}
