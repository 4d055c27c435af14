// SPDX-License-Identifier: MIT
// Symbols of the schematic: pins by side with the numbers of the package, and what is drawn inside. Packages: Atmel AT89S51 (2487D)
// PDIP-40, TI TLC2543 (SLAS079) DW/N-20, TI MAX232 (SLLS047) D/N-16.
import { svg } from "./dom.js";

export const PITCH = 15;
export const STUB = 16;

const range = (n, name) => Array.from({ length: n }, (_, i) => name(i));

function numbered(first, names) {
  return Object.fromEntries(names.map((name, i) => [name, first + i]));
}

const PORT = [0, 1, 2, 3].map((port) => range(8, (bit) => `P${port}.${bit}`));
const MCU = {
  
  column: 2,
  width: 128,
  left: ["XTAL1", "XTAL2", null, "RST", null, "PSEN", "ALE", "EA", null, ...PORT[1]],
  right: [...PORT[0], null, ...PORT[2], null, ...PORT[3]],
  numbers: {
    ...numbered(1, PORT[1]), RST: 9, ...numbered(10, PORT[3]), XTAL2: 18, XTAL1: 19, ...numbered(21, PORT[2]),
    PSEN: 29, ALE: 30, EA: 31, ...numbered(32, [...PORT[0]].reverse()),
  },
  aliases: {
    "P3.0": "P3.0/RXD", "P3.1": "P3.1/TXD", "P3.2": "P3.2/INT0", "P3.3": "P3.3/INT1", "P3.4": "P3.4/T0", "P3.5": "P3.5/T1",
    "P3.6": "P3.6/WR", "P3.7": "P3.7/RD",
  },
};
const AIN = range(11, (i) => `AIN${i}`);
const ADC = {
  
  column: 1,
  width: 104,
  left: AIN,
  right: ["EOC", "I/O CLOCK", "DATA IN", "DATA OUT", "/CS", null, "REF+", "REF-"],
  numbers: { ...numbered(1, AIN.slice(0, 9)), AIN9: 11, AIN10: 12, "REF-": 13, "REF+": 14, "/CS": 15, "DATA OUT": 16, "DATA IN": 17, "I/O CLOCK": 18, EOC: 19 },
};
const SENSOR = { column: 0, width: 92, left: [], right: ["OUT"], numbers: {}, least: 50, reads: true, flat: true };

const BOX = { column: 2, width: 110, left: [], right: [], numbers: {} };

const SYMBOLS = {
  at89s51: MCU,
  at89s52: MCU,
  tlc2543: ADC,
  gyro: SENSOR,
  accelerometer: SENSOR,
  source: SENSOR,
  crystal: { column: 1, width: 60, left: [], right: ["1", "2"], numbers: {}, draw: crystal, flat: true },
  max232: { column: 3, width: 92, left: ["R1OUT", "T1IN"], right: ["R1IN", "T1OUT"], numbers: { R1OUT: 12, T1IN: 11, R1IN: 13, T1OUT: 14 } },
  led: { column: 3, width: 104, left: ["K"], right: [], numbers: {}, draw: led, flat: true, least: 26 },
  host: { column: 4, width: 84, left: ["TXD", "RXD"], right: [], numbers: {} },
  f2812: { column: 2, width: 128, left: [], right: [], numbers: {} },
  gimu: { column: 0, width: 92, left: [], right: [], numbers: {} },
};

/** The symbol of a part: of its kind, with pins that the kind does not know where sideOf says; or a box of the pins alone. */
export function symbolOf(part, sideOf) {
  const known = SYMBOLS[part.kind] ?? BOX;
  const all = new Set([...known.left, ...known.right]);
  const more = part.pins.filter((pin) => !all.has(pin.name));
  if (!more.length) return known;
  const given = (side) => [
    ...known[side].filter((name) => part.pins.some((pin) => pin.name === name)),
    ...more.filter((pin) => sideOf(pin, known.column) === side).map((pin) => pin.name),
  ];
  return { ...known, left: given("left"), right: given("right") };
}

export function heightOf(symbol) {
  return Math.max(symbol.least ?? 0, Math.max(symbol.left.length, symbol.right.length) * PITCH + (symbol.flat ? 4 : 26));
}

/** Of a pin in the symbol: where its stub ends, from the symbol's corner, and its side. */
export function pinAt(symbol, name) {
  const side = symbol.left.includes(name) ? "left" : "right";
  const row = symbol[side].indexOf(name);
  const top = symbol.flat ? (heightOf(symbol) - (symbol[side].length - 1) * PITCH) / 2 : 18 + PITCH / 2;
  return { side, x: side === "left" ? -STUB : symbol.width + STUB, y: top + row * PITCH };
}

function crystal(symbol, x, y) {
  const height = heightOf(symbol);
  const at = (name) => y + pinAt(symbol, name).y;
  const middle = x + symbol.width - 14;
  const plate = (dy) => svg("path", { class: "line", d: `M${middle - 9} ${y + height / 2 + dy}h18` });
  return [
    svg("path", { class: "line", d: `M${x + symbol.width} ${at("1")}H${middle}V${y + height / 2 - 6}M${x + symbol.width} ${at("2")}H${middle}V${y + height / 2 + 6}` }),
    plate(-6), plate(6),
    svg("rect", { class: "box", x: middle - 9, y: y + height / 2 - 3.5, width: 18, height: 7 }),
  ];
}

/** Lit while its line is low: cathode at the line, resistor to the supply. */
function led(symbol, x, y) {
  const middle = y + heightOf(symbol) / 2;
  return [
    svg("path", { class: "line", d: `M${x} ${middle}h14M${x + 30} ${middle}h14M${x + 74} ${middle}h14v-8m-6 0h12` }),
    svg("path", { class: "led", d: `M${x + 14} ${middle}l16 -8v16zM${x + 14} ${middle - 8}v16` }),
    svg("path", { class: "rays", d: `M${x + 16} ${middle - 10}l-5 -6M${x + 22} ${middle - 10}l-5 -6` }),
    svg("rect", { class: "box", x: x + 44, y: middle - 5, width: 30, height: 10 }),
    svg("text", { class: "small", x: x + 96, y: middle - 4 }, "5V"),
  ];
}
