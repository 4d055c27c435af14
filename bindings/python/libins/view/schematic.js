// SPDX-License-Identifier: MIT
// The board as a schematic: parts in columns, nets routed on tracks between them, every pin with its level. A full square is high,
// an open one low, a grey one floats.
import { button, el, mark, put, svg } from "./dom.js";
import { heightOf, pinAt, PITCH, STUB, symbolOf } from "./symbols.js";

const GAP = 18;
const TRACK = 9;
const CHANNEL = 26;
const MARGIN = 10;
/** Left free for the buttons. */
const FOOT = 26;
const SQUARE = 7;
const POWER = { VCC: "VCC", "5V": "5V", VREF: "VREF", GND: "GND" };
const MAIN = 2;
/** Nets with a light on them. */
const LEDS = ["RXD", "TXD"];

export class Schematic {
  name = "schematic";
  title = "Schematic";

  constructor(view) {
    this.view = view;
    this.drawing = svg("svg", { class: "schematic", tabindex: "0", role: "group", "aria-label": "Schematic of the board", preserveAspectRatio: "xMidYMid meet" });
    this.element = el(
      "div", {}, this.drawing,
      el(
        "div", { class: "row over" }, button("−", "Zoom out", () => this.#zoom(1.25)), button("+", "Zoom in", () => this.#zoom(0.8)),
        button("All", "Show all of it", () => this.#all()), el("span", { class: "muted" }, "■ high  □ low   a net, clicked: shown in the analyser or not")
      )
    );
    this.drawing.addEventListener("wheel", (event) => {
      event.preventDefault();
      this.#zoom(event.deltaY > 0 ? 1.1 : 0.9);
    }, { passive: false });
    this.drawing.addEventListener("pointerdown", (event) => this.#drag(event));
    this.drawing.addEventListener("keydown", (event) => this.#key(event));
  }

  suits(hello) {
    return hello.parts.length > 0;
  }

  hello(hello) {
    const leds = LEDS.filter((net) => hello.wires.includes(net)).map((net, i) => ({ name: `D${i + 1}`, kind: "led", pins: [{ name: "K", net }], led: net }));
    const given = [...(hello.parts ?? []), ...leds];
    const columnOf = (part) => symbolOf(part, () => "right").column;
    const others = (pin, part) => given.filter((each) => each !== part && each.pins.some((other) => other.net === pin.net));
    const sideOf = (part) => (pin, column) => (others(pin, part).some((each) => columnOf(each) < column) ? "left" : "right");
    const parts = given.map((part) => ({ ...part, symbol: symbolOf(part, sideOf(part)) }));
    const columns = [0, 1, 2, 3, 4].map((column) => parts.filter((part) => part.symbol.column === column)).filter((column) => column.length);
    this.marks = [];
    this.texts = [];
    this.nets = new Map();
    this.#place(columns);
    const wires = this.#route(columns);
    const drawn = parts.map((part) => this.#part(part));
    this.drawing.replaceChildren(
      svg("defs", {}, svg("pattern", { id: "dots", width: 18, height: 18, patternUnits: "userSpaceOnUse" }, svg("circle", { class: "dots", cx: 1, cy: 1, r: 0.9 }))),
      svg("rect", { x: -2000, y: -2000, width: 6000, height: 6000, fill: "url(#dots)" }), ...wires, ...drawn
    );
    this.#all();
  }

  /** Columns side by side; in a column, parts at the height that makes the first wire to the main column straight. */
  #place(columns) {
    const main = Math.max(0, columns.findIndex((column) => column[0].symbol.column === MAIN));
    const order = [main, ...columns.map((_, i) => i).filter((i) => i < main).reverse(), ...columns.map((_, i) => i).filter((i) => i > main)];
    for (const i of order) {
      const beside = i === main ? [] : columns[i < main ? i + 1 : i - 1];
      for (const part of columns[i]) part.y = this.#straight(part, beside);
      columns[i].sort((a, b) => a.y - b.y);
      let free = -Infinity;
      for (const part of columns[i]) {
        part.y = Math.max(part.y, free);
        free = part.y + heightOf(part.symbol) + GAP;
      }
    }
    const top = Math.min(...columns.flat().map((part) => part.y));
    let x = 0;
    columns.forEach((column, i) => {
      const width = Math.max(...column.map((part) => part.symbol.width));
      for (const part of column) {
        part.x = x + STUB + (part.symbol.column < MAIN ? width - part.symbol.width : 0);
        part.y += -top;
      }
      column.right = x + width + 2 * STUB;
      x = column.right + this.#channel(column, columns[i + 1] ?? []);
    });
    this.width = x;
    this.height = Math.max(...columns.flat().map((part) => part.y + heightOf(part.symbol)));
  }

  #straight(part, beside) {
    for (const pin of part.pins) {
      for (const other of beside) {
        const there = other.pins.find((each) => each.net && each.net === pin.net);
        if (there) return other.y + pinAt(other.symbol, there.name).y - pinAt(part.symbol, pin.name).y;
      }
    }
    return beside.length ? Math.max(...beside.map((other) => other.y)) + 1000 * (part.symbol.column === MAIN ? 0 : 0.2) : 0;
  }

  /** Width between two columns: a track for each net that is not straight. */
  #channel(left, right) {
    const tracks = this.#between(left, right).filter((net) => !net.flat).length;
    return tracks || right.length ? CHANNEL + TRACK * tracks : 0;
  }

  /** Nets with pins on the right of one column or the left of the next. */
  #between(left, right) {
    const found = new Map();
    const add = (part, side) => {
      for (const pin of part.pins) {
        const at = pinAt(part.symbol, pin.name);
        if (!pin.net || POWER[pin.net] || at.side !== side) continue;
        if (!found.has(pin.net)) found.set(pin.net, { net: pin.net, pins: [] });
        found.get(pin.net).pins.push({ x: (part.x ?? 0) + at.x, y: part.y + at.y, side });
      }
    };
    for (const part of left) add(part, "right");
    for (const part of right) add(part, "left");
    const nets = [...found.values()].filter((net) => net.pins.length > 1);
    for (const net of nets) {
      net.flat = net.pins.every((pin) => Math.abs(pin.y - net.pins[0].y) < 0.5);
      const mean = (side) => {
        const mine = net.pins.filter((pin) => pin.side === side);
        return mine.reduce((sum, pin) => sum + pin.y, 0) / mine.length;
      };
      net.down = mean("right") > mean("left");
      net.y = Math.min(...net.pins.map((pin) => pin.y));
    }
    return nets;
  }

  #route(columns) {
    for (let i = 0; i < columns.length; i++) {
      const nets = this.#between(columns[i], columns[i + 1] ?? []);
      const bent = nets.filter((net) => !net.flat);
      bent.sort((a, b) => (a.down !== b.down ? (a.down ? 1 : -1) : a.down ? a.y - b.y : b.y - a.y));
      bent.forEach((net, k) => (net.track = columns[i].right + CHANNEL / 2 + TRACK * (k + 0.5)));
      for (const net of nets) this.#wire(net);
    }
    return [...this.nets.values()].map((net) => net.group);
  }

  #wire({ net, pins, flat, track }) {
    const group = this.#group(net);
    const xs = pins.map((pin) => pin.x);
    const ys = pins.map((pin) => pin.y);
    const path = flat
      ? `M${Math.min(...xs)} ${ys[0]}H${Math.max(...xs)}`
      : [`M${track} ${Math.min(...ys)}V${Math.max(...ys)}`, ...pins.map((pin) => `M${pin.x} ${pin.y}H${track}`)].join("");
    group.append(svg("path", { class: "wire", d: path }), svg("path", { class: "hit", d: path }));
    if (!flat) {
      const inner = pins.filter((pin) => pin.y > Math.min(...ys) && pin.y < Math.max(...ys));
      group.append(...inner.map((pin) => svg("circle", { class: "dot", cx: track, cy: pin.y, r: 2.8 })));
    } else if (pins.length > 2) {
      group.append(...pins.filter((pin) => pin.x > Math.min(...xs) && pin.x < Math.max(...xs)).map((pin) => svg("circle", { class: "dot", cx: pin.x, cy: pin.y, r: 2.8 })));
    }
  }

  #group(net) {
    const known = this.nets.get(net);
    if (known) return known.group;
    const digital = this.view.hello.wires.includes(net);
    const toggle = () => this.view.panel("analyser").toggle(net);
    const group = svg(
      "g",
      digital
        ? { class: "net", tabindex: "0", role: "button", "aria-label": `${net}: show in the analyser`, onclick: toggle, onkeydown: (event) => {
            if (event.key === "Enter" || event.key === " ") {
              event.preventDefault();
              toggle();
            }
          } }
        : { class: "net" },
      svg("title", {}, net)
    );
    this.nets.set(net, { group, digital });
    return group;
  }

  #part(part) {
    const { symbol, x, y } = part;
    const height = heightOf(symbol);
    const group = svg("g", {});
    if (symbol.draw) group.append(...symbol.draw(symbol, x, y));
    else group.append(svg("rect", { class: "box", x, y, width: symbol.width, height }));
    if (symbol.reads) this.#readings(part, group);
    else if (part.led) {
      for (const node of group.querySelectorAll(".led, .rays")) this.texts.push((state) => mark(node, "data-on", String(Number(Boolean(state.led?.[part.led])))));
      group.append(svg("text", { class: "small", x: x + 44, y: y - 2 }, `${part.name}  ${part.led}`));
    } else if (symbol.draw) group.append(svg("text", { class: "small", x: x - 14, y: y + height + 9 }, part.hz ? `${part.name}  ${part.hz / 1e6} MHz` : part.name));
    else {
      group.append(svg("text", { class: "name", x: x + symbol.width / 2, y: y + 14, "text-anchor": "middle" }, part.kind.toUpperCase()));
      group.append(svg("text", { class: "small", x, y: y - 4 }, part.name));
    }
    for (const name of [...symbol.left, ...symbol.right]) if (name) this.#pin(part, name, group);
    return group;
  }

  #pin(part, name, group) {
    const { symbol } = part;
    const at = pinAt(symbol, name);
    const left = at.side === "left";
    const [x, y] = [part.x + at.x, part.y + at.y];
    const edge = left ? part.x : part.x + symbol.width;
    group.append(svg("path", { class: "pin", d: `M${x} ${y}H${edge}` }));
    if (!symbol.flat) group.append(svg("text", { x: left ? edge + 4 : edge - 4, y: y + 4, "text-anchor": left ? "start" : "end" }, symbol.aliases?.[name] ?? name));
    if (symbol.numbers[name]) group.append(svg("text", { class: "small", x: (x + edge) / 2, y: y - 3, "text-anchor": "middle" }, String(symbol.numbers[name])));
    const net = part.pins.find((pin) => pin.name === name)?.net;
    if (POWER[net]) group.append(svg("text", { class: "small", x: left ? x - 3 : x + 3, y: y + 3, "text-anchor": left ? "end" : "start" }, POWER[net]));
    const port = /^P([0-3])\.([0-7])$/.exec(name);
    const wire = this.view.hello.wires.includes(net);
    if (!port && !wire) return;
    const square = svg("rect", { class: "level", x: x - SQUARE / 2, y: y - SQUARE / 2, width: SQUARE, height: SQUARE });
    group.append(square);
    this.marks.push((state) => {
      const level = port && state.pins?.[`P${port[1]}`] !== undefined ? (state.pins[`P${port[1]}`] >> port[2]) & 1 : state.nets?.[net];
      mark(square, "data-level", level === undefined || level === null ? "z" : String(Number(level)));
    });
  }

  /** A sensor's box: rate, volts and code of its channel. */
  #readings(part, group) {
    const channel = part.pins[0].net.replace("AIN", "");
    const row = (n, kind) => svg("text", { class: kind, x: part.x + 7, y: part.y + 14 + 14 * n });
    const [name, volts, code] = [row(0, "name"), row(1, "volts"), row(2, "volts")];
    put(name, part.name);
    group.append(name, volts, code);
    this.texts.push((state) => {
      const [v, c] = [state.volts?.[channel], state.codes?.[channel]];
      put(volts, v === undefined || v === null ? "" : `${v.toFixed(4)} V`);
      put(code, c === undefined || c === null ? "" : `code ${c.toString(16).toUpperCase().padStart(3, "0")}h`);
    });
  }

  draw(state) {
    for (const each of this.marks ?? []) each(state);
    for (const each of this.texts ?? []) each(state);
    const chosen = this.view.panel("analyser").wires;
    for (const [net, { group, digital }] of this.nets ?? []) if (digital) mark(group, "aria-pressed", String(chosen.includes(net)));
  }

  #all() {
    this.box = [-MARGIN, -MARGIN, this.width + 2 * MARGIN, this.height + 2 * MARGIN + FOOT];
    this.#show();
  }

  #show() {
    this.drawing.setAttribute("viewBox", this.box.map((each) => each.toFixed(1)).join(" "));
  }

  #zoom(by) {
    const [x, y, width, height] = this.box;
    this.box = [x + (width * (1 - by)) / 2, y + (height * (1 - by)) / 2, width * by, height * by];
    this.#show();
  }

  #drag(event) {
    if (event.target.closest("[role=button]")) return;
    this.drawing.setPointerCapture(event.pointerId);
    let [x, y] = [event.clientX, event.clientY];
    this.drawing.onpointermove = (moved) => {
      const scale = this.drawing.getScreenCTM().a;
      this.box[0] -= (moved.clientX - x) / scale;
      this.box[1] -= (moved.clientY - y) / scale;
      [x, y] = [moved.clientX, moved.clientY];
      this.#show();
    };
    this.drawing.onpointerup = () => (this.drawing.onpointermove = null);
  }

  #key(event) {
    if (event.target !== this.drawing) return;
    const move = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] }[event.key];
    if (move) {
      this.box[0] += 2 * PITCH * move[0];
      this.box[1] += 2 * PITCH * move[1];
      this.#show();
    } else if (event.key === "+") this.#zoom(0.8);
    else if (event.key === "-") this.#zoom(1.25);
    else if (event.key === "0") this.#all();
    else return;
    event.preventDefault();
  }
}
