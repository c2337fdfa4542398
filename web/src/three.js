// pstrips/three: a loader for three.js. Its group stands at the base level and refines itself.

import {
  BufferAttribute, BufferGeometry, Color, DoubleSide, DynamicDrawUsage, FrontSide, Group, Loader, Mesh, MeshStandardMaterial,
  RepeatWrapping, SRGBColorSpace, Texture,
} from "three";
import { MeshLevel, ProgressiveDecoder, useWorkers } from "pstrips/decoder";

// What one frame may cost: a look at the clock after each piece, and bytes for the graphics card.
const frameMilliseconds = 4, frameBytes = 1 << 20, pieceBytes = 1 << 18;

const names = { NORMAL: "normal", TANGENT: "tangent", COLOR_0: "color", TEXCOORD_0: "uv", TEXCOORD_1: "uv1" };

function materialOf(description, mesh, textures) {
  const has = (semantic) => mesh.attributes.some((attribute) => attribute.semantic === semantic);
  const material = new MeshStandardMaterial({
    vertexColors: has("COLOR_0"),
    // Without normals in the file the card takes those of the triangles.
    flatShading: !has("NORMAL"),
    metalness: description ? description.metallic : 0,
    roughness: description ? description.roughness : 1,
    side: description && !description.doubleSided ? FrontSide : DoubleSide,
  });
  if (!description) return material;
  const [r, g, b, a] = description.baseColor;
  material.name = description.name;
  material.color.setRGB(r, g, b);
  material.emissive = new Color(...description.emissive);
  material.opacity = a;
  material.transparent = description.alphaMode === "blend";
  if (description.alphaMode === "mask") material.alphaTest = description.alphaCutoff;
  if (description.image !== undefined) (textures[description.image] ??= []).push(material);
  return material;
}

// A mesh of the file: one geometry that all its instances share.
class LiveMesh {
  constructor(description, scene, textures) {
    this.level = new MeshLevel(description);
    this.queue = [];
    this.geometry = new BufferGeometry();
    // How many there were after each level: which vertices it brought.
    this.geometry.userData.wedges = [];
    this.attributes = [];
    this.add("position", this.level.positions, 3, false);
    this.level.attributes.forEach((attribute) => {
      const name = names[attribute.semantic];
      if (name) this.add(name, attribute.array, attribute.count, attribute.normalized);
      else this.attributes.push(undefined);
    });
    this.geometry.setIndex(this.changing(new BufferAttribute(this.level.indices, 1)));
    this.geometry.setDrawRange(0, 0);
    const materials = description.groups.map((group) => materialOf(scene.materials[group.material], description, textures));
    this.material = materials.length === 1 ? materials[0] : materials;
  }

  add(name, array, count, normalized) {
    const attribute = this.changing(new BufferAttribute(array, count, normalized));
    this.geometry.setAttribute(name, attribute);
    this.attributes.push(attribute);
  }

  changing(attribute) {
    attribute.setUsage(DynamicDrawUsage);
    return attribute;
  }

  // Splits a patch into pieces that a frame can take.
  push(patch) {
    const split = (target, array, width, piece) => {
      if (!target) return;
      const step = Math.max(1, Math.floor(pieceBytes / array.BYTES_PER_ELEMENT / width)) * width;
      for (let at = 0; at < piece.data.length; at += step)
        this.queue.push({ target, array, at: piece.first * width + at, data: piece.data.subarray(at, at + step) });
    };
    for (const piece of patch.positions) split(this.attributes[0], this.level.positions, 3, piece);
    patch.attributes.forEach((piece, i) => {
      const { array, count } = this.level.attributes[i];
      split(this.attributes[i + 1], array, count, piece);
    });
    for (const piece of patch.indices) split(this.geometry.index, this.level.indices, 3, piece);
    this.queue.push({ patch });
  }

  // Takes the next piece; returns its bytes.
  takePiece() {
    const { target, array, at, data, patch } = this.queue.shift();
    if (patch) {
      this.show(patch);
      return 0;
    }
    array.set(data, at);
    target.addUpdateRange(at, data.length);
    target.needsUpdate = true;
    return data.byteLength;
  }

  show(patch) {
    this.level.describe(patch);
    this.geometry.userData.wedges.push(patch.wedges);
    this.geometry.setDrawRange(0, 3 * patch.triangles);
    if (!Array.isArray(this.material)) return;
    this.geometry.clearGroups();
    this.level.groups.forEach((group, i) => {
      if (group.count) this.geometry.addGroup(3 * group.first, 3 * group.count, i);
    });
  }
}

function sceneOf(scene, meshes, group) {
  const drawn = (i) => {
    const mesh = new Mesh(meshes[i].geometry, meshes[i].material);
    mesh.name = scene.meshes[i].name;
    mesh.userData.index = i;
    return mesh;
  };
  if (!scene.nodes.length) {
    meshes.forEach((_, i) => group.add(drawn(i)));
    return;
  }
  const nodes = scene.nodes.map((node) => {
    const object = new Group();
    object.name = node.name;
    object.matrix.fromArray(node.matrix);
    object.matrix.decompose(object.position, object.quaternion, object.scale);
    node.meshes.forEach((i) => object.add(drawn(i)));
    return object;
  });
  scene.nodes.forEach((node, i) => (node.parent === undefined ? group : nodes[node.parent]).add(nodes[i]));
}

// Files may name images beside themselves and nowhere else.
function isBeside(plain) {
  return plain !== "" && !/^([a-z][a-z0-9+.-]*:|[/\\])/i.test(plain) && !plain.split(/[/\\]/).includes("..");
}

async function showImage(image, blob, materials, origin) {
  // A texture's first row is the one at v = 0.
  const imageOrientation = origin === "lowerLeft" ? "flipY" : "none";
  const bitmap = await createImageBitmap(blob, { colorSpaceConversion: "none", imageOrientation });
  const texture = new Texture(bitmap);
  texture.name = image.name;
  texture.flipY = false;
  texture.colorSpace = SRGBColorSpace;
  texture.wrapS = texture.wrapT = RepeatWrapping;
  texture.needsUpdate = true;
  for (const material of materials) {
    material.map = texture;
    material.needsUpdate = true;
  }
}

const nextFrame = () =>
  new Promise((resolve) => {
    // Hidden pages have no frames.
    if (typeof requestAnimationFrame === "function" && !globalThis.document?.hidden) requestAnimationFrame(resolve);
    else setTimeout(resolve, 16);
  });

export class PStripLoader extends Loader {
  constructor(manager) {
    super(manager);
    this.options = {};
    this.running = new Set();
  }

  // Where decoder-worker.js is, for pages whose policy forbids workers from blobs.
  setDecoderPath(url) {
    this.options.workerUrl = url;
    return this;
  }

  setWorkerLimit(count) {
    this.options.workers = count;
    return this;
  }

  // { maxTriangles, maxError, maxBytes }: when to stop.
  setLimits(limits) {
    this.limits = limits;
    return this;
  }

  preload() {
    this.decoder ??= new ProgressiveDecoder(this.options);
    return this;
  }

  // onLoad is called with the group at its base level; group.userData.pstrips tells of the rest.
  load(url, onLoad, onProgress, onError = (error) => console.error(error)) {
    const stop = new AbortController();
    this.running.add(stop);
    this.manager.itemStart(url);
    const fetched = fetch(new URL(url, new URL(this.path || ".", globalThis.location?.href)), {
      headers: this.requestHeader, credentials: this.withCredentials ? "include" : "same-origin", signal: stop.signal,
    });
    this.show(fetched, stop, onProgress).then(onLoad).catch((error) => {
      this.manager.itemError(url);
      onError(error);
    }).finally(() => this.manager.itemEnd(url));
  }

  loadAsync(url, onProgress) {
    return new Promise((resolve, reject) => this.load(url, resolve, onProgress, reject));
  }

  parse(buffer, onLoad, onError) {
    const stop = new AbortController();
    this.running.add(stop);
    this.show(Promise.resolve(buffer), stop).then(onLoad, onError);
  }

  abort() {
    for (const stop of this.running) stop.abort(new DOMException("the load was stopped", "AbortError"));
    return this;
  }

  dispose() {
    this.abort();
    this.decoder?.dispose();
    this.decoder = undefined;
  }

  // Resolves with the group once the base is in it.
  show(source, stop, onProgress) {
    this.preload();
    const group = new Group();
    return new Promise((resolve, reject) => {
      const done = this.refine(group, source, stop, onProgress, resolve);
      group.userData.pstrips = { done, abort: () => stop.abort(new DOMException("the load was stopped", "AbortError")) };
      done.catch(reject).finally(() => this.running.delete(stop));
    });
  }

  // Shows level after level, as much in each frame as it may cost.
  async refine(group, source, stop, onProgress, onBase) {
    const response = await source;
    const total = Number(response.headers?.get("content-length") ?? response.byteLength ?? 0);
    const textures = {}, state = group.userData.pstrips, images = [];
    let meshes, scene;
    for await (const level of this.decoder.patches(response, { ...this.limits, signal: stop.signal })) {
      const first = !meshes;
      meshes ??= level.scene.meshes.map((description) => new LiveMesh(description, level.scene, textures));
      for (const patch of level.patches) meshes[patch.mesh].push(patch);
      await this.spread(meshes, stop.signal, first);
      if (first) {
        sceneOf(level.scene, meshes, group);
        scene = level.scene;
      }
      for (const { image, data } of level.images) {
        const description = level.scene.images[image];
        images.push(showImage(description, new Blob([data], { type: description.mimeType }), textures[image] ?? [], scene.textureOrigin));
        delete textures[image];
      }
      const { triangles, vertices, bytes, error, complete } = level;
      Object.assign(state, { triangles, vertices, bytes, error, complete });
      onProgress?.({ type: "progress", lengthComputable: total > 0, loaded: bytes, total, triangles, vertices, error, complete });
      if (first) onBase(group);
    }
    if (scene) images.push(...this.fetchImages(scene, textures, response.url));
    await Promise.all(images);
    return group;
  }

  // Those that stand beside the file; an image that does not come leaves its materials without one.
  fetchImages(scene, textures, base) {
    const wanted = scene.images.map((image, i) => [image, textures[i]]).filter(([image, materials]) => materials && isBeside(image.uri));
    return wanted.map(async ([image, materials]) => {
      const url = new URL(image.uri.split("/").map(encodeURIComponent).join("/"), this.resourcePath || base || globalThis.location?.href);
      try {
        const response = await fetch(url);
        if (!response.ok) throw new Error(`${response.status} ${response.statusText}`);
        await showImage(image, await response.blob(), materials, scene.textureOrigin);
      } catch (error) {
        console.warn(`pstrips: no texture from ${url}: ${error.message}`);
        this.manager.itemError(url.href);
      }
    });
  }

  // The base is small and shown at once.
  async spread(meshes, signal, atOnce) {
    for (;;) {
      const start = performance.now();
      let bytes = 0;
      for (const mesh of meshes)
        while (mesh.queue.length && (atOnce || (bytes < frameBytes && performance.now() - start < frameMilliseconds))) bytes += mesh.takePiece();
      if (meshes.every((mesh) => !mesh.queue.length)) return;
      signal.throwIfAborted();
      await nextFrame();
    }
  }
}

export { useWorkers };
