'use strict';
(() => {
const byId = id => document.getElementById(id);
const data = JSON.parse(byId('data').textContent);
const pictures = JSON.parse(byId('pictures').textContent);
const methods = data.methods;
const drawnMethods = methods.filter(m => m.picture);
const rowsOf = kind => methods.map(m => kind === 'published' ? m : m.equal_width);

function element(tag, attributes = {}, ...children) {
  const node = document.createElement(tag);
  for (const [key, value] of Object.entries(attributes)) node.setAttribute(key, value);
  node.append(...children);
  return node;
}
function svg(tag, attributes = {}, text) {
  const node = document.createElementNS('http://www.w3.org/2000/svg', tag);
  for (const [key, value] of Object.entries(attributes)) node.setAttribute(key, value);
  if (text !== undefined) node.textContent = text;
  return node;
}
const clamp = (x, low, high) => Math.min(high, Math.max(low, x));
const counted = (n, thing) => `${grouped(n)} ${thing}${n === 1 ? '' : 's'}`;
const grouped = n => String(Math.round(n)).replace(/\B(?=(\d{3})+$)/g, '\u202f');

// ---- head ----
const baseName = data.scene.input.split('/').pop();
document.title = `Burin: methods compared on ${baseName}`;
byId('title').textContent = `Methods compared on ${baseName}`;
byId('facts').textContent =
  `${data.scene.width} × ${data.scene.height} pixels, ${counted(data.scene.triangles, 'triangle')}, ` +
  `lines: ${data.scene.lines.join(', ')}; width ${data.scene.line_width_px} px. ` +
  `Truth: method ${data.truth.method}, ${data.truth.time_s.toFixed(1)} s. ` +
  `${counted(methods.length, 'method')} on ${counted(data.scene.threads, 'thread')}.`;
byId('foot').textContent = 'All numbers are in metrics.json and metrics.csv beside this page.';

// ---- pictures: a viewer with a wipe, and the same crop of all ----
// All start here, in the page's own script, and so hold up its load event: who prints or photographs
// the page when it is loaded gets them all.
const images = new Map();
for (const [name, url] of Object.entries(pictures)) {
  const image = new Image();
  image.onload = () => draw();
  image.src = url;
  images.set(name, image);
}
const imageOf = name => images.get(name);
const choices = [['truth', data.truth.picture]];
for (const m of drawnMethods) choices.push([m.name, m.picture]);
for (const m of drawnMethods) choices.push([`${m.name}, difference`, m.difference]);
const left = byId('left'), right = byId('right');
for (const select of [left, right]) {
  for (const [label, file] of choices) select.append(element('option', {value: file}, label));
}
left.value = data.truth.picture;
right.value = drawnMethods.length ? drawnMethods[0].picture : data.truth.picture;
const labelOf = file => choices.find(c => c[1] === file)[0];

const viewer = byId('viewer'), canvas = byId('view'), wipe = byId('wipe');
const state = {scale: 0, x: 0, y: 0, wipe: 0.5};  // CSS pixels per image pixel; image point in the middle
const size = () => ({w: imageOf(data.truth.picture).naturalWidth, h: imageOf(data.truth.picture).naturalHeight});
const fitScale = () => Math.min(canvas.clientWidth / size().w, canvas.clientHeight / size().h);
function fit() {
  const {w, h} = size();
  Object.assign(state, {scale: fitScale(), x: w / 2, y: h / 2});
  scheduleDraw();
}
function zoomBy(factor, atX = canvas.clientWidth / 2, atY = canvas.clientHeight / 2) {
  const scale = clamp(state.scale * factor, Math.min(fitScale(), 1), 64);
  const dx = atX - canvas.clientWidth / 2, dy = atY - canvas.clientHeight / 2;
  state.x += dx / state.scale - dx / scale;
  state.y += dy / state.scale - dy / scale;
  state.scale = scale;
  scheduleDraw();
}
function panBy(dx, dy) {
  const {w, h} = size();
  state.x = clamp(state.x + dx / state.scale, 0, w);
  state.y = clamp(state.y + dy / state.scale, 0, h);
  scheduleDraw();
}
function setWipe(part) {
  state.wipe = clamp(part, 0, 1);
  scheduleDraw();
}
const contextOf = target => target.getContext('2d', {willReadFrequently: true});
function drawInto(target, image, scale, x, y, clip) {
  const ratio = window.devicePixelRatio || 1;
  const context = contextOf(target);
  const w = target.clientWidth, h = target.clientHeight;
  context.save();
  context.setTransform(ratio, 0, 0, ratio, 0, 0);
  if (clip) {
    context.beginPath();
    context.rect(clip[0], 0, clip[1] - clip[0], h);
    context.clip();
  }
  context.imageSmoothingEnabled = scale * ratio < 1;
  context.imageSmoothingQuality = 'high';
  context.drawImage(image, w / 2 - x * scale, h / 2 - y * scale, image.naturalWidth * scale, image.naturalHeight * scale);
  context.restore();
}
function resized(target) {
  const ratio = window.devicePixelRatio || 1;
  target.width = Math.round(target.clientWidth * ratio);
  target.height = Math.round(target.clientHeight * ratio);
}
const crops = [];
function markCrop([x, y], scale) {
  if (!crops.length) return;
  const ratio = window.devicePixelRatio || 1, context = contextOf(canvas);
  const side = crops[0].canvas.clientWidth / scale * state.scale;
  const at = [(x - state.x) * state.scale + canvas.clientWidth / 2, (y - state.y) * state.scale + canvas.clientHeight / 2];
  context.setTransform(ratio, 0, 0, ratio, 0, 0);
  context.strokeStyle = 'rgba(193, 70, 30, .8)';
  context.strokeRect(at[0] - side / 2, at[1] - side / 2, side, side);
}
function draw() {
  const truth = imageOf(data.truth.picture);
  if (!truth.complete || !truth.naturalWidth) return;
  if (!(state.scale > 0)) fit();
  if (!(state.scale > 0)) return;  // not laid out yet
  resized(canvas);
  const edge = state.wipe * canvas.clientWidth;
  for (const [file, from, to] of [[left.value, 0, edge], [right.value, edge, canvas.clientWidth]]) {
    const image = imageOf(file);
    if (image.complete && image.naturalWidth) drawInto(canvas, image, state.scale, state.x, state.y, [from, to]);
  }
  const line = contextOf(canvas), ratio = window.devicePixelRatio || 1;
  line.fillStyle = '#1b65a7';
  line.fillRect((edge - 1) * ratio, 0, 2 * ratio, canvas.height);
  wipe.style.left = `${edge}px`;
  wipe.setAttribute('aria-valuenow', Math.round(100 * state.wipe));
  Object.assign(viewer.dataset, {zoom: state.scale.toFixed(3), x: state.x.toFixed(2), y: state.y.toFixed(2)});
  byId('zoom-level').textContent = `${state.scale >= 10 ? state.scale.toFixed(0) : state.scale.toFixed(2)}×`;
  byId('tag-left').textContent = labelOf(left.value);
  byId('tag-right').textContent = labelOf(right.value);
  // As long as all of the picture is shown, the crops show a place with many lines.
  const focus = state.scale > fitScale() * 1.01 ? [state.x, state.y] : data.scene.focus;
  const cropScale = Math.max(4, state.scale);
  markCrop(focus, cropScale);
  for (const crop of crops) {
    const image = imageOf(crop.file);
    if (!image.complete || !image.naturalWidth) continue;
    resized(crop.canvas);
    drawInto(crop.canvas, image, cropScale, focus[0], focus[1], null);
    crop.figure.classList.toggle('shown', crop.file === right.value || crop.file === left.value);
  }
  viewer.dataset.drawn = 'yes';
}
let scheduled = false;
function scheduleDraw() {
  if (scheduled) return;
  scheduled = true;
  requestAnimationFrame(() => { scheduled = false; draw(); });
}
function stepRight(step) {
  const files = drawnMethods.map(m => m.picture);
  if (!files.length) return;
  const at = files.indexOf(right.value);
  right.value = files[(Math.max(at, 0) + (at < 0 ? 0 : step) + files.length) % files.length];
  scheduleDraw();
}
function toggleDifference() {
  const m = drawnMethods.find(x => x.picture === right.value || x.difference === right.value);
  if (m) right.value = right.value === m.picture ? m.difference : m.picture;
  scheduleDraw();
}
const keys = {
  ',': () => setWipe(state.wipe - 0.02), '.': () => setWipe(state.wipe + 0.02),
  '+': () => zoomBy(2), '=': () => zoomBy(2), '-': () => zoomBy(0.5), '0': fit,
  'ArrowLeft': () => panBy(-40, 0), 'ArrowRight': () => panBy(40, 0),
  'ArrowUp': () => panBy(0, -40), 'ArrowDown': () => panBy(0, 40),
  '[': () => stepRight(-1), ']': () => stepRight(1), 'd': toggleDifference, 'D': toggleDifference,
};
viewer.addEventListener('keydown', event => {
  if (event.ctrlKey || event.metaKey || event.altKey) return;
  const onWipe = event.target === wipe;
  if (onWipe && event.key === 'ArrowLeft') setWipe(state.wipe - 0.02);
  else if (onWipe && event.key === 'ArrowRight') setWipe(state.wipe + 0.02);
  else if (keys[event.key]) keys[event.key]();
  else return;
  event.preventDefault();
});
let drag = null;
viewer.addEventListener('pointerdown', event => {
  drag = {wipe: event.target === wipe, x: event.clientX, y: event.clientY};
  viewer.setPointerCapture(event.pointerId);
  viewer.classList.add('dragging');
});
viewer.addEventListener('pointermove', event => {
  if (!drag) return;
  if (drag.wipe) {
    setWipe((event.clientX - canvas.getBoundingClientRect().left) / canvas.clientWidth);
  } else {
    panBy(drag.x - event.clientX, drag.y - event.clientY);
    Object.assign(drag, {x: event.clientX, y: event.clientY});
  }
});
for (const name of ['pointerup', 'pointercancel']) {
  viewer.addEventListener(name, () => { drag = null; viewer.classList.remove('dragging'); });
}
viewer.addEventListener('wheel', event => {
  event.preventDefault();
  const box = canvas.getBoundingClientRect();
  zoomBy(Math.pow(2, -event.deltaY / 240), event.clientX - box.left, event.clientY - box.top);
}, {passive: false});
byId('zoom-in').onclick = () => zoomBy(2);
byId('zoom-out').onclick = () => zoomBy(0.5);
byId('zoom-fit').onclick = fit;
left.onchange = right.onchange = scheduleDraw;
for (const [label, file] of choices) {
  if (label.endsWith(', difference')) continue;
  const m = methods.find(x => x.picture === file);
  const tile = element('canvas');
  const figure = element('figure', {}, tile, element('figcaption', {}, label, ' ',
    element('small', {}, m && m.psnr98_db !== null ? `${m.psnr98_db.toFixed(1)} dB` : '')));
  figure.onclick = () => { right.value = file; scheduleDraw(); };
  byId('crops').append(figure);
  crops.push({canvas: tile, figure, file});
}
new ResizeObserver(scheduleDraw).observe(viewer);
window.addEventListener('load', draw);
window.addEventListener('beforeprint', draw);
window.addEventListener('afterprint', scheduleDraw);

// ---- tables ----
const groups = [
  ['scene', 'On this scene', 'against the truth with the same line classes'],
  ['chart', 'On the test chart', data.chart.line_width_px === null ? 'not drawn: the lines are too wide for it'
    : 'lines of known place and direction'],
  ['motion', 'In motion', data.motion.frames > 1 ? `${data.motion.frames} frames, 1/32 pixel apart`
    : 'not measured; ask for it with --frames 32'],
  ['cost', 'Cost', 'time and memory for the picture'],
];
function merit(metric, value) {
  switch (metric.better) {
    case 'lower': return -value;
    case 'higher': return value;
    case 'near_zero': return -Math.abs(value);
    case 'near_one': return -Math.abs(value - 1);
    default: return null;
  }
}
// No error at all has no decibels, and is the best there is.
function valueOf(metric, row) {
  const value = row[metric.key];
  return value === null && row.rmse === 0 && metric.key.startsWith('psnr') ? Infinity : value;
}
// Against the truth of its own width a method has no bias to be proud of.
const competes = (metric, row) => valueOf(metric, row) !== null &&
  (metric.key !== 'width_bias' || row.truth_width_px === data.scene.line_width_px);
function shown(metric, value) {
  if (value === null) return '—';
  if (value === Infinity) return 'exact';
  if (metric.digits === 0) return grouped(value);
  return value.toFixed(metric.digits).replace('-', '\u2212');
}
function table(kind, [group, title, note]) {
  const metrics = data.metrics.filter(m => m.group === group);
  const rows = rowsOf(kind);
  const used = metrics.filter(m => rows.some(r => r[m.key] !== null));
  if (!used.length) return element('p', {class: 'hint'}, `${title}: ${note}.`);
  const head = element('tr', {}, element('th', {}, 'method'));
  const columns = used.concat(group === 'scene'
    ? [{key: 'asked_width_px', title: 'asked px', what: 'Line width that the method was asked for.', digits: 2, better: 'none'},
       {key: 'truth_width_px', title: 'truth px', what: 'Line width of the truth that it is compared with.', digits: 2, better: 'none'}] : []);
  for (const m of columns) head.append(element('th', {title: m.what, scope: 'col'}, m.title));
  const body = element('tbody');
  const best = columns.map(m => {
    const merits = rows.filter(r => competes(m, r)).map(r => merit(m, valueOf(m, r)));
    return merits.length && merits[0] !== null ? Math.max(...merits) : null;
  });
  methods.forEach((method, i) => {
    const missing = group === 'scene' && method.not_drawn.length ? element('small', {}, `without ${method.not_drawn.join(', ')}`) : '';
    const line = element('tr', {}, element('th', {scope: 'row'}, method.name, missing));
    columns.forEach((m, k) => {
      const value = valueOf(m, rows[i]);
      const isBest = competes(m, rows[i]) && best[k] !== null && rows.length > 1 &&
        shown(m, Math.abs(merit(m, value))) === shown(m, Math.abs(best[k]));
      line.append(element('td', {class: value === null ? 'none' : isBest ? 'best' : ''}, shown(m, value)));
    });
    body.append(line);
  });
  const result = element('table', {class: kind}, element('caption', {}, `${title} `,
    element('small', {}, group === 'cost' ? note : `${note}; ${kind === 'published' ? 'as published' : 'at equal width'}`)),
    element('thead', {}, head), body);
  [...head.children].forEach((cell, k) => { cell.onclick = () => sortBy(body, head, k, k ? columns[k - 1] : null); });
  return element('div', {class: 'scroll'}, result);
}
function sortBy(body, head, k, metric) {
  const ascending = head.children[k].getAttribute('aria-sort') !== 'ascending';
  for (const cell of head.children) cell.removeAttribute('aria-sort');
  head.children[k].setAttribute('aria-sort', ascending ? 'ascending' : 'descending');
  const number = line => {
    const text = line.children[k].textContent.replace('\u2212', '-').replace(/\u202f/g, '');
    return text === '—' ? null : text === 'exact' ? Infinity : Number(text);
  };
  const lines = [...body.children].sort((a, b) => {
    if (!metric) return a.children[0].textContent.localeCompare(b.children[0].textContent);
    const x = number(a), y = number(b);
    if (x === null || y === null) return (x === null) - (y === null);
    return x === y ? 0 : x < y ? -1 : 1;
  });
  const nulls = metric ? lines.filter(l => number(l) === null) : [];
  const valued = lines.filter(l => !nulls.includes(l));
  if (!ascending) valued.reverse();
  body.append(...valued, ...nulls);
}
for (const group of groups) {
  for (const kind of ['published', 'equal_width']) {
    const rows = rowsOf(kind);
    const empty = !data.metrics.some(m => m.group === group[0] && rows.some(r => r[m.key] !== null));
    if ((empty || group[0] === 'cost') && kind === 'equal_width') continue;
    const node = table(kind, group);
    if (group[0] === 'cost') node.querySelector('table')?.classList.remove('published');
    byId('tables').append(node);
  }
}
const hints = {
  published: `Every method was asked for lines of ${data.scene.line_width_px} px and draws them as its source says. ` +
    'A dot marks the best value of a column. Click a heading to sort.',
  equal_width: data.chart.line_width_px === null
    ? 'Not measured: lines this wide are not on the chart, which would tell how wide each method draws them.'
    : 'Each method was asked for the width at which its lines on the chart have the integrated width of the truth. ' +
    'A method that cannot draw that width is compared with a truth of its own width.',
};
const switches = [...document.querySelectorAll('.switch button')];
function chooseRow(kind) {
  document.body.dataset.row = kind;
  for (const b of switches) b.setAttribute('aria-checked', b.dataset.row === kind);
  byId('row-hint').textContent = hints[kind];
  drawFingerprints(kind);
}
for (const b of switches) b.onclick = () => chooseRow(b.dataset.row);

// ---- curves: a row per method, a column per plot ----
const range = (count, first, step) => Array.from({length: count}, (_, i) => first + i * step);
// A stroke of width w seen through a square pixel, over all directions: box(w), convolved with the
// pixel's shadow, which at angle a is box(|cos a|) convolved with box(|sin a|).
const angles = range(45, 0.5, 1).map(d => d * Math.PI / 180);
const averaged = f => angles.reduce((sum, a) => sum + f(Math.cos(a), Math.sin(a)), 0) / angles.length;
function trueProfile(u, w) {
  const square = x => x > 0 ? x * x : 0;
  const below = (t, a, b) => (square(t + (a + b) / 2) - square(t + (a - b) / 2) -
    square(t - (a - b) / 2) + square(t - (a + b) / 2)) / (2 * a * b);
  return averaged((a, b) => below(u + w / 2, a, b) - below(u - w / 2, a, b));
}
const sinc = x => x === 0 ? 1 : Math.sin(Math.PI * x) / (Math.PI * x);
const trueModulation = (f, w) => Math.abs(sinc(f * w) * averaged((a, b) => sinc(f * a) * sinc(f * b)));
const plots = [
  {title: 'Width by angle', note: 'px, over 0–180°', zero: true,
   points: r => r.curves && r.curves.width_px_by_degree.map((v, i) => [i, v]), ideal: r => [[0, r.truth_width_px], [179, r.truth_width_px]], unit: '°'},
  {title: 'Error by angle', note: 'RMSE of coverage', zero: true,
   points: r => r.curves && r.curves.rmse_by_degree.map((v, i) => [i, v]), unit: '°'},
  {title: 'Profile', note: 'coverage across the line, px', zero: true,
   points: r => r.curves && range(r.curves.profile_coverage.length, r.curves.profile_first_u_px, r.curves.profile_step_px)
     .map((u, i) => [u, r.curves.profile_coverage[i]]), unit: ' px',
   ideal: r => range(8 * Math.ceil(-r.curves.profile_first_u_px) + 1, Math.floor(r.curves.profile_first_u_px), 0.25)
     .filter(u => Math.abs(u) <= -r.curves.profile_first_u_px).map(u => [u, trueProfile(u, r.truth_width_px)])},
  {title: 'Modulation', note: 'by cycles per pixel', zero: true,
   points: r => r.curves && r.curves.modulation.map((v, i) => [i * r.curves.modulation_step_cycles_per_px, v]), unit: ' c/px',
   ideal: r => r.curves.modulation.map((v, i) => i * r.curves.modulation_step_cycles_per_px)
     .map(f => [f, trueModulation(f, r.truth_width_px)])},
  {title: 'Leak by gap', note: 'share of a hidden line, log px', zero: true, top: 1, dots: true, log: true,
   points: r => r.curves && r.curves.gap_px.map((g, i) => [Math.log10(g), r.curves.leak_share_by_gap[i]]), unit: ' px'},
  {title: 'Over frames', note: 'total ink over the truth’s mean',
   points: r => r.coverage_by_frame.length ? r.coverage_by_frame.map((v, i) => [i, v]) : null,
   ideals: () => data.motion.truth_coverage_by_frame.map((v, i) => [i, v]), unit: '. frame'},
];
const W = 190, H = 66, L = 26, B = 11;
function drawFingerprints(kind) {
  const rows = rowsOf(kind);
  const holder = byId('fingerprints');
  holder.replaceChildren();
  const columns = plots.filter(p => rows.some(r => (p.points(r) || []).length));
  byId('curves-hint').textContent = columns.length
    ? `Blue: the method. Grey: the others. Dashed: what it should be. ${kind === 'published' ? 'As published' : 'At equal width'}.`
    : 'No chart was drawn.';
  if (!columns.length) return;
  const head = element('tr', {}, element('th', {}, 'method'));
  for (const p of columns) head.append(element('th', {}, p.title, element('small', {}, p.note)));
  const body = element('tbody');
  const scales = columns.map(p => {
    const all = rows.flatMap(r => p.points(r) || []).concat(p.ideals ? p.ideals() : []);
    const ys = all.concat(p.ideal ? rows.filter(r => p.points(r)).flatMap(r => p.ideal(r)) : []).map(q => q[1]);
    const xs = all.map(q => q[0]);
    let low = p.zero ? 0 : Math.min(...ys), high = p.top || Math.max(...ys);
    if (!(high > low)) { low -= p.zero ? 0 : 0.01; high += 0.01; }
    return {x0: Math.min(...xs), x1: Math.max(...xs), y0: low, y1: high};
  });
  methods.forEach((method, i) => {
    const line = element('tr', {}, element('th', {scope: 'row'}, method.name));
    columns.forEach((p, k) => line.append(element('td', {}, p.points(rows[i]) ? plot(p, scales[k], rows, i, k) : '—')));
    body.append(line);
  });
  holder.append(element('table', {}, element('thead', {}, head), body));
}
function plot(p, s, rows, i, k) {
  const px = x => L + (x - s.x0) / (s.x1 - s.x0 || 1) * (W - L), py = y => (H - B) * (1 - (y - s.y0) / (s.y1 - s.y0));
  const path = points => points.map(([x, y], n) => `${n ? 'L' : 'M'}${px(x).toFixed(1)} ${py(y).toFixed(1)}`).join('');
  const number = v => Math.abs(v) >= 100 ? v.toFixed(0) : String(Number(v.toPrecision(2)));
  const node = svg('svg', {viewBox: `-1 -5 ${W + 4} ${H + 8}`, role: 'img', 'data-plot': k,
    'aria-label': `${p.title}, ${methods[i].name}`});
  node.append(svg('rect', {class: 'frame', x: L, y: 0, width: W - L, height: H - B}));
  rows.forEach((r, n) => { if (n !== i && p.points(r)) node.append(svg('path', {class: 'others', d: path(p.points(r))})); });
  if (p.ideal) node.append(svg('path', {class: 'ideal', d: path(p.ideal(rows[i]))}));
  if (p.ideals) node.append(svg('path', {class: 'ideal', d: path(p.ideals())}));
  const points = p.points(rows[i]);
  node.append(svg('path', {class: 'curve', d: path(points)}));
  if (p.dots) for (const [x, y] of points) node.append(svg('circle', {class: 'dot', cx: px(x), cy: py(y), r: 1.8}));
  node.append(svg('text', {x: L - 3, y: 7, 'text-anchor': 'end'}, number(s.y1)),
    svg('text', {x: L - 3, y: H - B, 'text-anchor': 'end'}, number(s.y0)));
  const xText = x => p.log ? number(Math.pow(10, x)) : number(x);
  node.append(svg('text', {x: L, y: H}, xText(s.x0)), svg('text', {x: W, y: H, 'text-anchor': 'end'}, xText(s.x1)));
  node.addEventListener('pointermove', event => {
    const box = node.getBoundingClientRect();
    const x = s.x0 + ((event.clientX - box.left) / box.width * (W + 4) - 1 - L) / (W - L) * (s.x1 - s.x0);
    showCursor(k, x);
  });
  node.addEventListener('pointerleave', () => showCursor(k, null));
  node.readAt = x => {
    for (const old of node.querySelectorAll('.cursor, .read')) old.remove();
    if (x === null) return;
    const near = points.reduce((a, q) => Math.abs(q[0] - x) < Math.abs(a[0] - x) ? q : a);
    node.append(svg('line', {class: 'cursor', x1: px(near[0]), x2: px(near[0]), y1: 0, y2: H - B}),
      svg('text', {class: 'read', x: clamp(px(near[0]) + 3, L, W - 62), y: 9},
        `${Number(near[1].toPrecision(3))} at ${xText(near[0])}${p.unit}`));
  };
  return node;
}
function showCursor(k, x) {
  for (const node of document.querySelectorAll(`svg[data-plot="${k}"]`)) node.readAt(x);
}
chooseRow('published');

// ---- methods and definitions ----
for (const m of methods) {
  const note = element('article', {}, element('h3', {}, m.name), element('p', {class: 'source'}, m.source));
  if (m.how) note.append(element('p', {}, m.how));
  if (m.limits) note.append(element('p', {class: 'limits'}, m.limits));
  note.append(element('p', {class: 'source'}, m.not_drawn.length
    ? `Of the lines asked for it cannot draw: ${m.not_drawn.join(', ')}.` : 'Draws all lines asked for.'));
  const renamed = m.truth_classes.filter(c => !m.drawn.includes(c));
  if (renamed.length) note.append(element('p', {class: 'source'}, `Finds under other names, and is measured with: ${renamed.join(', ')}.`));
  byId('notes').append(note);
}
for (const m of data.metrics) {
  byId('definitions').append(element('div', {}, element('dt', {}, `${m.title} `, element('code', {}, m.key)),
    element('dd', {}, m.what)));
}
})();
