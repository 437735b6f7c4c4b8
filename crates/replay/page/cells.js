// Cycles as cells: one each, but for runs in which nothing moves, which are folded into one.

// So many dull cycles make a fold.
const DULL = 8;

class Cells {
  constructor(doc) {
    this.doc = doc;
    this.open = new Set();
    this.fires = doc.links.map((link) => cyclesWith(doc, [link.valid, link.ready]));
    this.dull = this.findDull();
    this.jobs = new Uint8Array(doc.cycles);
    for (const unit of doc.units) {
      for (const item of unit.items) if (item.schedule) this.cutAt(this.jobs, item.schedule.job);
    }
    this.fold = true;
    this.build();
  }
  cutAt(marks, id) {
    for (const cycle of this.doc.registers[id].at) marks[cycle] = 1;
  }
  // 0: a cycle with a token that moves; 1: one like the one before; 2: the first of another kind.
  findDull() {
    const { doc } = this;
    const kinds = new Uint8Array(doc.cycles).fill(1);
    const cuts = new Uint8Array(doc.cycles);
    this.cutAt(cuts, doc.cause);
    for (const unit of doc.units) if (unit.phase !== null) this.cutAt(cuts, unit.phase);
    for (let i = 0; i < doc.cycles; i++) {
      if (this.fires.some((marks) => marks[i])) kinds[i] = 0;
      else if (cuts[i] || i === 0 || kinds[i - 1] === 0) kinds[i] = 2;
    }
    return kinds;
  }
  build() {
    const { doc, dull } = this;
    const starts = [];
    for (let i = 0; i < doc.cycles; ) {
      let end = i + 1;
      if (this.fold && dull[i] !== 0) {
        while (end < doc.cycles && dull[end] === 1) end++;
        if (end - i < DULL) end = i + 1;
      }
      if (end - i > 1 && this.open.has(i)) {
        for (let k = i; k < end; k++) if (k === i || this.jobs[k]) starts.push(k);
      } else {
        starts.push(i);
      }
      i = end;
    }
    this.starts = Uint32Array.from(starts);
  }
  setFold(fold) {
    this.fold = fold;
    this.build();
  }
  get length() {
    return this.starts.length;
  }
  // The cell of a cycle.
  of(cycle) {
    return upTo(this.starts, cycle) - 1;
  }
  start(cell) {
    return this.starts[cell];
  }
  size(cell) {
    return (cell + 1 < this.length ? this.starts[cell + 1] : this.doc.cycles) - this.starts[cell];
  }
  // Opens the fold of a cycle into a cell a job, or closes it.
  toggle(cycle) {
    let first = cycle;
    while (first > 0 && this.dull[first] === 1) first--;
    if (this.dull[cycle] === 0) return;
    if (!this.open.delete(first)) this.open.add(first);
    this.build();
  }
}
