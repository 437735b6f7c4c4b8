// The cycle in sentences, and the history of the chosen pixel.

class Tell {
  constructor(app) {
    this.app = app;
    const { doc } = app;
    this.says = document.getElementById("says");
    // Room for the sentences of every cycle, so that what stands below does not move.
    this.says.style.setProperty("--room", `${12 + 1.8 * doc.units.length}em`);
    this.past = document.getElementById("past");
    this.names = doc.units.map((unit) => this.namesOf(unit));
    this.moments = [];
    for (const unit of doc.units) {
      for (const moment of unit.moments) {
        const cycles = listOf(cyclesWith(doc, [moment.when]));
        const { shape } = doc.registers[moment.token];
        this.moments.push({ ...moment, cycles, table: shape.table });
      }
    }
    this.findEvents();
  }
  // The registers of a unit by name, for its sentences.
  namesOf(unit) {
    const { registers } = this.app.doc;
    const ids = [...unit.aside];
    for (const item of unit.items) {
      if (item.register !== undefined) ids.push(item.register);
      if (item.table) for (const row of item.table.rows) ids.push(...row.cells);
    }
    return new Map(ids.map((id) => [registers[id].name, id]));
  }
  // What stands for {name} or {name.field}; of a token in a table the row is its name.
  word(names, path, cycle) {
    const { doc, hex } = this.app;
    if (names.has(path)) {
      const register = doc.registers[names.get(path)];
      return textOf(register.shape, rawAt(register, cycle), hex);
    }
    const dot = path.lastIndexOf("."), owner = path.slice(0, dot), wanted = path.slice(dot + 1);
    for (const [name, id] of names) {
      const register = doc.registers[id];
      if (register.shape.kind !== "token" || (name !== owner && !name.startsWith(`${owner}.`))) continue;
      const field = doc.tokens[register.shape.table].fields.find((field) => field.name === wanted);
      const number = rawAt(register, cycle);
      return number && field ? textOf(field.shape, field.raw[number - 1], hex) : NONE;
    }
    return `{${path}}`;
  }
  // The sentences of a cycle, with their units.
  sentences(cycle) {
    const { doc } = this.app;
    const list = [];
    doc.units.forEach((unit, number) => {
      for (const { when, text } of unit.says) {
        if (!rawAt(doc.registers[when], cycle)) continue;
        list.push([unit, text.replace(/\{([^}]+)\}/g, (_, path) => this.word(this.names[number], path, cycle))]);
      }
    });
    return list;
  }
  draw() {
    const { cycle } = this.app;
    const list = this.sentences(cycle);
    this.spoken = list.map(([unit, text]) => `${unit.title} ${text}`).join(" ");
    const lines = list.map(([unit, text], i) => {
      const same = i > 0 && list[i - 1][0] === unit;
      return make("div", {}, make("b", {}, same ? "" : unit.title), make("span", {}, text));
    });
    if (!lines.length) lines.push(make("div", {}, make("b", {}, ""), make("span", {}, "Nothing happens.")));
    this.says.replaceChildren(...lines);
    this.drawPast();
  }
  // By kind and token what happened to it, in order.
  findEvents() {
    const { doc } = this.app;
    this.events = doc.tokens.map(() => new Map());
    this.moments.forEach((moment, number) => {
      const events = this.events[moment.table], register = doc.registers[moment.token];
      for (const cycle of moment.cycles) {
        const token = rawAt(register, cycle);
        if (!events.has(token)) events.set(token, []);
        events.get(token).push([cycle, number]);
      }
    });
    this.byPlace = doc.tokens.map((kind, table) => {
      const map = new Map();
      const field = kind.fields.find((field) => field.shape.kind === "place");
      if (field) {
        for (const token of this.events[table].keys()) {
          const raw = field.raw[token - 1];
          if (!map.has(raw)) map.set(raw, []);
          map.get(raw).push(token);
        }
      }
      return { map, field };
    });
  }
  // A row for every time a token went its way through the moments; a told flag that is 0 ends the way.
  rowsOf([x, y]) {
    const { doc } = this.app;
    const rows = [];
    this.byPlace.forEach(({ map, field }, table) => {
      if (!field) return;
      for (const token of map.get(y * 2 ** field.shape.low + x) || []) {
        const own = [];
        const events = this.events[table].get(token).sort((a, b) => a[0] - b[0] || a[1] - b[1]);
        for (const [cycle, number] of events) {
          let row = own.find((row) => !row.over && row.cycles[number] === undefined && row.last < number);
          if (!row) own.push((row = { table, token, cycles: [], last: -1 }));
          row.cycles[number] = cycle;
          row.last = number;
          const { tells } = this.moments[number];
          row.over = tells.some((id) => doc.registers[id].shape.kind === "flag" && !rawAt(doc.registers[id], cycle));
        }
        rows.push(...own);
      }
    });
    const first = (row) => row.cycles.find((cycle) => cycle !== undefined);
    return rows.sort((a, b) => first(a) - first(b));
  }
  drawPast() {
    const { doc, chosen, cycle, hex } = this.app;
    const title = document.getElementById("past-title");
    if (!chosen) {
      setText(title, "Pixel");
      if (this.shown !== "none") this.past.replaceChildren(make("p", {}, "None chosen: click one in the picture, or go there with Tab and the arrow keys."));
      this.shown = "none";
      return;
    }
    setText(title, `Pixel (${chosen[0]}, ${chosen[1]})`);
    const key = `${chosen}/${hex}`;
    if (this.shown !== key) this.buildPast(chosen);
    this.shown = key;
    for (const { element, at } of this.jumps) element.setAttribute("aria-current", at === cycle ? "true" : "false");
  }
  buildPast(chosen) {
    const { doc, hex } = this.app;
    const rows = this.rowsOf(chosen);
    this.jumps = [];
    if (!rows.length) {
      const words = "Nothing was drawn here in the recorded cycles.";
      return this.past.replaceChildren(make("p", {}, words));
    }
    const heads = ["triangle"];
    for (const moment of this.moments) {
      heads.push(moment.title, ...moment.tells.map((id) => doc.registers[id].name));
    }
    const body = rows.map((row) => {
      const owner = doc.tokens[row.table].owner[row.token - 1];
      const line = make("tr", {}, make("th", { scope: "row" }, `T${owner}`));
      this.moments.forEach((moment, number) => {
        const at = row.cycles[number];
        if (at === undefined) line.append(make("td", {}, NONE));
        else {
          const element = make("button", { type: "button", class: "jump", onclick: () => this.app.go(at) }, this.app.label(at));
          this.jumps.push({ element, at });
          line.append(make("td", {}, element));
        }
        for (const id of moment.tells) {
          const register = doc.registers[id];
          line.append(make("td", {}, at === undefined ? NONE : textOf(register.shape, rawAt(register, at), hex)));
        }
      });
      return line;
    });
    const head = make("tr", {}, ...heads.map((name) => make("th", { scope: "col" }, name)));
    const table = make("table", {}, make("thead", {}, head), make("tbody", {}, ...body));
    this.past.replaceChildren(table, ...this.explain(rows[rows.length - 1]));
    const { command } = doc;
    if (command) {
      const text = command.replace(/\{x\} \{y\}$/, chosen.join(" "));
      this.past.append(make("p", { class: "note" }, "This pixel explained: ", make("code", {}, text)));
    }
  }
  // Beside the machine's value the exact one, the error and its bound.
  explain(row) {
    const { doc } = this.app;
    const kind = doc.tokens[row.table];
    if (!kind.truth.length) return [];
    const lines = [];
    for (const truth of kind.truth) {
      const raw = truth.error[row.token - 1];
      const field = kind.fields.find((field) => field.name === truth.field);
      if (raw === -(2 ** 31)) continue;
      const value = Number(numberOf(field.shape, field.raw[row.token - 1])), error = raw / 2 ** truth.fraction;
      const sign = (number) => (number < 0 ? MINUS : "+") + Math.abs(number).toFixed(3);
      lines.push(make("tr", {}, make("th", { scope: "row" }, field.name), make("td", {}, String(value)),
        make("td", {}, (value - error).toFixed(3)), make("td", {}, sign(error)),
        make("td", { title: truth.why || "" }, truth.bound === null ? "none" : truth.bound.toFixed(3))));
    }
    if (!lines.length) return [];
    const head = ["", "machine", "exact", "error", "bound"].map((name) => make("th", { scope: "col" }, name));
    const owner = `Triangle T${kind.owner[row.token - 1]} here, LSB`;
    return [make("h3", {}, owner), make("table", { "aria-label": owner },
      make("thead", {}, make("tr", {}, ...head)), make("tbody", {}, ...lines))];
  }
}
