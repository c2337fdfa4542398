// Draws files with our loader and with three's own, from one camera under one light, and says how many
// pixels differ; the tests call what it puts on `window`.

import * as THREE from "three";
import { GLTFLoader } from "three/addons/loaders/GLTFLoader.js";
import { OBJLoader } from "three/addons/loaders/OBJLoader.js";
import { PLYLoader } from "three/addons/loaders/PLYLoader.js";
import { PStripLoader } from "pstrips/three";

const size = 512;
const renderer = new THREE.WebGLRenderer({ antialias: false });
renderer.setSize(size, size);
renderer.setClearColor(0xff00ff);

const readers = {
  obj: async (url) => new OBJLoader().loadAsync(url),
  ply: async (url) => new THREE.Mesh(await new PLYLoader().loadAsync(url), new THREE.MeshStandardMaterial()),
  glb: async (url) => (await new GLTFLoader().loadAsync(url)).scene,
  gltf: async (url) => (await new GLTFLoader().loadAsync(url)).scene,
};

function cameraFor(object) {
  const sphere = new THREE.Box3().setFromObject(object).getBoundingSphere(new THREE.Sphere());
  const camera = new THREE.PerspectiveCamera(40, 1, sphere.radius / 100, sphere.radius * 20);
  camera.position.copy(sphere.center).add(new THREE.Vector3(0.5, 0.4, 1).normalize().multiplyScalar(3 * sphere.radius));
  camera.lookAt(sphere.center);
  return camera;
}

// Materials differ in what formats say of them; shape and texture are compared, so those are kept.
function plain(object) {
  object.traverse((part) => {
    if (!part.isMesh) return;
    const replace = (material) => new THREE.MeshBasicMaterial({ map: material.map, side: THREE.DoubleSide, vertexColors: false });
    const shaded = new THREE.MeshNormalMaterial({ flatShading: true, side: THREE.DoubleSide });
    part.material = [part.material].flat().map((material) => (material.map ? replace(material) : shaded));
    if (part.material.length === 1) part.material = part.material[0];
  });
}

function draw(object, camera) {
  const scene = new THREE.Scene();
  scene.add(object);
  renderer.render(scene, camera);
  const pixels = new Uint8Array(4 * size * size), gl = renderer.getContext();
  gl.readPixels(0, 0, size, size, gl.RGBA, gl.UNSIGNED_BYTE, pixels);
  return pixels;
}

const background = (pixels, i) => pixels[i] === 255 && pixels[i + 1] === 0 && pixels[i + 2] === 255;

// Shares of the pixels that either covers: `differ`, by more than 8 of 255 in a colour, and `iou` of
// the silhouettes.
function difference(a, b) {
  let covered = 0, differ = 0, both = 0;
  for (let i = 0; i < a.length; i += 4) {
    const inA = !background(a, i), inB = !background(b, i);
    covered += inA || inB;
    both += inA && inB;
    differ += [0, 1, 2].some((c) => Math.abs(a[i + c] - b[i + c]) > 8);
  }
  return { covered, differ: differ / covered, iou: both / covered };
}

// What both levels of our file are beside the original.
window.compare = async (original, ours) => {
  const reference = await readers[original.split(".").pop()](original);
  plain(reference);
  const camera = cameraFor(reference), expected = draw(reference, camera), loader = new PStripLoader();
  const base = await loader.setLimits({ maxTriangles: 1 }).loadAsync(ours);
  await base.userData.pstrips.done;
  const triangles = base.userData.pstrips.triangles;
  plain(base);
  const atBase = difference(draw(base, camera), expected);
  const full = await loader.setLimits({}).loadAsync(ours);
  await full.userData.pstrips.done;
  plain(full);
  const atEnd = difference(draw(full, camera), expected);
  loader.dispose();
  return { triangles, complete: full.userData.pstrips.complete, atBase, atEnd };
};

// Loads and tells what became of it; `stopAt` triangles end the load.
window.load = async (url, { workers = 1, stopAt = Infinity } = {}) => {
  const loader = new PStripLoader().setWorkerLimit(workers);
  const levels = [];
  let group, error;
  try {
    group = await loader.loadAsync(url, (level) => {
      levels.push({ triangles: level.triangles, bytes: level.loaded });
      if (level.triangles >= stopAt) loader.abort();
    });
    await group.userData.pstrips.done;
  } catch (thrown) {
    error = { name: thrown.name, code: thrown.code, offset: thrown.offset, message: thrown.message };
  }
  let drawn = 0;
  group?.traverse((part) => (drawn += part.isMesh ? part.geometry.drawRange.count / 3 : 0));
  const state = group?.userData.pstrips;
  loader.dispose();
  return { error, levels, drawn, complete: state?.complete ?? false };
};
document.body.dataset.ready = "yes";
