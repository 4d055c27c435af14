// SPDX-License-Identifier: MIT
// What the scenario expects, as it stands now, and the figures of the line.
import { el, mark, put } from "./dom.js";

const WORDS = { true: ["✓ holds", "good"], false: ["✗ fails", "bad"], null: ["open", "muted"] };

export class Verdicts {
  name = "verdicts";
  title = "Verdicts";

  constructor(view) {
    this.view = view;
    this.rows = el("tbody");
    this.figures = el("tbody");
    this.none = el("div", { class: "empty" }, "The scenario expects nothing.");
    this.table = el("table", {}, el("thead", {}, el("tr", {}, ...["expected", "bound", "now", "verdict"].map((text) => el("th", {}, text)))), this.rows);
    this.element = el("div", { class: "scroll" }, this.table, this.none, el("table", {}, el("thead", {}, el("tr", {}, el("th", {}, "line"), el("th", { class: "number" }, "count"))), this.figures));
    this.cells = new Map();
  }

  hello() {
    this.cells.clear();
    this.rows.replaceChildren();
    this.figures.replaceChildren();
  }

  draw(state) {
    const verdicts = state.verdicts ?? [];
    this.none.hidden = verdicts.length > 0;
    this.table.hidden = !verdicts.length;
    verdicts.forEach((verdict, i) => {
      const [now, word] = this.#cells(`verdict ${i}`, this.rows, [verdict.value, bound(verdict)]);
      put(now, shown(verdict.now ?? verdict.found));
      const [text, kind] = WORDS[String(verdict.ok ?? null)];
      put(word, text);
      mark(word, "class", kind);
    });
    for (const [name, value] of Object.entries(state.link ?? {})) {
      if (typeof value === "number") put(this.#cells(`link ${name}`, this.figures, [name], 1)[0], shown(value));
    }
  }

  #cells(key, rows, texts, more = 2) {
    let cells = this.cells.get(key);
    if (!cells) {
      cells = Array.from({ length: more }, () => el("td", { class: more === 1 ? "number" : "" }));
      rows.append(el("tr", {}, ...texts.map((text) => el("td", {}, text)), ...cells));
      this.cells.set(key, cells);
    }
    return cells;
  }
}

function shown(value) {
  if (value === null || value === undefined) return "-";
  return typeof value === "number" && !Number.isInteger(value) ? value.toPrecision(4) : String(value);
}

function bound({ at_least, at_most }) {
  return [at_least !== undefined && at_least !== null ? `≥ ${at_least}` : "", at_most !== undefined && at_most !== null ? `≤ ${at_most}` : ""].join(" ").trim();
}
