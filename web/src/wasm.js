// The decoder in WebAssembly behind one synchronous class; what leaves it are copies, so that the
// memory it stands in may grow or go away.

const text = new TextDecoder();

// In the order of pstrips::ErrorCode.
const codes = ["bad argument", "io", "truncated", "corrupt", "over limit", "unsupported", "interrupted"];

// In the order of pstrips::ComponentType.
const arrays = [Int8Array, Uint8Array, Int16Array, Uint16Array, Int32Array, Uint32Array, Float32Array, Float64Array];

// In the order of the members of PstripsMesh.
const fields = ["vertices", "wedges", "triangles", "groups", "stripEntries", "positions", "triangleList", "groupFirst", "strips",
                "changed", "changedWedges", "changedTriangles"];

// The constructor for elements of an attribute.
export const arrayOf = (attribute) => arrays[attribute.type];

// Why a file, or the rest of it, was not taken; `offset` is a byte of the file, where one is known.
export class PStripError extends Error {
  constructor(code, message, offset) {
    super(offset === undefined ? `${code}: ${message}` : `${code} at byte ${offset}: ${message}`);
    this.name = "PStripError";
    this.code = code;
    this.offset = offset;
  }
}

export class WasmDecoder {
  static async create(module, options) {
    // The decoder opens, reads and writes nothing; only what ends a program is imported at all.
    const imports = {};
    for (const { module: from, name } of WebAssembly.Module.imports(module)) {
      imports[from] ??= {};
      imports[from][name] = () => {
        throw new PStripError("over limit", "the decoder ran out of memory");
      };
    }
    const { exports } = await WebAssembly.instantiate(module, imports);
    exports._initialize();
    return new WasmDecoder(exports, options);
  }

  constructor(exports, { maxMemory, strips }) {
    this.wasm = exports;
    this.viewer = exports.pstrips_open(maxMemory, strips ? 1 : 0);
    this.scene = undefined;
    this.sizes = [];
    this.images = [];
  }

  close() {
    if (this.viewer) this.wasm.pstrips_close(this.viewer);
    this.viewer = 0;
  }

  // Takes the next bytes of the file; false after an error, which stays.
  feed(bytes) {
    const at = this.wasm.pstrips_allocate(bytes.length);
    if (!at) throw new PStripError("over limit", "the decoder ran out of memory");
    new Uint8Array(this.wasm.memory.buffer, at, bytes.length).set(bytes);
    const failed = this.wasm.pstrips_feed(this.viewer, at, bytes.length);
    this.wasm.pstrips_release(at);
    return !failed;
  }

  // What was wrong, or what is missing if no more bytes come; undefined for a whole file.
  problem() {
    const code = this.wasm.pstrips_error_code(this.viewer);
    if (code < 0) return undefined;
    const at = this.wasm.pstrips_error(this.viewer);
    const bytes = new Uint8Array(this.wasm.memory.buffer, at);
    const offset = this.wasm.pstrips_error_offset(this.viewer);
    return { code: codes[code], message: text.decode(bytes.slice(0, bytes.indexOf(0))), offset: offset < 0 ? undefined : offset };
  }

  totals() {
    return {
      packets: this.wasm.pstrips_packets(this.viewer),
      vertices: this.wasm.pstrips_vertices(this.viewer),
      triangles: this.wasm.pstrips_triangles(this.viewer),
      error: this.wasm.pstrips_distance(this.viewer),
    };
  }

  // What is new to show: { level: whether it is one; scene, once; meshes: a patch for each that has
  // changed; images }, or undefined.
  update() {
    const images = this.scene ? this.newImages() : [], level = this.wasm.pstrips_update(this.viewer) === 1;
    const out = { level, meshes: [], images };
    if (!level) return images.length ? out : undefined;
    if (!this.scene) {
      this.scene = this.readScene();
      this.sizes = this.scene.meshes.map(() => 0);
      out.scene = this.scene;
    }
    this.scene.meshes.forEach((mesh, i) => {
      const patch = this.patch(i, mesh.attributes);
      if (patch) out.meshes.push(patch);
    });
    return out;
  }

  // What has changed of a mesh, copied. `attributes` go on where those of the patch before ended.
  patch(index, attributes) {
    const at = this.wasm.pstrips_mesh(this.viewer, index);
    const words = new Uint32Array(this.wasm.memory.buffer, at, fields.length);
    const mesh = Object.fromEntries(fields.map((name, i) => [name, words[i]]));
    const ranges = this.copy(Uint32Array, mesh.changed, 2 * (mesh.changedWedges + mesh.changedTriangles));
    const known = this.sizes[index];
    if (!ranges.length && known) return undefined;
    this.sizes[index] = mesh.wedges;
    const wedges = ranges.subarray(0, 2 * mesh.changedWedges), triangles = ranges.subarray(2 * mesh.changedWedges);
    return {
      mesh: index, vertices: mesh.vertices, wedges: mesh.wedges, triangles: mesh.triangles,
      groupFirst: this.copy(Uint32Array, mesh.groupFirst, mesh.groups + 1),
      positions: this.copyRanges(Float32Array, mesh.positions, wedges),
      indices: this.copyRanges(Uint32Array, mesh.triangleList, triangles),
      attributes: attributes.map((attribute, i) => {
        const from = known * attribute.count, type = arrayOf(attribute);
        const data = this.wasm.pstrips_attribute(this.viewer, index, i) + from * type.BYTES_PER_ELEMENT;
        return { first: known, data: this.copy(type, data, mesh.wedges * attribute.count - from) };
      }),
      strips: mesh.stripEntries ? this.copy(Uint32Array, mesh.strips, mesh.stripEntries) : undefined,
    };
  }

  // Ranges of elements, three entries each: [{ first, data }].
  copyRanges(type, at, ranges) {
    const out = [];
    for (let i = 0; i < ranges.length; i += 2)
      out.push({ first: ranges[i], data: this.copy(type, at + 3 * ranges[i] * type.BYTES_PER_ELEMENT, 3 * (ranges[i + 1] - ranges[i])) });
    return out;
  }

  copy(type, at, count) {
    const bytes = new Uint8Array(this.wasm.memory.buffer, at, count * type.BYTES_PER_ELEMENT).slice();
    return new type(bytes.buffer);
  }

  // Images stand behind all packets, so there are none to look for before.
  newImages() {
    const out = [];
    this.scene.images.forEach((image, i) => {
      const size = this.images[i] ? 0 : this.wasm.pstrips_image_bytes(this.viewer, i);
      if (!size) return;
      this.images[i] = true;
      out.push({ image: i, data: this.copy(Uint8Array, this.wasm.pstrips_image(this.viewer, i), size) });
    });
    return out;
  }

  // As pstrips_scene() says.
  readScene() {
    const start = this.wasm.pstrips_scene(this.viewer);
    const view = new DataView(this.wasm.memory.buffer, start);
    let at = 0;
    const u32 = () => view.getUint32((at += 4) - 4, true);
    const f64 = () => view.getFloat64((at += 8) - 8, true);
    const times = (count, read) => Array.from({ length: count }, read);
    const list = (read) => times(u32(), read);
    const string = () => {
      const size = u32();
      at += size;
      return text.decode(new Uint8Array(view.buffer, view.byteOffset + at - size, size));
    };
    const index = () => {
      const value = u32();
      return value === 0xffffffff ? undefined : value;
    };
    return {
      profile: ["plain", "compact"][u32()],
      packets: u32(),
      textureOrigin: ["upperLeft", "lowerLeft"][u32()],
      materials: list(() => ({
        name: string(), baseColor: times(4, f64), emissive: times(3, f64), metallic: f64(), roughness: f64(),
        alphaCutoff: f64(), alphaMode: ["opaque", "mask", "blend"][u32()], image: index(), doubleSided: u32() === 1,
      })),
      images: list(() => ({ name: string(), uri: string(), mimeType: string() })),
      nodes: list(() => ({ name: string(), parent: index(), matrix: times(16, f64), meshes: list(u32) })),
      meshes: list(() => ({
        name: string(), vertices: u32(), wedges: u32(), triangles: u32(),
        groups: list(() => ({ name: string(), material: index(), kind: ["polygons", "lines", "points"][u32()] })),
        attributes: list(() => ({ semantic: string(), type: u32(), count: u32(), normalized: u32() === 1 })),
      })),
    };
  }
}
