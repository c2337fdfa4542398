// One file while it is decoded, for a worker and for a page without one: bytes in, patches out.

import { WasmDecoder } from "./wasm.js";

// Small enough that a limit is not overshot by much, and that the base is shown alone.
const slice = 4096;

export class Session {
  static async create(module, options) {
    return new Session(await WasmDecoder.create(module, options), options);
  }

  constructor(decoder, { maxTriangles = Infinity, maxError = 0 }) {
    this.decoder = decoder;
    this.maxTriangles = maxTriangles;
    this.maxError = maxError;
    this.bytes = 0;
    this.decoding = 0;
    this.updating = 0;
    this.enough = false;
  }

  close() {
    this.decoder.close();
  }

  // Takes bytes up to the next level that is worth showing: { taken, bytes, enough, problem, totals,
  // update }. `last` says that no more follow, then the rest is shown in any case.
  step(bytes, last) {
    let taken = 0, whole = true, shows = false;
    while (taken < bytes.length && whole && !shows && !this.enough) {
      const start = performance.now();
      const end = Math.min(taken + slice, bytes.length);
      whole = this.decoder.feed(bytes.subarray(taken, end));
      this.decoding += performance.now() - start;
      this.bytes += end - taken;
      taken = end;
      const { triangles, error } = this.decoder.totals();
      this.enough = triangles > 0 && (triangles >= this.maxTriangles || (this.maxError > 0 && error <= this.maxError));
      // Making a level costs as much as it holds; half of the time goes into that, at most.
      shows = triangles > 0 && this.decoding > this.updating;
    }
    const ends = !whole || this.enough || (last && taken === bytes.length);
    const update = shows || ends ? this.show() : undefined;
    return {
      taken, bytes: this.bytes, enough: this.enough, update, totals: this.decoder.totals(),
      problem: !whole || (ends && !this.enough) ? this.decoder.problem() : undefined,
    };
  }

  show() {
    const start = performance.now();
    const update = this.decoder.update();
    this.updating += performance.now() - start;
    return update;
  }
}

// The buffers that a message about an update can give away.
export function transfers(update) {
  if (!update) return [];
  const pieces = update.meshes.flatMap((mesh) => [...mesh.positions, ...mesh.indices, ...mesh.attributes]);
  return [...pieces, ...update.images].map((piece) => piece.data.buffer)
    .concat(update.meshes.flatMap((mesh) => (mesh.strips ? [mesh.strips.buffer] : [])));
}
