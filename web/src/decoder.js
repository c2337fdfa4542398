// pstrips/decoder: progressive files while they arrive, as typed arrays that are ready to draw.

import { MeshLevel } from "./mesh_level.js";
import { Session } from "./session.js";
import { PStripError } from "./wasm.js";
import { wasmBase64, workerSource } from "./embedded.js";

export { MeshLevel, PStripError };

export const supported = typeof WebAssembly === "object" && typeof DecompressionStream === "function";

// The compiled decoder; made once, when first asked for.
let compiled;
function compile() {
  compiled ??= (async () => {
    if (!supported) throw new PStripError("unsupported", "this browser lacks WebAssembly or DecompressionStream");
    const packed = Uint8Array.from(atob(wasmBase64), (c) => c.charCodeAt(0));
    const stream = new Blob([packed]).stream().pipeThrough(new DecompressionStream("deflate-raw"));
    return WebAssembly.compile(await new Response(stream).arrayBuffer());
  })();
  return compiled;
}

// Settles when the decoder can start without a wait.
export const ready = { then: (done, failed) => compile().then(() => done?.(), failed) };

let defaultWorkers = 1;
// How many workers decoders start with from now on, where their options do not say; 0: none.
export function useWorkers(count) {
  defaultWorkers = count;
}

// The calls of Session on another thread.
class Remote {
  constructor(url) {
    const source = url ?? URL.createObjectURL(new Blob([workerSource], { type: "text/javascript" }));
    this.worker = new Worker(source, { type: "module" });
    if (!url) URL.revokeObjectURL(source);
    this.waiting = new Map();
    this.sessions = 0;
    this.next = 0;
    this.worker.onmessage = ({ data: { id, answer, failure } }) => {
      const { resolve, reject } = this.waiting.get(id) ?? {};
      this.waiting.delete(id);
      if (!resolve) return;  // of a file that was closed meanwhile
      if (failure) reject(new PStripError(failure.code, failure.message));
      else resolve(answer);
    };
    this.worker.onerror = (event) => this.fail(new PStripError("io", `the worker did not start: ${event.message ?? source}`));
  }

  fail(error) {
    this.failed = error;
    for (const { reject } of this.waiting.values()) reject(error);
    this.waiting.clear();
  }

  call(id, message, transfer = []) {
    if (this.failed) return Promise.reject(this.failed);
    return new Promise((resolve, reject) => {
      this.waiting.set(id, { resolve, reject });
      this.worker.postMessage({ id, ...message }, transfer);
    });
  }

  async open(module, options) {
    const id = this.next++;
    ++this.sessions;
    await this.call(id, { call: "open", module, options });
    return {
      step: (bytes, last) => {
        const own = bytes.slice();
        return this.call(id, { call: "step", bytes: own, last }, [own.buffer]);
      },
      close: () => {
        --this.sessions;
        this.waiting.delete(id);
        if (!this.failed) this.worker.postMessage({ id, call: "close" });
      },
    };
  }
}

// The same on the thread of the page, a slice at a time.
const local = {
  sessions: 0,
  async open(module, options) {
    const session = await Session.create(module, options);
    let closed = false;
    return {
      async step(bytes, last) {
        await new Promise((resolve) => setTimeout(resolve));
        if (closed) throw new PStripError("interrupted", "the decoder was closed");
        return session.step(bytes.subarray(0, 65536), last && bytes.length <= 65536);
      },
      close() {
        closed = true;
        session.close();
      },
    };
  },
};

// Pieces of a response, a stream, an array or anything that can be iterated.
async function* piecesOf(source, signal) {
  if (source instanceof ArrayBuffer) source = new Uint8Array(source);
  if (ArrayBuffer.isView(source)) return yield new Uint8Array(source.buffer, source.byteOffset, source.byteLength);
  if (typeof Response !== "undefined" && source instanceof Response) {
    if (!source.ok) throw new PStripError("io", `the server answered ${source.status} ${source.statusText}`.trim());
    source = source.body;
  }
  if (!source.getReader) return yield* source;
  const reader = source.getReader();
  try {
    for (;;) {
      const { done, value } = await abortable(reader.read(), signal);
      if (done) return;
      yield value;
    }
  } catch (error) {
    if (signal?.aborted) throw error;
    throw error instanceof PStripError ? error : new PStripError("io", `the connection broke: ${error.message}`);
  } finally {
    reader.cancel().catch(() => {});
  }
}

function abortable(promise, signal) {
  if (!signal) return promise;
  return new Promise((resolve, reject) => {
    const abort = () => reject(signal.reason);
    if (signal.aborted) abort();
    else signal.addEventListener("abort", abort, { once: true });
    promise.then(resolve, reject).finally(() => signal.removeEventListener("abort", abort));
  });
}

export class ProgressiveDecoder {
  // options: { workers, workerUrl, maxMemory, strips }, see decoder.d.ts.
  constructor({ workers = defaultWorkers, workerUrl, maxMemory = 2 ** 30, strips = false } = {}) {
    this.limits = { maxMemory, strips };
    this.workerCount = typeof Worker === "function" ? workers : 0;
    this.workerUrl = workerUrl;
    this.pool = [];
    this.open = new Set();
  }

  // Frees everything; decodes that are under way end with an AbortError.
  dispose() {
    this.disposed = true;
    for (const stop of this.open) stop(new DOMException("the decoder was disposed of", "AbortError"));
    for (const remote of this.pool) remote.worker.terminate();
    this.pool = [];
  }

  thread() {
    if (!this.workerCount) return local;
    if (this.pool.length < this.workerCount && this.pool.every((remote) => remote.sessions > 0))
      this.pool.push(new Remote(this.workerUrl));
    return this.pool.reduce((best, remote) => (remote.sessions < best.sessions ? remote : best));
  }

  // Levels of a file, one after the other: `for await (const level of decoder.decode(response))`.
  async *decode(source, options = {}) {
    let meshes;
    for await (const level of this.patches(source, options)) {
      meshes ??= level.scene.meshes.map((description) => new MeshLevel(description));
      const changes = meshes.map(() => ({ wedges: [], triangles: [] }));
      for (const patch of level.patches) changes[patch.mesh] = meshes[patch.mesh].apply(patch);
      const { patches, ...rest } = level;
      yield { ...rest, meshes, changes };
    }
  }

  // The same with what is new of each mesh instead of arrays, for those who spread the copying.
  async *patches(source, { maxTriangles, maxError, maxBytes = Infinity, signal } = {}) {
    if (this.disposed) throw new PStripError("bad argument", "the decoder was disposed of");
    const stop = new AbortController();
    const abort = () => stop.abort(signal.reason);
    if (signal?.aborted) throw signal.reason;
    signal?.addEventListener("abort", abort);
    const disposer = (reason) => stop.abort(reason);
    this.open.add(disposer);
    let session;
    try {
      const module = await compile();
      session = await this.thread().open(module, { ...this.limits, maxTriangles, maxError });
      yield* this.steps(session, piecesOf(source, stop.signal), maxBytes, stop.signal);
    } finally {
      session?.close();
      this.open.delete(disposer);
      signal?.removeEventListener("abort", abort);
    }
  }

  async *steps(session, pieces, maxBytes, signal) {
    let scene, step;
    const feed = async function* (piece, last) {
      for (let taken = 0; ; ) {
        step = await abortable(session.step(piece.subarray(taken), last), signal);
        taken += step.taken;
        const { update, totals, bytes, problem } = step;
        // The last level says that it is, even when it brings nothing else.
        const complete = last && !problem && !step.enough;
        if (update || complete) {
          const type = scene ? "refinement" : "base";
          scene ??= update.scene;
          yield { type, ...totals, bytes, complete, scene, patches: update?.meshes ?? [], images: update?.images ?? [] };
        }
        if (problem && !last) throw new PStripError(problem.code, problem.message, problem.offset);
        if (step.enough || taken === piece.length) return;
      }
    };
    let left = maxBytes, failure;
    try {
      while (left > 0 && !step?.enough) {
        const { done, value } = await pieces.next();
        if (done) break;
        const piece = value.subarray(0, left);
        left -= piece.length;
        yield* feed(piece, false);
      }
    } catch (error) {
      if (signal.aborted || step?.problem) throw error;
      failure = error;
    } finally {
      pieces.return();
    }
    if (step?.enough) return;
    // What came is shown before it is said that the rest is missing.
    yield* feed(new Uint8Array(0), true);
    if (failure) throw failure;
    if (step.problem && left > 0) throw new PStripError(step.problem.code, step.problem.message, step.problem.offset);
  }
}
