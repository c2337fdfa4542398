// The viewer: a page that shows a file while it arrives. ?url=FILE opens one of the same server.

import {
  AmbientLight, Box3, BufferAttribute, BufferGeometry, Color, DirectionalLight, DoubleSide, Group, Mesh, MeshStandardMaterial, PerspectiveCamera,
  Scene, Sphere, Vector3, WebGLRenderer,
} from "three";
import { OrbitControls } from "three/addons/controls/OrbitControls.js";
import { ProgressiveDecoder } from "pstrips/decoder";
import { PStripLoader } from "pstrips/three";

const at = (id) => document.getElementById(id);
const canvas = at("canvas");
const worker = new URL("decoder-worker.js", import.meta.url);
const loader = new PStripLoader().setDecoderPath(worker);

const renderer = new WebGLRenderer({ canvas, antialias: true, preserveDrawingBuffer: true });
const scene = new Scene(), camera = new PerspectiveCamera(40, 1, 0.01, 100), model = new Group();
const light = new DirectionalLight(0xffffff, 2);
scene.add(model, new AmbientLight(0xffffff, 0.4), camera);
camera.add(light);
light.position.set(0.5, 1, 1);
const controls = new OrbitControls(camera, canvas);
controls.listenToKeyEvents(canvas);
controls.enableDamping = false;

let dirty = true;
controls.addEventListener("change", () => (dirty = true));
function frame() {
  const { clientWidth: width, clientHeight: height } = canvas;
  if (canvas.width !== Math.round(width * devicePixelRatio) || canvas.height !== Math.round(height * devicePixelRatio)) {
    renderer.setPixelRatio(devicePixelRatio);
    renderer.setSize(width, height, false);
    camera.aspect = width / Math.max(1, height);
    camera.updateProjectionMatrix();
    dirty = true;
  }
  if (dirty) renderer.render(scene, camera);
  dirty = false;
  requestAnimationFrame(frame);
}
canvas.addEventListener("webglcontextrestored", () => (dirty = true));
matchMedia("(prefers-color-scheme: dark)").addEventListener("change", paint);
function paint() {
  scene.background = new Color(getComputedStyle(document.body).backgroundColor);
  dirty = true;
}

function look(group) {
  const sphere = new Box3().setFromObject(group).getBoundingSphere(new Sphere());
  if (!(sphere.radius > 0)) return;
  const far = sphere.radius / Math.sin((camera.fov * Math.PI) / 360);
  camera.position.copy(sphere.center).add(new Vector3(0.4, 0.35, 1).normalize().multiplyScalar(far));
  camera.near = far / 1000;
  camera.far = far * 10;
  camera.updateProjectionMatrix();
  controls.target.copy(sphere.center);
  controls.update();
}

const units = ["B", "KB", "MB", "GB"];
function sizeText(bytes) {
  const unit = Math.min(3, Math.floor(Math.log10(Math.max(1, bytes)) / 3));
  return `${(bytes / 1000 ** unit).toFixed(unit ? 2 : 0)} ${units[unit]}`;
}

const history = [];
function report(level) {
  history.push(level);
  at("triangles").textContent = level.triangles.toLocaleString("en");
  at("vertices").textContent = level.vertices.toLocaleString("en");
  at("bytes").textContent = level.total ? `${sizeText(level.loaded)} of ${sizeText(level.total)}` : sizeText(level.loaded);
  at("error").textContent = level.complete ? "0, exact" : level.error.toPrecision(3);
  if (level.total) at("progress").value = level.loaded / level.total;
  else at("progress").removeAttribute("value");
  plot();
  dirty = true;
}

function plot() {
  const points = history.filter((level) => level.error > 0 && level.loaded > 0);
  if (points.length < 2) return;
  const scale = (values, from, to) => {
    const logs = values.map(Math.log), low = Math.min(...logs), span = Math.max(...logs) - low || 1;
    return logs.map((value) => from + ((value - low) / span) * (to - from));
  };
  const x = scale(points.map((level) => level.loaded), 52, 312), y = scale(points.map((level) => level.error), 128, 12);
  const label = (text, left, top, anchor) => `<text x="${left}" y="${top}" text-anchor="${anchor}">${text}</text>`;
  const [first, last] = [points[0], points.at(-1)];
  at("plot").innerHTML = `<path d="M${x.map((value, i) => `${value.toFixed(1)} ${y[i].toFixed(1)}`).join("L")}"/>` +
    label(first.error.toPrecision(2), 46, y[0] + 5, "end") + label(last.error.toPrecision(2), 46, y.at(-1) + 4, "end") +
    label(sizeText(first.loaded), 52, 148, "start") + label(sizeText(last.loaded), 312, 148, "end");
}

// The file is kept, so that the level can be chosen again.
let opened, current, shownLimits = {};
async function open(source, limits = {}) {
  if (source.name && !/\.pstrip$/i.test(source.name)) {
    at("message").textContent = `${source.name} is a model; make it progressive first: pstrips convert ${source.name} model.pstrip`;
    return;
  }
  current?.abort();
  history.length = 0;
  model.clear();
  at("message").textContent = "";
  at("hint").hidden = true;
  at("stop").disabled = false;
  loader.setLimits(limits);
  shownLimits = limits;
  try {
    const group = await new Promise((resolve, reject) => {
      if (typeof source === "string") loader.load(source, resolve, report, reject);
      else loader.load(URL.createObjectURL(source), resolve, report, reject);
    });
    current = group.userData.pstrips;
    model.add(group);
    if (opened !== source) look(group);
    opened = source;
    dirty = true;
    await current.done;
    await recolour();
    document.body.dataset.state = "complete";
  } catch (error) {
    document.body.dataset.state = "failed";
    if (error.name !== "AbortError") at("message").textContent = error.message;
  }
  at("stop").disabled = true;
  at("progress").value = 1;
  if (current && !Object.keys(limits).length) allowLevels();
  dirty = true;
}

function allowLevels() {
  const slider = at("level"), most = current.triangles;
  slider.disabled = false;
  slider.max = 1000;
  slider.value = 1000;
  // Equal steps are equal factors: a coarse level needs a fine choice.
  slider.onchange = () => {
    const share = Number(slider.value) / 1000;
    open(opened, share < 1 ? { maxTriangles: Math.max(1, Math.round(most ** share)) } : {});
  };
}

// What the file says of a mesh is kept while it is shown in other colours.
const painted = new MeshStandardMaterial({ vertexColors: true, flatShading: true, side: DoubleSide, roughness: 0.9 });
async function recolour() {
  const mode = at("colours").value;
  const strips = mode === "strips" && opened ? await stripsOfLevel() : undefined;
  if (at("colours").value !== mode) return;
  model.traverse((object) => {
    if (!(object instanceof Mesh)) return;
    object.userData.own ??= { geometry: object.geometry, material: object.material };
    const { geometry, material } = object.userData.own;
    Object.assign(object, { geometry, material });
    for (const each of [material].flat()) each.wireframe = mode === "wire";
    if (mode === "arrival") paintArrival(geometry);
    if (mode === "strips" && strips) object.geometry = strips[object.userData.index];
    if (object.geometry !== geometry || mode === "arrival") object.material = painted;
  });
  dirty = true;
  requestAnimationFrame(() => requestAnimationFrame(() => (canvas.dataset.colours = mode)));
}

const hue = (share, light = 0.55) => new Color().setHSL(0.66 * (1 - share), 0.7, light);

// Vertices of the base are blue, those of the last level red.
function paintArrival(geometry) {
  const counts = geometry.userData.wedges, colours = new Uint8Array(3 * geometry.attributes.position.count);
  counts.forEach((end, level) => {
    const { r, g, b } = hue(counts.length > 1 ? level / (counts.length - 1) : 0);
    for (let i = level ? counts[level - 1] : 0; i < end; ++i) colours.set([255 * r, 255 * g, 255 * b], 3 * i);
  });
  geometry.setAttribute("color", new BufferAttribute(colours, 3, true));
}

// The level that is shown, decoded again with its display strips: a geometry for each mesh, a colour
// for each strip.
async function stripsOfLevel() {
  const source = typeof opened === "string" ? await fetch(opened) : opened.stream();
  const decoder = new ProgressiveDecoder({ workerUrl: worker, strips: true });
  let last;
  for await (const level of decoder.decode(source, shownLimits)) last = level;
  decoder.dispose();
  return last.meshes.map(geometryOfStrips);
}

function geometryOfStrips({ positions, strips, triangles }) {
  const corners = new Float32Array(9 * triangles), colours = new Uint8Array(9 * triangles);
  let count = 0, first = 0, strip = 0, colour = [];
  strips.forEach((entry, i) => {
    if (entry === 0xffffffff) first = i + 1;
    if (i === first) {
      const { r, g, b } = new Color().setHSL((0.618 * ++strip) % 1, 0.65, 0.5 + 0.15 * (strip % 3 - 1));
      colour = [r, g, b].map((part) => 255 * part);
    }
    if (entry === 0xffffffff || i < first + 2) return;
    const [a, b, c] = strips.subarray(i - 2, i + 1);
    if (a === b || b === c || a === c) return;
    ((i - first) % 2 ? [b, a, c] : [a, b, c]).forEach((wedge) => {
      corners.set(positions.subarray(3 * wedge, 3 * wedge + 3), 3 * count);
      colours.set(colour, 3 * count++);
    });
  });
  const geometry = new BufferGeometry();
  geometry.setAttribute("position", new BufferAttribute(corners.subarray(0, 3 * count), 3));
  geometry.setAttribute("color", new BufferAttribute(colours.subarray(0, 3 * count), 3, true));
  return geometry;
}

at("colours").onchange = recolour;
at("stop").onclick = () => current?.abort();
at("file").onchange = ({ target }) => target.files[0] && open(target.files[0]);
addEventListener("dragover", (event) => {
  event.preventDefault();
  document.body.classList.add("dropping");
});
addEventListener("dragleave", () => document.body.classList.remove("dropping"));
addEventListener("drop", (event) => {
  event.preventDefault();
  document.body.classList.remove("dropping");
  if (event.dataTransfer.files[0]) open(event.dataTransfer.files[0]);
});

paint();
frame();
const url = new URLSearchParams(location.search).get("url");
if (url) open(url);
