"use strict";
(function () {
  const data = JSON.parse(document.getElementById("data").textContent);
  const numbers = (text) => new Float64Array(Uint8Array.from(atob(text), (c) => c.charCodeAt(0)).buffer);
  const curves = data.curves.map((c) => ({ ...c, x: numbers(c.x), y: numbers(c.y), on: true }));
  const canvas = document.getElementById("plot"), pen = canvas.getContext("2d"), told = document.getElementById("told");
  const FRAME = { left: 84, right: data.right === null ? 24 : 84, top: 16, low: 52 };
  let range, drag = null, at = null;

  // Least and largest number of what is shown, with a little room.
  function bounds(list, of) {
    let low = Infinity, high = -Infinity;
    for (const c of list) {
      for (let n = 0; n < c.x.length; n++) {
        const v = c[of][n];
        if (Number.isFinite(c.x[n] + c.y[n])) [low, high] = [Math.min(low, v), Math.max(high, v)];
      }
    }
    if (low > high) return [0, 1];
    const room = high - low > 1e-9 * Math.max(Math.abs(low), Math.abs(high)) ? 0.03 * (high - low) : 0.5 * Math.abs(high) || 1;
    return [low - room, high + room];
  }
  function whole() {
    const shown = curves.filter((c) => c.on);
    const side = (right) => bounds(shown.filter((c) => c.right === right), "y");
    range = { x: bounds(shown, "x"), left: side(false), right: side(true) };
  }
  const box = () => ({ x: FRAME.left, y: FRAME.top, w: canvas.clientWidth - FRAME.left - FRAME.right, h: canvas.clientHeight - FRAME.top - FRAME.low });
  const across = (v) => box().x + (v - range.x[0]) / (range.x[1] - range.x[0]) * box().w;
  const up = (v, axis) => box().y + box().h - (v - range[axis][0]) / (range[axis][1] - range[axis][0]) * box().h;
  const axisOf = (c) => (c.right ? "right" : "left");

  function ticks([low, high], most) {
    const rough = (high - low) / most, power = 10 ** Math.floor(Math.log10(rough));
    const within = (s) => Math.floor(high / s) - Math.ceil(low / s);
    const steps = [0.1, 0.2, 0.5, 1, 2, 5, 10].map((m) => m * power);
    // the smallest step that has room, or the largest one with two ticks
    const least = steps.find((s) => s >= rough * 0.999999);
    const step = within(least) > 0 ? least : steps.findLast((s) => s < least && within(s) > 0) || least;
    const first = Math.ceil(low / step), count = within(step);
    const size = Math.max(Math.abs(low), Math.abs(high)), places = Math.max(0, -Math.floor(Math.log10(step) + 1e-9));
    const text = (v) => (size >= 1e7 || size < 1e-4 ? v.toExponential(Math.max(0, Math.round(Math.log10(size / step)))) : v.toFixed(Math.min(places, 20)));
    return Array.from({ length: Math.min(Math.max(count, 0), Math.max(most, 5)) + 1 }, (_, n) => [(first + n) * step, text((first + n) * step)]);
  }
  function draw() {
    const ratio = window.devicePixelRatio || 1, { x, y, w, h } = box();
    canvas.width = canvas.clientWidth * ratio;
    canvas.height = canvas.clientHeight * ratio;
    pen.setTransform(ratio, 0, 0, ratio, 0, 0);
    pen.clearRect(0, 0, canvas.clientWidth, canvas.clientHeight);
    pen.font = "13px system-ui, sans-serif";
    pen.lineWidth = 1;
    const line = (a, b, c, d, colour) => {
      pen.strokeStyle = colour;
      pen.beginPath();
      pen.moveTo(a, b);
      pen.lineTo(c, d);
      pen.stroke();
    };
    pen.fillStyle = "#14202b";
    pen.textBaseline = "middle";
    for (const [v, text] of ticks(range.x, Math.max(2, Math.floor(w / 90)))) {
      line(across(v), y, across(v), y + h, "#dde3e8");
      pen.textAlign = "center";
      pen.fillText(text, across(v), y + h + 14);
    }
    for (const axis of data.right === null ? ["left"] : ["left", "right"]) {
      for (const [v, text] of ticks(range[axis], Math.max(2, Math.floor(h / 50)))) {
        const p = up(v, axis);
        if (axis === "left") line(x, p, x + w, p, "#dde3e8");
        else line(x + w, p, x + w + 5, p, "#14202b");
        pen.textAlign = axis === "left" ? "right" : "left";
        pen.fillText(text, axis === "left" ? x - 7 : x + w + 8, p);
      }
    }
    pen.textAlign = "center";
    pen.fillText(data.x, x + w / 2, y + h + 37);
    const upright = (text, px) => {
      pen.save();
      pen.translate(px, y + h / 2);
      pen.rotate(-Math.PI / 2);
      pen.fillText(text, 0, 0);
      pen.restore();
    };
    upright(data.left, 13);
    if (data.right !== null) upright(data.right, canvas.clientWidth - 13);
    pen.save();
    pen.beginPath();
    pen.rect(x, y, w, h);
    pen.clip();
    for (const c of curves.filter((c) => c.on)) {
      pen.strokeStyle = pen.fillStyle = c.colour;
      pen.lineWidth = 2;
      pen.lineJoin = "round";
      pen.beginPath();
      let joined = false;
      for (let n = 0; n < c.x.length; n++) {
        if (!Number.isFinite(c.x[n] + c.y[n])) {
          joined = false;
          continue;
        }
        const px = across(c.x[n]), py = up(c.y[n], axisOf(c));
        if (joined) pen.lineTo(px, py);
        else pen.moveTo(px, py);
        joined = true;
      }
      pen.stroke();
      const seen = c.x.length <= 60 || c.marks;
      for (let n = 0; seen && n < c.x.length; n++) {
        pen.beginPath();
        pen.arc(across(c.x[n]), up(c.y[n], axisOf(c)), c.marks ? 5 : 3, 0, 7);
        pen.fill();
      }
    }
    if (at) {
      line(across(at.x), y, across(at.x), y + h, "#55606a");
      for (const { c, n } of at.found) {
        pen.fillStyle = c.colour;
        pen.beginPath();
        pen.arc(across(c.x[n]), up(c.y[n], axisOf(c)), 5, 0, 7);
        pen.fill();
      }
    }
    if (drag && drag.to) {
      pen.fillStyle = "rgba(11, 111, 184, .16)";
      pen.fillRect(drag.from[0], drag.from[1], drag.to[0] - drag.from[0], drag.to[1] - drag.from[1]);
    }
    pen.restore();
    pen.strokeStyle = "#14202b";
    pen.lineWidth = 1;
    pen.strokeRect(x, y, w, h);
  }
  // The point of each curve nearest to an x, where it has one in sight.
  function tell(x) {
    const found = [];
    for (const c of curves.filter((c) => c.on)) {
      let best = -1;
      for (let n = 0; n < c.x.length; n++) {
        if (Number.isFinite(c.x[n] + c.y[n]) && (best < 0 || Math.abs(c.x[n] - x) < Math.abs(c.x[best] - x))) best = n;
      }
      if (best >= 0) found.push({ c, n: best });
    }
    if (!found.length) return;
    const near = found.reduce((a, b) => (Math.abs(a.c.x[a.n] - x) <= Math.abs(b.c.x[b.n] - x) ? a : b));
    const here = near.c.x[near.n];
    at = { x: here, found: found.filter(({ c, n }) => c.x[n] === here) };
    const figures = (v) => `${+v.toPrecision(7)}`;
    told.textContent = [`${data.x}  ${figures(here)}`, ...at.found.map(({ c, n }) => `${c.name}  ${figures(c.y[n])}`)].join("\n");
    told.hidden = false;
    const px = across(here), right = px > canvas.clientWidth / 2;
    told.style.transform = `translate(${right ? px - told.offsetWidth - 12 : px + 12}px, ${FRAME.top + 8}px)`;
    draw();
  }
  function forget() {
    at = null;
    told.hidden = true;
  }
  function reset() {
    forget();
    whole();
    draw();
  }
  const value = (px) => range.x[0] + (px - box().x) / box().w * (range.x[1] - range.x[0]);
  const where = (e) => {
    const edge = canvas.getBoundingClientRect();
    return [e.clientX - edge.left, e.clientY - edge.top];
  };
  canvas.addEventListener("pointerdown", (e) => {
    drag = { from: where(e) };
    canvas.setPointerCapture(e.pointerId);
  });
  canvas.addEventListener("pointermove", (e) => {
    const p = where(e);
    if (drag && Math.hypot(p[0] - drag.from[0], p[1] - drag.from[1]) > 6) {
      drag.to = p;
      forget();
      draw();
    } else if (!drag || e.pointerType !== "mouse") {
      tell(value(p[0]));
    }
  });
  canvas.addEventListener("pointerup", (e) => {
    const { from, to } = drag || {};
    drag = null;
    if (!to) return tell(value(where(e)[0]));
    const cut = (axis, a, b, start, length, turned) => {
      const [low, high] = range[axis], of = (p) => {
        const s = Math.min(Math.max((p - start) / length, 0), 1);
        return low + (turned ? 1 - s : s) * (high - low);
      };
      const [l, r] = [of(a), of(b)].sort((p, q) => p - q);
      if (r - l > 1e-12 * Math.max(Math.abs(l), Math.abs(r))) range[axis] = [l, r];
    };
    const { x, y, w, h } = box();
    if (Math.abs(to[0] - from[0]) > 6) cut("x", from[0], to[0], x, w, false);
    // a drag along the axis zooms along it alone
    if (Math.abs(to[1] - from[1]) > 24) ["left", "right"].forEach((axis) => cut(axis, from[1], to[1], y, h, true));
    draw();
  });
  canvas.addEventListener("pointercancel", () => { drag = null; });
  canvas.addEventListener("pointerleave", () => { forget(); draw(); });
  canvas.addEventListener("dblclick", reset);
  canvas.addEventListener("wheel", (e) => {
    e.preventDefault();
    const middle = value(where(e)[0]), by = Math.exp(Math.min(Math.max(e.deltaY, -300), 300) * 0.001);
    range.x = range.x.map((v) => middle + (v - middle) * by);
    forget();
    draw();
  }, { passive: false });
  canvas.addEventListener("keydown", (e) => {
    if (e.key === "0" || e.key === "Home") return reset();
    const step = { ArrowLeft: -1, ArrowRight: 1 }[e.key];
    if (!step) return;
    e.preventDefault();
    const xs = curves.filter((c) => c.on).flatMap((c) => [...c.x].filter((v, n) => Number.isFinite(v + c.y[n])));
    const now = at ? at.x : step > 0 ? -Infinity : Infinity;
    const next = xs.filter((v) => (step > 0 ? v > now : v < now)).reduce((a, b) => (a === null || (b - a) * step < 0 ? b : a), null);
    if (next !== null) tell(next);
  });
  document.getElementById("whole").addEventListener("click", reset);
  for (const c of curves) {
    const key = document.createElement("button"), mark = document.createElement("i");
    key.type = "button";
    mark.style.background = c.colour;
    key.append(mark, c.name);
    key.setAttribute("aria-pressed", "true");
    key.addEventListener("click", () => {
      c.on = !c.on;
      key.setAttribute("aria-pressed", String(c.on));
      forget();
      draw();
    });
    document.getElementById("keys").append(key);
  }
  window.addEventListener("resize", draw);
  whole();
  draw();
  // An address that ends in #x=100 tells the values there.
  const wanted = new URLSearchParams(location.hash.slice(1)).get("x");
  if (wanted !== null && Number.isFinite(+wanted)) tell(+wanted);
  document.documentElement.dataset.curves = curves.length;
})();
