// Errors of each channel over its fraction bits, with what is proved of them.

// By fraction bits the bound of each input, the largest over its machines; a gap where a machine has none, and who lacks it.
const boundsOf = (key, figure) => {
  const all = new Map();
  for (const row of rows) {
    const bits = get(row, key), input = inputOf(row);
    if (!all.has(bits)) all.set(bits, inputs.map(() => []));
    const bound = get(row, figure);
    all.get(bits)[input].push(typeof bound === "number" ? bound : null);
  }
  const known = new Map(), lacking = new Map();
  for (const [bits, of] of all) {
    const without = inputs.filter((name, k) => !of[k].length || of[k].includes(null));
    if (without.length) lacking.set(bits, without);
    else known.set(bits, of.map((bounds) => Math.max(...bounds)));
  }
  return { known, lacking };
};

const errorChart = (channel, key) => {
  const seen = inputs.map(() => new Map());
  for (const row of rows) {
    const error = get(row, `${channel}_error`);
    if (typeof error === "number") seen[inputOf(row)].set(`${get(row, key)} ${error}`, [get(row, key), error]);
  }
  const points = seen.map((of) => [...of.values()]);
  if (!points.some((of) => of.length)) return "";
  const these = boundsOf(key, `${channel}_bound_for_input`), every = boundsOf(key, `${channel}_bound`);
  const errors = [...points.flat().map((p) => p[1]), ...[these, every].flatMap((of) => [...of.known.values()].flat())];
  const all = [...new Set(rows.map((row) => get(row, key)))].sort((a, b) => a - b);
  const log = (v) => Math.log10(Math.max(v, 1e-6)), x = scale(extent(all), L + 12, W - R - 12), straight = scale(extent(errors.map(log)), H - B - 12, T + 12);
  const y = Object.assign((v) => straight(log(v)), { ticks: logTicks(straight.low, straight.high) });
  x.ticks = all;
  // A line for each input, or one where all inputs have the same bounds; it breaks where there is none.
  const lines = (of, name) => {
    const alike = [...of.known.values()].every((bounds) => bounds.every((bound) => bound === bounds[0]));
    const line = (k) => all.map((bits, place) => {
      const bounds = of.known.get(bits);
      return bounds ? `${place && of.known.has(all[place - 1]) ? "L" : "M"}${x(bits)} ${y(bounds[k])}` : "";
    }).join("");
    const dash = (k) => all.filter((bits) => of.known.has(bits)).map((bits) => `M${x(bits) - 5} ${y(of.known.get(bits)[k])}h10`).join("");
    return (alike ? [0] : inputs.map((input, k) => k)).map((k) => {
      const colour = inputs.length > 1 && !alike ? ` style="stroke:${colourOf(k)}"` : "";
      return `<path class="${name}"${colour} data-input="${alike ? "all" : k}" d="${line(k)}"/><path class="proved"${colour} d="${dash(k)}"/>`;
    }).join("");
  };
  const gaps = [...these.lacking].map(([bits, names]) => `<text class="none" data-bits="${bits}" transform="translate(${x(bits) + 4} ${T + 14}) rotate(90)">none for ${esc(names.join(", "))}</text>`).join("");
  const dots = points.map((of, k) => `<path class="points" data-input="${k}" style="fill:${colourOf(k)}" d="${of.map(([bits, error]) => `M${x(bits)} ${y(error)}${shapes[k % shapes.length](3.5)}`).join("")}"/>`).join("");
  return `<h3>${channel === "z" ? "Depth" : "Colour"}</h3><svg class="chart" data-channel="${channel}" viewBox="0 0 ${W} ${H}" role="img" aria-label="largest ${channel} error over its fraction bits, with the proved bounds">` +
    axes(x, y, key, "LSB, logarithmic") + lines(every, "screen-bound") + lines(these, "bound") + dots + gaps + "</svg>" + legend() +
    `<p class="key">Marks: largest error, simulated. Full line: proved for these triangles; dashed: proved for every triangle in the guard band. A line breaks where a machine or an input has no such bound${inputs.length > 1 ? "; each input is held against its own line" : ""}.</p>`;
};
