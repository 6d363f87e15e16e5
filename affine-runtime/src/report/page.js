"use strict";
// The page of a run: a body under its affine map by WebGL 2, curves by canvas. Data are those of the run, see `page.rs`.
const data = JSON.parse(document.getElementById("data").textContent);
const element = (id) => document.getElementById(id);
const planar = data.n === 2, last = data.t.length - 1;
const span = data.t[last] - data.t[0];
// Parts of the run, 0 to 1, at which there are frames and outputs.
const part = (t) => (span === 0 ? 0 : (t - data.t[0]) / span);
const parts = data.t.map(part);
const outputs = data.outputs.map(part);
const COLOURS = ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#8a8a8a", "#b0a000"];
const SECONDS = 12;
// Axes of the body: colours, and how far they come out of the ball, whose radius is 1.
const AXES = ["#e67300", "#009e73", "#cc79a7"];
const AXIS = 1.3;

let at = 0, playing = false, then = null;
let azimuth = 35 * Math.PI / 180, elevation = 25 * Math.PI / 180;

const least = (values) => values.reduce((a, b) => Math.min(a, b), Infinity);
const most = (values) => values.reduce((a, b) => Math.max(a, b), -Infinity);
// What is no number is null.
const some = (value) => (value === null ? NaN : value);

// The frame before a part of the run.
function before(s) {
  let low = 0, high = last;
  while (high - low > 1) {
    const middle = (low + high) >> 1;
    if (parts[middle] <= s) low = middle; else high = middle;
  }
  return s >= parts[last] ? last : low;
}

// Time, centre and placement at a part of the run, along straight lines between frames; three rows, whatever n.
function body(s) {
  const k = before(s), next = Math.min(k + 1, last);
  const w = next === k ? 0 : Math.min(Math.max((s - parts[k]) / (parts[next] - parts[k]), 0), 1);
  const mix = (a, b) => a.map((value, i) => value + w * (b[i] - value));
  const x = mix(data.x[k], data.x[next]), phi = mix(data.phi[k], data.phi[next]);
  return { k, t: data.t[0] + s * span, x: planar ? [x[0], x[1], 0] : x,
    phi: planar ? [phi[0], phi[1], 0, phi[2], phi[3], 0, 0, 0, 1] : phi };
}

// Rows of cofactors: phi^-T but for a positive factor.
function cofactors([a, b, c, d, e, f, g, h, i]) {
  return [e * i - f * h, f * g - d * i, d * h - e * g, c * h - b * i, a * i - c * g, b * g - a * h,
    b * f - c * e, c * d - a * f, a * e - b * d];
}

// Rows: right, up, towards the eye.
function view() {
  if (planar) return [1, 0, 0, 0, 1, 0, 0, 0, 1];
  const [s, c, u, v] = [Math.sin(azimuth), Math.cos(azimuth), Math.sin(elevation), Math.cos(elevation)];
  return [-s, c, 0, -u * c, -u * s, v, v * c, v * s, u];
}

// Middle and radius of a ball that holds all bodies of the run; radius of the largest alone, its stretch.
function extent() {
  const centres = parts.map((s) => body(s).x);
  const middle = [0, 1, 2].map((i) => centres.map((x) => x[i])).map((values) => (least(values) + most(values)) / 2);
  let radius = 0, largest = 0;
  centres.forEach((x, k) => {
    const stretch = Math.exp(data.stretches[k][0]);
    largest = Math.max(largest, stretch);
    radius = Math.max(radius, Math.hypot(...x.map((value, i) => value - middle[i])) + AXIS * stretch);
  });
  return { middle, radius, largest };
}

const VERTEX = `#version 300 es
in vec3 a;
uniform mat3 phi, normals, view;
uniform vec3 x, middle, scale;
out vec3 point, normal;
void main() {
  vec3 y = view * (x + phi * a - middle);
  gl_Position = vec4(y.xy * scale.xy, -y.z * scale.z, 1.0);
  point = a;
  normal = view * normals * a;
}`;
// Kinds: 0 a ball, 1 a disc, 2 a line. Octants or quadrants differ in colour; the first axis of the body has a mark.
const FRAGMENT = `#version 300 es
precision highp float;
in vec3 point, normal;
uniform int kind;
uniform vec3 ink;
out vec4 colour;
void main() {
  if (kind == 2) { colour = vec4(ink, 1.0); return; }
  float side = kind == 0 ? point.x * point.y * point.z : point.x * point.y;
  vec3 base = side > 0.0 ? vec3(0.0, 0.45, 0.70) : vec3(0.45, 0.76, 0.94);
  if (kind == 0 ? point.x > 0.97 : point.x > 0.0 && abs(point.y) < 0.03) base = vec3(0.90, 0.45, 0.0);
  float light = kind == 0 ? 0.35 + 0.65 * max(dot(normalize(normal), normalize(vec3(0.3, 0.6, 0.8))), 0.0) : 1.0;
  colour = vec4(base * light, 1.0);
}`;

// The unit ball, or the unit disc: points and triangles.
function mesh() {
  const points = [], triangles = [], around = 72, down = planar ? 12 : 36;
  for (let i = 0; i <= down; i++) {
    for (let j = 0; j <= around; j++) {
      const turn = 2 * Math.PI * j / around, polar = Math.PI * i / down;
      const radius = planar ? i / down : Math.sin(polar);
      points.push(radius * Math.cos(turn), radius * Math.sin(turn), planar ? 0 : Math.cos(polar));
      if (i < down && j < around) {
        const here = i * (around + 1) + j, below = here + around + 1;
        triangles.push(here, below, here + 1, here + 1, below, below + 1);
      }
    }
  }
  return { points: new Float32Array(points), triangles: new Uint16Array(triangles) };
}

function painter() {
  const canvas = element("scene");
  const gl = canvas.getContext("webgl2", { antialias: true });
  if (!gl) { element("without").hidden = false; canvas.hidden = true; return () => {}; }
  const program = gl.createProgram();
  for (const [kind, text] of [[gl.VERTEX_SHADER, VERTEX], [gl.FRAGMENT_SHADER, FRAGMENT]]) {
    const shader = gl.createShader(kind);
    gl.shaderSource(shader, text);
    gl.compileShader(shader);
    gl.attachShader(program, shader);
  }
  gl.bindAttribLocation(program, 0, "a");
  gl.linkProgram(program);
  if (!gl.getProgramParameter(program, gl.LINK_STATUS)) throw new Error(gl.getProgramInfoLog(program));
  gl.useProgram(program);
  gl.depthFunc(gl.LEQUAL);
  gl.enableVertexAttribArray(0);
  const place = (name) => gl.getUniformLocation(program, name);
  const matrix = (name, rows) => gl.uniformMatrix3fv(place(name), true, rows);
  const { points, triangles } = mesh();
  const buffer = (target, content) => {
    const made = gl.createBuffer();
    gl.bindBuffer(target, made);
    gl.bufferData(target, content, gl.STATIC_DRAW);
    return made;
  };
  const use = (made) => { gl.bindBuffer(gl.ARRAY_BUFFER, made); gl.vertexAttribPointer(0, 3, gl.FLOAT, false, 0, 0); };
  const surface = buffer(gl.ARRAY_BUFFER, points);
  buffer(gl.ELEMENT_ARRAY_BUFFER, triangles);
  const axes = buffer(gl.ARRAY_BUFFER, new Float32Array([0, 0, 0, AXIS, 0, 0, 0, 0, 0, 0, AXIS, 0, 0, 0, 0, 0, 0, AXIS]));
  const { middle, radius, largest } = extent();
  // Counted from the middle, so that single precision is enough far from the origin.
  const centre = (x) => x.map((value, i) => value - middle[i]);
  const trail = buffer(gl.ARRAY_BUFFER, new Float32Array(parts.flatMap((s) => centre(body(s).x))));
  const travels = data.x.some((x) => x.some((value, i) => value !== data.x[0][i]));

  return () => {
    const { k, x, phi } = body(at), follow = element("follow").checked;
    const reach = 1.05 * (follow ? AXIS * largest : radius);
    gl.viewport(0, 0, canvas.width, canvas.height);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
    const side = Math.min(canvas.width, canvas.height);
    gl.uniform3f(place("scale"), side / canvas.width / reach, side / canvas.height / reach, 0.4 / (radius + largest));
    matrix("view", view());
    gl.uniform3fv(place("middle"), follow ? centre(x) : [0, 0, 0]);
    gl.uniform1i(place("kind"), planar ? 1 : 0);
    gl.uniform3fv(place("x"), centre(x));
    matrix("phi", phi);
    matrix("normals", cofactors(phi));
    gl.enable(gl.DEPTH_TEST);
    use(surface);
    gl.drawElements(gl.TRIANGLES, triangles.length, gl.UNSIGNED_SHORT, 0);
    gl.uniform1i(place("kind"), 2);
    const lines = (ink, mode, first, count) => {
      gl.uniform3f(place("ink"), ...[1, 3, 5].map((i) => parseInt(ink.slice(i, i + 2), 16) / 255));
      gl.drawArrays(mode, first, count);
    };
    use(axes);
    for (let a = 0; a < data.n && element("axes").checked; a++) lines(AXES[a], gl.LINES, 2 * a, 2);
    if (!travels) return;
    gl.uniform3fv(place("x"), [0, 0, 0]);
    matrix("phi", [1, 0, 0, 0, 1, 0, 0, 0, 1]);
    gl.disable(gl.DEPTH_TEST);
    use(trail);
    lines("#d95f00", gl.LINE_STRIP, 0, k + 1);
    lines("#8c8c8c", gl.LINE_STRIP, k, last - k + 1);
  };
}

// A line of a legend.
function explain(id, text, colour) {
  const item = document.createElement("li"), stroke = document.createElement("span");
  stroke.style.color = colour;
  stroke.textContent = "\u2501 ";
  item.append(stroke, text);
  element(id + "-legend").append(item);
}

// Curves over the run, with a cursor and marks of events; `series` are `{ name, at, values }`, labels of so many digits.
function plotter(id, series, digits, prefix = "") {
  const canvas = element(id), pen = canvas.getContext("2d");
  const finite = series.flatMap((one) => one.values).filter(Number.isFinite);
  let low = least(finite), high = most(finite);
  const size = finite.length ? Math.max(-low, high) : 0;
  // What changes by rounding alone is drawn as what stays.
  if (!(high - low > 1e-9 * size)) [low, high] = size ? [low - Math.abs(low), low + Math.abs(low)] : [-1, 1];
  canvas.hidden = canvas.previousElementSibling.hidden = !series.length;
  series.forEach((one, i) => explain(id, one.name, COLOURS[i % COLOURS.length]));
  const left = 58, edge = 14;
  const scrub = (event) => event.buttons && go((event.offsetX - left) / (canvas.clientWidth - left - edge));
  for (const kind of ["pointerdown", "pointermove"]) canvas.addEventListener(kind, scrub);
  return () => {
    const width = canvas.clientWidth, height = canvas.clientHeight, ratio = canvas.width / width || 1;
    const across = (s) => left + s * (width - left - edge);
    const up = (y) => height - 24 - (y - low) / (high - low) * (height - 24 - edge);
    const style = getComputedStyle(document.body);
    const write = (text, align, x, y, room) => { pen.textAlign = align; pen.fillText(text, x, y, room); };
    const line = (x0, y0, x1, y1) => { pen.beginPath(); pen.moveTo(x0, y0); pen.lineTo(x1, y1); pen.stroke(); };
    pen.setTransform(ratio, 0, 0, ratio, 0, 0);
    pen.clearRect(0, 0, width, height);
    const faint = style.getPropertyValue("--faint");
    Object.assign(pen, { font: "12px system-ui, sans-serif", fillStyle: style.color, strokeStyle: faint, lineWidth: 1 });
    for (const y of [low, (low + high) / 2, high]) {
      line(left, up(y), width - edge, up(y));
      write(prefix + figure(y, (high - low) / 2, digits), "right", left - 6, up(y) + 4, left - 8);
    }
    for (const event of data.events) line(across(part(event.t)), edge, across(part(event.t)), height - 24);
    write(figure(data.t[0]), "left", left, height - 8);
    write("t = " + figure(data.t[last]), "right", width - edge, height - 8);
    pen.lineWidth = 1.6;
    series.forEach((one, i) => {
      pen.strokeStyle = COLOURS[i % COLOURS.length];
      pen.beginPath();
      let drawn = false;
      one.values.forEach((value, k) => {
        const is = Number.isFinite(value);
        if (is) pen[drawn ? "lineTo" : "moveTo"](across(one.at[k]), up(value));
        drawn = is;
      });
      pen.stroke();
    });
    pen.strokeStyle = style.color;
    line(across(at), edge, across(at), height - 24);
  };
}

// A number to so many digits, or as many as tell it from others that far away; without more said, from times near by.
const figure = (value, apart = Math.abs(span) / 1000, digits = 5) => Math.abs(value) <= 1e-3 * apart ? "0"
  : String(Number(value.toPrecision(Math.min(17, Math.max(digits, 1 + Math.ceil(Math.log10(Math.abs(value) / apart)))))));
const drifts = data.drifts.map(({ symbol, values }) => {
  let worst = 1e-17;
  return { name: symbol, at: outputs, values: values.map((value) => Math.log10(worst = Math.max(worst, some(value)))) };
});
const axes = Array.from({ length: data.n }, (_, a) => a);
const stretches = axes.map((a) => ({ name: "q" + (a + 1), at: parts, values: data.stretches.map((all) => some(all[a])) }));
const energies = data.energies.map((energy) => ({ name: energy.symbol, at: outputs, values: energy.values.map(some) }));
for (const a of axes) explain("axes", "axis " + (a + 1) + " of the body", AXES[a]);
const painters = [painter(), plotter("stretches", stretches, 4), plotter("energies", energies, 3),
  plotter("drifts", drifts, 3, "1e")];

function draw() {
  for (const paint of painters) paint();
  element("time").value = at;
  element("now").textContent = "t = " + figure(data.t[0] + at * span);
  element("play").textContent = playing ? "Pause" : "Play";
}
function go(s) { at = Math.min(Math.max(s, 0), 1); draw(); }
function play(on) { playing = on; if (on && at >= 1) at = 0; draw(); if (on) requestAnimationFrame(tick); }
function tick(when) {
  if (!playing) { then = null; return; }
  if (then !== null) at += (when - then) / 1000 / SECONDS * Number(element("speed").value);
  then = when;
  if (at >= 1) { at = 1; playing = false; then = null; }
  draw();
  if (playing) requestAnimationFrame(tick);
}

element("play").addEventListener("click", () => play(!playing));
element("time").addEventListener("input", (event) => go(Number(event.target.value)));
for (const id of ["follow", "axes"]) element(id).addEventListener("change", draw);
function turn(across, up) {
  [azimuth, elevation] = [azimuth + across, Math.min(Math.max(elevation + up, -1.55), 1.55)];
  draw();
}
document.addEventListener("keydown", (event) => {
  if (event.ctrlKey || event.metaKey || event.altKey || event.target.tagName === "SELECT") return;
  const k = before(at);
  // From between two frames the frame before is one step back.
  const back = parts[Math.max(at > parts[k] ? k : k - 1, 0)];
  const keys = event.shiftKey ? { ArrowRight: () => turn(0.1, 0), ArrowLeft: () => turn(-0.1, 0),
    ArrowUp: () => turn(0, 0.1), ArrowDown: () => turn(0, -0.1) } : { " ": () => play(!playing), Home: () => go(0),
    ArrowRight: () => go(parts[Math.min(k + 1, last)]), ArrowLeft: () => go(back), End: () => go(1) };
  if (!(event.key in keys) || (event.key === " " && ["checkbox", "button"].includes(event.target.type))) return;
  event.preventDefault();
  keys[event.key]();
});
const dragged = (event) => event.buttons && turn(-event.movementX * 0.008, event.movementY * 0.008);
if (planar) element("scene").style.touchAction = "auto"; else element("scene").addEventListener("pointermove", dragged);
const resized = new ResizeObserver((entries) => {
  const pixels = (length) => Math.max(1, Math.round(length * devicePixelRatio));
  for (const { target } of entries) [target.width, target.height] = [target.clientWidth, target.clientHeight].map(pixels);
  draw();
});
for (const canvas of document.querySelectorAll("canvas")) resized.observe(canvas);
matchMedia("(prefers-color-scheme: dark)").addEventListener("change", draw);
draw();
