// SPDX-License-Identifier: MIT
// Knobs of the sensors: a slider and a number each, in groups; what they change goes to the engine, whose values they show.
import { button, el } from "./dom.js";

const EACH_MS = 50;

export class Knobs {
  name = "knobs";
  title = "Knobs";

  constructor(view) {
    this.view = view;
    this.element = el("div", { class: "scroll" });
  }

  suits(hello) {
    return (hello.knobs ?? []).length > 0;
  }

  hello(hello) {
    this.knobs = new Map();
    const groups = Map.groupBy ? Map.groupBy(hello.knobs, (knob) => knob.group) : grouped(hello.knobs);
    this.element.replaceChildren(
      ...[...groups].flatMap(([group, knobs]) => [
        el("div", { class: "group" }, el("span", {}, group), button("Reset", `${group}: as when this page was opened; inputs: let go`, () => knobs.forEach((knob) => this.#set(knob.name, knob.unit === "V" ? null : knob.value)))),
        ...knobs.map((knob) => this.#row(knob)),
      ])
    );
  }

  #row(knob) {
    const limits = { min: knob.min, max: knob.max, value: knob.value };
    const fine = { step: knob.step };
    const changed = (event) => this.#set(knob.name, event.target.value === "" ? null : Number(event.target.value));
    const slider = el("input", { type: "range", "aria-label": `${knob.group}: ${knob.label}, slider`, oninput: changed, ...fine, ...limits });
    const number = el("input", { type: "number", id: `knob-${knob.name}`, "aria-label": `${knob.group}: ${knob.label}`, onchange: changed, ...fine, ...limits });
    this.knobs.set(knob.name, { slider, number });
    return el("div", { class: "knob" }, el("span", {}, knob.label), slider, number, el("span", { class: "muted" }, (knob.unit ?? "").replace("sqrt(Hz)", "√Hz")));
  }

  /** The newest value of a knob, sent no more often than each EACH_MS. */
  #set(name, value) {
    const knob = this.knobs.get(name);
    this.#show(knob, value);
    knob.next = value;
    if (knob.timer) return;
    const send = async () => {
      while (knob.next !== undefined) {
        const now = knob.next;
        knob.next = undefined;
        await this.view.ask("knob", { name, value: now });
        await new Promise((done) => setTimeout(done, EACH_MS));
      }
      knob.timer = null;
    };
    knob.timer = send();
  }

  draw(state) {
    for (const [name, value] of Object.entries(state.knobs ?? {})) {
      const knob = this.knobs?.get(name);
      if (knob && !knob.timer && knob.shown !== value) this.#show(knob, value);
    }
  }

  /** null: nobody turns it. */
  #show(knob, value) {
    knob.shown = value;
    const text = value === null ? "" : String(Number(value.toPrecision(4)));
    if (document.activeElement !== knob.slider || value === null) knob.slider.value = text;
    if (document.activeElement !== knob.number || value === null) knob.number.value = text;
  }
}

function grouped(knobs) {
  const groups = new Map();
  for (const knob of knobs) groups.set(knob.group, [...(groups.get(knob.group) ?? []), knob]);
  return groups;
}
