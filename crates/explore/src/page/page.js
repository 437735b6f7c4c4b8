// The page: a point is chosen in the front, everything else follows it.
const numeric = columns.filter((name) => rows.some((row) => typeof row[at[name]] === "number") && name !== "front");

const start = () => {
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
  const command = (row) => `edgewalk render ${quote(get(row, "input"))} --machine point.toml` + (get(row, "shading") && get(row, "shading") !== "gouraud" ? ` --shading ${get(row, "shading")}` : "") + (get(row, "stalls") === "none" ? "" : ` --stalls ${quote(get(row, "stalls"))}`);
  const varied = (row) => data.varied.map((name) => `${name}=${get(row, name)}`).join(" ") || "the only machine";
  const told = (row) => `${get(row, "input")}, ${varied(row)}` + (get(row, "stalls") === "none" ? "" : `, stalls ${get(row, "stalls")}`);
  // What tells a row from the others: its input and memory where there are several, and the varied keys.
  const label = (row) => [inputs.length > 1 ? get(row, "input") : "", data.memories.length > 1 ? memoryName[get(row, "stalls")] : "", varied(row).replace(/[a-z]+\./g, "")].filter((word) => word).join(" ");

  let picked = 0, other = null, order = [];
  const names = data.objectives.map((o) => o.name).filter((name) => numeric.includes(name));
  let xName = names[0] ?? numeric[0], yName = names[1] ?? numeric[1] ?? numeric[0];

  const chart = byId("front-chart");
  const select = (id, label, options, value, change) => {
    const box = document.createElement("label");
    box.append(label);
    const list = document.createElement("select");
    list.id = id;
    for (const [name, option] of options) list.append(new Option(name, option, false, option === value));
    list.onchange = () => { change(list.value); front(); };
    box.append(list);
    return box;
  };
  const named = numeric.map((name) => [name, name]), only = { input: "", stalls: "" };
  byId("front-controls").append(select("x-axis", "across", named, xName, (v) => xName = v), select("y-axis", "up", named, yName, (v) => yName = v));
  if (inputs.length > 1) byId("front-controls").append(select("only-input", "input", [["all", ""], ...inputs.map((name) => [name, name])], "", (v) => only.input = v));
  if (data.memories.length > 1) byId("front-controls").append(select("only-memory", "memory", [["all", ""], ...data.memories.map(([stalls, name]) => [name, stalls])], "", (v) => only.stalls = v));

  // Rows beyond the limit of a figure are not shown; a figure that is not known keeps no limit.
  const limit = { name: "", most: true, value: NaN };
  const keeps = (row) => { const v = get(row, limit.name); return !limit.name || Number.isNaN(limit.value) || (typeof v === "number" && (limit.most ? v <= limit.value : v >= limit.value)); };
  const number = document.createElement("input");
  Object.assign(number, { id: "limit-value", type: "number", step: "any", ariaLabel: "limit" });
  number.oninput = () => { limit.value = number.value === "" ? NaN : Number(number.value); front(); };
  byId("front-controls").append(select("limit-figure", "only", [["all", ""], ...named], "", (v) => limit.name = v), select("limit-way", "", [["at most", "most"], ["at least", "least"]], "most", (v) => limit.most = v === "most"), number);

  let place = () => [0, 0];
  const front = () => {
    const shown = rows.map((row, i) => [i, get(row, xName), get(row, yName)]).filter(([i, x, y]) => typeof x === "number" && typeof y === "number" && keeps(rows[i]) && Object.entries(only).every(([name, value]) => !value || get(rows[i], name) === value));
    order = shown.map((p) => p).sort((a, b) => a[1] - b[1] || a[2] - b[2]).map((p) => p[0]);
    const x = scale(extent(shown.map((p) => p[1])), L + 12, W - R - 12), y = scale(extent(shown.map((p) => p[2])), H - B - 12, T + 12);
    place = (i) => [x(get(rows[i], xName)), y(get(rows[i], yName))];
    const dots = inputs.map((input, k) => `<path class="rest" style="fill:${colourOf(k)}" data-input="${k}" d="${shown.filter(([i]) => get(rows[i], "front") !== 1 && inputOf(rows[i]) === k).map(([, a, b]) => mark(k, x(a), y(b), 3)).join("")}"/>`).join("");
    // With one input its machines on the front are diamonds.
    const diamonds = shown.filter(([i]) => get(rows[i], "front") === 1).map(([i, a, b]) => `<path class="front" data-point="${i}" data-input="${inputOf(rows[i])}" style="fill:${inputs.length > 1 ? colourOf(inputOf(rows[i])) : ""}" d="${mark(inputs.length > 1 ? inputOf(rows[i]) : 3, x(a), y(b), 5)}"/>`).join("");
    chart.innerHTML = `<svg class="chart" viewBox="0 0 ${W} ${H}" tabindex="0" role="application" aria-label="${esc(yName)} over ${esc(xName)}; arrow keys go from point to point, Enter chooses one, b keeps it as the second to compare">` +
      axes(x, y, xName, yName) + `${dots}${diamonds}<circle class="cursor" r="9"/></svg>` + legend() +
      `<p class="key">${inputs.length > 1 ? "Large, with an edge" : "◆"}: first front, no other machine is at least as good in every objective; small: others. A mark is a machine on one input${data.memories.length > 1 ? " with one memory" : ""}. Click or use the arrow keys; f goes to the next of the front.</p>`;
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
      if (step || event.key === "f") { say(picked); point(); } else choose();
    };
    point();
  };
  const say = (i) => { byId("said").textContent = `${told(rows[i])}: ${yName} ${fmt(get(rows[i], yName))}, ${xName} ${fmt(get(rows[i], xName))}`; };
  const point = () => {
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
    say(picked); point(); causes(); parallel(); diff();
  };

  const errors = () => {
    const charts = [["z", "formats.z_fraction"], ["color", "formats.color_fraction"]].filter(([, key]) => data.varied.includes(key)).map(([channel, key]) => errorChart(channel, key)).join("");
    if (charts) { byId("errors").hidden = false; byId("errors-chart").innerHTML = charts; }
  };

  // Bars of parts that add up, for the front and what is chosen.
  const bars = (id, list, parts, value, unit) => {
    const height = 22, most = Math.max(...list.map((i) => parts.reduce((sum, p) => sum + (value(rows[i], p) ?? 0), 0)), 1), wide = 340;
    const used = parts.filter((p) => list.some((i) => value(rows[i], p)));
    const body = list.map((i, line) => {
      let x = 366;
      const all = used.map((part) => {
        const v = value(rows[i], part) ?? 0, w = v / most * wide, k = parts.indexOf(part) % colours.length;
        const bar = v ? `<rect x="${x}" y="${line * height + 3}" width="${w}" height="${height - 6}" fill="url(#${id}${k})" stroke="var(--paper)" stroke-width=".5"><title>${esc(part)}: ${fmt(v)} ${unit}</title></rect>` : "";
        x += w;
        return bar;
      }).join("");
      const text = label(rows[i]), cut = text.length > 60 ? text.slice(0, 59) + "…" : text;
      return `<text class="bar-label" x="360" y="${line * height + 15}" text-anchor="end">${i === picked ? "▸ " : ""}${esc(cut)}<title>${esc(told(rows[i]))}</title></text>${all}`;
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
};
if (rows.length) start();
