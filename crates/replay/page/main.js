// Where the page stands: the cycle, the chosen pixel, and how to go from there.

class App {
  constructor(doc) {
    this.doc = doc;
    this.cycle = 0;
    this.chosen = null;
    this.hex = false;
    this.playing = null;
    this.cells = new Cells(doc);
    // Which links a unit gives on.
    this.gives = new Map(doc.units.map((unit) => [unit.name, []]));
    doc.links.forEach((link, number) => this.gives.get(link.from)?.push(number));
    this.readColours();
    this.strip = new Strip(this);
    this.cards = new Cards(this);
    this.planes = new Planes(this);
    this.tell = new Tell(this);
    this.lesson = new Lesson(this);
    this.steps = doc.links.map((link, number) => ({ ...link.step, number })).filter((step) => step.key).reverse();
    this.moves = new Map(this.steps.map((step) => [step.name, listOf(this.cells.fires[step.number])]));
    this.about();
    this.tools();
    this.keys();
    this.fromAddress();
    this.resize();
    new ResizeObserver(() => this.resize()).observe(document.getElementById("strip"));
    for (const scheme of ["(prefers-color-scheme: dark)", "(forced-colors: active)"]) {
      matchMedia(scheme).addEventListener("change", () => {
        this.readColours();
        this.resize();
      });
    }
    addEventListener("hashchange", () => {
      if (location.hash !== this.address) this.fromAddress();
    });
  }
  readColours() {
    const style = getComputedStyle(document.documentElement);
    const of = (name) => style.getPropertyValue(name).trim();
    this.colours = { ink: of("--ink"), soft: of("--soft"), wait: of("--wait"), cause: [], onCause: [] };
    for (const state of ["fires", "works", "waits", "rests"]) this.colours[state] = of(`--${state}`);
    this.doc.causes.forEach((_, code) => {
      this.colours.cause.push(of(`--k${code % 10}`));
      this.colours.onCause.push(of(`--on${code % 10}`));
    });
  }
  about() {
    const { doc } = this;
    const { name, drawn } = doc.scene;
    const size = doc.store ? ` on ${doc.store.width}\u00d7${doc.store.height}` : "";
    const part = doc.from ? `cycles ${doc.from} to ${doc.from + doc.cycles - 1}` : `${doc.cycles} cycles`;
    const text = `${name} \u00b7 ${drawn}${size} \u00b7 ${part} \u00b7 machine ${doc.machine.hash}`;
    setText(document.getElementById("about"), text);
    document.title = `${name}, edgewalk replay`;
    if (!doc.difference) return;
    const { text: what, expected, found } = doc.difference;
    const banner = document.getElementById("difference");
    banner.hidden = false;
    banner.append(make("b", {}, "First difference: "), what, make("br", {}), "expected ",
      make("code", {}, expected), ", found ", make("code", {}, found));
  }
  label(cycle) {
    return String(cycle + this.doc.from);
  }
  colourOf(kind, token) {
    const parts = kind.swatch.map((place) => {
      const { shape, raw } = kind.fields[place];
      return Math.round((255 * raw[token - 1]) / (2 ** shape.bits - 1));
    });
    return `rgb(${parts.join(", ")})`;
  }
  // Hands over, waits, works or rests.
  stateOf(unit, cycle) {
    const { doc, cells } = this;
    const links = this.gives.get(unit.name);
    if (links.some((number) => cells.fires[number][cycle])) return "fires";
    if (links.some((number) => rawAt(doc.registers[doc.links[number].valid], cycle))) return "waits";
    return unit.works !== null && rawAt(doc.registers[unit.works], cycle) ? "works" : "rests";
  }

  // Goes to a cycle of the recording.
  go(cycle) {
    this.cycle = Math.min(this.doc.cycles - 1, Math.max(0, cycle));
    this.draw();
    if (this.playing === null) {
      this.remember();
      this.speak();
    }
  }
  draw() {
    this.strip.cursor();
    this.strip.drawLanes();
    this.cards.draw();
    this.planes.draw();
    this.tell.draw();
    const cause = this.doc.causes[rawAt(this.strip.cause, this.cycle)];
    setText(this.badge, `${cause.name.toUpperCase()}: ${cause.means}`);
    this.badge.dataset.cause = rawAt(this.strip.cause, this.cycle);
    if (document.activeElement !== this.input) this.input.value = this.label(this.cycle);
  }
  speak() {
    const cause = this.doc.causes[rawAt(this.strip.cause, this.cycle)];
    setText(document.getElementById("live"), `Cycle ${this.label(this.cycle)}, ${cause.name}. ${this.tell.spoken}`);
  }
  resize() {
    this.planes.resize();
    this.strip.drawOverview();
    this.draw();
  }
  // By cells; a fold is one.
  byCell(by) {
    const cell = this.cells.of(this.cycle);
    if (by < 0 && this.cycle > this.cells.start(cell)) return this.go(this.cells.start(cell));
    const to = Math.min(this.cells.length - 1, Math.max(0, cell + by));
    this.go(by > 0 && to === cell ? this.doc.cycles - 1 : this.cells.start(to));
  }
  // To the next, or with -1 the last, of some cycles.
  along(list, by) {
    const place = by > 0 ? upTo(list, this.cycle) : upTo(list, this.cycle - 1) - 1;
    if (place >= 0 && place < list.length) this.go(list[place]);
  }
  toCause(code, by) {
    const { at, raw } = this.strip.cause;
    const starts = [];
    for (let i = 0; i < at.length; i++) if (code === null || raw[i] === code) starts.push(at[i]);
    const now = rawAt(this.strip.cause, this.cycle);
    // Within a run of the cause the next such cycle is the next one.
    if (code !== null && now === code && by > 0 && this.cycle + 1 < this.doc.cycles
      && rawAt(this.strip.cause, this.cycle + 1) === code) return this.go(this.cycle + 1);
    if (code !== null && by < 0) {
      for (let cycle = this.cycle - 1; cycle >= 0; cycle--) if (rawAt(this.strip.cause, cycle) === code) return this.go(cycle);
      return;
    }
    this.along(starts, by);
  }
  choose(pixel) {
    this.chosen = pixel;
    this.draw();
    this.remember();
  }

  play(on) {
    if (this.playing !== null) cancelAnimationFrame(this.playing);
    this.playing = null;
    setText(this.player, on ? "\u275a\u275a Pause" : "\u25b6 Play");
    if (!on) {
      this.remember();
      return this.speak();
    }
    if (this.cycle === this.doc.cycles - 1) this.go(0);
    let before = null, owed = 0;
    const frame = (now) => {
      owed += before === null ? 1 : ((now - before) * this.speed) / 1000;
      before = now;
      const whole = Math.floor(owed);
      owed -= whole;
      if (whole > 0) {
        const cell = this.cells.of(this.cycle);
        if (cell + whole >= this.cells.length) {
          this.go(this.doc.cycles - 1);
          return this.play(false);
        }
        this.go(this.cells.start(cell + whole));
      }
      this.playing = requestAnimationFrame(frame);
    };
    this.playing = requestAnimationFrame(frame);
  }
  setHex(hex) {
    this.hex = hex;
    setText(this.words, hex ? "words: hex" : "words: real");
    this.cards.fit();
    this.draw();
    this.remember();
    this.speak();
  }
  setFold(fold) {
    this.folds.checked = fold;
    this.cells.setFold(fold);
    this.draw();
    this.remember();
  }
  faster(by) {
    this.slider.value = String(Math.min(10, Math.max(0, Number(this.slider.value) + by)));
    this.setSpeed();
  }
  setSpeed() {
    this.speed = 2 ** Number(this.slider.value);
    setText(document.getElementById("speed"), `${this.speed}/s`);
  }
  help() {
    const dialog = document.getElementById("help");
    if (dialog.open) dialog.close();
    else dialog.showModal();
  }

  tools() {
    const find = (id) => document.getElementById(id);
    [this.player, this.slider, this.folds, this.words, this.badge, this.input] =
      ["play", "slider", "folds", "words", "badge", "input"].map(find);
    this.player.addEventListener("click", () => this.play(this.playing === null));
    this.slider.addEventListener("input", () => this.setSpeed());
    this.folds.addEventListener("change", () => this.setFold(this.folds.checked));
    this.words.addEventListener("click", () => this.setHex(!this.hex));
    find("ask").addEventListener("click", () => this.help());
    this.input.max = this.label(this.doc.cycles - 1);
    this.input.min = this.label(0);
    setText(find("last"), `/ ${this.label(this.doc.cycles - 1)}`);
    this.input.addEventListener("change", () => {
      const cycle = Number(this.input.value) - this.doc.from;
      this.input.blur();
      if (Number.isFinite(cycle)) this.go(Math.round(cycle));
    });
    this.setSpeed();
    const box = find("moves");
    const pair = (name, go) => {
      const button = (by, sign, word) => make("button",
        { type: "button", "data-step": name, "data-by": by, "aria-label": `${word} ${name}`, onclick: () => go(by) }, sign);
      box.append(make("span", { class: "pair" }, button(-1, "\u25c0", "previous"), name, button(1, "\u25b6", "next")));
    };
    for (const step of [...this.steps].reverse()) pair(step.name, (by) => this.along(this.moves.get(step.name), by));
    pair("cycle", (by) => this.go(this.cycle + by));
  }
  // Every key, what it does in words, and how.
  keys() {
    const list = [
      [[" "], "Space", "play or pause", () => this.play(this.playing === null)],
      [["ArrowRight"], "\u2192", "next cell; with Shift the next cycle, also inside a fold", (shift) => (shift ? this.go(this.cycle + 1) : this.byCell(1))],
      [["ArrowLeft"], "\u2190", "previous cell; with Shift the previous cycle", (shift) => (shift ? this.go(this.cycle - 1) : this.byCell(-1))],
      [["Home"], "Home", "first cycle", () => this.go(0)],
      [["End"], "End", "last cycle", () => this.go(this.doc.cycles - 1)],
      ...this.steps.map((step) => [[step.key], step.key, `next ${step.name}; with Shift the previous one`,
        (shift) => this.along(this.moves.get(step.name), shift ? -1 : 1)]),
      [["c"], "c", "next change of the cause; with Shift the previous one", (shift) => this.toCause(null, shift ? -1 : 1)],
      [["Enter"], "Enter", "open the fold into a cell a job, or close it", () => {
        this.cells.toggle(this.cycle);
        this.draw();
      }],
      [["f"], "f", "fold dull cycles, or not", () => this.setFold(!this.cells.fold)],
      [["x"], "x", "words as real numbers or in hex", () => this.setHex(!this.hex)],
      [["+", "="], "+", "play faster", () => this.faster(1)],
      [["-"], "-", "play slower", () => this.faster(-1)],
      [["g"], "g", "type a cycle to go to", () => this.input.select()],
      [["?"], "?", "this list", () => this.help()],
    ];
    if (this.lesson.exists) {
      list.push([["]"], "]", "next step of the lesson", () => this.lesson.on && this.lesson.step(this.lesson.at + 1)],
        [["["], "[", "previous step of the lesson", () => this.lesson.on && this.lesson.step(this.lesson.at - 1)]);
    }
    document.getElementById("keys").append(...list.map(([, name, text]) =>
      make("tr", {}, make("th", { scope: "row" }, make("kbd", {}, name)), make("td", {}, text))));
    const of = new Map(list.flatMap(([keys, , , go]) => keys.map((key) => [key, go])));
    document.addEventListener("keydown", (event) => {
      if (event.ctrlKey || event.altKey || event.metaKey) return;
      const { tagName } = event.target;
      const own = tagName === "INPUT" && event.target.type === "number";
      const press = (tagName === "BUTTON" || tagName === "SUMMARY") && [" ", "Enter"].includes(event.key);
      const slide = tagName === "INPUT" && event.target.type === "range" && event.key.startsWith("Arrow");
      const go = of.get(event.key) || of.get(event.key.toLowerCase());
      if (own || press || slide || !go || (document.getElementById("help").open && event.key !== "?")) return;
      event.preventDefault();
      go(event.shiftKey);
    });
  }

  // The state as part of the address, so that it can be sent.
  remember() {
    const parts = [`c=${this.label(this.cycle)}`];
    if (this.chosen) parts.push(`px=${this.chosen.join(",")}`);
    if (this.hex) parts.push("hex");
    if (!this.cells.fold) parts.push("nofold");
    this.address = `#${parts.join("&")}`;
    // Browsers allow only so many changes of the address in a while.
    clearTimeout(this.writing);
    this.writing = setTimeout(() => history.replaceState(null, "", this.address), 150);
  }
  fromAddress() {
    const parts = new URLSearchParams(location.hash.slice(1));
    const start = this.doc.difference ? this.doc.difference.cycle : 0;
    const asked = parts.has("c") ? Number(parts.get("c")) : start;
    const cycle = Number.isFinite(asked) ? Math.round(asked) - this.doc.from : 0;
    this.cycle = Math.min(this.doc.cycles - 1, Math.max(0, cycle));
    const pixel = (parts.get("px") || "").split(",").map(Number);
    const { store } = this.doc;
    const inside = pixel.length === 2 && store && pixel.every((n, i) => Number.isInteger(n) && n >= 0 && n < [store.width, store.height][i]);
    this.chosen = inside ? pixel : null;
    this.hex = parts.has("hex");
    setText(this.words, this.hex ? "words: hex" : "words: real");
    this.folds.checked = !parts.has("nofold");
    this.cells.setFold(this.folds.checked);
    this.cards.fit();
    this.strip.drawOverview();
    this.draw();
    this.speak();
  }
}

decode(document.getElementById("replay").textContent).then(
  (doc) => {
    window.app = new App(doc);
    app.lesson.show(doc.lesson.length > 0 && !location.hash);
    document.body.classList.add("ready");
  },
  (error) => {
    document.getElementById("difference").hidden = false;
    setText(document.getElementById("difference"), error.message);
    document.body.classList.add("failed");
  },
);
