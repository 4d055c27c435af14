// SPDX-License-Identifier: MIT
// Source and disassembly: where the board stands, breakpoints by click or key.
import { button, choice, el, mark, put } from "./dom.js";

const AHEAD = 120;
const BEFORE = 24;

/** Lines with a gutter; one is the cursor's, which the arrow keys move. */
class Listing {
  /** toggle(line): breakpoint there or not. */
  constructor(name, label, toggle) {
    this.name = name;
    this.toggle = toggle;
    this.rows = [];
    this.code = el("div", { class: "code", role: "listbox", tabindex: "0", "aria-label": `${label}: arrow keys choose a line, b sets a breakpoint` });
    this.node = el("div", { class: "scroll" }, this.code);
    this.code.addEventListener("keydown", (event) => this.#key(event));
    this.code.addEventListener("click", (event) => this.#click(event));
  }

  /** lines: [{number, text, has}]. */
  fill(lines) {
    this.rows = lines.map((line, i) => {
      const gutter = el("span", { class: "gutter", "aria-hidden": "true" });
      const node = el("div", { role: "option", id: `${this.name}-${i}`, class: line.has ? "has" : "" }, gutter, el("span", { class: "number" }, line.number), el("span", {}, line.text || " "));
      return { ...line, node, gutter };
    });
    this.code.replaceChildren(...this.rows.map((row) => row.node));
    this.cursor = this.here = this.followed = null;
  }

  /** Show where the board stands, and breakpoints: a predicate of a row. */
  show(isHere, hasBreak, follow) {
    const here = this.rows.find(isHere) ?? null;
    for (const row of this.rows) {
      const broken = hasBreak(row);
      const now = row === here;
      mark(row.node, "class", [row.has && "has", now && "here", row === this.cursor && "cursor"].filter(Boolean).join(" "));
      mark(row.node, "aria-selected", String(row === this.cursor));
      const sign = broken ? "●" : now ? "▶" : "";
      if (row.sign !== sign) row.gutter.textContent = row.sign = sign;
      if (row.broken !== broken) mark(row.node, "data-break", String((row.broken = broken)));
    }
    if (follow && here && here !== this.followed) this.#into(here);
    this.followed = follow ? here : null;
    this.here = here;
    return here !== null;
  }

  #into(row) {
    const { scrollTop, clientHeight } = this.node;
    const { offsetTop } = row.node;
    if (offsetTop < scrollTop + 20 || offsetTop > scrollTop + clientHeight - 40) this.node.scrollTop = Math.max(0, offsetTop - clientHeight / 3);
  }

  #choose(row) {
    if (!row) return;
    if (this.cursor) this.cursor.node.classList.remove("cursor");
    this.cursor = row;
    mark(row.node, "class", `${row.node.className} cursor`);
    mark(this.code, "aria-activedescendant", row.node.id);
    this.#into(row);
  }

  #click(event) {
    const row = this.rows.find((each) => each.node.contains(event.target));
    this.#choose(row);
    if (row && event.target === row.gutter) this.toggle(row);
  }

  #key(event) {
    const i = this.rows.indexOf(this.cursor ?? this.here);
    const to = { ArrowDown: i + 1, ArrowUp: i - 1, PageDown: i + 20, PageUp: i - 20, Home: 0, End: this.rows.length - 1 }[event.key];
    if (to !== undefined) this.#choose(this.rows[Math.min(Math.max(to, 0), this.rows.length - 1)]);
    else if (event.key === "b" && (this.cursor ?? this.here)) this.toggle(this.cursor ?? this.here);
    else return;
    event.preventDefault();
  }
}

export class Source {
  name = "source";
  title = "Source";

  constructor(view) {
    this.view = view;
    this.file = choice("File", [], (file) => this.#open(file), { id: "source-file" });
    this.follow = el("input", { type: "checkbox", checked: true, "aria-label": "Follow the board" });
    this.none = el("div", { class: "empty", hidden: true });
    this.listing = new Listing(this.name, "Source", (row) => this.#toggle(row));
    this.element = el("div", {}, el("div", { class: "row" }, this.file, el("label", {}, this.follow, "follow")), this.none, this.listing.node);
  }

  suits(hello) {
    return Boolean(hello.has_source && hello.can_step);
  }

  hello(hello) {
    this.shownFile = null;
    this.file.replaceChildren(...hello.files.map((file) => el("option", { value: file }, file)));
    this.#open(hello.files[0]);
  }

  async #open(file) {
    if (this.shownFile === file) return;
    this.shownFile = file;
    this.file.value = file;
    const answer = await this.view.link.ask("source", { file }).catch((error) => ({ lines: [], addresses: {}, why: error.message }));
    if (this.shownFile !== file) return;
    this.listing.fill(answer.lines.map((text, i) => ({ number: i + 1, text, has: Boolean(answer.addresses[i + 1]) })));
    this.none.hidden = !answer.why;
    put(this.none, answer.why ?? "");
    this.view.redraw();
  }

  shown() {
    this.view.redraw();
  }

  draw(state) {
    const { line } = state;
    const follow = this.follow.checked && !state.running;
    if (follow && line && line.file !== this.shownFile) this.#open(line.file);
    const mine = (place) => place && place.file === this.shownFile;
    const broken = new Set((state.breaks ?? []).filter((each) => mine(each.line)).map((each) => each.line.number));
    this.listing.show((row) => mine(line) && row.number === line.number, (row) => broken.has(row.number), follow);
  }

  async #toggle(row) {
    const there = (this.view.state.breaks ?? []).filter((each) => each.line?.file === this.shownFile && each.line.number === row.number);
    for (const each of there) await this.view.ask("break_remove", { number: each.number });
    if (!there.length) await this.view.ask("break_add", { at: `${this.shownFile}:${row.number}` });
  }
}

export class Disassembly {
  name = "disassembly";
  title = "Disassembly";

  constructor(view) {
    this.view = view;
    this.listing = new Listing(this.name, "Disassembly", (row) => this.#toggle(row));
    const step = (name, text, label, id) => button(text, label, () => this.view.ask(name, { instruction: true }), { id });
    this.element = el(
      "div", {},
      el("div", { class: "row" }, step("step", "Instruction", "Step one instruction", "do-stepi"), step("step_back", "⟵ Instruction", "Step back one instruction", "do-stepi-back")),
      this.listing.node
    );
  }

  suits(hello) {
    return Boolean(hello.can_step);
  }

  hello() {
    this.listing.fill([]);
    this.asked = null;
  }

  shown() {
    this.view.redraw();
  }

  draw(state) {
    if (state.pc === undefined) return;
    const broken = new Set((state.breaks ?? []).flatMap((each) => each.addresses));
    const known = this.listing.show((row) => row.address === state.pc, (row) => broken.has(row.address), !state.running);
    if (!known && !state.running && this.asked !== state.pc) this.#fetch(state.pc);
  }

  async #fetch(pc) {
    this.asked = pc;
    const answer = await this.view.ask("disassembly", { address: pc, count: AHEAD, before: BEFORE });
    if (!answer) return;
    const digits = (value) => value.toString(16).toUpperCase().padStart(4, "0");
    let name = null;
    this.listing.fill(answer.instructions.map(({ address, octets, text, function: inside }) => {
      const note = inside && inside !== name ? `   ; ${inside}` : "";
      name = inside;
      return { address, number: digits(address), text: `${octets.toUpperCase().padEnd(7)} ${text}${note}`, has: true };
    }));
    this.asked = null;
    this.view.redraw();
  }

  async #toggle(row) {
    const there = (this.view.state.breaks ?? []).filter((each) => each.addresses.includes(row.address));
    for (const each of there) await this.view.ask("break_remove", { number: each.number });
    if (!there.length) await this.view.ask("break_add", { at: `*0x${row.address.toString(16)}` });
  }
}
