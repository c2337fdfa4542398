// Feeds files in slices to the decoder in WebAssembly, puts its patches together and prints each
// level, positions as bits; the native print_levels does the same: node print_levels.mjs DECODER.wasm FILE…

import { readFileSync } from "node:fs";

import { MeshLevel } from "../../web/src/mesh_level.js";
import { WasmDecoder } from "../../web/src/wasm.js";

const slice = 100;

function printLevel(decoder, meshes) {
  console.log(`packets ${decoder.totals().packets}`);
  for (const mesh of meshes) {
    console.log(`positions ${new Uint32Array(mesh.positions.buffer, 0, 3 * mesh.wedges).join(" ")}`);
    console.log(`triangles ${mesh.indices.subarray(0, 3 * mesh.triangles).join(" ")}`);
    console.log(`groups ${mesh.groups.map((group) => group.count).join(" ")}`);
    console.log(`strips ${mesh.strips?.join(" ") ?? ""}`);
  }
}

const [wasm, ...files] = process.argv.slice(2);
const module = await WebAssembly.compile(readFileSync(wasm));
for (const file of files) {
  const bytes = readFileSync(file);
  const decoder = await WasmDecoder.create(module, { maxMemory: 2 ** 30, strips: true });
  let meshes;
  for (let at = 0, whole = true; whole && at < bytes.length; at += slice) {
    whole = decoder.feed(bytes.subarray(at, at + slice));
    const update = decoder.update();
    if (!update?.level) continue;
    meshes ??= update.scene.meshes.map((description) => new MeshLevel(description));
    for (const patch of update.meshes) meshes[patch.mesh].apply(patch);
    printLevel(decoder, meshes);
  }
  const problem = decoder.problem();
  console.log(`end ${problem ? `${problem.code} ${problem.offset} ${problem.message}` : ""}`);
  decoder.close();
}
