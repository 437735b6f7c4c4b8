"use strict";
(() => {
  const data = JSON.parse(document.getElementById("data").textContent);
  const { columns, rows } = data;
  if (!rows.length) return;
  const at = Object.fromEntries(columns.map((name, i) => [name, i]));
  const get = (row, name) => name in at ? row[at[name]] : data.alike[name];
  const byId = (id) => document.getElementById(id);
  const fmt = (v) => v === null || v === undefined ? "–" : typeof v !== "number" ? String(v) : Number.isInteger(v) ? String(v) : Number(v.toPrecision(5)).toString();
  const esc = (t) => String(t).replace(/[&<>"]/g, (c) => ({ "&": "&amp;", "<": "&lt;", ">": "&gt;", '"': "&quot;" })[c]);
  const numeric = columns.filter((name) => rows.some((row) => typeof row[at[name]] === "number") && name !== "front");
  // Okabe and Ito's colours, each with a pattern of its own.
  const colours = ["#0072b2", "#e69f00", "#009e73", "#cc79a7", "#56b4e9", "#d55e00", "#f0e442", "#999999", "#444444"];
  const patterns = ["", "M0 8L8 0", "M4 0V8", "M0 4H8", "M0 0L8 8", "M0 8L8 0M0 0L8 8", "M4 0V8M0 4H8", "M2 2h1M6 6h1", "M0 2H8M0 6H8"];
  const defs = (id) => "<defs>" + colours.map((colour, i) => `<pattern id="${id}${i}" width="8" height="8" patternUnits="userSpaceOnUse"><rect width="8" height="8" fill="${colour}"/><path d="${patterns[i]}" stroke="#fff" stroke-width="1.4" stroke-opacity=".75" fill="none"/></pattern>`).join("") + "</defs>";
  const W = 720, H = 420, L = 84, R = 24, T = 30, B = 46;
  const scale = (values, from, to) => {
    const low = Math.min(...values), high = Math.max(...values);
    const of = (v) => high > low ? from + (v - low) / (high - low) * (to - from) : (from + to) / 2;
    return Object.assign(of, { low, high, ticks: high > low ? [0, .25, .5, .75, 1].map((t) => low + t * (high - low)) : [low] });
  };
  const extent = (list) => { let low = Infinity, high = -Infinity; for (const v of list) { if (v < low) low = v; if (v > high) high = v; } return [low, high]; };
  const axes = (x, y, xName, yName) => `<path class="axis" d="M${L} ${T}V${H - B}H${W - R}"/>` +
    x.ticks.map((v) => `<path class="grid" d="M${x(v)} ${T}V${H - B}"/><text x="${x(v)}" y="${H - B + 17}" text-anchor="middle">${fmt(v)}</text>`).join("") +
    y.ticks.map((v) => `<path class="grid" d="M${L} ${y(v)}H${W - R}"/><text x="${L - 6}" y="${y(v) + 4}" text-anchor="end">${fmt(v)}</text>`).join("") +
    `<text x="${(L + W - R) / 2}" y="${H - 8}" text-anchor="middle">${esc(xName)}</text><text x="${L}" y="${T - 12}">${esc(yName)}</text>`;

  // A machine file of a point.
  const keysOf = (row) => data.keys.map(([name, word]) => [name, get(row, name), word]).filter((key) => key[1] !== null && key[1] !== undefined);
  const toml = (row) => {
    const sections = new Map();
    for (const [name, value, word] of keysOf(row)) {
      const [section, key] = name.split(".");
      if (!sections.has(section)) sections.set(section, []);
      sections.get(section).push(`${key} = ${word ? JSON.stringify(value) : value}`);
    }
    return `# machine ${get(row, "machine")}\n` + [...sections].map(([name, lines]) => `[${name}]\n${lines.join("\n")}\n`).join("\n");
  };
  const quote = (text) => /^[\w./-]+$/.test(text) ? text : `'${text.replaceAll("'", "'\\''")}'`;
  const command = (row) => `edgewalk render ${quote(get(row, "input"))} --machine point.toml` + (get(row, "stalls") === "none" ? "" : ` --stalls ${quote(get(row, "stalls"))}`);
  const varied = (row) => data.varied.map((name) => `${name}=${get(row, name)}`).join(" ") || "the only machine";
  const told = (row) => `${get(row, "input")}, ${varied(row)}` + (get(row, "stalls") === "none" ? "" : `, stalls ${get(row, "stalls")}`);

  let picked = 0, other = null, order = [];
  const names = data.objectives.map((o) => o.name).filter((name) => numeric.includes(name));
  let xName = names[0] ?? numeric[0], yName = names[1] ?? numeric[1] ?? numeric[0];

  const chart = byId("front-chart");
  const select = (id, label, value, change) => {
    const box = document.createElement("label");
    box.append(label);
    const list = document.createElement("select");
    list.id = id;
    for (const name of numeric) list.append(new Option(name, name, false, name === value));
    list.onchange = () => { change(list.value); front(); };
    box.append(list);
    return box;
  };
  byId("front-controls").append(select("x-axis", "across", xName, (v) => xName = v), select("y-axis", "up", yName, (v) => yName = v));

  let place = () => [0, 0];
  const front = () => {
    const shown = rows.map((row, i) => [i, get(row, xName), get(row, yName)]).filter(([, x, y]) => typeof x === "number" && typeof y === "number");
    order = shown.map((p) => p).sort((a, b) => a[1] - b[1] || a[2] - b[2]).map((p) => p[0]);
    const x = scale(extent(shown.map((p) => p[1])), L + 12, W - R - 12), y = scale(extent(shown.map((p) => p[2])), H - B - 12, T + 12);
    place = (i) => [x(get(rows[i], xName)), y(get(rows[i], yName))];
    const dots = shown.filter(([i]) => get(rows[i], "front") !== 1).map(([, a, b]) => `M${x(a).toFixed(1)} ${y(b).toFixed(1)}h0`).join("");
    const diamonds = shown.filter(([i]) => get(rows[i], "front") === 1).map(([i, a, b]) => `<path class="front" data-point="${i}" d="M${x(a).toFixed(1)} ${(y(b) - 6).toFixed(1)}l6 6l-6 6l-6 -6z"/>`).join("");
    chart.innerHTML = `<svg class="chart" viewBox="0 0 ${W} ${H}" tabindex="0" role="application" aria-label="${esc(yName)} over ${esc(xName)}; arrow keys go from point to point, Enter chooses one, b keeps it as the second to compare">` +
      axes(x, y, xName, yName) + `<path class="rest" d="${dots}"/>${diamonds}<circle class="cursor" r="9"/></svg>` +
      `<p class="key">◆ first front: no other machine is at least as good in every objective; • others. Click or use the arrow keys; f goes to the next of the front.</p>`;
    const svg = chart.firstChild;
    const nearest = (event) => {
      const box = svg.getBoundingClientRect(), px = (event.clientX - box.left) / box.width * W, py = (event.clientY - box.top) / box.height * H;
      let best = null, least = 400;
      for (const [i] of shown) { const [a, b] = place(i), d = (a - px) ** 2 + (b - py) ** 2 - (get(rows[i], "front") === 1 ? .5 : 0); if (d < least) { least = d; best = i; } }
      return best;
    };
    svg.onmousemove = (event) => { const i = nearest(event); if (i !== null) say(i); };
    svg.onclick = (event) => { const i = nearest(event); if (i !== null) { if (event.shiftKey) other = i; else picked = i; choose(); } };
    svg.onkeydown = (event) => {
      const now = order.indexOf(picked), step = { ArrowRight: 1, ArrowUp: 1, ArrowLeft: -1, ArrowDown: -1 }[event.key];
      if (step) picked = order[Math.max(0, Math.min(order.length - 1, now + step))];
      else if (event.key === "f") { const on = order.filter((i) => get(rows[i], "front") === 1); picked = on[(on.indexOf(picked) + 1) % on.length] ?? picked; }
      else if (event.key === "b") other = picked;
      else if (event.key !== "Enter" && event.key !== " ") return;
      event.preventDefault();
      if (step || event.key === "f") { say(picked); mark(); } else choose();
    };
    mark();
  };
  const say = (i) => { byId("said").textContent = `${told(rows[i])}: ${yName} ${fmt(get(rows[i], yName))}, ${xName} ${fmt(get(rows[i], xName))}`; };
  const mark = () => {
    const [x, y] = place(picked), cursor = chart.querySelector(".cursor");
    if (Number.isFinite(x) && Number.isFinite(y)) { cursor.setAttribute("cx", x); cursor.setAttribute("cy", y); }
  };
  // The pictures of a machine that draws the same pixels, from the end of the page.
  const picturesOf = (row) => {
    const key = data.pictures[data.same_pixels[get(row, "key")]];
    return key && [...document.querySelectorAll(`#pictures [data-key="${key}"] img`)].map((image) => [image.alt, image.src]);
  };
  const choose = () => {
    const row = rows[picked], text = toml(row), of = picturesOf(row);
    const figures = data.objectives.map((o) => o.name).filter((n) => numeric.includes(n)).map((n) => `${n} ${fmt(get(row, n))}`).join(", ");
    byId("chosen").innerHTML = `<h3>Chosen: ${esc(told(row))}</h3><p>${esc(figures)}; row <code>${esc(get(row, "key"))}</code>, machine <code>${esc(get(row, "machine"))}</code></p>` +
      `<p><code id="command">${esc(command(row))}</code></p><pre id="toml" tabindex="0">${esc(text)}</pre>` +
      `<p><a id="download" download="point.toml" href="data:text/plain;charset=utf-8,${encodeURIComponent(text)}">point.toml</a> <button type="button" id="keep">Compare with this one (b)</button></p>` +
      (of ? `<div class="pictures">${of.map(([name, src]) => `<figure><img alt="${esc(name)}" src="${src}"><figcaption>${esc(name)}</figcaption></figure>`).join("")}</div>`
        : `<p class="key">No picture of this one is kept here; the command above draws it and its error.</p>`);
    byId("keep").onclick = () => { other = picked; choose(); };
    say(picked); mark(); causes(); parallel(); diff();
  };

  // Errors of each channel over its fraction bits, with what is proved.
  const errors = () => {
    const charts = [["z", "formats.z_fraction"], ["color", "formats.color_fraction"]].filter(([, key]) => data.varied.includes(key)).map(([channel, key]) => {
      const points = new Map(), lines = { [`${channel}_bound_for_input`]: new Map(), [`${channel}_bound`]: new Map() };
      for (const row of rows) {
        const bits = get(row, key), error = get(row, `${channel}_error`);
        if (typeof error === "number") points.set(`${bits} ${error}`, [bits, error]);
        for (const [name, line] of Object.entries(lines)) { const v = get(row, name); if (typeof v === "number") line.set(bits, Math.max(v, line.get(bits) ?? 0)); }
      }
      const list = [...points.values()], all = [...list.map((p) => p[1]), ...Object.values(lines).flatMap((l) => [...l.values()])];
      if (!list.length) return "";
      const log = (v) => Math.log10(Math.max(v, 1e-6)), x = scale(extent(list.map((p) => p[0])), L + 12, W - R - 12), y = scale(extent(all.map(log)), H - B - 12, T + 12);
      const yl = Object.assign((v) => y(log(v)), { ticks: y.ticks.map((t) => 10 ** t) });
      x.ticks = [...new Set(list.map((p) => p[0]))].sort((a, b) => a - b);
      const path = (line) => [...line].sort((a, b) => a[0] - b[0]).map(([b, v], i) => `${i ? "L" : "M"}${x(b)} ${yl(v)}`).join("");
      return `<h3>${channel === "z" ? "Depth" : "Colour"}</h3><svg class="chart" viewBox="0 0 ${W} ${H}" role="img" aria-label="largest ${channel} error over its fraction bits, with the proved bounds">` + axes(x, yl, key, "LSB, logarithmic") +
        [`${channel}_bound_for_input`, `${channel}_bound`].flatMap((name) => [...lines[name]]).map(([b, v]) => `<path class="proved" d="M${x(b) - 5} ${yl(v)}h10"/>`).join("") +
        `<path class="rest" d="${list.map(([b, e]) => `M${x(b)} ${yl(e)}h0`).join("")}"/><path class="bound" d="${path(lines[`${channel}_bound_for_input`])}"/><path class="screen-bound" d="${path(lines[`${channel}_bound`])}"/></svg>` +
        `<p class="key">• largest error, simulated; full line: proved for these triangles; dashed: proved for every triangle in the guard band.</p>`;
    }).join("");
    if (charts) { byId("errors").hidden = false; byId("errors-chart").innerHTML = charts; }
  };

  // Bars of parts that add up, for the front and what is chosen.
  const bars = (id, list, parts, value, unit) => {
    const height = 22, most = Math.max(...list.map((i) => parts.reduce((sum, p) => sum + (value(rows[i], p) ?? 0), 0)), 1), wide = 440;
    const used = parts.filter((p) => list.some((i) => value(rows[i], p)));
    const body = list.map((i, line) => {
      let x = 260;
      const all = used.map((part) => {
        const v = value(rows[i], part) ?? 0, w = v / most * wide, k = parts.indexOf(part) % colours.length;
        const bar = v ? `<rect x="${x}" y="${line * height + 3}" width="${w}" height="${height - 6}" fill="url(#${id}${k})" stroke="var(--paper)" stroke-width=".5"><title>${esc(part)}: ${fmt(v)} ${unit}</title></rect>` : "";
        x += w;
        return bar;
      }).join("");
      const text = varied(rows[i]).replace(/[a-z]+\./g, ""), cut = text.length > 42 ? text.slice(0, 41) + "…" : text;
      return `<text x="254" y="${line * height + 15}" text-anchor="end">${i === picked ? "▸ " : ""}${esc(cut)}<title>${esc(told(rows[i]))}</title></text>${all}`;
    }).join("");
    return `<svg class="chart" viewBox="0 0 ${W} ${list.length * height + 4}" role="img" aria-label="${esc(used.join(", "))} of ${list.length} machines, ${unit}">${defs(id)}${body}</svg>` + legendOf(id, used, parts);
  };
  const legendOf = (id, used, parts) => `<ul class="legend">` + used.map((name) => `<li><svg viewBox="0 0 26 14" aria-hidden="true"><rect width="26" height="14" fill="url(#${id}${parts.indexOf(name) % colours.length})"/></svg>${esc(name)}</li>`).join("") + "</ul>";
  const some = () => {
    const on = rows.map((row, i) => i).filter((i) => get(rows[i], "front") === 1).slice(0, 24);
    const list = on.length ? on : rows.map((row, i) => i).slice(0, 24);
    for (const i of [other, picked]) if (i !== null && !list.includes(i)) list.unshift(i);
    return list;
  };
  const causes = () => {
    byId("causes").hidden = false;
    byId("causes-chart").innerHTML = bars("cause", some(), data.causes, (row, cause) => get(row, `cycles_${cause}`), "cycles");
    const list = some().filter((i) => data.units.some((unit) => get(rows[i], `lut4_${unit}`)));
    if (list.length) { byId("area").hidden = false; byId("area-chart").innerHTML = bars("unit", list, data.units, (row, unit) => get(row, `lut4_${unit}`), "LUT4"); }
  };

  const parallel = () => {
    const lanes = [...data.varied.filter((name) => numeric.includes(name)), ...names];
    if (lanes.length < 2) return;
    byId("parallel").hidden = false;
    const gap = (W - 120) / (lanes.length - 1), tops = [58, H - 30];
    const scales = lanes.map((name) => scale(extent(rows.map((row) => get(row, name)).filter((v) => typeof v === "number")), tops[1], tops[0]));
    const stride = Math.ceil(rows.length / 1500);
    const shown = rows.map((row, i) => i).filter((i) => i % stride === 0 || get(rows[i], "front") === 1 || i === picked);
    shown.sort((a, b) => (a === picked) - (b === picked) || (get(rows[a], "front") === 1) - (get(rows[b], "front") === 1));
    const path = (i) => lanes.map((name, k) => { const v = get(rows[i], name); return typeof v === "number" ? `${60 + k * gap} ${scales[k](v).toFixed(1)}` : null; }).filter((p) => p).join("L");
    byId("parallel-chart").innerHTML = `<svg class="chart" viewBox="0 0 ${W} ${H}" role="img" aria-label="parallel coordinates of ${esc(lanes.join(", "))}">` +
      shown.map((i) => `<path class="line${get(rows[i], "front") === 1 ? " on" : ""}${i === picked ? " picked" : ""}" d="M${path(i)}"/>`).join("") +
      lanes.map((name, k) => `<path class="axis" d="M${60 + k * gap} ${tops[0]}V${tops[1]}"/><text x="${60 + k * gap}" y="${k % 2 ? 34 : 18}" text-anchor="middle">${esc(name.replace(/^[a-z]+\./, ""))}</text><text x="${60 + k * gap}" y="${tops[0] - 6}" text-anchor="middle">${fmt(scales[k].high)}</text><text x="${60 + k * gap}" y="${tops[1] + 16}" text-anchor="middle">${fmt(scales[k].low)}</text>`).join("") +
      `</svg><p class="key">Orange: first front; the thick line is the chosen point${stride > 1 ? `; of the others every ${stride}th` : ""}.</p>`;
  };

  const diff = () => {
    if (other === null || other === picked) return;
    const [a, b] = [rows[picked], rows[other]];
    byId("diff").hidden = false;
    const differ = (list) => list.filter((name) => get(a, name) !== get(b, name)).map((name) => {
      const [x, y] = [get(a, name), get(b, name)];
      const change = typeof x === "number" && typeof y === "number" && x ? `${((y - x) / x * 100).toFixed(1)} %` : "";
      return `<tr><th scope="row">${esc(name)}</th><td>${esc(fmt(x))}</td><td>${esc(fmt(y))}</td><td>${change}</td></tr>`;
    }).join("");
    const figures = columns.filter((n) => !["key", "machine", "front", "seconds"].includes(n) && !data.varied.includes(n));
    const pair = [picturesOf(a), picturesOf(b)];
    byId("diff-table").innerHTML = `<table><thead><tr><th>differs in</th><th>chosen</th><th>compared with</th><th>change</th></tr></thead><tbody>${differ(data.varied)}${differ(figures)}</tbody></table>` +
      (pair[0] && pair[1] ? `<figure><canvas id="pixels"></canvas><figcaption id="pixels-said"></figcaption></figure>` : `<p class="key">Pixels: draw both with <code>edgewalk compare A.toml B.toml ${esc(quote(get(a, "input")))}</code>.</p>`);
    if (pair[0] && pair[1]) pixels(pair.map((of) => of[0][1]));
  };
  const load = (src) => new Promise((done) => { const image = new Image(); image.onload = () => done(image); image.src = src; });
  const pixels = async (sources) => {
    const [a, b] = await Promise.all(sources.map(load)), canvas = byId("pixels");
    if (!canvas || a.width !== b.width) return;
    canvas.width = a.width; canvas.height = a.height;
    const context = canvas.getContext("2d", { willReadFrequently: true }), of = (image) => { context.drawImage(image, 0, 0); return context.getImageData(0, 0, a.width, a.height); };
    const one = of(a), two = of(b);
    let count = 0, most = 0;
    for (let i = 0; i < one.data.length; i += 4) {
      const d = Math.max(...[0, 1, 2].map((k) => Math.abs(one.data[i + k] - two.data[i + k])));
      if (d) { count++; most = Math.max(most, d); }
      const v = d ? 80 + d * 0.68 : 0;
      one.data[i] = one.data[i + 1] = v; one.data[i + 2] = d ? 40 : 0;
    }
    context.putImageData(one, 0, 0);
    byId("pixels-said").textContent = `${count} pixels differ, by at most ${most} of 255`;
  };

  const best = rows.findIndex((row) => get(row, "front") === 1);
  picked = best < 0 ? 0 : best;
  front(); errors(); choose();
})();
