// SPDX-License-Identifier: MIT
// The serial line: what each side sent, as text or in hexadecimal, and a line to send to the board.
import { button, choice, el } from "./dom.js";

/** Kept, and of them in the page: a long text is laid out anew with each octet. */
const OCTETS = 1 << 14;
const SHOWN = 1 << 10;

export class Terminal {
  name = "terminal";
  title = "Terminal";

  constructor(view) {
    this.view = view;
    this.form = "hex";
    this.line = choice("Line", [], (line) => this.#choose(line), { id: "terminal-line" });
    const form = choice("Shown as", [["hex", "hex"], ["text", "text"]], (value) => this.#as(value), { id: "terminal-form" });
    this.who = choice("Directions", [["both", "both"], ["tx", "from board"], ["rx", "to board"]], () => this.#again(), { id: "terminal-who" });
    this.out = el("pre", { class: "terminal", id: "terminal-out" });
    this.scroll = el("div", { class: "scroll", tabindex: "0", role: "log", "aria-live": "off", "aria-label": "Octets on the line" }, this.out);
    this.input = el("input", { class: "grow mono", id: "terminal-input", placeholder: "octets in hexadecimal: 06 1B", "aria-label": "To send to the board" });
    this.ending = choice("Line end", [["", "no end"], ["\r", "CR"], ["\n", "LF"], ["\r\n", "CR LF"]], () => {}, { id: "terminal-end", hidden: true });
    const send = el("form", { class: "row", onsubmit: (event) => this.#send(event) }, this.input, this.ending, el("button", { class: "main", id: "terminal-send" }, "Send"));
    const bar = el("div", { class: "row" }, this.line, form, this.who, button("Clear", "Clear the terminal", () => this.#clear()));
    this.element = el("div", {}, bar, this.scroll, send);
    this.kept = new Map();
  }

  suits(hello) {
    return (hello.lines ?? []).length > 0;
  }

  hello(hello) {
    this.kept = new Map(hello.lines.map((line) => [line, []]));
    this.line.replaceChildren(...hello.lines.map((line) => el("option", { value: line }, line)));
    this.input.disabled = hello.kind === "recording";
    this.#again();
  }

  frame(frame) {
    for (const [line, ways] of Object.entries(frame.uart ?? {})) {
      if (!this.kept.has(line)) continue;
      if (frame.rewound !== undefined) this.#cut(line, ways);
      const kept = this.kept.get(line);
      for (const way of ["tx", "rx"]) {
        const octets = octetsOf(ways[way] ?? "");
        if (!octets.length) continue;
        kept.push([way, octets, ways[`${way}_from`] ?? 0]);
        if (line === this.line.value) (this.fresh ??= []).push([way, octets]);
      }
      let count = kept.reduce((sum, [, octets]) => sum + octets.length, 0);
      while (count > OCTETS) count -= kept.shift()[1].length;
    }
  }

  /** What was sent behind an instant that the run was taken back to has not been sent. */
  #cut(line, ways) {
    const left = (this.kept.get(line) ?? []).map(([way, octets, from]) => [way, octets.slice(0, Math.max(0, ways[`${way}_from`] - from)), from]);
    this.kept.set(line, left.filter(([, octets]) => octets.length));
    if (line === this.line.value) this.#again();
  }

  draw() {
    if (!this.fresh) return;
    const atEnd = this.scroll.scrollTop + this.scroll.clientHeight > this.scroll.scrollHeight - 30;
    for (const [way, octets] of this.fresh) this.#show(way, octets);
    this.fresh = null;
    while (this.shownOctets > SHOWN && this.out.childNodes.length > 1) {
      this.shownOctets -= this.out.firstChild.count;
      this.out.firstChild.remove();
    }
    if (atEnd) this.scroll.scrollTop = this.scroll.scrollHeight;
  }

  #show(way, octets) {
    if (this.who.value !== "both" && this.who.value !== way) return;
    const last = this.out.lastChild;
    const text = this.form === "hex" ? `${hexOf(octets)} ` : new TextDecoder("latin1").decode(Uint8Array.from(octets)).replace(/[^\n\x20-\x7e]/g, "·");
    this.shownOctets += octets.length;
    if (last?.way === way && last.count < 64) {
      last.append(text);
      last.count += octets.length;
      return;
    }
    const block = el("div", { class: way === "tx" ? "board" : "host" }, way === "tx" ? "board → " : "→ board ", text);
    block.way = way;
    block.count = octets.length;
    this.out.append(block);
  }

  #again() {
    this.out.replaceChildren();
    this.shownOctets = 0;
    this.fresh = [...(this.kept.get(this.line.value) ?? [])];
    this.view.redraw();
  }

  #choose() {
    this.#again();
  }

  #as(form) {
    this.form = form;
    this.ending.hidden = form === "hex";
    this.input.placeholder = form === "hex" ? "octets in hexadecimal: 06 1B" : "text";
    this.#again();
  }

  #clear() {
    this.kept.set(this.line.value, []);
    this.#again();
  }

  async #send(event) {
    event.preventDefault();
    const line = this.line.value;
    const text = this.input.value;
    if (this.form === "hex" && !/^(\s*[0-9a-f]{2})+\s*$/i.test(text)) {
      this.view.say(`${text || "nothing"}: not pairs of hexadecimal digits, as in 06 1B`);
      return;
    }
    const octets = this.form === "hex" ? { hex: text.replace(/\s/g, "") } : { text: text + this.ending.value };
    if (await this.view.ask("uart_send", { line, ...octets })) this.input.value = "";
  }
}

function octetsOf(hex) {
  return (hex.match(/../g) ?? []).map((pair) => parseInt(pair, 16));
}

export function hexOf(octets) {
  return octets.map((octet) => octet.toString(16).padStart(2, "0").toUpperCase()).join(" ");
}
