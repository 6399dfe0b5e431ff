// The film: its data, what is shown at a time, and what the user does.

(function () {
  const data = JSON.parse(document.getElementById("data").textContent);
  const bytes = (text) => Uint8Array.from(atob(text), (c) => c.charCodeAt(0)).buffer;
  const $ = (id) => document.getElementById(id);
  const middle = [0, 1, 2].map((i) => (data.low[i] + data.high[i]) / 2);
  const about = (at) => at.map((v, i) => v - middle[i]);
  const moments = new Float64Array(bytes(data.times));
  const bodies = data.bodies.map((b) => ({
    ...b, points: new Float32Array(bytes(b.points)), triangles: new Uint32Array(bytes(b.triangles)),
    edges: new Uint32Array(bytes(b.edges)), poses: new Float32Array(bytes(b.poses)), pressures: new Float32Array(bytes(b.pressures)),
  }));
  const lines = data.lines.map((l) => ({
    ...l, points: new Uint16Array(bytes(l.points)), tensions: new Uint16Array(bytes(l.tensions)),
    shares: new Uint16Array(bytes(l.shares)), states: new Uint8Array(bytes(l.states)),
  }));
  const anchors = data.anchors.map((a) => ({ name: a.name, at: about(a.at) }));
  const sea = data.sea && { ...data.sea, waves: new Float64Array(bytes(data.sea.waves)) };
  const size = data.high.map((v, i) => v - data.low[i]);
  const reach = Math.max(Math.hypot(...size) / 2, 1);

  let painter;
  try {
    painter = new Painter($("scene"));
  } catch (error) {
    fail(error.message);
    return;
  }
  const camera = new Camera(reach);
  const STOPS = [[0.06, 0.2, 0.55], [0.42, 0.13, 0.62], [0.78, 0.18, 0.4], [0.93, 0.43, 0.1], [0.99, 0.75, 0.08]];
  function ramp(share, stops = STOPS) {
    const at = Math.min(Math.max(share, 0), 1) * (stops.length - 1), n = Math.min(Math.floor(at), stops.length - 2);
    return stops[n].map((v, i) => v + (at - n) * (stops[n + 1][i] - v));
  }
  const css = (c) => `rgb(${c.map((v) => Math.round(255 * v)).join(",")})`;
  // A round number: 1, 2 or 5 times a power of ten, at most this.
  function round(value) {
    const power = 10 ** Math.floor(Math.log10(value));
    return [5, 2, 1].map((m) => m * power).find((v) => v <= value * 1.0001) || power;
  }
  const figures = (v) => (v >= 100 ? v.toFixed(0) : v >= 1 ? v.toFixed(1) : v.toFixed(3));

  // What stands still: the bottom with its grid, and anchors.
  const margin = 0.08 * Math.max(size[0], size[1], 0.3 * reach);
  const plane = { x: [data.low[0] - margin, data.high[0] + margin], y: [data.low[1] - margin, data.high[1] + margin] };
  const spacing = round(Math.max(plane.x[1] - plane.x[0], plane.y[1] - plane.y[0]) * data.length.per / 6) / data.length.per;
  let bottom = null;
  if (data.bottom !== null) {
    const z = data.bottom, corner = (i, j) => about([plane.x[i], plane.y[j], z]);
    const points = new Float32Array([corner(0, 0), corner(1, 0), corner(1, 1), corner(0, 1)].flat());
    const mesh = faceted(points, new Uint32Array([0, 1, 2, 0, 2, 3])), grid = [];
    const every = (axis, make) => {
      for (let v = Math.ceil(plane[axis][0] / spacing) * spacing; v <= plane[axis][1]; v += spacing) grid.push(make(v));
    };
    const ink = [0.5, 0.44, 0.33];
    every("x", (v) => [about([v, plane.y[0], z]), about([v, plane.y[1], z]), ink]);
    every("y", (v) => [about([plane.x[0], v, z]), about([plane.x[1], v, z]), ink]);
    bottom = { mesh: { places: painter.buffer(mesh.places), normals: painter.buffer(mesh.normals), count: mesh.count },
      grid: painter.buffer(segments(grid)), count: 6 * grid.length };
  }
  const STILL = new Float32Array([1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1]);
  for (const body of bodies) {
    const mesh = faceted(body.points, body.triangles), edges = [];
    const at = (n) => Array.from(body.points.subarray(3 * n, 3 * n + 3));
    for (let e = 0; e < body.edges.length; e += 2) edges.push([at(body.edges[e]), at(body.edges[e + 1]), [0.12, 0.14, 0.17]]);
    body.mesh = { places: painter.buffer(mesh.places), normals: painter.buffer(mesh.normals), count: mesh.count };
    body.strokes = { buffer: painter.buffer(segments(edges)), count: 6 * edges.length };
  }
  const drawn = painter.buffer(new Float32Array(0), false), crosses = painter.buffer(new Float32Array(0), false);

  const waves = data.field && { ...data.field, values: new Float32Array(bytes(data.field.values)) };
  const surface = waves ? field(painter, waves, { middle, reach, level: data.level })
    : water(painter, sea, { bodies, plane, middle, reach, level: data.level });
  // Pressures of both signs: white is none.
  const SIGNS = [[0.02, 0.19, 0.38], [0.57, 0.77, 0.87], [0.97, 0.97, 0.97], [0.96, 0.65, 0.51], [0.4, 0.0, 0.12]];
  for (const body of bodies) {
    if (body.pressures.length) body.mesh.paints = painter.buffer(new Float32Array(3 * body.mesh.count), false);
  }
  // Elevations of both signs: white is the still water.
  const HEIGHTS = [[0.33, 0.19, 0.02], [0.75, 0.51, 0.18], [0.96, 0.96, 0.96], [0.21, 0.59, 0.56], [0.0, 0.24, 0.19]];
  const crest = waves ? waves.values.reduce((most, _, n, all) => (n % 2 || !Number.isFinite(all[n]) ? most : Math.max(most, Math.hypot(all[n], all[n + 1]))), 0) : 0;
  surface.stops = HEIGHTS;
  surface.still = data.level - middle[2];
  surface.crest = crest;
  function paint(body, time) {
    const [c, s] = [Math.cos(waves.frequency * time), Math.sin(waves.frequency * time)], out = new Float32Array(3 * body.mesh.count);
    for (let t = 0; t < body.pressures.length / 2; t++) {
      const value = (body.pressures[2 * t] * c + body.pressures[2 * t + 1] * s) / (data.pressure || 1);
      const colour = ramp(0.5 + 0.5 * value, SIGNS);
      for (let k = 0; k < 3; k++) out.set(colour, 9 * t + 3 * k);
    }
    painter.refill(body.mesh.paints, out);
  }

  const now = { time: moments[0], playing: false, speed: 1, labels: true, water: true, by: data.share > 0 ? "share" : "tension" };
  const last = moments.length - 1;
  // The instant before a time, and the share of the way to the next.
  function place(time) {
    let low = 0, high = last;
    while (high - low > 1) {
      const half = (low + high) >> 1;
      if (moments[half] <= time) low = half; else high = half;
    }
    const room = moments[high] - moments[low];
    return [low, high, room > 0 ? Math.min(Math.max((time - moments[low]) / room, 0), 1) : 0];
  }
  function poseOf(body, [a, b, s]) {
    const p = body.poses.subarray(7 * a, 7 * a + 7), q = body.poses.subarray(7 * b, 7 * b + 7);
    const mixed = Array.from(p, (v, i) => v + s * (q[i] - v));
    const same = p[3] * q[3] + p[4] * q[4] + p[5] * q[5] + p[6] * q[6] < 0 ? -1 : 1;
    const turn = [3, 4, 5, 6].map((i) => p[i] * (1 - s) + same * s * q[i]), long = Math.hypot(...turn) || 1;
    const [x, y, z, w] = turn.map((v) => v / long), at = about(mixed.slice(0, 3));
    return new Float32Array([
      1 - 2 * (y * y + z * z), 2 * (x * y + z * w), 2 * (x * z - y * w), 0,
      2 * (x * y - z * w), 1 - 2 * (x * x + z * z), 2 * (y * z + x * w), 0,
      2 * (x * z + y * w), 2 * (y * z - x * w), 1 - 2 * (x * x + y * y), 0, ...at, 1]);
  }
  function pointOf(line, n, [a, b, s]) {
    return [0, 1, 2].map((i) => {
      const p = line.points[3 * (a * line.count + n) + i], q = line.points[3 * (b * line.count + n) + i];
      return size[i] * ((p + s * (q - p)) / 65535 - 0.5);
    });
  }
  const valueOf = (list, line, n, [a, b, s]) => (list[a * line.count + n] * (1 - s) + list[b * line.count + n] * s) / 65535;

  const tags = [];
  function tag(name, kind, where) {
    const made = document.createElement("span");
    made.textContent = name;
    made.className = kind;
    $("names").append(made);
    tags.push({ made, where });
  }
  let where = [0, 0, 0];
  bodies.filter((b) => b.name).forEach((b) => tag(b.name, "body", () => { const m = poseOf(b, where); return [m[12], m[13], m[14]]; }));
  lines.forEach((l) => tag(l.name, "line", () => l.states[where[0]] ? pointOf(l, Math.floor(l.count * 0.4), where) : null));
  anchors.filter((a) => !lines.some((l) => l.name === a.name)).forEach((a) => tag(a.name, "anchor", () => a.at));
  const rows = lines.map((line) => {
    const row = $("told").querySelector("tbody").insertRow(), head = row.insertCell(), mark = document.createElement("i");
    head.append(mark, line.name);
    return { row, mark, tension: row.insertCell(), share: row.insertCell() };
  });
  $("force").textContent = `Largest tension along line (${data.force.name})`;
  $("told").hidden = !lines.length;

  function draw() {
    where = place(now.time);
    painter.begin(camera);
    if (bottom) {
      painter.mesh(bottom.mesh, STILL, [0.86, 0.79, 0.66, 1], true);
      painter.strokes(bottom.grid, bottom.count, 1, 0.55);
    }
    const list = [];
    for (const line of lines) {
      if (!line.states[where[0]]) continue;
      const points = Array.from({ length: line.count }, (_, n) => pointOf(line, n, where));
      for (let n = 0; n + 1 < line.count; n++) {
        // one that found no shape is dashed
        if (line.states[where[0]] === 2 && n % 2) continue;
        list.push([points[n], points[n + 1], ramp(valueOf(now.by === "share" && line.line ? line.shares : line.tensions, line, n, where))]);
      }
    }
    painter.refill(drawn, segments(list));
    painter.strokes(drawn, 6 * list.length, 3.2);
    const arm = 0.006 * camera.far, marks = [];
    for (const a of anchors) {
      for (const [u, v] of [[1, 1], [1, -1]]) {
        marks.push([added(a.at, [-u * arm, -v * arm, 0]), added(a.at, [u * arm, v * arm, 0]), [0.25, 0.16, 0.05]]);
      }
      marks.push([a.at, added(a.at, [0, 0, 1.6 * arm]), [0.25, 0.16, 0.05]]);
    }
    painter.refill(crosses, segments(marks));
    painter.strokes(crosses, 6 * marks.length, 2.4);
    for (const body of bodies) {
      const pose = poseOf(body, where);
      if (body.pressures.length) paint(body, now.time);
      painter.mesh(body.mesh, pose, body.junction ? [0.95, 0.8, 0.2, 1] : body.box ? [0.72, 0.76, 0.8, 1] : [0.86, 0.45, 0.22, 1]);
      painter.strokes(body.strokes.buffer, body.strokes.count, 1.2, 0.9, pose);
    }
    if (now.water) {
      surface.move(now.time);
      painter.surface(surface);
    }
    names();
    tell();
    axes();
  }
  function names() {
    const taken = [];
    for (const { made, where: find } of tags) {
      const at = now.labels && find(), seen = at && painter.seen(at);
      made.hidden = true;
      if (!seen) continue;
      made.hidden = false;
      const [w, h] = [made.offsetWidth, made.offsetHeight], { clientWidth: wide, clientHeight: high } = painter.canvas;
      // the first free place around what is named, the nearest ring first; hidden only where none is free
      const free = ([x, y]) => x >= 0 && y >= 0 && x + w <= wide && y + h <= high
        && !taken.some(([a, b, c, d]) => x < a + c && a < x + w && y < b + d && b < y + h);
      const around = (r) => [[8 + r, -h - 4 - r], [8 + r, 4 + r], [-w - 8 - r, -h - 4 - r], [-w - 8 - r, 4 + r],
        [-w / 2, -h - 8 - r], [-w / 2, 8 + r], [10 + r, -h / 2], [-w - 10 - r, -h / 2]];
      const places = [0, 16, 34, 56].flatMap(around).map(([dx, dy]) => [seen[0] + dx, seen[1] + dy]);
      const found = places.find(free);
      made.hidden = !found;
      if (!found) continue;
      const [x, y] = found;
      taken.push([x, y, w, h]);
      made.style.transform = `translate(${x}px, ${y}px)`;
    }
  }
  function tell() {
    $("clock").textContent = `${now.time.toFixed(moments[last] < 100 ? 2 : 1)} of ${moments[last].toFixed(1)} s`;
    $("time").value = now.time;
    lines.forEach((line, n) => {
      const on = line.states[where[0]], top = (list) => {
        let most = 0;
        for (let k = 0; k < line.count; k++) most = Math.max(most, valueOf(list, line, k, where));
        return most;
      };
      const { row, mark, tension, share } = rows[n], by = now.by === "share" && line.line;
      row.className = on ? "" : "off";
      const [pull, part] = [top(line.tensions), line.line ? top(line.shares) : 0];
      mark.style.background = on ? css(ramp(by ? part : pull)) : "#fff";
      tension.textContent = on ? figures(pull * data.tension * data.force.per) : "off";
      share.textContent = on && part > 0 ? (part * data.share).toFixed(3) : "";
    });
  }
  function axes() {
    const { right, up, out } = camera.frame, pen = $("axes").getContext("2d");
    pen.setTransform(2, 0, 0, 2, 90, 90);
    pen.clearRect(-45, -45, 90, 90);
    const all = [["X", [1, 0, 0], "#a31515"], ["Y", [0, 1, 0], "#1b6b1b"], ["Z", [0, 0, 1], "#1541a3"]];
    all.sort((a, b) => dot(a[1], out) - dot(b[1], out));
    for (const [name, along, colour] of all) {
      const [x, y] = [30 * dot(along, right), -30 * dot(along, up)];
      pen.strokeStyle = pen.fillStyle = colour;
      pen.lineWidth = 2.5;
      pen.beginPath();
      pen.moveTo(0, 0);
      pen.lineTo(x, y);
      pen.stroke();
      pen.font = "bold 11px system-ui, sans-serif";
      pen.textAlign = "center";
      pen.textBaseline = "middle";
      pen.fillText(name, x * 1.3, y * 1.3);
    }
  }
  function colours(pen, stops) {
    for (let x = 0; x < 160; x++) {
      pen.fillStyle = css(ramp(x / 159, stops));
      pen.fillRect(x, 0, 1, 12);
    }
  }
  function legend() {
    if (crest > 0) {
      const [least, most, what] = $("elevation").querySelectorAll("span");
      [least.textContent, most.textContent] = [-crest, crest].map((v) => (v * data.length.per).toFixed(2));
      what.textContent = `elevation of the water (${data.length.name})`;
      colours($("elevation").querySelector("canvas").getContext("2d"), HEIGHTS);
      $("elevation").hidden = false;
    }
    $("colours").hidden = !lines.length;
    const share = now.by === "share", most = share ? data.share : data.tension * data.force.per;
    if (data.pressure > 0) {
      $("least").textContent = (-data.pressure).toFixed(2);
      $("most").textContent = data.pressure.toFixed(2);
      $("what").textContent = "pressure over density \u00d7 gravity \u00d7 amplitude";
      colours($("ramp").getContext("2d"), SIGNS);
      $("legend").hidden = false;
      return;
    }
    $("most").textContent = share ? most.toFixed(3) : figures(most);
    $("what").textContent = share ? "tension/break along the line" : `tension along the line (${data.force.name})`;
    colours($("ramp").getContext("2d"), STOPS);
    $("legend").hidden = !lines.length;
  }

  // When something changes it is drawn with the next picture of the browser.
  let waiting = false, before = 0;
  function ask() {
    if (!waiting) {
      waiting = true;
      requestAnimationFrame(step);
    }
  }
  function step(stamp) {
    waiting = false;
    if (now.playing) {
      now.time += Math.min(stamp - before, 250) / 1000 * now.speed;
      if (now.time >= moments[last]) {
        now.time = moments[last];
        play(false);
      }
    }
    before = stamp;
    draw();
    if (now.playing) ask();
  }
  function play(on) {
    if (on && now.time >= moments[last]) now.time = moments[0];
    now.playing = on && last > 0;
    before = performance.now();
    $("play").classList.toggle("playing", now.playing);
    $("play").setAttribute("aria-label", now.playing ? "Pause" : "Play");
    ask();
  }
  function go(time) {
    now.time = Math.min(Math.max(time, moments[0]), moments[last]);
    ask();
  }
  function hop(by) {
    play(false);
    const [a, b, s] = place(now.time), near = s > 0.999 ? b : a;
    go(moments[Math.min(Math.max(by < 0 && s > 0.001 && s <= 0.999 ? a : near + by, 0), last)]);
  }
  const VIEWS = { iso: [-2.2, 0.42], side: [-Math.PI / 2, 0.02], front: [Math.PI, 0.02], top: [-Math.PI / 2, 1.5707] };
  // As far off as lets everything into the picture, from where it is looked at.
  function fit() {
    const { right, up, out } = camera.frame, canvas = painter.canvas;
    const aspect = canvas.clientWidth / Math.max(canvas.clientHeight, 1);
    const below = Math.min(data.low[2], data.bottom ?? data.low[2]), above = Math.max(data.high[2], data.level + crest);
    const half = [size[0] / 2 + margin, size[1] / 2 + margin, (above - below) / 2], signs = [-1, 1];
    const corners = signs.flatMap((x) => signs.flatMap((y) => signs.map((z) => [x * half[0], y * half[1], z * half[2]])));
    // a corner nearer to the viewer needs more distance
    const far = (c) => dot(c, out) + 1.12 * Math.max(Math.abs(dot(c, up)), Math.abs(dot(c, right)) / aspect) / Math.tan(FIELD / 2);
    camera.target = [0, 0, (below + above) / 2 - middle[2]];
    camera.far = Math.max(1, ...corners.map(far));
  }
  function view(name) {
    if (VIEWS[name]) camera.look(...VIEWS[name]);
    fit();
    ask();
  }

  document.querySelectorAll("[data-view]").forEach((b) => b.addEventListener("click", () => view(b.dataset.view)));
  document.querySelectorAll("[data-zoom]").forEach((b) => b.addEventListener("click", () => { camera.zoom(+b.dataset.zoom); ask(); }));
  $("labels").addEventListener("change", (e) => { now.labels = e.target.checked; ask(); });
  $("water").addEventListener("change", (e) => { now.water = e.target.checked; ask(); });
  $("colour").addEventListener("change", (e) => { now.by = e.target.value; legend(); ask(); });
  $("play").addEventListener("click", () => play(!now.playing));
  $("back").addEventListener("click", () => hop(-1));
  $("on").addEventListener("click", () => hop(1));
  $("time").addEventListener("input", (e) => go(+e.target.value));
  $("speed").addEventListener("change", (e) => { now.speed = +e.target.value; });
  document.addEventListener("keydown", (e) => {
    const at = e.target.tagName;
    if (at === "SELECT" || e.ctrlKey || e.metaKey || e.altKey) return;
    const done = { ArrowLeft: () => hop(-1), ArrowRight: () => hop(1), Home: () => go(moments[0]), End: () => go(moments[last]),
      ArrowUp: () => { camera.zoom(0.9); ask(); }, ArrowDown: () => { camera.zoom(1.1); ask(); },
      " ": at === "BUTTON" || at === "SUMMARY" || e.target.type === "checkbox" ? null : () => play(!now.playing) }[e.key];
    if (done) {
      e.preventDefault();
      done();
    }
  });
  const fingers = new Map(), canvas = $("scene");
  canvas.addEventListener("contextmenu", (e) => e.preventDefault());
  canvas.addEventListener("pointerdown", (e) => {
    fingers.set(e.pointerId, [e.clientX, e.clientY]);
    canvas.setPointerCapture(e.pointerId);
  });
  for (const end of ["pointerup", "pointercancel"]) canvas.addEventListener(end, (e) => fingers.delete(e.pointerId));
  canvas.addEventListener("pointermove", (e) => {
    const old = fingers.get(e.pointerId);
    if (!old) return;
    const [dx, dy] = [e.clientX - old[0], e.clientY - old[1]];
    const other = [...fingers].find(([id]) => id !== e.pointerId);
    if (other) {
      const far = (p) => Math.hypot(p[0] - other[1][0], p[1] - other[1][1]) || 1;
      camera.zoom(far(old) / far([e.clientX, e.clientY]));
      camera.pan(dx / 2, dy / 2, canvas.clientHeight);
    } else if (e.shiftKey || e.buttons & 6) {
      camera.pan(dx, dy, canvas.clientHeight);
    } else {
      camera.orbit(dx, dy);
    }
    fingers.set(e.pointerId, [e.clientX, e.clientY]);
    ask();
  });
  canvas.addEventListener("wheel", (e) => {
    e.preventDefault();
    camera.zoom(Math.exp(Math.min(Math.max(e.deltaY, -300), 300) * 0.001));
    ask();
  }, { passive: false });
  window.addEventListener("resize", ask);

  [$("time").min, $("time").max] = [moments[0], moments[last]];
  const long = moments[last] - moments[0], speeds = [0.1, 0.25, 0.5, 1, 2, 5, 10, 20, 50, 100, 500];
  // a long run is shown in about a minute
  now.speed = speeds.find((s) => long / s <= 60) || 500;
  speeds.forEach((s) => $("speed").add(new Option(`${s}\u00d7`, s, false, s === now.speed)));
  $("scale").textContent = bottom ? `grid ${+(spacing * data.length.per).toPrecision(6)} ${data.length.name}` : "";
  $("scale").hidden = !bottom;
  $("colour").value = now.by;
  $("colour").disabled = !(data.share > 0);
  if (data.notes.length) {
    $("notes").hidden = false;
    $("notes").querySelector("summary").textContent = `Notes (${data.notes.length})`;
    data.notes.forEach((text) => {
      const item = document.createElement("li");
      item.textContent = text;
      $("notes").querySelector("ul").append(item);
    });
  }
  // An address that ends in #t=12.5&view=side&zoom=0.5 opens there.
  const wanted = new URLSearchParams(location.hash.slice(1));
  if (wanted.has("t")) now.time = Math.min(Math.max(+wanted.get("t") || 0, moments[0]), moments[last]);
  legend();
  view(wanted.get("view") || "iso");
  if (+wanted.get("zoom") > 0) {
    if (bodies.length) camera.target = about(Array.from(bodies[0].poses.subarray(0, 3)));
    camera.zoom(+wanted.get("zoom"));
  }
  document.documentElement.dataset.frames = moments.length;
})();
