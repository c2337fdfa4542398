import { Group, Loader, LoadingManager } from "three";

export interface ProgressOfLevel {
  type: "progress";
  lengthComputable: boolean;
  loaded: number;
  total: number;
  triangles: number;
  vertices: number;
  error: number;
  complete: boolean;
}

/**
 * In `userData.pstrips` of a loaded group. Its meshes have their number in the file in `userData.index`, their geometries in
 * `userData.wedges` how many vertices each level had.
 */
export interface Refinement {
  /** Settles when no more levels come; rejects with a PStripError, the last level stays. */
  done: Promise<Group>;
  abort(): void;
  triangles: number;
  vertices: number;
  bytes: number;
  error: number;
  complete: boolean;
}

export class PStripLoader extends Loader {
  constructor(manager?: LoadingManager);
  /** Calls onLoad with the group at its base level, which then goes on refining itself. */
  load(url: string, onLoad?: (group: Group) => void, onProgress?: (level: ProgressOfLevel) => void, onError?: (error: unknown) => void): void;
  loadAsync(url: string, onProgress?: (level: ProgressOfLevel) => void): Promise<Group>;
  parse(buffer: ArrayBuffer | Uint8Array, onLoad: (group: Group) => void, onError?: (error: unknown) => void): void;
  abort(): this;
  dispose(): void;
  setDecoderPath(url: string | URL): this;
  setWorkerLimit(count: number): this;
  setLimits(limits: { maxTriangles?: number; maxError?: number; maxBytes?: number }): this;
  preload(): this;
}

export function useWorkers(count: number): void;
