"use strict";
// Drawing: a camera, and what WebGL2 draws. Coordinates are metres about the middle of the film, z up.

function fail(text) {
  const box = document.getElementById("failed");
  box.textContent = text;
  box.hidden = false;
}

const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const scaled = (a, s) => [a[0] * s, a[1] * s, a[2] * s];
const added = (a, b) => [a[0] + b[0], a[1] + b[1], a[2] + b[2]];
const unit = (a) => scaled(a, 1 / (Math.hypot(...a) || 1));

// Matrices are columns one behind the other.
function times(a, b) {
  const out = new Float32Array(16);
  for (let c = 0; c < 4; c++) {
    for (let r = 0; r < 4; r++) {
      let sum = 0;
      for (let k = 0; k < 4; k++) sum += a[4 * k + r] * b[4 * c + k];
      out[4 * c + r] = sum;
    }
  }
  return out;
}

const FIELD = 35 * Math.PI / 180;

class Camera {
  constructor(reach) {
    this.reach = reach;
    this.target = [0, 0, 0];
    this.look(-2.2, 0.42, 3);
  }
  // Where the viewer stands: angle from +X toward +Y, height above the horizon (rad), distance in reaches.
  look(turn, rise, far) {
    this.turn = turn;
    this.rise = rise;
    if (far) this.far = far * this.reach;
  }
  get out() {
    const c = Math.cos(this.rise);
    return [c * Math.cos(this.turn), c * Math.sin(this.turn), Math.sin(this.rise)];
  }
  get frame() {
    const out = this.out;
    const right = [-Math.sin(this.turn), Math.cos(this.turn), 0];
    return { out, right, up: cross(out, right) };
  }
  matrix(aspect) {
    const { out, right, up } = this.frame;
    const eye = added(this.target, scaled(out, this.far));
    const view = [
      right[0], up[0], out[0], 0, right[1], up[1], out[1], 0, right[2], up[2], out[2], 0,
      -dot(right, eye), -dot(up, eye), -dot(out, eye), 1,
    ];
    const near = Math.max(this.far - 4 * this.reach, this.far * 0.02), end = this.far + 6 * this.reach;
    const f = 1 / Math.tan(FIELD / 2);
    const project = [
      f / aspect, 0, 0, 0, 0, f, 0, 0, 0, 0, (end + near) / (near - end), -1, 0, 0, 2 * end * near / (near - end), 0,
    ];
    this.eye = eye;
    return times(project, view);
  }
  zoom(by) {
    this.far = Math.min(Math.max(this.far * by, 0.005 * this.reach), 20 * this.reach);
  }
  // Turns by a drag of so many pixels.
  orbit(dx, dy) {
    this.turn -= dx * 0.006;
    this.rise = Math.min(Math.max(this.rise + dy * 0.006, -1.5), 1.5707);
  }
  pan(dx, dy, height) {
    const { right, up } = this.frame;
    const size = 2 * this.far * Math.tan(FIELD / 2) / height;
    this.target = added(this.target, added(scaled(right, -dx * size), scaled(up, dy * size)));
  }
}

const HEAD = "#version 300 es\nprecision highp float;\n";
const SOLID = [HEAD + `
in vec3 place; in vec3 normal; in vec3 paint; uniform mat4 whole; uniform mat4 pose; out vec3 face; out vec3 at; out vec3 tint;
void main() { vec4 p = pose * vec4(place, 1.); at = p.xyz; face = mat3(pose) * normal; tint = paint; gl_Position = whole * p; }`, HEAD + `
in vec3 face; in vec3 at; in vec3 tint; uniform vec4 colour; uniform float painted; uniform vec3 eye; out vec4 ink;
void main() {
  vec3 n = normalize(face); vec3 v = normalize(eye - at);
  if (dot(n, v) < 0.) n = -n;
  float light = .42 + .38 * max(dot(n, normalize(vec3(-.4, -.5, .9))), 0.) + .2 * max(dot(n, v), 0.);
  // colours that tell a value are lit less
  ink = vec4(mix(colour.rgb * light, tint * (.75 + .25 * light), painted), colour.a);
}`];
// A segment is four corners; each knows both ends, and is moved aside by half the width on the screen.
const STROKE = [HEAD + `
in vec3 a; in vec3 b; in vec2 corner; in vec3 paint; uniform mat4 whole; uniform vec2 size; uniform float width; uniform float lift;
out vec3 tint;
void main() {
  vec4 p = whole * vec4(a, 1.), q = whole * vec4(b, 1.);
  float least = 1e-4 * max(abs(p.w), abs(q.w));
  if (p.w < least && q.w >= least) p = mix(p, q, (least - p.w) / (q.w - p.w));
  if (q.w < least && p.w >= least) q = mix(q, p, (least - q.w) / (p.w - q.w));
  vec2 along = (q.xy / q.w - p.xy / p.w) * size;
  along = length(along) > 1e-6 ? normalize(along) : vec2(1., 0.);
  vec4 at = corner.x < .5 ? p : q;
  vec2 aside = vec2(-along.y, along.x) * corner.y + along * (corner.x < .5 ? -.4 : .4);
  at.xy += aside * width / size * at.w;
  at.z -= lift * at.w;
  tint = paint; gl_Position = at;
}`, HEAD + `in vec3 tint; uniform float alpha; out vec4 ink; void main() { ink = vec4(tint, alpha); }`];
const WATER = [HEAD + `
in vec2 flat_; in float high; in vec2 slope; uniform mat4 whole; out vec3 at; out vec2 tilt;
void main() { at = vec3(flat_, high); tilt = slope; gl_Position = whole * vec4(at, 1.); }`, HEAD + `
in vec3 at; in vec2 tilt; uniform vec3 eye; uniform float boost; uniform vec3 stops[5]; uniform float still; uniform float crest; out vec4 ink;
void main() {
  vec3 n = normalize(vec3(-tilt * boost, 1.)); vec3 v = normalize(eye - at);
  if (v.z < 0.) n = -n;
  float sun = pow(max(dot(reflect(-normalize(vec3(-.5, -.6, .6)), n), v), 0.), 24.);
  float grazing = pow(1. - max(dot(n, v), 0.), 3.);
  float shade = dot(n, normalize(vec3(-.6, -.7, .5)));
  vec3 colour = mix(vec3(.02, .22, .40), vec3(.42, .66, .80), clamp(.3 * grazing + 1.1 * shade - .25, 0., 1.));
  ink = vec4(colour + .2 * sun, .3 + .16 * grazing);
  // of a regular wave the colour tells the elevation
  if (crest > 0.) {
    float share = clamp(2. + 2. * (at.z - still) / crest, 0., 4.);
    vec3 tint = stops[0];
    for (int k = 0; k < 4; k++) tint = mix(tint, stops[k + 1], clamp(share - float(k), 0., 1.));
    ink = vec4(tint * (.8 + .2 * clamp(shade, 0., 1.)), .85);
  }
}`];

class Painter {
  constructor(canvas) {
    const gl = canvas.getContext("webgl2", { alpha: false, antialias: true, preserveDrawingBuffer: true });
    if (!gl) throw new Error("This browser offers no WebGL2, which the film is drawn with.");
    this.gl = gl;
    this.canvas = canvas;
    this.solid = this.program(SOLID);
    this.stroke = this.program(STROKE);
    this.water = this.program(WATER);
  }
  program(texts) {
    const gl = this.gl, made = gl.createProgram();
    texts.forEach((text, n) => {
      const shader = gl.createShader(n ? gl.FRAGMENT_SHADER : gl.VERTEX_SHADER);
      gl.shaderSource(shader, text);
      gl.compileShader(shader);
      if (!gl.getShaderParameter(shader, gl.COMPILE_STATUS)) throw new Error(gl.getShaderInfoLog(shader));
      gl.attachShader(made, shader);
    });
    gl.linkProgram(made);
    if (!gl.getProgramParameter(made, gl.LINK_STATUS)) throw new Error(gl.getProgramInfoLog(made));
    const found = {};
    return { made, at: (name) => (found[name] ??= gl.getUniformLocation(made, name)) };
  }
  buffer(data, still = true) {
    const gl = this.gl, made = gl.createBuffer();
    gl.bindBuffer(gl.ARRAY_BUFFER, made);
    gl.bufferData(gl.ARRAY_BUFFER, data, still ? gl.STATIC_DRAW : gl.DYNAMIC_DRAW);
    return made;
  }
  refill(buffer, data) {
    const gl = this.gl;
    gl.bindBuffer(gl.ARRAY_BUFFER, buffer);
    gl.bufferData(gl.ARRAY_BUFFER, data, gl.DYNAMIC_DRAW);
  }
  attribute(program, name, buffer, size, stride = 0, offset = 0) {
    const gl = this.gl, at = gl.getAttribLocation(program.made, name);
    if (at < 0) return;
    gl.bindBuffer(gl.ARRAY_BUFFER, buffer);
    gl.enableVertexAttribArray(at);
    gl.vertexAttribPointer(at, size, gl.FLOAT, false, 4 * stride, 4 * offset);
  }
  begin(camera) {
    const gl = this.gl, canvas = this.canvas, ratio = Math.min(window.devicePixelRatio || 1, 2);
    const [w, h] = [Math.max(1, Math.round(canvas.clientWidth * ratio)), Math.max(1, Math.round(canvas.clientHeight * ratio))];
    if (canvas.width !== w || canvas.height !== h) [canvas.width, canvas.height] = [w, h];
    this.ratio = ratio;
    this.whole = camera.matrix(w / h);
    this.eye = camera.eye;
    gl.viewport(0, 0, w, h);
    gl.clearColor(0.87, 0.92, 0.95, 1);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
    gl.enable(gl.DEPTH_TEST);
    gl.enable(gl.BLEND);
    gl.blendFunc(gl.SRC_ALPHA, gl.ONE_MINUS_SRC_ALPHA);
  }
  mesh(mesh, pose, colour, behind = false) {
    const gl = this.gl, p = this.solid;
    gl.useProgram(p.made);
    this.attribute(p, "place", mesh.places, 3);
    this.attribute(p, "normal", mesh.normals, 3);
    gl.uniformMatrix4fv(p.at("whole"), false, this.whole);
    gl.uniformMatrix4fv(p.at("pose"), false, pose);
    gl.uniform4fv(p.at("colour"), colour);
    gl.uniform1f(p.at("painted"), mesh.paints ? 1 : 0);
    if (mesh.paints) this.attribute(p, "paint", mesh.paints, 3);
    else if (gl.getAttribLocation(p.made, "paint") >= 0) gl.disableVertexAttribArray(gl.getAttribLocation(p.made, "paint"));
    gl.uniform3fv(p.at("eye"), this.eye);
    // what lies on a surface is drawn before it
    if (behind) {
      gl.enable(gl.POLYGON_OFFSET_FILL);
      gl.polygonOffset(2, 60);
    }
    gl.drawArrays(gl.TRIANGLES, 0, mesh.count);
    gl.disable(gl.POLYGON_OFFSET_FILL);
  }
  // Strokes: eleven numbers a corner, six corners a segment. `whole` may bring a pose along.
  strokes(buffer, corners, width, alpha = 1, pose = null, lift = 2e-5) {
    const gl = this.gl, p = this.stroke;
    gl.useProgram(p.made);
    [["a", 3, 0], ["b", 3, 3], ["corner", 2, 6], ["paint", 3, 8]].forEach(([n, s, o]) => this.attribute(p, n, buffer, s, 11, o));
    gl.uniformMatrix4fv(p.at("whole"), false, pose ? times(this.whole, pose) : this.whole);
    gl.uniform2f(p.at("size"), this.canvas.width, this.canvas.height);
    gl.uniform1f(p.at("width"), width * this.ratio);
    gl.uniform1f(p.at("alpha"), alpha);
    gl.uniform1f(p.at("lift"), lift);
    gl.drawArrays(gl.TRIANGLES, 0, corners);
  }
  surface(grid) {
    const gl = this.gl, p = this.water;
    gl.useProgram(p.made);
    this.attribute(p, "flat_", grid.flat, 2);
    this.attribute(p, "high", grid.high, 1);
    this.attribute(p, "slope", grid.slope, 2);
    gl.uniformMatrix4fv(p.at("whole"), false, this.whole);
    gl.uniform3fv(p.at("eye"), this.eye);
    gl.uniform1f(p.at("boost"), grid.boost);
    gl.uniform3fv(p.at("stops"), grid.stops.flat());
    gl.uniform1f(p.at("still"), grid.still);
    gl.uniform1f(p.at("crest"), grid.crest);
    gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, grid.corners);
    gl.depthMask(false);
    gl.drawElements(gl.TRIANGLES, grid.count, gl.UNSIGNED_INT, 0);
    gl.depthMask(true);
  }
  // Where a place is on the screen (CSS pixels); null behind the viewer.
  seen(at) {
    const m = this.whole, w = m[3] * at[0] + m[7] * at[1] + m[11] * at[2] + m[15];
    if (w <= 0) return null;
    const x = (m[0] * at[0] + m[4] * at[1] + m[8] * at[2] + m[12]) / w;
    const y = (m[1] * at[0] + m[5] * at[1] + m[9] * at[2] + m[13]) / w;
    return [(x + 1) / 2 * this.canvas.clientWidth, (1 - y) / 2 * this.canvas.clientHeight];
  }
}

const CORNERS = [[0, -1], [1, -1], [1, 1], [0, -1], [1, 1], [0, 1]];

// The corners of a list of segments [from, to, colour].
function segments(list) {
  const out = new Float32Array(list.length * 66);
  let n = 0;
  for (const [a, b, colour] of list) {
    for (const corner of CORNERS) {
      out.set(a, n);
      out.set(b, n + 3);
      out.set(corner, n + 6);
      out.set(colour, n + 8);
      n += 11;
    }
  }
  return out;
}

// Triangles that share no corners, each with its own normal.
function faceted(points, triangles) {
  const places = new Float32Array(triangles.length * 3), normals = new Float32Array(triangles.length * 3);
  for (let t = 0; t < triangles.length; t += 3) {
    const [a, b, c] = [0, 1, 2].map((k) => Array.from(points.subarray(3 * triangles[t + k], 3 * triangles[t + k] + 3)));
    const n = unit(cross(added(b, scaled(a, -1)), added(c, scaled(a, -1))));
    [a, b, c].forEach((p, k) => {
      places.set(p, 3 * (t + k));
      normals.set(n, 3 * (t + k));
    });
  }
  return { places, normals, count: triangles.length };
}
