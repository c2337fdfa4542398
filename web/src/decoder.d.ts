/** Whether this browser has what the decoder needs. */
export const supported: boolean;
/** Settles when the decoder can start without a wait. */
export const ready: PromiseLike<void>;
/** How many workers decoders start with from now on, where their options do not say; 0: none, 1 at first. */
export function useWorkers(count: number): void;

export type ErrorCode = "bad argument" | "io" | "truncated" | "corrupt" | "over limit" | "unsupported" | "interrupted";

/** Why a file, or the rest of it, was not taken. What was reached before stays. */
export class PStripError extends Error {
  readonly code: ErrorCode;
  /** Byte of the file at which it was noticed, where one is known. */
  readonly offset?: number;
}

export interface DecoderOptions {
  /** Threads to decode on; 0 decodes on the page's own, a slice at a time. Default: useWorkers(). */
  workers?: number;
  /** Where decoder-worker.js is, for pages whose policy forbids workers from blobs. */
  workerUrl?: string | URL;
  /** What a file may ask for in the decoder, in bytes. Default 2^30. */
  maxMemory?: number;
  /** Whether display strips are made besides the triangles. Default false. */
  strips?: boolean;
}

export interface Until {
  /** The level that reaches one of these is the last. */
  maxTriangles?: number;
  /** Distance to the full model, model units. */
  maxError?: number;
  maxBytes?: number;
  signal?: AbortSignal;
}

export interface MaterialDescription {
  name: string;
  /** Linear RGBA. */
  baseColor: [number, number, number, number];
  emissive: [number, number, number];
  metallic: number;
  roughness: number;
  /** With the alpha mode "mask". */
  alphaCutoff: number;
  alphaMode: "opaque" | "mask" | "blend";
  /** Of the base colour, into the images of the scene. */
  image?: number;
  doubleSided: boolean;
}

export interface NodeDescription {
  name: string;
  /** Comes before its children. */
  parent?: number;
  /** 16 numbers, column by column. */
  matrix: number[];
  meshes: number[];
}

export interface SceneDescription {
  profile: "plain" | "compact";
  packets: number;
  /** The corner of an image at which texture coordinates are (0, 0). */
  textureOrigin: "upperLeft" | "lowerLeft";
  materials: MaterialDescription[];
  /** A URI is plain text, not percent-encoded. */
  images: { name: string; uri: string; mimeType: string }[];
  /** Empty: each mesh stands once, where its positions say. */
  nodes: NodeDescription[];
  meshes: { name: string; vertices: number; wedges: number; triangles: number }[];
}

export type AttributeArray = Int8Array | Uint8Array | Int16Array | Uint16Array | Int32Array | Uint32Array | Float32Array | Float64Array;

/** A mesh as it is now. Arrays have their full length from the first level on and stay the same. */
export interface MeshLevel {
  name: string;
  groups: { name: string; material?: number; kind: "polygons" | "lines" | "points"; first: number; count: number }[];
  vertices: number;
  /** Entries of the arrays that count: a wedge is a vertex with one tuple of attributes. */
  wedges: number;
  triangles: number;
  positions: Float32Array;
  indices: Uint32Array;
  attributes: { semantic: string; count: number; normalized: boolean; array: AttributeArray }[];
  /** Display strips of wedges, parted by 0xffffffff, when asked for. */
  strips?: Uint32Array;
}

export type Range = [first: number, end: number];

export interface Level {
  type: "base" | "refinement";
  triangles: number;
  vertices: number;
  packets: number;
  /** Of the file, so far. */
  bytes: number;
  /** Bound of the distance to the full model, model units. */
  error: number;
  /** The whole model is there, exactly. */
  complete: boolean;
  scene: SceneDescription;
  meshes: MeshLevel[];
  /** Of each mesh, what this level changed. */
  changes: { wedges: Range[]; triangles: Range[] }[];
  /** Encoded image files that have arrived. */
  images: { image: number; data: Uint8Array }[];
}

export type Source = Response | ReadableStream<Uint8Array> | AsyncIterable<Uint8Array> | Iterable<Uint8Array> | ArrayBuffer | ArrayBufferView;

export class ProgressiveDecoder {
  constructor(options?: DecoderOptions);
  /** Levels of a file, one after the other, as they arrive. Throws a PStripError after the last that could be shown. */
  decode(source: Source, until?: Until): AsyncGenerator<Level, void, void>;
  /** Frees everything and ends decodes that are under way with an AbortError. */
  dispose(): void;
}
