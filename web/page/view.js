// The page: mouse, fingers and keys turn the scene, the panel changes its look, and the address keeps both.
import {Connection} from "./connection.js";
import {Orbit} from "./orbit.js";
import {Panel} from "./panel.js";
import {SceneView} from "./scene_view.js";

const $ = selector => document.querySelector(selector);
const canvas = $("#picture");
let orbit = null, panel = null, view = null, toastTimer = 0, addressTimer = 0;
let hasView = false;
let explained = null;  // the place that was asked for last, while its view is shown
let fittedBy = "";  // the kind of view that is shown as the server has fitted it to the size of the picture

function toast(text, isFault = false) {
  $("#toast").textContent = text;
  $("#toast").classList.toggle("fault-toast", isFault);
  $("#toast").hidden = false;
  clearTimeout(toastTimer);
  toastTimer = setTimeout(() => { $("#toast").hidden = true; }, isFault ? 9000 : 3500);
}

// ---- the address keeps the view and what of the look is not as the scene has it ----

const longestSheetInAddress = 20000;
const listed = numbers => numbers.join(",");

function writeAddress() {
  const camera = orbit.camera(), first = panel.hello.look, {look} = panel;
  const parts = [["eye", listed(camera.eye)], ["target", listed(camera.target)], ["up", listed(camera.up)]];
  parts.push(camera.height === undefined ? ["fov", camera.fov] : ["height", camera.height]);
  for (const key of ["crease_angle", "width", "hidden", "shading", "style"])
    if (look[key] !== first[key]) parts.push([key, look[key]]);
  if (listed(look.lines) !== listed(first.lines)) parts.push(["lines", listed(look.lines)]);
  for (const [name, text] of Object.entries(look.parameters)) parts.push([`set.${name}`, text]);
  if (look.sheet && look.sheet.length <= longestSheetInAddress) parts.push(["sheet", look.sheet]);
  const text = parts.map(([key, value]) => `${key}=${encodeURIComponent(value).replaceAll("%2C", ",")}`).join("&");
  history.replaceState(null, "", "#" + text);
}

function addressChanges() {
  clearTimeout(addressTimer);
  addressTimer = setTimeout(writeAddress, 200);
}

/** What the address says: a view and a part of a look; null where it says nothing that makes sense. */
function readAddress() {
  const address = new URLSearchParams(location.hash.slice(1).replaceAll("+", "%2B"));
  const vector = key => (address.get(key) ?? "").split(",").map(Number);
  const isVector = v => v.length === 3 && v.every(Number.isFinite);
  const look = {};
  for (const key of ["hidden", "shading", "style", "sheet"]) if (address.has(key)) look[key] = address.get(key);
  for (const key of ["crease_angle", "width"])
    if (address.has(key) && Number.isFinite(Number(address.get(key)))) look[key] = Number(address.get(key));
  if (address.has("lines")) look.lines = address.get("lines").split(",").filter(Boolean);
  const changes = [...address].filter(([key]) => key.startsWith("set."));
  if (changes.length || look.style !== undefined)
    look.parameters = Object.fromEntries(changes.map(([key, value]) => [key.slice(4), value]));
  const camera = {eye: vector("eye"), target: vector("target"), up: vector("up"), fov: Number(address.get("fov") ?? 35),
                  height: address.has("height") ? Number(address.get("height")) : null};
  const isView = [camera.eye, camera.target, camera.up].every(isVector) && camera.fov > 0 && camera.fov < 180 &&
    (camera.height === null || camera.height > 0);
  return {camera: isView ? camera : null, look: Object.keys(look).length ? look : null};
}

// ---- what changes the view ----

function viewChanged() {
  hasView = true;
  // Many times a second: what is the same already is left alone, for a browser lays out what is set.
  if (!$("#mark").hidden) closeExplained();  // it is of the view before
  const projection = orbit.isOrthographic ? "Parallel" : "Perspective";
  if ($("#projection").textContent !== projection) $("#projection").textContent = projection;
  view.viewChanged();
  addressChanges();
}

async function takeView(kind) {
  const message = {kind, size: view.size};
  if (kind === "fit") message.camera = orbit.camera(true);
  const answer = await view.connection.request(message);
  if (answer.kind === "error") return toast(answer.message, true);
  orbit.take(answer);
  fittedBy = kind;
  viewChanged();
}

function sizeChanged() {
  if (orbit.taken && fittedBy) takeView(fittedBy);
  else view.viewChanged();
}

function toggleProjection() {
  orbit.toggleProjection();
  viewChanged();
}

const turnPerPixel = 0.008;
const quarter = Math.PI / 2;
const standardViews = [[0, 0], [quarter, 0], [2 * quarter, 0], [-quarter, 0], [0, quarter], [0, -quarter]];

/** From the front, the right, behind, the left, the top, below. */
function takeStandardView(i) {
  orbit.look(...standardViews[i]);
  viewChanged();
}

/** A place on the canvas, in parts of its height from its middle. */
function fromMiddle(x, y) {
  const box = canvas.getBoundingClientRect();
  return [(x - box.left - box.width / 2) / box.height, (y - box.top - box.height / 2) / box.height];
}

function listenToPointers() {
  const pointers = new Map();
  let way = 0, isClick = false;
  const middle = () => {
    const all = [...pointers.values()];
    return {x: all.reduce((t, p) => t + p.x, 0) / all.length, y: all.reduce((t, p) => t + p.y, 0) / all.length,
            spread: all.length > 1 ? Math.hypot(all[0].x - all[1].x, all[0].y - all[1].y) : 0};
  };
  canvas.onpointerdown = event => {
    canvas.setPointerCapture(event.pointerId);
    pointers.set(event.pointerId, {x: event.clientX, y: event.clientY});
    isClick = pointers.size === 1 && event.button === 0 && !event.shiftKey;
    way = 0;
  };
  canvas.onpointermove = event => {
    const pointer = pointers.get(event.pointerId);
    if (!pointer) return;
    const before = middle();
    Object.assign(pointer, {x: event.clientX, y: event.clientY});
    const now = middle(), dx = now.x - before.x, dy = now.y - before.y;
    way += Math.abs(event.movementX) + Math.abs(event.movementY);
    if (way > 3 || pointers.size > 1) isClick = false;
    else return;
    const height = canvas.clientHeight;
    const moves = pointers.size > 1 || event.shiftKey || (event.buttons & 6) !== 0;
    if (moves) orbit.pan(dx / height, dy / height);
    else orbit.turn(dx * turnPerPixel, dy * turnPerPixel);
    if (pointers.size > 1 && before.spread > 0 && now.spread > 0)
      orbit.zoom(before.spread / now.spread, ...fromMiddle(now.x, now.y));
    viewChanged();
  };
  canvas.onpointerup = canvas.onpointercancel = event => {
    pointers.delete(event.pointerId);
    if (isClick && event.type === "pointerup") explain(event);
    isClick = false;
  };
  canvas.oncontextmenu = event => event.preventDefault();
  canvas.addEventListener("wheel", event => {
    event.preventDefault();
    const lines = event.deltaMode === WheelEvent.DOM_DELTA_LINE ? 16 : 1;
    const speed = event.ctrlKey ? 0.01 : 0.0012;
    orbit.zoom(Math.exp(Math.max(-1, Math.min(1, event.deltaY * lines * speed))), ...fromMiddle(event.clientX, event.clientY));
    viewChanged();
  }, {passive: false});
}

function listenToKeys() {
  const step = 0.12, part = 0.06;
  const arrows = {ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1]};
  const hidden = ["none", "dashed", "solid"];
  document.addEventListener("keydown", event => {
    if (event.ctrlKey || event.metaKey || event.altKey || $("#help").open) return;
    const isControl = event.target.matches("input, select, textarea, #panel button");
    const arrow = arrows[event.key];
    if ((arrow || ["Home", "End", "PageUp", "PageDown"].includes(event.key)) && isControl) return;
    const key = event.key.toLowerCase();
    if (arrow && event.shiftKey) orbit.pan(-arrow[0] * part, -arrow[1] * part);
    else if (arrow) orbit.turn(arrow[0] * step, arrow[1] * step);
    else if (event.target.matches("textarea, input[type=number], select")) return;
    else if (key === "+" || key === "=") orbit.zoom(1 / 1.15);
    else if (key === "-") orbit.zoom(1.15);
    else if (key >= "1" && key <= "6") takeStandardView(Number(key) - 1);
    else {
      const actions = {
        f: () => takeView("fit"), "0": () => takeView("fit"), home: () => takeView("home"), p: toggleProjection,
        h: () => panel.hasSheet() || panel.change({hidden: hidden[(hidden.indexOf(panel.look.hidden) + 1) % 3]}),
        e: () => panel.hasSheet() && panel.toggleEditor(), s: togglePanel, "?": () => $("#help").showModal(),
        escape: closeExplained,
      };
      if (!actions[key]) return;
      event.preventDefault();
      return void actions[key]();
    }
    event.preventDefault();
    viewChanged();
  });
}

function togglePanel() {
  const isHidden = document.body.classList.toggle("no-panel");
  $("#panel-switch").setAttribute("aria-expanded", !isHidden);
}

// ---- what is asked of the picture ----

/** How far from a line a click may be, in pixels of the page. */
const reach = {mouse: 5, pen: 8, touch: 16};

function showMark(x, y, [width, height]) {
  $("#mark").style.left = (x + 0.5) / width * canvas.clientWidth + "px";
  $("#mark").style.top = (y + 0.5) / height * canvas.clientHeight + "px";
  $("#mark").hidden = false;
}

/** Says why the line is there that is nearest to a place. */
async function explain({clientX, clientY, pointerType}) {
  const box = canvas.getBoundingClientRect(), message = view.message("explain"), {size} = message;
  const inside = (part, whole) => Math.max(0, Math.min(whole - 1, Math.floor(part * whole)));
  message.x = inside((clientX - box.left) / box.width, size[0]);
  message.y = inside((clientY - box.top) / box.height, size[1]);
  message.reach = Math.min(64, Math.round((reach[pointerType] ?? reach.mouse) * size[0] / box.width));
  showMark(message.x, message.y, size);
  const asked = explained = Symbol();
  const answer = await view.connection.request(message);
  if (asked !== explained) return;  // another place was asked for, or the view has changed
  if (answer.kind === "error") return toast(answer.message, true);
  showMark(answer.x, answer.y, size);
  $("#explained h2").textContent = `pixel ${answer.x}, ${answer.y}`;
  const reasons = answer.reasons.length ? answer.reasons : ["no line is near"];
  $("#explained-reasons").replaceChildren(...reasons.map(text => Object.assign(document.createElement("li"), {textContent: text})));
  $("#explained-lines").textContent = answer.reasons.length ? answer.lines.trim() : "";
  $("#explained-fragments").textContent = answer.fragments.trim();
  $("#explained").hidden = false;
  $("#explained").scrollTop = 0;
}

function closeExplained() {
  explained = null;
  $("#explained").hidden = true;
  $("#mark").hidden = true;
}

async function save(format) {
  $("#saved").textContent = `making ${format.toUpperCase()} …`;
  const answer = await view.connection.request(view.message("save", {format}));
  if (answer.kind === "error") {
    $("#saved").textContent = "";
    return toast(answer.message, true);
  }
  const link = document.createElement("a");
  link.href = URL.createObjectURL(new Blob([answer.bytes], {type: answer.type}));
  link.download = answer.name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 60000);
  $("#saved").textContent = [`${answer.name} is saved by your browser`, ...answer.notes].join("; ");
}

async function copyCommand() {
  const answer = await view.connection.request(view.message("command"));
  if (answer.kind === "error") return toast(answer.message, true);
  document.body.dataset.command = answer.command;
  try {
    await navigator.clipboard.writeText(answer.command);
    $("#saved").textContent = answer.needs_scene ? "Copied; save the scene first, which it draws." : "Copied: " + answer.command;
  } catch {
    $("#saved").textContent = answer.command;
  }
}

// ---- the beginning ----

function lookChanged(look) {
  view.lookChanged(look);
  addressChanges();
}

function shown(frame) {
  if (!$("#wait").hidden) $("#wait").hidden = true;
  canvas.shownFrames = (canvas.shownFrames ?? 0) + 1;
  if (frame.full) $("#time").textContent = `${frame.width} × ${frame.height} · drawn in ${frame.draw_ms.toFixed(0)} ms`;
}

function showNotes(notes) {
  $("#notes").hidden = notes.length === 0;
  $("#notes ul").replaceChildren(...notes.map(note => Object.assign(document.createElement("li"), {textContent: note})));
}

/** Shows what the address says: a reload, a bookmark or an address pasted over this one. */
async function followAddress() {
  const {camera, look} = readAddress();
  panel.restore(look ?? {});
  view.begin(panel.look);
  if (!camera) return takeView("home");
  fittedBy = "";
  orbit.take(camera);
  viewChanged();
}

async function begin(connection, hello) {
  document.title = `${hello.name} – burin view`;
  $("#name").textContent = hello.name;
  orbit = new Orbit(hello.axis, Math.hypot(...hello.high.map((x, i) => x - hello.low[i])));
  panel = new Panel(hello, lookChanged, toast);
  view = new SceneView(canvas, connection, orbit, {
    onShown: shown,
    onFailed: answer => panel.showFault(answer) || toast(answer.message, true),
    onLook: sheet => panel.takeSheet(sheet),
  });
  showNotes(hello.notes);
  await followAddress();
  addEventListener("hashchange", followAddress);
  listenToPointers();
  listenToKeys();
  new ResizeObserver(sizeChanged).observe($("#paper"));
  document.body.dataset.ready = "yes";
}

for (const format of ["png", "svg", "toml"]) $(`#save-${format}`).onclick = () => save(format);
$("#copy").onclick = copyCommand;
$("#fit").onclick = () => takeView("fit");
$("#home").onclick = () => takeView("home");
$("#views").onchange = event => {
  takeStandardView(event.target.selectedIndex - 1);
  event.target.selectedIndex = 0;  // the same one can be chosen again
};
$("#projection").onclick = toggleProjection;
$("#panel-switch").onclick = togglePanel;
$("#help-button").onclick = () => $("#help").showModal();
$("#explained .close").onclick = closeExplained;

const whatIsSo = {
  dropped: "The connection to burin view was cut; it is made again …",
  full: "burin view shows as many pages as it can at once. Close one of the others, and this one goes on.",
  other: "Another burin view answers here. Each prints an address of its own: use that one.",
  gone: "burin view does not answer: it has ended, or the way to it is cut. Start it again and use its new address; "
    + "if it still runs, this page goes on as soon as it answers.",
  silent: "burin view runs, but does not answer. This page goes on as soon as it does; if it never does, start it again.",
  busy: "burin view is still at work on what you asked for …",
};

function stateChanged(state) {
  if (document.body.dataset.connection === state) return;
  document.body.dataset.connection = state;
  $("#state").textContent = whatIsSo[state] ?? "";
  $("#state").hidden = state === "open";
  if (!view) $("#wait").hidden = state !== "open" && state !== "busy";
}

/** The server has begun anew for this page: it is told the look, and asked for the view. */
function resume() {
  view.begin(panel.look);
  if (hasView) viewChanged();
  else followAddress();
}

const connection = new Connection(answer => {
  if (answer.kind === "hello") view ? resume() : begin(connection, answer);
  else if (!view?.take(answer) && answer.kind === "error") toast(answer.message, true);
}, stateChanged);
