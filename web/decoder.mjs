// The decoder in JavaScript: bytes in, positions and triangles out.

const text = new TextDecoder();

// Compiles decoder.wasm, given as bytes.
export async function compile(wasm) {
  const module = await WebAssembly.compile(wasm);
  // The decoder opens, reads and writes nothing; only what ends a program is linked at all.
  const imports = {};
  for (const { module: from, name } of WebAssembly.Module.imports(module)) {
    imports[from] ??= {};
    imports[from][name] = () => {
      throw new Error(`the decoder has stopped in ${name}`);
    };
  }
  return { module, imports };
}

export class Decoder {
  static async create({ module, imports }) {
    const { exports } = await WebAssembly.instantiate(module, imports);
    exports._initialize();
    return new Decoder(exports);
  }

  constructor(exports) {
    this.wasm = exports;
    this.viewer = exports.pstrips_open();
  }

  close() {
    this.wasm.pstrips_close(this.viewer);
  }

  // Takes the next bytes of the file; throws what is wrong with them.
  feed(bytes) {
    const at = this.wasm.pstrips_allocate(bytes.length);
    new Uint8Array(this.wasm.memory.buffer, at, bytes.length).set(bytes);
    const failed = this.wasm.pstrips_feed(this.viewer, at, bytes.length);
    this.wasm.pstrips_release(at);
    if (failed) throw new Error(this.error());
  }

  // What is missing if no more bytes come; empty for a whole file.
  error() {
    const at = this.wasm.pstrips_error(this.viewer);
    const bytes = new Uint8Array(this.wasm.memory.buffer, at);
    return text.decode(bytes.subarray(0, bytes.indexOf(0)));
  }

  // Whether there is something new to show.
  update() {
    return this.wasm.pstrips_update(this.viewer) !== 0;
  }

  packets() {
    return this.wasm.pstrips_packets(this.viewer);
  }

  meshes() {
    return this.wasm.pstrips_meshes(this.viewer);
  }

  // x, y and z of each vertex.
  positions(mesh) {
    const at = this.wasm.pstrips_positions(this.viewer, mesh);
    const count = 3 * this.wasm.pstrips_vertex_count(this.viewer, mesh);
    return new Float32Array(this.wasm.memory.buffer, at, count).slice();
  }

  // Display strips of vertices, parted by 0xffffffff.
  strips(mesh) {
    return this.entries(this.wasm.pstrips_strips(this.viewer, mesh));
  }

  // Three vertices a triangle.
  triangles(mesh) {
    return this.entries(this.wasm.pstrips_triangles(this.viewer, mesh));
  }

  entries(at) {
    const count = this.wasm.pstrips_entries(this.viewer);
    return new Uint32Array(this.wasm.memory.buffer, at, count).slice();
  }
}
