// Values as text.

const MINUS = "\u2212";
const NONE = "\u2013";

// The number that the bits stand for, times 2^fraction; a BigInt where a number would not be exact.
function numberOf(shape, raw) {
  if (!shape.signed) return raw;
  if (typeof raw === "bigint") return BigInt.asIntN(shape.bits, raw);
  return raw >= 2 ** (shape.bits - 1) ? raw - 2 ** shape.bits : raw;
}

// Digits behind the point: three, of large numbers one, and never more than the format has.
function digitsOf(shape) {
  const enough = shape.bits - shape.fraction > 16 ? 1 : 3;
  return Math.min(enough, shape.fraction);
}

// Rounded half away from zero.
function decimal(shape, value) {
  const digits = digitsOf(shape);
  const negative = value < 0;
  let text;
  if (typeof value === "bigint") {
    const whole = negative ? -value : value;
    const half = shape.fraction > 0 ? 1n << BigInt(shape.fraction - 1) : 0n;
    const scaled = (whole * 10n ** BigInt(digits) + half) >> BigInt(shape.fraction);
    const padded = scaled.toString().padStart(digits + 1, "0");
    text = digits ? `${padded.slice(0, -digits)}.${padded.slice(-digits)}` : padded;
  } else {
    text = (Math.abs(value) / 2 ** shape.fraction).toFixed(digits);
  }
  return negative && /[1-9]/.test(text) ? MINUS + text : text;
}

function hexadecimal(shape, raw) {
  return raw.toString(16).toUpperCase().padStart(Math.ceil(shape.bits / 4), "0");
}

// The pixel of an address: of the map where the shape has one and the bit above the address is 1.
function pixelOfPlace(shape, raw) {
  const ofMap = Number.isInteger(shape.map) && raw >= 2 ** (shape.bits - 1);
  const address = ofMap ? raw - 2 ** (shape.bits - 1) : raw, pitch = 2 ** (ofMap ? shape.map : shape.low);
  return { x: address % pitch, y: Math.floor(address / pitch), ofMap };
}

function textOfPlace(shape, raw) {
  const { x, y, ofMap } = pixelOfPlace(shape, raw);
  return `${ofMap ? "map " : ""}(${x}, ${y})`;
}

// What stands on the page for the bits of a register or field.
function textOf(shape, raw, hex) {
  switch (shape.kind) {
    case "flag":
      return hex ? String(raw) : raw ? "yes" : "no";
    case "code":
      return hex ? hexadecimal(shape, raw) : shape.words[raw];
    case "triangle":
      return raw ? `T${raw - 1}` : NONE;
    case "token":
      return raw ? `#${raw}` : NONE;
    case "place":
      return hex ? hexadecimal(shape, raw) : textOfPlace(shape, raw);
    default:
      return hex ? hexadecimal(shape, raw) : decimal(shape, numberOf(shape, raw));
  }
}

// Characters of the longest text among some raw values, so that nothing moves while they change.
function widthOf(shape, list, hex) {
  if (shape.kind === "code") return Math.max(...shape.words.map((word) => word.length));
  if (shape.kind === "flag") return 3;
  let least = null, most = null, longest = 0;
  for (const raw of list) {
    const value = shape.kind === "number" ? numberOf(shape, raw) : raw;
    if (least === null || value < least) least = value;
    if (most === null || value > most) most = value;
    if (shape.kind === "place") longest = Math.max(longest, textOfPlace(shape, raw).length);
  }
  if (least === null) return 1;
  if (hex) return Math.ceil(shape.bits / 4);
  if (shape.kind === "place") return longest;
  if (shape.kind !== "number") return String(most).length + 1;
  return Math.max(decimal(shape, least).length, decimal(shape, most).length);
}

// An element with attributes and children.
function make(tag, attributes, ...children) {
  const element = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes || {})) {
    if (value === null || value === undefined) continue;
    if (name === "onclick") element.addEventListener("click", value);
    else element.setAttribute(name, value);
  }
  element.append(...children);
  return element;
}

function setText(element, text) {
  if (element.textContent !== text) element.textContent = text;
}
