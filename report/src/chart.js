// Line charts with uPlot: several lines, each with its own abscissas in any order, stacked areas or points; zoom by dragging
// or keys, values at the cursor, labels at the ends of lines, and a table of the numbers.
import uPlot from "uplot";
import { button, freshId, h, lazyDetails, plainTable } from "./dom.js";
import { axisTitle, format, powerOfTen, scaled } from "./format.js";
import { colour, dash, onEnd, onThemeChange, style } from "./theme.js";

const tableRows = 200;
const nameRoom = 0.07; // of the height, above the lines: for the names of bands

const finite = (n) => n !== null && n !== undefined && Number.isFinite(n);

function extent(arrays, accept) {
  let low = Infinity;
  let high = -Infinity;
  for (const { values, keep } of arrays)
    for (let i = 0; i < values.length; ++i) {
      const value = values[i];
      if (!finite(value) || !accept(value) || (keep && !keep(i))) continue;
      if (value < low) low = value;
      if (value > high) high = value;
    }
  return low <= high ? [low, high] : null;
}

function padded([low, high], log) {
  if (log) {
    const room = (high / low) ** 0.05 * 1.05;
    return [low / room, high * room];
  }
  const room = high > low ? 0.06 * (high - low) : Math.abs(high) * 0.1 || 1;
  return [low === 0 ? 0 : low - room, high === 0 && low < 0 ? 0 : high + room];
}

// Returns the ticks of a logarithmic axis: decades; if fewer than two, 1, 2 and 5 of each; if still fewer than two, linear ticks.
function logTicks(low, high) {
  const some = (mantissas) => {
    const ticks = [];
    for (let e = Math.floor(Math.log10(low)); e <= Math.ceil(Math.log10(high)); ++e)
      for (const m of mantissas) {
        const tick = Number(`${m}e${e}`);
        if (tick >= low && tick <= high) ticks.push(tick);
      }
    return ticks;
  };
  const decades = some([1]);
  if (decades.length > 9) return decades.filter((_, i) => i % Math.ceil(decades.length / 9) === 0);
  if (decades.length > 1) return decades;
  const divided = some([1, 2, 5]);
  if (divided.length > 1) return divided;
  const step = 10 ** Math.floor(Math.log10(high - low));
  const ticks = [];
  for (let k = Math.ceil(low / step); k * step <= high; ++k) ticks.push(k * step);
  return ticks;
}

// Charts of one group zoom together.
const groups = new Map();

/*
 options: title, bands [{from, to, label}] of x behind the lines, x and y {name, unit, log, loose: with a margin at both ends, span: range that is always shown, zero: include zero}, series [{label, x, y, lower, index, points, line}], stacked, group, height, note, plain: without labels.
 lower: lower side of a stacked area. index: of colour and dashes; by default the index in the list.
*/
export function chart(options) {
  const { title, series, x, y } = options;
  const positive = (log) => (value) => !log || value > 0;
  const okX = positive(x.log);
  const okY = positive(y.log);
  const wholeX = x.span ?? extent(series.map((s) => ({ values: s.x, keep: x.loose && ((i) => finite(s.y[i])) })), okX);
  const wholeY = y.span ?? extent(series.map((s) => ({ values: s.y })), okY);
  const figure = h("figure", { class: "chart" }, h("figcaption", {}, h("h3", {}, title), options.note && h("p", { class: "note" }, options.note)));
  if (!wholeX || !wholeY) {
    figure.append(h("p", { class: "note" }, y.log ? "No number above zero." : "No numbers."));
    return figure;
  }
  const unitX = x.log ? scaled(0, x.unit) : scaled(Math.max(...wholeX.map(Math.abs)), x.unit);
  const unitY = y.log ? scaled(0, y.unit) : scaled(Math.max(...wholeY.map(Math.abs)), y.unit);
  const lines = series.map((s, i) => ({ ...s, index: s.index ?? i }));
  const data = [null, ...lines.map((s) => [Float64Array.from(s.x, (v) => v * unitX.factor), Float64Array.from(s.y, (v) => v * unitY.factor)])];
  const lowers = lines.map((s) => s.lower && Float64Array.from(s.lower, (v) => v * unitY.factor));
  // Time has no margin; other quantities have one.
  const tight = [wholeX[0] * unitX.factor, wholeX[1] * unitX.factor];
  const full = x.log || x.loose ? padded(tight, x.log) : tight[0] < tight[1] ? tight : padded(tight, false);
  let windowX = full;
  const rangeY = () => {
    const inside = (xs) => (i) => xs[i] >= windowX[0] && xs[i] <= windowX[1];
    const all = lines.map((s, i) => ({ values: data[i + 1][1], keep: inside(data[i + 1][0]) }));
    if (options.stacked || y.zero) all.push({ values: [0] });
    if (y.span) all.push({ values: y.span.map((v) => v * unitY.factor) });
    const [low, high] = padded(extent(all, okY) ?? [wholeY[0] * unitY.factor, wholeY[1] * unitY.factor], y.log);
    if (!options.bands?.length) return [low, high];
    return [low, y.log ? high * (high / low) ** nameRoom : high + nameRoom * (high - low)];
  };

  const path = (u, s) => {
    const [xs, ys] = data[s];
    const stroke = new Path2D();
    const dots = new Path2D();
    const one = lines[s - 1];
    if (one.points) {
      const size = 3.5 * devicePixelRatio;
      for (let i = 0; i < xs.length; ++i) {
        if (!finite(ys[i]) || !finite(xs[i]) || !okX(xs[i]) || !okY(ys[i])) continue;
        const px = u.valToPos(xs[i], "x", true);
        const py = u.valToPos(ys[i], "y", true);
        dots.moveTo(px + size, py);
        dots.arc(px, py, size, 0, 2 * Math.PI);
      }
      if (one.line === false) return { stroke: null, fill: dots };
    }
    let open = false;
    let [lastX, lastY] = [NaN, NaN];
    for (let i = 0; i < xs.length; ++i) {
      if (!finite(ys[i]) || !finite(xs[i]) || !okX(xs[i]) || !okY(ys[i])) {
        open = false;
        continue;
      }
      const px = u.valToPos(xs[i], "x", true);
      const py = u.valToPos(ys[i], "y", true);
      if (open && i + 1 < xs.length && Math.abs(px - lastX) < 0.4 && Math.abs(py - lastY) < 0.4) continue;
      if (open) stroke.lineTo(px, py);
      else stroke.moveTo(px, py);
      [open, lastX, lastY] = [true, px, py];
    }
    const lower = lowers[s - 1];
    if (!lower) return { stroke, fill: one.points ? dots : null };
    const fill = new Path2D();
    for (let i = 0; i < xs.length; ++i) fill.lineTo(u.valToPos(xs[i], "x", true), u.valToPos(ys[i], "y", true));
    for (let i = xs.length - 1; i >= 0; --i) fill.lineTo(u.valToPos(xs[i], "x", true), u.valToPos(lower[i], "y", true));
    return { stroke, fill };
  };

  const tick = (log) => (u, splits) => splits.map((v) => (v === null ? "" : (log && powerOfTen(v)) || format(v, log ? 3 : 6)));
  const axis = (which, log, label) => ({
    scale: which,
    label,
    labelSize: 20,
    labelFont: "12px system-ui, sans-serif",
    font: "11px system-ui, sans-serif",
    stroke: () => style("--quiet"),
    grid: { stroke: () => style("--grid"), width: 1 },
    ticks: { show: false },
    border: { show: true, stroke: () => style("--axis"), width: 1 },
    values: tick(log),
    ...(log && { splits: (u, at, low, high) => logTicks(low, high), filter: (u, splits) => splits }),
    size: which === "x" ? 28 : (u, values) => 14 + 6.2 * Math.max(2, ...(values ?? []).map((v) => v.length)),
    gap: 4,
  });

  const direct = !options.stacked && lines.length > 1 && lines.length <= 6 && !options.plain;
  const longest = Math.max(...lines.map((s) => s.label.length));
  const endLabels = (u) => {
    if (!direct || u.width < 480 || longest > 22) return;
    const { ctx } = u;
    const size = 11 * devicePixelRatio;
    const places = [];
    lines.forEach((s, i) => {
      const [xs, ys] = data[i + 1];
      let last = -1;
      for (let k = 0; k < xs.length; ++k)
        if (xs[k] <= windowX[1] && finite(ys[k]) && okY(ys[k]) && (last < 0 || xs[k] >= xs[last])) last = k;
      if (last >= 0) places.push({ s, y: u.valToPos(ys[last], "y", true) });
    });
    places.sort((a, b) => a.y - b.y);
    for (let i = 1; i < places.length; ++i) places[i].y = Math.max(places[i].y, places[i - 1].y + 1.15 * size);
    const floor = u.bbox.top + u.bbox.height;
    for (let i = places.length - 1, low = floor; i >= 0; --i, low = places[i + 1].y - 1.15 * size) places[i].y = Math.min(places[i].y, low);
    ctx.save();
    ctx.font = `${size}px system-ui, sans-serif`;
    ctx.textAlign = "left";
    ctx.textBaseline = "middle";
    for (const { s, y: py } of places) {
      ctx.fillStyle = colour(s.index);
      ctx.fillText(s.label, u.bbox.left + u.bbox.width + 6 * devicePixelRatio, py);
    }
    ctx.restore();
  };
  // Every second band is shaded. Names stand at the top where they fit, elsewhere numbers, which the key below the chart explains.
  const names = [...new Set((options.bands ?? []).map((band) => band.label))];
  const key = h("p", { class: "note band-key", hidden: true });
  const bands = (u) => {
    if (!options.bands?.length) return;
    const numbered = new Set();
    const { ctx } = u;
    const { left, top, width, height } = u.bbox;
    const size = 10 * devicePixelRatio;
    ctx.save();
    ctx.font = `${size}px system-ui, sans-serif`;
    ctx.textAlign = "center";
    ctx.textBaseline = "top";
    options.bands.forEach(({ from, to, label }, i) => {
      const low = Math.max(left, u.valToPos(from * unitX.factor, "x", true));
      const high = Math.min(left + width, u.valToPos(to * unitX.factor, "x", true));
      if (!(low < high)) return;
      if (i % 2 === 1) {
        ctx.fillStyle = style("--grid");
        ctx.globalAlpha = 0.55;
        ctx.fillRect(low, top, high - low, height);
        ctx.globalAlpha = 1;
      }
      const fits = (text, room) => ctx.measureText(text).width + room <= high - low;
      const number = names.indexOf(label) + 1;
      const text = fits(label, size) ? label : fits(number, 0) ? `${number}` : "";
      if (text !== label) numbered.add(number);
      ctx.fillStyle = style("--quiet");
      ctx.fillText(text, (low + high) / 2, top + size / 3);
    });
    ctx.restore();
    key.hidden = numbered.size === 0;
    key.textContent = `Narrow bands: ${[...numbered].sort((a, b) => a - b).map((n) => `${n} ${names[n - 1]}`).join(", ")}`;
  };
  const bandAt = (at) => options.bands?.find(({ from, to }) => at >= from * unitX.factor && at <= to * unitX.factor)?.label;
  const roomRight = (u) => (direct && u.width >= 480 && longest <= 22 ? 12 + 6.4 * longest : 14);

  // The legend shows the values at the cursor.
  const values = lines.map(() => h("span", { class: "value" }));
  const legend = h("ul", { class: "legend" }, lines.map((s, i) => h("li", {}, swatch(s, options.stacked), h("span", {}, s.label), values[i])));
  const where = h("p", { class: "where", "aria-live": "polite" });
  const holder = h("div", {
    class: "plot", tabindex: 0, role: "application", "aria-roledescription": "chart", "aria-label": summary(options, unitX, unitY),
    "aria-describedby": "chart-keys",
  });
  const nearest = (xs, at) => {
    let best = -1;
    for (let k = 0; k < xs.length; ++k)
      if (finite(xs[k]) && (best < 0 || Math.abs(xs[k] - at) < Math.abs(xs[best] - at))) best = k;
    return best;
  };
  let cursor = null;
  const show = (at) => {
    cursor = at;
    lines.forEach((s, i) => {
      const [xs, ys] = data[i + 1];
      const k = at === null ? -1 : nearest(xs, at);
      const value = k < 0 ? NaN : ys[k] - (lowers[i] ? lowers[i][k] : 0);
      values[i].textContent = at === null || !finite(value) ? "" : `${format(value)}${unitY.unit ? ` ${unitY.unit}` : ""}`;
    });
    const single = lines.length === 1 && values[0].textContent ? `: ${values[0].textContent}` : "";
    const band = at === null ? undefined : bandAt(at);
    where.textContent = at === null ? "" : `${x.name} ${format(at)}${unitX.unit ? ` ${unitX.unit}` : ""}${band ? `, ${band}` : ""}${single}`;
  };
  // Announces the values to screen readers when keys move the cursor.
  const announce = () => {
    where.setAttribute("aria-label", `${where.textContent}: ${lines.map((s, i) => `${s.label} ${values[i].textContent || "none"}`).join(", ")}`);
  };

  let plot = null;
  const group = options.group && groups.get(options.group) ? groups.get(options.group) : new Set();
  if (options.group) groups.set(options.group, group);
  const zoomTo = (range) => {
    windowX = range ? [Math.max(full[0], range[0]), Math.min(full[1], range[1])] : full;
    reset.hidden = windowX[0] === full[0] && windowX[1] === full[1];
    plot?.batch(() => {
      plot.setScale("x", { min: windowX[0], max: windowX[1] });
      const [min, max] = rangeY();
      plot.setScale("y", { min, max });
    });
  };
  const zoomAll = (range) => {
    const si = range && [range[0] / unitX.factor, range[1] / unitX.factor];
    if (!options.group) return zoomTo(range);
    for (const other of group) other(si);
  };
  const follow = (si) => zoomTo(si && [si[0] * unitX.factor, si[1] * unitX.factor]);
  group.add(follow);
  onEnd(() => group.delete(follow));
  const reset = button("Show all", () => zoomAll(null), { class: "reset", hidden: true });

  const draw = () => {
    plot = new uPlot({
      width: Math.max(260, holder.clientWidth),
      height: options.height ?? 260,
      mode: 2,
      legend: { show: false },
      padding: [10, roomRight, 0, 0],
      cursor: {
        drag: { x: true, y: false, setScale: false },
        points: { show: false },
        y: false,
        bind: { dblclick: () => () => (zoomAll(null), null) },
      },
      scales: {
        x: { time: false, distr: x.log ? 3 : 1, range: () => windowX },
        y: { distr: y.log ? 3 : 1, range: () => rangeY() },
      },
      axes: [axis("x", x.log, axisTitle(x.name, unitX.unit)), axis("y", y.log, axisTitle(y.name, unitY.unit))],
      series: [{}, ...lines.map((s) => ({
        label: s.label,
        facets: [{ scale: "x", auto: true }, { scale: "y", auto: true }],
        stroke: () => colour(s.index),
        fill: () => (s.lower || s.points ? colour(s.index) + (s.points ? "" : options.stacked ? "c0" : "30") : undefined),
        width: options.stacked ? 0.5 : 1.75,
        dash: options.stacked || s.points ? undefined : dash(s.index).map((d) => d * devicePixelRatio),
        paths: path,
      }))],
      hooks: {
        drawClear: [bands],
        draw: [endLabels],
        setCursor: [(u) => {
          if (u.cursor.left < 0) return show(null);
          show(u.posToVal(u.cursor.left, "x"));
        }],
        setSelect: [(u) => {
          const { left, width } = u.select;
          if (width > 4) zoomAll([u.posToVal(left, "x"), u.posToVal(left + width, "x")]);
          u.setSelect({ left: 0, top: 0, width: 0, height: 0 }, false);
        }],
      },
    }, data, holder);
    plot.root.querySelector("canvas").setAttribute("aria-hidden", "true");
  };
  const sizes = new ResizeObserver(() => {
    if (holder.clientWidth === 0) return;
    if (!plot) draw();
    else if (Math.abs(plot.width - holder.clientWidth) > 1) plot.setSize({ width: holder.clientWidth, height: plot.height });
  });
  sizes.observe(holder);
  const redraw = () => plot?.redraw(true, true);
  onThemeChange(redraw);
  // A canvas does not shrink by itself to the width of paper.
  addEventListener("beforeprint", redraw);
  onEnd(() => {
    sizes.disconnect();
    removeEventListener("beforeprint", redraw);
    plot?.destroy();
  });

  holder.addEventListener("keydown", (event) => {
    if (!plot || event.ctrlKey || event.metaKey || event.altKey) return;
    const [low, high] = windowX;
    const step = (high - low) / 50;
    const at = cursor ?? low;
    const move = (to) => {
      const bounded = Math.min(high, Math.max(low, to));
      plot.setCursor({ left: plot.valToPos(bounded, "x"), top: plot.over.clientHeight / 2 }, false);
      show(bounded);
      announce();
    };
    const keys = {
      ArrowRight: () => move(at + step), ArrowLeft: () => move(at - step), Home: () => move(low), End: () => move(high),
      "+": () => zoomAll([at - (at - low) / 2, at + (high - at) / 2]), "-": () => zoomAll([low - (at - low), high + (high - at)]),
      0: () => zoomAll(null), Escape: () => zoomAll(null),
    };
    const key = event.key === "=" ? "+" : event.key;
    if (!keys[key]) return;
    event.preventDefault();
    keys[key]();
  });
  const parts = [h("div", { class: "plot-frame" }, holder, reset), options.bands?.length ? key : null, lines.length > 1 || options.stacked ? legend : null, h("div", { class: "below" }, numbers(options, unitX, unitY), where)];
  figure.append(...parts.filter(Boolean));
  return figure;
}

function swatch(s, stacked) {
  const canvas = h("canvas", { class: "swatch", width: 48, height: 20, "aria-hidden": "true" });
  const draw = () => {
    const ctx = canvas.getContext("2d");
    ctx.clearRect(0, 0, 48, 20);
    ctx.strokeStyle = ctx.fillStyle = colour(s.index);
    ctx.lineWidth = 4;
    ctx.setLineDash(s.points ? [] : dash(s.index).map((d) => 2 * d));
    if (stacked) ctx.fillRect(8, 2, 32, 16);
    else {
      if (s.line !== false) {
        ctx.beginPath();
        ctx.moveTo(0, 10);
        ctx.lineTo(48, 10);
        ctx.stroke();
      }
      if (s.points) {
        ctx.beginPath();
        ctx.arc(24, 10, 7, 0, 7);
        ctx.fill();
      }
    }
  };
  draw();
  onThemeChange(draw);
  return canvas;
}

// Describes the chart in a sentence, for screen readers.
function summary({ title, series, x, y }, unitX, unitY) {
  const parts = series.map((s) => {
    const range = extent([{ values: s.y }], () => true);
    if (!range) return `${s.label}: no numbers`;
    const [low, high] = range.map((v) => format(v * unitY.factor));
    return `${s.label}: from ${low} to ${high}${unitY.unit ? ` ${unitY.unit}` : ""}`;
  });
  return `${title}. ${y.name} over ${x.name}. ${parts.slice(0, 8).join("; ")}`;
}

function numbers({ title, series, x, y }, unitX, unitY) {
  return lazyDetails("Numbers", () => {
    const shared = series.every((s) => s.x === series[0].x);
    const groupsOf = shared ? [series] : series.map((s) => [s]);
    return h("div", { id: freshId("numbers") }, groupsOf.map((some) => {
      const n = some[0].x.length;
      const stride = Math.max(1, Math.ceil(n / tableRows));
      const rows = [];
      for (let i = 0; i < n; i += stride) rows.push([format(some[0].x[i] * unitX.factor, 6), ...some.map((s) => format((s.y[i] - (s.lower ? s.lower[i] : 0)) * unitY.factor, 6))]);
      return [stride > 1 && h("p", { class: "note" }, `Every ${stride}th of ${n} rows; all of them are in the run's files.`),
        plainTable([axisTitle(x.name, unitX.unit), ...some.map((s) => axisTitle(s.label, unitY.unit))], rows, `Numbers: ${title}`, { class: "numbers" })];
    }));
  });
}
