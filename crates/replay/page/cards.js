// A card a unit, with the links between them.

class Cards {
  constructor(app) {
    this.app = app;
    // What is to be kept up to date: an element, and the register or field it shows.
    this.values = [];
    this.links = [];
    this.bars = [];
    this.heads = [];
    const { doc } = app;
    const columns = this.columns();
    const row = document.getElementById("cards");
    columns.forEach((units, column) => {
      const links = column > 0 ? [this.gutter(columns, column)] : [];
      // The links go with the cards they lead to, where those begin a new row.
      row.append(make("div", { class: "stage" }, ...links,
        make("div", { class: "column" }, ...units.map((unit) => this.card(unit, columns)))));
    });
    if (!doc.units.length) row.append("This recording has no units.");
  }
  // Units side by side, each right of those that give to it.
  columns() {
    const { doc } = this.app;
    const rank = new Map(doc.units.map((unit) => [unit.name, 0]));
    for (let pass = 0; pass < doc.units.length; pass++) {
      for (const { from, to } of doc.links) {
        if (rank.has(from) && rank.has(to) && rank.get(to) <= rank.get(from)) {
          rank.set(to, Math.min(rank.get(from) + 1, doc.units.length - 1));
        }
      }
    }
    this.rank = rank;
    const columns = [];
    for (const unit of doc.units) (columns[rank.get(unit.name)] ||= []).push(unit);
    return columns.filter(Boolean);
  }
  between(link) {
    return this.rank.has(link.from) && this.rank.has(link.to) && this.rank.get(link.to) === this.rank.get(link.from) + 1;
  }
  titleOf(name) {
    const unit = this.app.doc.units.find((unit) => unit.name === name);
    return unit ? unit.title : "outside";
  }
  gutter(columns, column) {
    const from = new Set(columns[column - 1].map((unit) => unit.name));
    const crowded = columns[column - 1].length + columns[column].length > 2;
    const links = this.app.doc.links.filter((link) => this.between(link) && from.has(link.from));
    const boxes = links.map((link) => {
      const word = make("span", { class: "word" });
      const ends = crowded ? [make("small", {}, `${this.titleOf(link.from)} \u2192 ${this.titleOf(link.to)}`)] : [];
      const box = make("div", { class: "link", "data-link": link.name }, ...ends,
        make("span", {}, link.name), make("span", { class: "arrow", "aria-hidden": "true" }), word);
      this.links.push({ link, box, word });
      return box;
    });
    return make("div", { class: "gutter" }, ...boxes);
  }
  card(unit) {
    const { doc } = this.app;
    const head = make("header", {}, make("h2", {}, unit.title));
    if (unit.triangle !== null) head.append(this.value(unit.triangle, "b", "the triangle it works on"));
    if (unit.section) head.append(make("small", { title: `docs/machine.md, section ${unit.section}` }, `\u00a7${unit.section}`));
    const card = make("section", { class: "card", "data-unit": unit.name, title: unit.does, "aria-label": unit.title }, head);
    let list = null;
    const singles = unit.items.filter((item) => item.register !== undefined).length;
    for (const item of unit.items) {
      if (item.register === undefined) list = null;
      else if (!list) card.append((list = make("dl", { class: singles > 4 ? "pairs" : "" })));
      if (item.register !== undefined) this.single(list, item.register);
      else if (item.table) card.append(this.table(item.table));
      else if (item.schedule) card.append(this.bar(item.schedule));
    }
    const others = doc.links.filter((link) => !this.between(link) && (link.from === unit.name || link.to === unit.name));
    if (others.length) card.append(make("div", { class: "chips" }, ...others.map((link) => this.chip(link, unit))));
    for (const note of unit.notes) card.append(make("p", { class: "note" }, note));
    this.heads.push({ unit, card });
    return card;
  }
  chip(link, unit) {
    const word = make("span", { class: "word" });
    const other = link.from === unit.name ? link.to : link.from;
    const arrow = link.from === unit.name ? "\u2192" : "\u2190";
    const far = other === null ? "" : ` ${this.titleOf(other)}`;
    const box = make("span", { class: "chip", "data-link": link.name }, `${arrow} ${link.name}${far} `, word);
    this.links.push({ link, box, word });
    return box;
  }
  single(list, id) {
    const register = this.app.doc.registers[id];
    list.append(make("dt", { title: register.doc }, register.name.replaceAll("_", " ")), this.value(id, "dd"));
  }
  // An element that always shows a register.
  value(id, tag, title) {
    const register = this.app.doc.registers[id];
    const element = make(tag, { class: "value", "data-register": id, title: title || register.doc });
    this.values.push({ element, id, register, shape: register.shape, list: register.raw });
    return element;
  }
  // The cells of a token: one a field, and a swatch for its colour.
  tokenCells(id, brief) {
    const register = this.app.doc.registers[id];
    const kind = this.app.doc.tokens[register.shape.table];
    const cells = [];
    kind.fields.forEach((field, place) => {
      if (field.brief !== brief) return;
      const element = make("td", { class: "value", "data-register": id, "data-field": place, title: register.doc });
      this.values.push({ element, id, register, shape: field.shape, list: field.raw, field });
      cells.push(element);
    });
    if (brief && kind.swatch) {
      const element = make("i", { class: "swatch", "aria-hidden": "true" });
      this.values.push({ element, id, register, kind, swatch: true });
      cells.push(make("td", {}, element));
    }
    return cells;
  }
  kindOf(id) {
    const { doc } = this.app;
    const { shape } = doc.registers[id];
    return shape.kind === "token" ? doc.tokens[shape.table] : null;
  }
  table(table) {
    const titled = make("h3", {}, table.title);
    const tokens = table.rows.length && table.rows[0].cells.some((id) => this.kindOf(id)?.fields.some((field) => !field.brief));
    const box = table.folded ? make("details", {}, make("summary", {}, table.title)) : make("div", { class: "table" }, titled);
    box.append(this.grid(table, true));
    if (tokens) box.append(make("details", {}, make("summary", {}, "all fields"), this.grid(table, false)));
    return box;
  }
  grid(table, brief) {
    const heads = [make("th", {}, "")], body = make("tbody", {});
    const sample = table.rows.length ? table.rows[0].cells : [];
    const head = (name) => heads.push(make("th", { scope: "col" }, name));
    sample.forEach((id, place) => {
      const kind = this.kindOf(id);
      if (kind) {
        for (const field of kind.fields) if (field.brief === brief) head(field.name);
        if (brief && kind.swatch) head("\u25a0");
      } else if (brief) head(table.columns[place]);
    });
    for (const row of table.rows) {
      const line = make("tr", {}, make("th", { scope: "row" }, row.name));
      for (const id of row.cells) {
        if (this.kindOf(id)) line.append(...this.tokenCells(id, brief));
        else if (brief) line.append(this.value(id, "td"));
      }
      body.append(line);
    }
    return make("table", { "aria-label": table.title }, make("thead", {}, make("tr", {}, ...heads)), body);
  }
  bar({ job, during }) {
    const element = make("div", { class: "bar", role: "img", "aria-label": "progress of the work" });
    this.bars.push({ element, job: this.app.doc.registers[job], during: this.app.doc.registers[during], from: -1 });
    return element;
  }
  // Room for the longest text of the run, so that nothing moves.
  fit() {
    for (const value of this.values) {
      if (value.swatch) continue;
      value.element.style.minWidth = `${1.02 * widthOf(value.shape, value.list, this.app.hex)}ch`;
    }
  }
  draw() {
    const { doc, cycle, hex } = this.app;
    for (const value of this.values) {
      const { element, register, field } = value;
      const own = rawAt(register, cycle);
      const live = register.live === null || rawAt(doc.registers[register.live], cycle) !== 0;
      if (value.swatch) {
        element.style.background = own ? this.app.colourOf(value.kind, own) : "none";
      } else if (value.own !== own || value.hex !== hex) {
        const none = field && !own;
        setText(element, none ? NONE : textOf(value.shape, field ? field.raw[own - 1] : own, hex));
        value.own = own;
        value.hex = hex;
      }
      const pale = !live || (field && !own);
      const look = pale ? "pale" : changedAt(register, cycle) ? "moved" : "";
      if (value.look !== look) {
        element.classList.toggle("pale", look === "pale");
        element.classList.toggle("moved", look === "moved");
        value.look = look;
      }
    }
    for (const { link, box, word } of this.links) {
      const valid = rawAt(doc.registers[link.valid], cycle), ready = rawAt(doc.registers[link.ready], cycle);
      const state = valid ? (ready ? "fires" : "waits") : ready ? "ready" : "not ready";
      setText(word, state);
      box.dataset.look = state;
    }
    for (const { unit, card } of this.heads) card.dataset.look = this.app.stateOf(unit, cycle);
    for (const bar of this.bars) this.drawBar(bar);
  }
  // The jobs of the work that is going on, in their true proportion.
  drawBar(bar) {
    const { doc, cycle } = this.app;
    const { during, job, element } = bar;
    const change = place(during, cycle);
    if (during.raw[change] === 0) {
      if (bar.from !== -1) element.replaceChildren();
      bar.from = -1;
      return;
    }
    const from = during.at[change], to = change + 1 < during.at.length ? during.at[change + 1] : doc.cycles;
    if (bar.from !== from) {
      bar.from = from;
      bar.parts = [];
      for (let i = place(job, from); i < job.at.length && job.at[i] < to; i++) {
        const end = Math.min(to, i + 1 < job.at.length ? job.at[i + 1] : to);
        const start = Math.max(from, job.at[i]);
        const part = make("i", { title: `${job.shape.words[job.raw[i]]}, ${end - start} clocks` });
        part.style.flexGrow = end - start;
        bar.parts.push({ part, start, end });
      }
      element.replaceChildren(...bar.parts.map(({ part }) => part));
    }
    for (const { part, start, end } of bar.parts) {
      part.className = cycle >= end ? "done" : cycle >= start ? "now" : "";
    }
  }
}
