"use strict";
// What all charts of the page share: the data, numbers, scales, axes, and a mark for each input.
const data = JSON.parse(document.getElementById("data").textContent);
const { columns, rows, inputs } = data;
const at = Object.fromEntries(columns.map((name, i) => [name, i]));
const get = (row, name) => name in at ? row[at[name]] : data.alike[name];
const byId = (id) => document.getElementById(id);
const fmt = (v) => v === null || v === undefined ? "–" : typeof v !== "number" ? String(v) : Number.isInteger(v) ? String(v) : Number(v.toPrecision(5)).toString();
const esc = (t) => String(t).replace(/[&<>"]/g, (c) => ({ "&": "&amp;", "<": "&lt;", ">": "&gt;", '"': "&quot;" })[c]);
const memoryName = Object.fromEntries(data.memories);

// Okabe and Ito's colours, each with a pattern of its own.
const colours = ["#0072b2", "#e69f00", "#009e73", "#cc79a7", "#56b4e9", "#d55e00", "#f0e442", "#999999", "#444444"];
const patterns = ["", "M0 8L8 0", "M4 0V8", "M0 4H8", "M0 0L8 8", "M0 8L8 0M0 0L8 8", "M4 0V8M0 4H8", "M2 2h1M6 6h1", "M0 2H8M0 6H8"];
const defs = (id) => "<defs>" + colours.map((colour, i) => `<pattern id="${id}${i}" width="8" height="8" patternUnits="userSpaceOnUse"><rect width="8" height="8" fill="${colour}"/><path d="${patterns[i]}" stroke="#fff" stroke-width="1.4" stroke-opacity=".75" fill="none"/></pattern>`).join("") + "</defs>";
const colourOf = (input) => colours[input % colours.length];
const inputOf = (row) => inputs.indexOf(get(row, "input"));

// A mark about x, y: a shape for each input.
const shapes = [
  (r) => `m${-r} 0a${r} ${r} 0 1 0 ${2 * r} 0a${r} ${r} 0 1 0 ${-2 * r} 0z`,
  (r) => `m${-r} ${-r}h${2 * r}v${2 * r}h${-2 * r}z`,
  (r) => `m0 ${-r}l${r} ${2 * r}h${-2 * r}z`,
  (r) => `m0 ${-r * 1.3}l${r * 1.3} ${r * 1.3}l${-r * 1.3} ${r * 1.3}l${-r * 1.3} ${-r * 1.3}z`,
  (r) => `m0 ${r}l${r} ${-2 * r}h${-2 * r}z`,
  (r) => `m${-r} ${-r / 3}h${2 * r}v${r * 2 / 3}h${-2 * r}z`,
];
const mark = (input, x, y, r) => `M${x.toFixed(1)} ${y.toFixed(1)}${shapes[input % shapes.length](r)}`;
const legend = () => inputs.length < 2 ? "" : `<ul class="legend inputs">` + inputs.map((name, k) => `<li><svg viewBox="0 0 14 14" aria-hidden="true"><path d="${mark(k, 7, 7, 5)}" fill="${colourOf(k)}"/></svg>${esc(name)}</li>`).join("") + "</ul>";

const W = 720, H = 420, L = 84, R = 24, T = 30, B = 46;
const extent = (list) => { let low = Infinity, high = -Infinity; for (const v of list) { if (v < low) low = v; if (v > high) high = v; } return [low, high]; };
// Round values from low to high: 1, 2 or 5 times a power of ten apart.
const ticks = (low, high) => {
  if (!(high > low)) return [low];
  const power = 10 ** Math.floor(Math.log10((high - low) / 5)), step = [1, 2, 5, 10].map((t) => t * power).find((s) => s >= (high - low) / 5);
  const list = [];
  for (let k = Math.ceil(low / step - 1e-9); k <= Math.floor(high / step + 1e-9); k++) list.push(k * step);
  return list;
};
// Of a logarithmic axis from 10^low to 10^high: 1, 2 and 5 times powers of ten, or round values where fewer than two of them are there.
const logTicks = (low, high) => {
  const list = [];
  for (let k = Math.floor(low); k <= high; k++) for (const t of [1, 2, 5]) { const v = Number(`${t}e${k}`); if (Math.log10(v) >= low - 1e-9 && Math.log10(v) <= high + 1e-9) list.push(v); }
  return list.length > 1 ? list : ticks(10 ** low, 10 ** high).filter((v) => v > 0);
};
const tick = (v) => v.toLocaleString("en-US", { maximumSignificantDigits: 6 });
const scale = ([low, high], from, to) => {
  const of = (v) => high > low ? from + (v - low) / (high - low) * (to - from) : (from + to) / 2;
  return Object.assign(of, { low, high, ticks: ticks(low, high) });
};
const axes = (x, y, xName, yName) => `<path class="axis" d="M${L} ${T}V${H - B}H${W - R}"/>` +
  x.ticks.map((v) => `<path class="grid" d="M${x(v)} ${T}V${H - B}"/><text class="x-tick" x="${x(v)}" y="${H - B + 17}" text-anchor="middle">${tick(v)}</text>`).join("") +
  y.ticks.map((v) => `<path class="grid" d="M${L} ${y(v)}H${W - R}"/><text class="y-tick" x="${L - 6}" y="${y(v) + 4}" text-anchor="end">${tick(v)}</text>`).join("") +
  `<text x="${(L + W - R) / 2}" y="${H - 8}" text-anchor="middle">${esc(xName)}</text><text x="${L}" y="${T - 12}">${esc(yName)}</text>`;
