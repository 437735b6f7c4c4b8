// The whole run at a glance, and the lanes around the cycle.

const CELL = 20, FOLDED = 64, ROW = 18, NAMES = 74;
// Pixels between ticks over the run, at least.
const TICKS = 8;

class Strip {
  constructor(app) {
    this.app = app;
    const { doc } = app;
    this.overview = document.getElementById("overview");
    this.lanes = document.getElementById("lanes");
    this.cause = doc.registers[doc.cause];
    this.counts = new Array(doc.causes.length).fill(0);
    const { at, raw } = this.cause;
    for (let i = 0; i < at.length; i++) {
      this.counts[raw[i]] += (i + 1 < at.length ? at[i + 1] : doc.cycles) - at[i];
    }
    const stepped = doc.links.findIndex((link) => link.step);
    this.marks = stepped < 0 ? [] : listOf(app.cells.fires[stepped]);
    const giver = stepped < 0 ? null : doc.units.find((unit) => unit.name === doc.links[stepped].from);
    this.owner = giver && giver.triangle !== null ? doc.registers[giver.triangle] : null;
    this.legend();
    this.overview.addEventListener("click", (event) => {
      const box = this.overview.getBoundingClientRect();
      const part = (event.clientX - box.left) / box.width;
      app.go(Math.min(doc.cycles - 1, Math.max(0, Math.floor(part * doc.cycles))));
    });
    this.lanes.addEventListener("click", (event) => {
      const place = event.clientX - this.lanes.getBoundingClientRect().left;
      const hit = this.shown.find((cell) => place >= cell.left && place < cell.left + cell.width);
      if (hit) app.go(hit.cycle);
    });
  }
  legend() {
    const { doc } = this.app;
    const list = document.getElementById("legend");
    doc.causes.forEach((cause, code) => {
      if (!this.counts[code]) return;
      const share = ((100 * this.counts[code]) / doc.cycles).toFixed(1);
      const swatch = make("i", { class: `swatch k${code}`, "aria-hidden": "true" }, cause.letter);
      const text = make("span", {}, make("b", {}, cause.name), ` ${this.counts[code]} (${share} %)`);
      const title = `${cause.means}; click: to the next such cycle, with Shift to the one before`;
      const button = make("button", { type: "button", title, "data-cause": code }, swatch, text);
      button.addEventListener("click", (event) => this.app.toCause(code, event.shiftKey ? -1 : 1));
      list.append(button);
    });
  }
  // A canvas of the size it has on the page, and what to draw with.
  pen(canvas, height) {
    const width = (this.width = canvas.clientWidth), ratio = window.devicePixelRatio || 1;
    if (canvas.width !== Math.round(width * ratio) || canvas.height !== Math.round(height * ratio)) {
      canvas.width = Math.round(width * ratio);
      canvas.height = Math.round(height * ratio);
      canvas.style.height = `${height}px`;
    }
    const pen = canvas.getContext("2d");
    pen.setTransform(ratio, 0, 0, ratio, 0, 0);
    pen.clearRect(0, 0, width, height);
    pen.font = "11px system-ui, sans-serif";
    pen.textBaseline = "middle";
    return [pen, width];
  }
  drawOverview() {
    const { doc, colours } = this.app;
    const met = this.counts.map((count, code) => [count, code]).filter(([count]) => count).map(([, code]) => code);
    const top = 15, bar = 20, thin = 3;
    const height = top + bar + 4 + thin * met.length + 5;
    const [pen, width] = this.pen(this.overview, height);
    const { at, raw } = this.cause;
    let change = 0;
    for (let column = 0; column < width; column++) {
      const from = (column * doc.cycles) / width, to = ((column + 1) * doc.cycles) / width;
      const share = new Map();
      while (change + 1 < at.length && at[change + 1] <= from) change++;
      for (let i = change; i < at.length && (i === change || at[i] < to); i++) {
        const end = Math.min(to, i + 1 < at.length ? at[i + 1] : doc.cycles);
        share.set(raw[i], (share.get(raw[i]) || 0) + end - Math.max(from, at[i]));
      }
      let y = top;
      for (const [code, part] of share) {
        const high = (bar * part) / (to - from);
        pen.fillStyle = colours.cause[code];
        pen.fillRect(column, y, 1.5, high);
        y += high;
        pen.fillRect(column, top + bar + 4 + thin * met.indexOf(code), 1.5, thin - 1);
      }
    }
    pen.fillStyle = colours.ink;
    this.ticks = this.placed(pen, width);
    for (const { left, label } of this.ticks) {
      pen.fillRect(left, label ? 0 : top - 3, 1, label ? top : 3);
      pen.fillText(label, left + 3, 6);
    }
    this.whole = document.createElement("canvas");
    this.whole.width = this.overview.width;
    this.whole.height = this.overview.height;
    this.whole.getContext("2d").drawImage(this.overview, 0, 0);
  }
  // The marks that have room: their names where these do not touch, ticks alone where they are far enough apart.
  placed(pen, width) {
    const { doc } = this.app;
    const ticks = [];
    let free = 0;
    for (const cycle of this.marks) {
      const left = ((cycle + 0.5) * width) / doc.cycles;
      const name = this.owner ? textOf(this.owner.shape, rawAt(this.owner, cycle), false) : "";
      const right = left + 3 + pen.measureText(name).width;
      const label = left >= free && right < width ? name : "";
      if (label) free = right + 7;
      const near = ticks.length > 0 && left - ticks[ticks.length - 1].left < TICKS;
      if (near && label) ticks.pop();
      if (!near || label) ticks.push({ left, label });
    }
    return ticks;
  }
  cursor() {
    const { doc, cycle, colours } = this.app;
    const pen = this.overview.getContext("2d");
    const width = this.width, ratio = window.devicePixelRatio || 1;
    pen.setTransform(1, 0, 0, 1, 0, 0);
    pen.clearRect(0, 0, this.whole.width, this.whole.height);
    pen.drawImage(this.whole, 0, 0);
    pen.setTransform(ratio, 0, 0, ratio, 0, 0);
    const left = ((cycle + 0.5) * width) / doc.cycles, bottom = this.overview.clientHeight;
    pen.fillStyle = colours.ink;
    pen.fillRect(left - 1, 0, 2, bottom);
    pen.beginPath();
    pen.moveTo(left - 5, bottom);
    pen.lineTo(left + 5, bottom);
    pen.lineTo(left, bottom - 6);
    pen.fill();
  }
  drawLanes() {
    const { doc, cells, cycle, colours } = this.app;
    const units = doc.units.filter((unit) => unit.lane !== null);
    const height = ROW * (units.length + 1) + 4;
    const [pen, width] = this.pen(this.lanes, height);
    const here = cells.of(cycle);
    // The cell of the cycle stands at two fifths, but near the ends of the run.
    const wide = (cell) => (cells.size(cell) > 1 ? FOLDED : CELL);
    let first = here, before = (width - NAMES) * 0.4;
    while (first > 0 && before > wide(first - 1)) before -= wide(--first);
    let room = 0;
    for (let cell = first; cell < cells.length && room < width - NAMES; cell++) room += wide(cell);
    while (first > 0 && room + wide(first - 1) < width - NAMES) room += wide(--first);
    pen.fillStyle = colours.soft;
    ["cause", ...units.map((unit) => unit.title)].forEach((name, row) => {
      pen.fillText(name, 0, row * ROW + ROW / 2 + 2, NAMES - 6);
    });
    this.shown = [];
    let left = NAMES;
    for (let cell = first; cell < cells.length && left + 8 < width; cell++) {
      const box = { left, width: wide(cell), cycle: cells.start(cell), size: cells.size(cell) };
      this.shown.push(box);
      this.drawCause(pen, box);
      units.forEach((unit, row) => this.drawLane(pen, box, unit, (row + 1) * ROW + 2));
      if (cell === here) {
        pen.strokeStyle = colours.ink;
        pen.lineWidth = 2;
        pen.strokeRect(left, 1, box.width - 1, height - 2);
      }
      left += box.width;
    }
  }
  drawCause(pen, box) {
    const { doc, colours } = this.app;
    const code = rawAt(this.cause, box.cycle);
    pen.fillStyle = colours.cause[code];
    pen.fillRect(box.left + 0.5, 2.5, box.width - 1, ROW - 2);
    pen.fillStyle = colours.onCause[code];
    pen.textAlign = "center";
    const letter = doc.causes[code].letter;
    pen.fillText(box.size > 1 ? `${letter} \u00d7${box.size}` : letter, box.left + box.width / 2, ROW / 2 + 2);
    pen.textAlign = "left";
  }
  drawLane(pen, box, unit, top) {
    const { app } = this;
    const { doc, colours } = app;
    const state = app.stateOf(unit, box.cycle);
    pen.fillStyle = colours[state];
    pen.fillRect(box.left + 0.5, top + 0.5, box.width - 1, ROW - 2);
    if (state === "waits") {
      pen.fillStyle = colours.wait;
      pen.fillRect(box.left + box.width - 4, top + 0.5, 3, ROW - 2);
    }
    if (state === "rests") return;
    pen.fillStyle = colours.ink;
    pen.textAlign = "center";
    const lane = doc.registers[unit.lane];
    const text = box.size > 1 ? "\u2026" : textOf(lane.shape, rawAt(lane, box.cycle), app.hex);
    pen.fillText(text, box.left + box.width / 2 - (state === "waits" ? 1 : 0), top + ROW / 2, box.width - 2);
    pen.textAlign = "left";
  }
}
