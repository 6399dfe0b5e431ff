"use strict";
(() => {
  const data = JSON.parse(document.getElementById("data").textContent);
  // asked by its own copy whether it has changed: says its version and does nothing else
  if (location.hash === "#version") {
    if (parent !== window) parent.postMessage({ windlass: data.version }, "*");
    return;
  }
  const SVG = "http:/" + "/www.w3.org/2000/svg";
  const make = (name, attributes = {}, text) => {
    const made = document.createElement(name);
    for (const [key, value] of Object.entries(attributes)) made.setAttribute(key, value);
    if (text !== undefined) made.textContent = text;
    return made;
  };
  const draw = (name, attributes = {}, text) => {
    const made = document.createElementNS(SVG, name);
    for (const [key, value] of Object.entries(attributes)) made.setAttribute(key, value);
    if (text !== undefined) made.textContent = text;
    return made;
  };
  const numbers = (text) => {
    const bytes = Uint8Array.from(atob(text), (c) => c.charCodeAt(0));
    return new Float64Array(bytes.buffer);
  };
  const kept = (name) => { try { return sessionStorage.getItem(name); } catch { return null; } };
  const keep = (name, value) => { try { sessionStorage.setItem(name, value); } catch { /* nothing is kept */ } };
  const $ = (id) => document.getElementById(id);
  $("state").textContent = data.state;

  // what is chosen, by name, in every view, table and plot
  const groups = [];
  const choose = (name) => {
    keep("chosen", name);
    for (const [of, node] of groups) node.classList.toggle("chosen", name !== "" && of === name);
    plots(name);
  };
  const selectable = (name, node) => {
    groups.push([name, node]);
    node.setAttribute("tabindex", "0");
    node.addEventListener("click", () => choose(kept("chosen") === name ? "" : name));
    node.addEventListener("keydown", (event) => { if (event.key === "Enter" || event.key === " ") { event.preventDefault(); node.dispatchEvent(new Event("click")); } });
  };

  const WIDTH = 600, HEIGHT = 400, EDGE = 40;
  const view = (title, across, up) => {
    const scene = data.scene;
    const all = [...scene.paths.flatMap((p) => p.points), ...scene.bodies.flatMap((b) => [b.origin, ...b.shapes.flat()])];
    if (all.length === 0) return;
    const range = (axis) => all.reduce(([low, high], p) => [Math.min(low, p[axis]), Math.max(high, p[axis])], [Infinity, -Infinity]);
    const [x0, x1] = range(across), [y0, y1] = range(up);
    // one scale for both axes
    const scale = Math.min((WIDTH - 2 * EDGE) / (x1 - x0 || 1), (HEIGHT - 2 * EDGE) / (y1 - y0 || 1));
    const at = (p) => [WIDTH / 2 + (p[across] - (x0 + x1) / 2) * scale, HEIGHT / 2 - (p[up] - (y0 + y1) / 2) * scale];
    const text = (points) => points.map((p) => at(p).map((v) => v.toFixed(2)).join(",")).join(" ");
    const figure = make("figure"), svg = draw("svg", { viewBox: `0 0 ${WIDTH} ${HEIGHT}`, role: "img", "aria-label": title });
    // a name stands beside its place, where no other name stands
    const taken = [], ink = [];
    for (const path of scene.paths) {
      const points = path.points.map(at);
      for (let n = 1; n < points.length; n++) {
        const [[a, b], [c, d]] = [points[n - 1], points[n]], steps = Math.ceil(Math.hypot(c - a, d - b) / 4);
        for (let k = 0; k <= steps; k++) ink.push([a + (c - a) * k / (steps || 1), b + (d - b) * k / (steps || 1)]);
      }
    }
    const label = ([x, y], name) => {
      const w = 7 * name.length, h = 12;
      const places = [];
      for (const away of [0, 13, 26, 39]) for (const [dx, dy] of [[5, -5 - away], [5, 13 + away], [-5 - w, -5 - away], [-5 - w, 13 + away], [8 + away, 4], [-8 - away - w, 4]]) places.push([x + dx, y + dy]);
      const free = ([left, low]) => left > 0 && left + w < WIDTH && low > h && low < HEIGHT
        && taken.every(([l, b, width]) => left + w < l || l + width < left || low - h > b || b - h > low);
      const hidden = ([left, low]) => ink.filter(([x, y]) => x > left - 2 && x < left + w + 2 && y > low - h && y < low + 3).length;
      // the place over the least of the lines; the nearest one of equals
      const found = places.filter(free).map((place) => [hidden(place), place]).reduce((a, b) => (b[0] < a[0] ? b : a), [Infinity, places[0]]);
      const [left, low] = found[1];
      taken.push([left, low, w]);
      return draw("text", { x: left, y: low }, name);
    };
    figure.append(make("h2", {}, `${title} (${data.length})`), svg);
    // a round length of at most a fifth of the view
    const wanted = WIDTH / 5 / scale, power = 10 ** Math.floor(Math.log10(wanted));
    const bar = [5, 2, 1].map((m) => m * power).find((v) => v <= wanted) || power, barEnd = 10 + bar * scale;
    const barText = `${+bar.toPrecision(6)} ${data.length}`;
    svg.append(draw("path", { d: `M10,${HEIGHT - 14}v6h${bar * scale}v-6`, class: "bar" }), draw("text", { x: barEnd + 6, y: HEIGHT - 7 }, barText));
    taken.push([10, HEIGHT - 7, bar * scale + 6 + 7 * barText.length]);
    if (up === 2) {
      for (const [level, name, text] of [[scene.surface, "level", "water"], [scene.bottom, "ground", "bottom"]]) {
        if (level === null) continue;
        const y = at([0, 0, level])[1];
        if (y > 0 && y < HEIGHT) {
          svg.append(draw("line", { x1: 0, x2: WIDTH, y1: y, y2: y, class: name }), draw("text", { x: 4, y: y - 4 }, text));
          taken.push([4, y - 4, 7 * text.length]);
          for (let x = 0; x < WIDTH; x += 4) ink.push([x, y]);
        }
      }
    }
    for (const body of scene.bodies) {
      const group = draw("g");
      for (const shape of body.shapes) {
        const hull = convex(shape.map(at));
        if (hull.length > 1) group.append(draw("polygon", { points: hull.map((p) => p.join(",")).join(" "), class: "body" }));
      }
      const [x, y] = at(body.origin);
      group.append(draw("circle", { cx: x, cy: y, r: 2.5 }), draw("title", {}, body.name), label([x, y], body.name));
      selectable(body.name, group);
      svg.append(group);
    }
    for (const path of scene.paths) {
      const group = draw("g"), points = text(path.points);
      group.append(draw("polyline", { points, class: `path ${path.kind}` }));
      if (path.kind !== "bottom") {
        group.append(draw("polyline", { points, class: "hit" }), draw("title", {}, path.name));
        group.append(label(at(path.points[path.points.length - 1]), path.name));
        selectable(path.name, group);
      }
      svg.append(group);
    }
    $("views").append(figure);
  };
  // Andrew's monotone chain
  const convex = (points) => {
    const sorted = [...points].sort((a, b) => a[0] - b[0] || a[1] - b[1]);
    const half = (list) => {
      const made = [];
      for (const p of list) {
        while (made.length > 1) {
          const [a, b] = [made[made.length - 2], made[made.length - 1]];
          if ((b[0] - a[0]) * (p[1] - a[1]) - (b[1] - a[1]) * (p[0] - a[0]) > 0) break;
          made.pop();
        }
        made.push(p);
      }
      return made.slice(0, -1);
    };
    return [...half(sorted), ...half(sorted.reverse())];
  };
  if (data.scene) {
    view("Plan", 0, 1);
    view("Elevation", 0, 2);
  }

  for (const table of data.tables) {
    const box = make("div", { class: "wide" }), grid = make("table"), head = make("thead"), body = make("tbody");
    box.append(make("h2", {}, table.title));
    for (const [name, value] of table.facts) box.append(make("p", { class: "note" }, `${name}: ${value}`));
    const heads = make("tr");
    for (const [group, name, unit] of table.heads) heads.append(make("th", { scope: "col" }, [group, name, unit && `(${unit})`].filter(Boolean).join(" ")));
    head.append(heads);
    for (const cells of table.rows) {
      const row = make("tr");
      for (const cell of cells) row.append(make("td", {}, cell));
      const name = (cells[0] || "").replace(/ Tension$/, "");
      if (data.scene && data.scene.paths.some((p) => p.name === name)) selectable(name, row);
      body.append(row);
    }
    if (table.heads.length > 0) grid.append(head, body);
    box.append(grid);
    for (const note of table.notes) box.append(make("p", { class: "note" }, note));
    $("tables").append(box);
  }

  // curves of the chosen line, else of the first ones
  const MOST = 4;
  function plots(name) {
    const box = $("plots");
    box.replaceChildren();
    const own = data.curves.filter((c) => c.name === name);
    const shown = (own.length > 0 ? own : data.curves).slice(0, MOST);
    if (shown.length < data.curves.length) {
      const text = `${shown.length} of ${data.curves.length} curves are shown. Click a line or a body to show its own.`;
      box.append(make("p", { class: "note" }, text));
    }
    for (const curve of shown) {
      const x = numbers(curve.x), y = numbers(curve.y);
      const finite = [...y.keys()].filter((i) => Number.isFinite(y[i]) && Number.isFinite(x[i]));
      if (finite.length < 2) continue;
      const low = (v) => finite.reduce((a, i) => Math.min(a, v[i]), Infinity), high = (v) => finite.reduce((a, i) => Math.max(a, v[i]), -Infinity);
      const [x0, x1, y0, y1] = [low(x), high(x), low(y), high(y)];
      const LEFT = 60, px = (v) => LEFT + (v - x0) / (x1 - x0 || 1) * (WIDTH - LEFT - EDGE), py = (v) => 200 - 25 - (v - y0) / (y1 - y0 || 1) * 150;
      const figure = make("figure"), svg = draw("svg", { viewBox: `0 0 ${WIDTH} 200`, role: "img", "aria-label": `${curve.name} ${curve.what}` });
      svg.append(draw("polyline", { points: finite.map((i) => `${px(x[i]).toFixed(2)},${py(y[i]).toFixed(2)}`).join(" "), class: "path" }));
      const figures = (v) => Number(v.toPrecision(5)).toString();
      svg.append(draw("text", { x: 4, y: 20 }, figures(y1)), draw("text", { x: 4, y: 180 }, figures(y0)));
      svg.append(draw("text", { x: LEFT, y: 196 }, `${figures(x0)} s`), draw("text", { x: WIDTH - EDGE, y: 196, "text-anchor": "end" }, `${figures(x1)} s`));
      figure.append(make("h2", {}, `${curve.name}: ${curve.what}`), svg);
      box.append(figure);
    }
  }
  choose(kept("chosen") || "");
  scrollTo(0, Number(kept("scroll") || 0));
  addEventListener("scroll", () => keep("scroll", String(scrollY)));

  // a copy of the page in a frame says which version the file has now
  const probe = () => {
    if (document.hidden) return;
    const frame = make("iframe", { hidden: "", "aria-hidden": "true", src: `${location.href.split("#")[0]}#version` });
    document.body.append(frame);
    setTimeout(() => frame.remove(), 1500);
  };
  addEventListener("message", (event) => {
    const version = event.data && event.data.windlass;
    if (typeof version === "string" && version !== data.version) location.reload();
  });
  setInterval(probe, 2000);
})();
