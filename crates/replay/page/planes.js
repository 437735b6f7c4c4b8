// The picture as memory holds it, and where the units are on it.

class Planes {
  constructor(app) {
    this.app = app;
    this.views = [];
    const { doc } = app;
    const { store } = doc;
    if (!store) return;
    this.lists = store.planes.map((plane) => this.listOf(plane));
    if (!store.planes.length) return;
    ({ kind: this.kind, cycles: this.cycles, numbers: this.numbers } = this.lists[0]);
    this.address = this.kind.fields[0];
    for (const list of this.lists) this.findOverwritten(list);
    for (const plane of store.planes) this.add(plane);
  }
  // The writes of a plane: cycles, and which token.
  listOf({ when, token, enable, page }) {
    const { doc } = this.app;
    const register = doc.registers[token];
    const cycles = listOf(cyclesWith(doc, [when, enable, page.during].filter(Number.isInteger)));
    const numbers = cycles.map((cycle) => rawAt(register, cycle));
    return { kind: doc.tokens[register.shape.table], cycles, numbers, page, applied: 0 };
  }
  pixelOf(token, page) {
    const { x, y } = pixelOfPlace(this.address.shape, this.address.raw[token - 1]);
    return y * page.width + x;
  }
  // For every write the one before it at the same pixel, so that time can run back.
  findOverwritten(list) {
    const { width, height } = list.page;
    const last = new Int32Array(width * height).fill(-1);
    list.before = new Int32Array(list.cycles.length);
    list.numbers.forEach((number, i) => {
      const pixel = this.pixelOf(number, list.page);
      list.before[i] = last[pixel];
      last[pixel] = i;
    });
  }
  add(plane) {
    const { width, height } = plane.page;
    const canvas = make("canvas", { width, height });
    const marks = make("canvas", { class: "marks", tabindex: "0", role: "img" });
    const frame = make("div", { class: "frame" }, canvas, marks);
    const note = make("small", {});
    const under = make("p", { class: "under" });
    const panel = make("section", { class: "panel plane" }, make("h2", {}, plane.title, " ", note), frame, under);
    document.getElementById("planes").append(panel);
    const pen = canvas.getContext("2d");
    const list = this.lists[this.views.length];
    const view = { plane, list, canvas, marks, frame, note, under, pen, image: pen.createImageData(width, height),
      top: new Int32Array(width * height) };
    if (plane.scalar !== undefined) this.range(view);
    this.views.push(view);
    // A pixel is chosen in the picture; its history is that of the picture.
    if (!plane.map) {
      marks.addEventListener("click", (event) => this.click(view, event));
      marks.addEventListener("keydown", (event) => this.key(event));
    }
    for (let pixel = 0; pixel < width * height; pixel++) this.paint(view, pixel, -1);
  }
  // Nearest and farthest value of the run, for the scale of colours.
  range(view) {
    const { shape, raw } = this.kind.fields[view.plane.scalar + 1];
    const values = Array.from(view.list.numbers, (number) => Number(numberOf(shape, raw[number - 1])));
    const empty = Number(numberOf(shape, this.beforeOf(view, view.plane.scalar)[0]));
    view.empty = empty;
    const list = values.length ? values : [empty];
    view.least = list.reduce((a, b) => Math.min(a, b));
    view.most = list.reduce((a, b) => Math.max(a, b));
  }
  beforeOf({ plane }, channel) {
    return plane.map ? plane.before : plane.page.before[channel];
  }
  valueAt(view, channel, write, pixel) {
    if (write < 0) return this.beforeOf(view, channel)[pixel];
    return this.kind.fields[channel + 1].raw[view.list.numbers[write] - 1];
  }
  paint(view, pixel, write) {
    const { plane, image } = view;
    view.top[pixel] = write;
    const place = 4 * pixel;
    if (plane.colour) {
      for (let i = 0; i < 3; i++) {
        image.data[place + i] = (255 * this.valueAt(view, plane.colour[i], write, pixel)) / (2 ** plane.bits - 1);
      }
    } else {
      const { shape } = this.kind.fields[plane.scalar + 1];
      const value = Number(numberOf(shape, this.valueAt(view, plane.scalar, write, pixel)));
      const far = view.most > view.least ? (value - view.least) / (view.most - view.least) : 0;
      const shade = Math.min(1, Math.max(0, plane.bright ? 1 - far : far));
      const colour = write < 0 && value === view.empty ? [30, 32, 44] : nearToFar(shade);
      for (let i = 0; i < 3; i++) image.data[place + i] = colour[i];
    }
    image.data[place + 3] = 255;
  }
  // Brings the pictures to a cycle: those writes are seen that fired before it.
  draw() {
    if (!this.kind) return;
    for (const view of this.views) {
      const { list } = view;
      const wanted = upTo(list.cycles, this.app.cycle - 1);
      for (let i = list.applied; i < wanted; i++) this.paint(view, this.pixelOf(list.numbers[i], list.page), i);
      for (let i = list.applied - 1; i >= wanted; i--) this.paint(view, this.pixelOf(list.numbers[i], list.page), list.before[i]);
      list.applied = wanted;
      view.pen.putImageData(view.image, 0, 0);
      const size = `${list.page.width}\u00d7${list.page.height}`;
      setText(view.note, `${size}, ${wanted} of ${list.cycles.length} writes`);
      this.drawMarks(view);
      this.tell(view);
    }
  }
  // The chosen pixel in words, beside the picture.
  tell(view) {
    const { chosen, doc } = this.app;
    const { plane } = view;
    if (!chosen || plane.map) {
      view.marks.setAttribute("aria-label", plane.map ? plane.title : `${plane.title}; arrow keys choose a pixel`);
      const scale = plane.bright ? "most: yellow, least: blue" : "least: yellow, most: blue";
      return setText(view.under, plane.colour ? "Click a pixel: to the cycle that wrote it." : scale);
    }
    const pixel = chosen[1] * doc.store.width + chosen[0];
    const write = view.top[pixel];
    const channels = plane.colour || [plane.scalar];
    const text = channels.map((channel) => {
      const { name, shape } = this.kind.fields[channel + 1];
      return `${name} ${textOf(shape, this.valueAt(view, channel, write, pixel), this.app.hex)}`;
    });
    const words = `(${chosen[0]}, ${chosen[1]}): ${text.join(", ")}${write < 0 ? ", not written yet" : ""}`;
    setText(view.under, words);
    view.marks.setAttribute("aria-label", `${plane.title}, pixel ${words}`);
  }
  resize() {
    if (!this.kind) return;
    for (const view of this.views) {
      const { width, height } = view.plane.page;
      const room = view.frame.parentElement.clientWidth - 22;
      const scale = Math.min(room / width, 300 / height);
      view.scale = scale >= 1 ? Math.floor(scale) : scale;
      for (const canvas of [view.canvas, view.marks]) {
        canvas.style.width = `${Math.round(width * view.scale)}px`;
        canvas.style.height = `${Math.round(height * view.scale)}px`;
      }
      const ratio = window.devicePixelRatio || 1;
      view.marks.width = Math.round(width * view.scale * ratio);
      view.marks.height = Math.round(height * view.scale * ratio);
    }
  }
  // Outlines of the triangles at work, lines and pixels of the units, the chosen pixel.
  drawMarks(view) {
    const { doc, cycle, chosen } = this.app;
    const { page } = view.plane;
    const ratio = window.devicePixelRatio || 1, { scale } = view;
    const pen = view.marks.getContext("2d");
    pen.setTransform(ratio, 0, 0, ratio, 0, 0);
    pen.clearRect(0, 0, page.width * scale, page.height * scale);
    if (scale >= 10) {
      pen.fillStyle = "rgba(255, 255, 255, 0.45)";
      for (let y = 0; y < page.height; y++) {
        for (let x = 0; x < page.width; x++) pen.fillRect((x + 0.5) * scale - 1, (y + 0.5) * scale - 1, 2, 2);
      }
    }
    const outlined = new Set();
    const drawn = !Number.isInteger(page.during) || rawAt(doc.registers[page.during], cycle);
    const value = (id) => Number(numberOf(doc.registers[id].shape, rawAt(doc.registers[id], cycle)));
    for (const unit of drawn ? doc.units : []) {
      if (unit.triangle === null) continue;
      const number = rawAt(doc.registers[unit.triangle], cycle);
      if (!number) continue;
      // Dashed: a unit that is not on the screen yet has it.
      if (!outlined.has(number)) this.outline(pen, scale, doc.triangles[number - 1], unit.marks.length ? [] : [5, 4]);
      outlined.add(number);
      for (const mark of unit.marks) {
        if (mark.x === null) {
          pen.fillStyle = "rgba(255, 255, 255, 0.3)";
          pen.fillRect(0, value(mark.y) * scale, page.width * scale, Math.max(1, scale));
        } else {
          this.box(pen, scale, value(mark.x), value(mark.y), "#56b4e9");
        }
      }
    }
    const { cycles, numbers } = view.list;
    const now = upTo(cycles, cycle) - 1;
    if (now >= 0 && cycles[now] === cycle) {
      const pixel = this.pixelOf(numbers[now], page);
      const [x, y] = [pixel % page.width, Math.floor(pixel / page.width)];
      if (view.plane.colour) {
        pen.fillStyle = this.app.colourOf(this.kind, numbers[now]);
        pen.fillRect(x * scale, y * scale, scale, scale);
      }
      this.box(pen, scale, x, y, "#f0e442");
    }
    if (chosen && !view.plane.map) this.box(pen, scale, chosen[0], chosen[1], "#ffffff", 2);
  }
  outline(pen, scale, corners, dash) {
    if (!corners) return;
    pen.setLineDash(dash);
    pen.beginPath();
    for (const [x, y] of corners) pen.lineTo(x * scale, y * scale);
    pen.closePath();
    for (const [style, wide] of [["#000", 3], ["#fff", 1.2]]) {
      pen.strokeStyle = style;
      pen.lineWidth = wide;
      pen.stroke();
    }
    pen.setLineDash([]);
  }
  box(pen, scale, x, y, style, around = 0) {
    const size = Math.max(4, scale) + 2 * around;
    const left = (x + 0.5) * scale - size / 2, top = (y + 0.5) * scale - size / 2;
    for (const [colour, wide] of [["#000", 3.5], [style, 1.6]]) {
      pen.strokeStyle = colour;
      pen.lineWidth = wide;
      pen.strokeRect(left, top, size, size);
    }
  }
  click(view, event) {
    const box = view.marks.getBoundingClientRect();
    const { width, height } = this.app.doc.store;
    const x = Math.floor(((event.clientX - box.left) * width) / box.width);
    const y = Math.floor(((event.clientY - box.top) * height) / box.height);
    if (x < 0 || y < 0 || x >= width || y >= height) return;
    this.app.choose([x, y]);
    this.toWrite();
  }
  // To the write that made what is seen of the chosen pixel; if there is none yet, to the first to come.
  toWrite() {
    const { doc, chosen, cycle } = this.app;
    if (!chosen) return;
    const pixel = chosen[1] * doc.store.width + chosen[0];
    let to = -1;
    for (let i = 0; i < this.cycles.length; i++) {
      if (this.pixelOf(this.numbers[i], doc.store) !== pixel) continue;
      if (this.cycles[i] < cycle || to < 0) to = this.cycles[i];
    }
    if (to >= 0) this.app.go(to);
  }
  key(event) {
    const moves = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] };
    const { width, height } = this.app.doc.store;
    if (event.key === "Enter") this.toWrite();
    else if (moves[event.key]) {
      const [x, y] = this.app.chosen || [width >> 1, height >> 1];
      const [dx, dy] = moves[event.key];
      this.app.choose([Math.min(width - 1, Math.max(0, x + dx)), Math.min(height - 1, Math.max(0, y + dy))]);
    } else return;
    event.preventDefault();
    event.stopPropagation();
  }
}

// From yellow to blue, its lightness falling all the way.
function nearToFar(part) {
  const stops = [[253, 231, 37], [190, 180, 90], [124, 123, 120], [66, 78, 108], [0, 34, 78]];
  const at = part * (stops.length - 1), low = Math.min(stops.length - 2, Math.floor(at));
  return stops[low].map((colour, i) => colour + (stops[low + 1][i] - colour) * (at - low));
}
