// SPDX-License-Identifier: MIT
// All breakpoints with their hits, and new ones: at a place, where a condition holds, or both.
import { button, el, put } from "./dom.js";

export class Breakpoints {
  name = "breakpoints";
  title = "Breakpoints";

  constructor(view) {
    this.view = view;
    this.at = el("input", { class: "grow mono", id: "break-at", placeholder: "file.c:90, tick, *0x123", "aria-label": "Place of the breakpoint" });
    this.condition = el("input", { class: "grow mono", id: "break-condition", placeholder: "condition, or alone: its change", "aria-label": "Condition of the breakpoint" });
    this.rows = el("tbody");
    this.table = el("table", {}, el("thead", {}, el("tr", {}, ...["stop at", "if", "hits", ""].map((text) => el("th", {}, text)))), this.rows);
    this.none = el("div", { class: "empty" }, "None. Click beside a source line, or name a place above.");
    const form = el("form", { class: "row", onsubmit: (event) => this.#add(event) }, this.at, this.condition, el("button", { class: "main", id: "break-add" }, "Add"));
    this.element = el("div", { class: "scroll" }, form, this.table, this.none);
  }

  suits(hello) {
    return Boolean(hello.can_step);
  }

  async #add(event) {
    event.preventDefault();
    const asked = {};
    if (this.at.value.trim()) asked.at = this.at.value.trim();
    if (this.condition.value.trim()) asked.condition = this.condition.value.trim();
    if (await this.view.ask("break_add", asked)) this.at.value = this.condition.value = "";
  }

  shown() {
    this.view.redraw();
  }

  draw(state) {
    const breaks = state.breaks ?? [];
    this.none.hidden = breaks.length > 0;
    this.table.hidden = !breaks.length;
    const key = JSON.stringify(breaks.map(({ number, text, condition }) => [number, text, condition]));
    if (key !== this.key) {
      this.key = key;
      this.hits = breaks.map(() => el("td", { class: "number" }));
      this.rows.replaceChildren(
        ...breaks.map((each, i) =>
          el("tr", {}, el("td", {}, `${each.kind === "code" ? "" : `${each.kind} `}${each.text}`), el("td", {}, each.condition), this.hits[i],
            el("td", {}, button("Remove", `Remove breakpoint ${each.number}`, () => this.view.ask("break_remove", { number: each.number }))))
        )
      );
    }
    breaks.forEach((each, i) => put(this.hits[i], String(each.hits)));
  }
}
