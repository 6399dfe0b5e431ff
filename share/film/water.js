// The water: a grid, finer about the bodies. zeta = ramp sum a cos(k (toward . (x, y)) - w t + phase), each wave where the
// grid has four points on its length.
function water(painter, sea, { bodies, plane, middle, reach, level }) {
  const count = sea ? sea.waves.length / 5 : 0;
  const n = count ? Math.max(24, Math.min(150, Math.floor(Math.sqrt(4e6 / count)))) : 2;
  const centre = bodies.length ? [0, 1].map((i) => bodies.reduce((s, b) => s + b.poses[i], 0) / bodies.length) : [middle[0], middle[1]];
  let mean = 0, energy = 0;
  for (let w = 0; w < count; w++) {
    const [, kx, ky, a] = sea.waves.subarray(5 * w, 5 * w + 4);
    mean += a * a * Math.hypot(kx, ky);
    energy += a * a;
  }
  const wanted = energy > 0 ? 2 * Math.PI / (mean / energy) / 14 : 0;
  const axis = ([low, high], c) => {
    const far = Math.max(high - c, c - low, 1), even = 2 * far / (n - 1);
    let bend = 0.01;
    while (wanted > 0 && bend < 6 && even * bend / Math.sinh(bend) > wanted) bend += 0.05;
    return Array.from({ length: n }, (_, i) => {
      const s = 2 * i / (n - 1) - 1, t = Math.sinh(bend * s) / Math.sinh(bend);
      return c + t * (t < 0 ? c - low : high - c);
    });
  };
  const xs = axis(plane.x, centre[0]), ys = axis(plane.y, centre[1]);
  const gap = (list, i) => Math.max(list[Math.min(i + 1, n - 1)] - list[i], list[i] - list[Math.max(i - 1, 0)]);
  const places = new Float32Array(2 * n * n), corners = [];
  const cos = new Float32Array(n * n * count), sin = new Float32Array(n * n * count);
  for (let j = 0; j < n; j++) {
    for (let i = 0; i < n; i++) {
      const at = j * n + i, coarse = Math.max(gap(xs, i), gap(ys, j));
      places.set([xs[i] - middle[0], ys[j] - middle[1]], 2 * at);
      if (i + 1 < n && j + 1 < n) corners.push(at, at + 1, at + n + 1, at, at + n + 1, at + n);
      for (let w = 0; w < count; w++) {
        const [, kx, ky, a, phase] = sea.waves.subarray(5 * w, 5 * w + 5);
        const fade = Math.min(Math.max((Math.PI / 2 - Math.hypot(kx, ky) * coarse) * 2, 0), 1);
        cos[at * count + w] = fade * a * Math.cos(kx * xs[i] + ky * ys[j] + phase);
        sin[at * count + w] = fade * a * Math.sin(kx * xs[i] + ky * ys[j] + phase);
      }
    }
  }
  const gl = painter.gl, index = gl.createBuffer();
  gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, index);
  gl.bufferData(gl.ELEMENT_ARRAY_BUFFER, new Uint32Array(corners), gl.STATIC_DRAW);
  const heights = new Float32Array(n * n), slopes = new Float32Array(2 * n * n), turn = new Float32Array(2 * count);
  // from far off small slopes would not show
  const made = { flat: painter.buffer(places), high: painter.buffer(heights, false), slope: painter.buffer(slopes, false),
    corners: index, count: corners.length, boost: Math.min(Math.max(reach / 200, 2), 6), time: NaN };
  made.move = (time) => {
    if (made.time === time) return;
    made.time = time;
    let grown = !sea || (sea.since !== null && time < sea.since) ? 0 : 1;
    if (grown && sea.ramp > 0) grown = 0.5 * (1 - Math.cos(Math.PI * Math.min(Math.max((time - sea.rampStart) / sea.ramp, 0), 1)));
    for (let w = 0; w < count; w++) {
      turn[2 * w] = grown * Math.cos(sea.waves[5 * w] * time);
      turn[2 * w + 1] = grown * Math.sin(sea.waves[5 * w] * time);
    }
    for (let at = 0; at < n * n; at++) {
      let sum = 0;
      for (let w = 0, k = at * count; w < count; w++, k++) sum += cos[k] * turn[2 * w] + sin[k] * turn[2 * w + 1];
      heights[at] = level - middle[2] + sum;
    }
    for (let j = 0; j < n; j++) {
      for (let i = 0; i < n; i++) {
        const [l, r] = [Math.max(i - 1, 0), Math.min(i + 1, n - 1)], [d, u] = [Math.max(j - 1, 0), Math.min(j + 1, n - 1)];
        slopes[2 * (j * n + i)] = (heights[j * n + r] - heights[j * n + l]) / (xs[r] - xs[l]);
        slopes[2 * (j * n + i) + 1] = (heights[u * n + i] - heights[d * n + i]) / (ys[u] - ys[d]);
      }
    }
    painter.refill(made.high, heights);
    painter.refill(made.slope, slopes);
  };
  return made;
}

// The water about bodies in a regular wave, on its own grid: zeta = Re(value exp(-i w t)); none within the bodies.
function field(painter, { low, step, columns, frequency, values }, { middle, reach, level }) {
  const n = columns, m = values.length / 2 / n, heights = new Float32Array(n * m), slopes = new Float32Array(2 * n * m);
  const places = new Float32Array(2 * n * m), corners = [], wet = (at) => Number.isFinite(values[2 * at]);
  for (let j = 0; j < m; j++) {
    for (let i = 0; i < n; i++) {
      const at = j * n + i;
      places.set([low[0] + step * i - middle[0], low[1] + step * j - middle[1]], 2 * at);
      const cell = [at, at + 1, at + n + 1, at + n];
      // a cell at a hull is drawn into it, with the water of its wet corners
      if (i + 1 < n && j + 1 < m && cell.some(wet)) corners.push(cell[0], cell[1], cell[2], cell[0], cell[2], cell[3]);
    }
  }
  const near = new Int32Array(n * m).map((_, at) => {
    if (wet(at)) return at;
    const [i, j] = [at % n, Math.floor(at / n)];
    for (const [dx, dy] of [[1, 0], [-1, 0], [0, 1], [0, -1], [1, 1], [-1, 1], [1, -1], [-1, -1]]) {
      const [x, y] = [i + dx, j + dy];
      if (x >= 0 && y >= 0 && x < n && y < m && wet(y * n + x)) return y * n + x;
    }
    return -1;
  });
  const gl = painter.gl, index = gl.createBuffer();
  gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, index);
  gl.bufferData(gl.ELEMENT_ARRAY_BUFFER, new Uint32Array(corners), gl.STATIC_DRAW);
  const made = { flat: painter.buffer(places), high: painter.buffer(heights, false), slope: painter.buffer(slopes, false),
    corners: index, count: corners.length, boost: Math.min(Math.max(reach / 200, 2), 6), time: NaN };
  made.move = (time) => {
    if (made.time === time) return;
    made.time = time;
    const [c, s] = [Math.cos(frequency * time), Math.sin(frequency * time)];
    for (let at = 0; at < n * m; at++) {
      const from = near[at];
      heights[at] = level - middle[2] + (from < 0 ? 0 : values[2 * from] * c + values[2 * from + 1] * s);
    }
    for (let j = 0; j < m; j++) {
      for (let i = 0; i < n; i++) {
        const [l, r] = [Math.max(i - 1, 0), Math.min(i + 1, n - 1)], [d, u] = [Math.max(j - 1, 0), Math.min(j + 1, m - 1)];
        slopes[2 * (j * n + i)] = (heights[j * n + r] - heights[j * n + l]) / (step * Math.max(r - l, 1));
        slopes[2 * (j * n + i) + 1] = (heights[u * n + i] - heights[d * n + i]) / (step * Math.max(u - d, 1));
      }
    }
    painter.refill(made.high, heights);
    painter.refill(made.slope, slopes);
  };
  return made;
}
