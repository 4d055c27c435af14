// SPDX-License-Identifier: MIT
// Faults to switch on: a form made from what the engine says a kind needs, and the list of those that are there.
import { button, choice, el, put } from "./dom.js";

export class Faults {
  name = "faults";
  title = "Faults";

  constructor(view) {
    this.view = view;
    this.kind = choice("Kind of fault", [], () => this.#form(), { id: "fault-kind" });
    this.fields = el("div", { class: "form" });
    this.rows = el("tbody");
    this.list = el("table", {}, el("thead", {}, el("tr", {}, el("th", {}, "fault"), el("th", {}, "state"), el("th", { class: "number" }, "hits"), el("th"))), this.rows);
    this.none = el("div", { class: "empty" }, "Nothing is broken.");
    const add = el("form", { onsubmit: (event) => this.#add(event) }, el("div", { class: "row" }, this.kind, el("button", { class: "main", id: "fault-add" }, "Break it")), this.fields);
    this.nets = el("datalist", { id: "fault-nets" });
    this.element = el("div", { class: "scroll" }, add, this.nets, this.list, this.none);
    this.shownRows = "";
  }

  suits(hello) {
    return Object.keys(hello.faults ?? {}).length > 0;
  }

  hello(hello) {
    this.kinds = hello.faults;
    this.nets.replaceChildren(...[...hello.wires, "HOST RXD", "gnd", "vcc"].map((value) => el("option", { value })));
    this.kind.replaceChildren(...Object.keys(this.kinds).map((kind) => el("option", { value: kind }, kind)));
    this.#form();
  }

  #form() {
    const { keys } = this.kinds[this.kind.value];
    this.inputs = new Map(keys.map((key) => [key.name, { key, input: this.#input(key) }]));
    this.fields.replaceChildren(
      ...[...this.inputs.values()].flatMap(({ key, input }) => [el("label", { for: input.id }, key.required ? `${key.name} *` : key.name), input, el("span", { class: "muted" }, key.unit ?? "")])
    );
  }

  #input(key) {
    const common = { id: `fault-key-${key.name}`, required: Boolean(key.required), "aria-label": key.name };
    if (key.choices) return el("select", common, ...(key.required ? [] : [el("option", { value: "" }, "")]), ...key.choices.map((value) => el("option", { value }, String(value))));
    const isText = key.type === "text";
    return el("input", { ...common, type: isText ? "text" : "number", list: isText ? "fault-nets" : null, step: key.step ?? "any", min: key.min, max: key.max });
  }

  async #add(event) {
    event.preventDefault();
    const fault = { kind: this.kind.value };
    for (const [name, { key, input }] of this.inputs) {
      if (input.value === "") continue;
      const text = key.type === "text" || (key.choices && typeof key.choices[0] === "string");
      fault[name] = text ? input.value : Number(input.value);
    }
    await this.view.ask("fault_add", fault);
  }

  draw(state) {
    const faults = state.faults ?? [];
    this.none.hidden = faults.length > 0;
    this.list.hidden = !faults.length;
    const names = JSON.stringify(faults.map(({ index, kind, on }) => [index, kind, on]));
    if (names !== this.shownRows) {
      this.shownRows = names;
      this.hits = faults.map(() => el("td", { class: "number" }));
      this.rows.replaceChildren(...faults.map((fault, i) => this.#row(fault, this.hits[i])));
    }
    faults.forEach((fault, i) => put(this.hits[i], String(fault.hits ?? 0)));
  }

  #row(fault, hits) {
    const off = button("Off", `Switch ${fault.kind} off`, () => this.view.ask("fault_remove", { index: fault.index }), { disabled: !fault.on });
    return el("tr", {}, el("td", {}, fault.text ?? fault.kind), el("td", { class: fault.on ? "bad" : "muted" }, fault.on ? "on" : "off"), hits, el("td", {}, off));
  }
}
