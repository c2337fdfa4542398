// The viewer: a page that shows a file while it arrives. ?url=FILE opens one of the same server.

import {
  AmbientLight, Box3, Color, DirectionalLight, Group, Mesh, PerspectiveCamera, Scene, Sphere, Vector3, WebGLRenderer,
} from "three";
import { OrbitControls } from "three/addons/controls/OrbitControls.js";
import { PStripLoader } from "pstrips/three";

const at = (id) => document.getElementById(id);
const canvas = at("canvas");
const loader = new PStripLoader().setDecoderPath(new URL("decoder-worker.js", import.meta.url));

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
  const xs = points.map((level) => Math.log(level.loaded)), ys = points.map((level) => Math.log(level.error));
  const scale = (values, size) => {
    const low = Math.min(...values), span = Math.max(...values) - low || 1;
    return values.map((value) => 6 + ((value - low) / span) * (size - 12));
  };
  const x = scale(xs, 320), y = scale(ys, 120);
  at("plot").innerHTML = `<path d="M${x.map((value, i) => `${value.toFixed(1)} ${(120 - y[i]).toFixed(1)}`).join("L")}"/>`;
}

// The file is kept, so that the level can be chosen again.
let opened, current;
async function open(source, limits = {}) {
  current?.abort();
  history.length = 0;
  model.clear();
  at("message").textContent = "";
  at("hint").hidden = true;
  at("stop").disabled = false;
  loader.setLimits(limits);
  try {
    const group = await new Promise((resolve, reject) => {
      if (typeof source === "string") loader.load(source, resolve, report, reject);
      else loader.load(URL.createObjectURL(source), resolve, report, reject);
    });
    current = group.userData.pstrips;
    model.add(group);
    recolour();
    if (opened !== source) look(group);
    opened = source;
    dirty = true;
    await current.done;
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

function recolour() {
  const wire = at("colours").value === "wire";
  model.traverse((object) => {
    if (!(object instanceof Mesh)) return;
    for (const material of [object.material].flat()) material.wireframe = wire;
  });
  dirty = true;
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
