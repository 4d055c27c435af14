// SPDX-License-Identifier: MIT
// Registers, memory in hexadecimal, and expressions watched in C's words. What changed since the last stop is marked.
import { button, choice, el, mark, put } from "./dom.js";

const ROW = 8;
const REFRESH_MS = 200;
const WIDE = new Set(["pc", "dptr"]);

function hex(value, digits) {
  return value.toString(16).toUpperCase().padStart(digits, "0");
}

export class Registers {
  name = "registers";
  title = "Registers";

  constructor(view) {
    this.view = view;
    this.grid = el("div", { class: "registers mono", id: "registers" });
    this.element = el("div", { class: "scroll" }, this.grid);
  }

  suits(hello) {
    return Boolean(hello.can_step);
  }

  hello(hello) {
    this.before = {};
    this.rows = hello.registers.map((name) => {
      const value = el("b");
      const row = el("div", {}, el("span", {}, name), value);
      return { name, value, row };
    });
    this.grid.replaceChildren(...this.rows.map((each) => each.row));
  }

  stopped(state) {
    this.old = this.before ?? {};
    this.before = { ...state.registers };
  }

  shown() {
    this.view.redraw();
  }

  draw(state) {
    for (const { name, value, row } of this.rows ?? []) {
      const now = state.registers?.[name];
      if (now === undefined) continue;
      put(value, hex(now, WIDE.has(name) ? 4 : 2));
      mark(row, "class", !state.running && this.old?.[name] !== undefined && this.old[name] !== now ? "changed" : "");
    }
  }
}

export class Memory {
  name = "memory";
  title = "Memory";

  constructor(view) {
    this.view = view;
    this.space = choice("Memory", [], () => this.#fetch(), { id: "memory-space" });
    this.address = el("input", { class: "mono", size: 6, value: "00", id: "memory-address", "aria-label": "First address, in hexadecimal", onchange: () => this.#fetch() });
    this.count = el("input", { type: "number", min: 1, max: 4096, value: 128, id: "memory-count", "aria-label": "Number of octets", onchange: () => this.#fetch() });
    this.rows = el("div", { class: "hex", id: "memory-octets" });
    this.element = el("div", {}, el("div", { class: "row" }, this.space, this.address, "h", this.count, "octets"), el("div", { class: "scroll", tabindex: "0", role: "region", "aria-label": "Octets" }, this.rows));
    this.last = 0;
  }

  suits(hello) {
    return Boolean(hello.can_step);
  }

  hello(hello) {
    this.space.replaceChildren(...(hello.memories ?? []).map((space) => el("option", { value: space }, space)));
    this.space.value = hello.memories?.includes("iram") ? "iram" : (hello.memories?.[0] ?? "");
    this.text = null;
  }

  shown() {
    this.#fetch();
  }

  stopped() {
    if (this.slot.chosen === this) this.#fetch();
  }

  draw(state) {
    if (state.running && performance.now() - this.last > REFRESH_MS) this.#fetch();
  }

  async #fetch() {
    this.again = this.waiting;
    if (!this.view.connected || !this.view.hello?.can_step || this.waiting) return;
    this.waiting = true;
    this.last = performance.now();
    const space = this.space.value;
    const first = parseInt(this.address.value, 16) || 0;
    const answer = await this.view.ask("memory", { space, address: first, count: Number(this.count.value) });
    this.waiting = false;
    if (this.again) this.#fetch();
    if (!answer || this.text === `${space} ${first} ${answer.octets}`) return;
    this.text = `${space} ${first} ${answer.octets}`;
    const octets = (answer.octets.match(/../g) ?? []).map((pair) => parseInt(pair, 16));
    const lines = [];
    for (let i = 0; i < octets.length; i += ROW) {
      const row = octets.slice(i, i + ROW);
      const shown = row.map((octet) => (octet > 31 && octet < 127 ? String.fromCharCode(octet) : ".")).join("");
      lines.push(`${hex(first + i, 4)}  ${row.map((octet) => hex(octet, 2)).join(" ").padEnd(3 * ROW)} ${shown}`);
    }
    put(this.rows, lines.join("\n"));
  }
}

export class Watch {
  name = "watch";
  title = "Watch";

  constructor(view) {
    this.view = view;
    this.input = el("input", { class: "grow mono", id: "watch-input", placeholder: "sampled, codes[0], TCON.5", "aria-label": "Expression to watch" });
    this.rows = el("tbody");
    const form = el("form", { class: "row", onsubmit: (event) => this.#add(event) }, this.input, el("button", { class: "main", id: "watch-add" }, "Watch"));
    this.element = el("div", { class: "scroll" }, form, el("table", { id: "watches" }, this.rows));
    this.key = "";
  }

  suits(hello) {
    return Boolean(hello.can_step);
  }

  get expressions() {
    return (this.view.state.watch ?? []).map((each) => each.expression);
  }

  async #add(event) {
    event.preventDefault();
    const text = this.input.value.trim();
    if (text && (await this.#tell([...this.expressions, text]))) this.input.value = "";
  }

  async #tell(expressions) {
    const answer = await this.view.ask("watch", { expressions });
    if (answer) this.view.state.watch = answer.watch ?? answer.values;
    this.view.redraw();
    return answer;
  }

  shown() {
    this.view.redraw();
  }

  draw(state) {
    const watched = state.watch ?? [];
    const key = JSON.stringify(this.expressions);
    if (key !== this.key) {
      this.key = key;
      this.values = watched.map(() => el("td", { class: "number" }));
      this.rows.replaceChildren(
        ...watched.map((each, i) =>
          el("tr", {}, el("td", {}, each.expression), this.values[i],
            el("td", {}, button("×", `Watch ${each.expression} no longer`, () => this.#tell(this.expressions.filter((_, k) => k !== i)), { class: "quiet" })))
        )
      );
    }
    watched.forEach((each, i) => {
      put(this.values[i], String(each.error ?? each.value));
      mark(this.values[i], "class", each.error ? "bad" : "number");
    });
  }
}
