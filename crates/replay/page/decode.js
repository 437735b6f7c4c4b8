"use strict";
// Reads a replay: structure as JSON, values as differences in a deflated stream (docs/replay.md). Knows no machine.

const FORMAT = "edgewalk-replay";
const MAJOR = 1;
// Registers of at most so many bits are exact as numbers; wider ones are BigInt.
const NARROW = 52;

async function inflate(text) {
  if (typeof DecompressionStream === "undefined") {
    throw new Error("This browser cannot unpack the recording: it needs DecompressionStream (Chrome 103, Firefox 113, Safari 16.4, or later).");
  }
  const packed = Uint8Array.from(atob(text), (c) => c.charCodeAt(0));
  const stream = new Blob([packed]).stream().pipeThrough(new DecompressionStream("deflate-raw"));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

// The numbers of the stream, one after the other.
class Stream {
  constructor(bytes) {
    this.bytes = bytes;
    this.place = 0;
  }
  // At most 53 bits.
  number() {
    let value = 0, scale = 1, byte;
    do {
      byte = this.bytes[this.place++];
      value += (byte & 127) * scale;
      scale *= 128;
    } while (byte > 127);
    return value;
  }
  big() {
    let value = 0n, shift = 0n, byte;
    do {
      byte = this.bytes[this.place++];
      value |= BigInt(byte & 127) << shift;
      shift += 7n;
    } while (byte > 127);
    return value;
  }
  gaps(length) {
    const list = new Uint32Array(length);
    let now = 0;
    for (let i = 0; i < length; i++) list[i] = now += this.number();
    return list;
  }
  // Values modulo 2^bits, each as a difference to the one before.
  differences(bits, length) {
    if (bits > NARROW) return this.wide(bits, length);
    const list = bits > 32 ? new Float64Array(length) : new Uint32Array(length);
    const range = 2 ** bits;
    let now = 0;
    for (let i = 0; i < length; i++) {
      const coded = this.number();
      now += coded % 2 === 0 ? coded / 2 : -(coded + 1) / 2;
      if (now < 0) now += range;
      else if (now >= range) now -= range;
      list[i] = now;
    }
    return list;
  }
  wide(bits, length) {
    const list = new BigUint64Array(length);
    const mask = (1n << BigInt(bits)) - 1n;
    let now = 0n;
    for (let i = 0; i < length; i++) {
      const coded = this.big();
      now = (now + (coded & 1n ? -(coded + 1n) / 2n : coded / 2n)) & mask;
      list[i] = now;
    }
    return list;
  }
}

async function decode(text) {
  const doc = JSON.parse(text);
  if (doc.format !== FORMAT) throw new Error(`This is no replay: its format is ${doc.format}.`);
  if (doc.version[0] !== MAJOR) {
    throw new Error(`This replay has version ${doc.version.join(".")}; this page shows version ${MAJOR}.`);
  }
  const stream = new Stream(await inflate(doc.data));
  delete doc.data;
  for (const register of doc.registers) {
    register.at = stream.gaps(register.changes);
    register.raw = stream.differences(register.shape.bits, register.changes);
    register.hint = 0;
  }
  for (const kind of doc.tokens) {
    kind.owner = stream.differences(32, kind.count);
    for (const field of kind.fields) field.raw = stream.differences(field.shape.bits, kind.count);
    for (const truth of kind.truth) truth.error = Int32Array.from(stream.differences(32, kind.count));
  }
  if (doc.store) {
    const pixels = doc.store.width * doc.store.height;
    const channels = doc.tokens[doc.registers[doc.store.planes[0].token].shape.table].fields.length - 1;
    doc.store.before = [];
    for (let i = 0; i < channels; i++) doc.store.before.push(stream.differences(32, pixels));
    // A plane of the map holds one channel.
    for (const plane of doc.store.planes) {
      plane.page = plane.map ? doc.store.map : doc.store;
      if (plane.map) plane.before = stream.differences(32, plane.page.width * plane.page.height);
    }
  }
  return doc;
}

// Place of the change of a register that holds in a cycle. Mostly the same as before, or the next.
function place(register, cycle) {
  const at = register.at;
  let low = register.hint;
  if (at[low] > cycle) low = 0;
  else if (low + 1 >= at.length || at[low + 1] > cycle) return low;
  else if (low + 2 >= at.length || at[low + 2] > cycle) return (register.hint = low + 1);
  let high = at.length;
  while (high - low > 1) {
    const middle = (low + high) >> 1;
    if (at[middle] <= cycle) low = middle;
    else high = middle;
  }
  return (register.hint = low);
}

function rawAt(register, cycle) {
  return register.raw[place(register, cycle)];
}

// Whether the clock edge before the cycle changed the register.
function changedAt(register, cycle) {
  return cycle > 0 && register.at[place(register, cycle)] === cycle;
}

// 1 for every cycle in which all these flags are up.
function cyclesWith(doc, flags) {
  const all = new Uint8Array(doc.cycles).fill(1);
  for (const flag of flags) {
    const { at, raw } = doc.registers[flag];
    for (let i = 0; i < at.length; i++) {
      if (raw[i] === 0) all.fill(0, at[i], i + 1 < at.length ? at[i + 1] : doc.cycles);
    }
  }
  return all;
}

// The cycles themselves, ascending.
function listOf(marks) {
  const list = [];
  for (let i = 0; i < marks.length; i++) if (marks[i]) list.push(i);
  return Uint32Array.from(list);
}

// Number of entries of an ascending list that are at most this.
function upTo(list, limit) {
  let low = 0, high = list.length;
  while (low < high) {
    const middle = (low + high) >> 1;
    if (list[middle] <= limit) low = middle + 1;
    else high = middle;
  }
  return low;
}
