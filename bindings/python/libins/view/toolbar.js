// SPDX-License-Identifier: MIT
// Run control, speed, the way back, files to keep, the menu of panels, keys.
import { button, choice, download, el, labelled, mark, put } from "./dom.js";
import { PS_PER_S, seconds } from "./status.js";

const SPEEDS = [["0.001", "0.001×"], ["0.01", "0.01×"], ["0.1", "0.1×"], ["0.5", "0.5×"], ["1", "1×"], ["2", "2×"], ["5", "5×"], ["20", "20×"], ["max", "max"]];

/** Text, label, key as shown, command; in the order of the bar. */
const COMMANDS = [
  ["step", "Step", "Step to another line", "s"],
  ["step_over", "Over", "Step over a call", "n"],
  ["finish", "Out", "Finish this function", "f"],
  ["step_back", "⟵ Step", "Step back", "S"],
  ["step_over_back", "⟵ Over", "Step back over a call", "N"],
  ["run_back", "⟵ Run", "Run back to a breakpoint or the begin", "R"],
  ["reset", "Reset", "Start again from power-on", "0"],
];
const BACK = 3;

export class Toolbar {
  constructor(view, node) {
    this.view = view;
    this.node = node;
    this.keys = new Map([["r", () => this.run()], ["?", () => this.help.showModal()]]);
    this.title = el("h1");
    this.runButton = button("Run", "Run or pause (r)", () => this.run(), { class: "main", id: "do-run" });
    this.buttons = COMMANDS.map(([name, text, label, key]) => {
      const act = () => view.ask(name);
      this.keys.set(key, act);
      return button(text, `${label} (${key})`, act, { id: `do-${name}` });
    });
    this.speed = choice("Speed", SPEEDS, (value) => view.ask("speed", { value: value === "max" ? value : Number(value) }), { id: "speed" });
    this.slider = el("input", { type: "range", min: "0", value: "0", "aria-label": "Instant of the recording", oninput: () => this.#seek() });
    this.instant = el("span", { class: "mono" });
    this.seek = el("div", { id: "seek", hidden: true }, this.slider, this.instant);
    this.menu = el("div");
    this.toSave = button("Save scenario", "Save what was done as a scenario", () => this.#save(), { id: "do-save" });
    this.toKeep = button("Snapshot", "Save the present state as a snapshot", () => this.#snapshot(), { id: "do-snapshot" });
    this.help = this.#help();
    this.asHelp = button("?", "Keys (?)", () => this.help.showModal(), { id: "do-help" });
    node.append(
      this.title, this.runButton, el("span", { class: "gap" }), ...this.buttons.slice(0, BACK), el("span", { class: "gap" }),
      ...this.buttons.slice(BACK), el("span", { class: "gap" }), this.speed, this.seek, el("span", { class: "push" }),
      this.toSave, this.toKeep, el("details", { class: "menu", id: "panels" }, el("summary", {}, "Panels"), this.menu), this.asHelp, this.help
    );
    document.addEventListener("keydown", (event) => this.#key(event));
    document.addEventListener("click", (event) => {
      for (const menu of document.querySelectorAll("details.menu[open]")) if (!menu.contains(event.target)) menu.open = false;
    });
  }

  hello(hello) {
    put(this.title, hello.title);
    this.title.title = hello.title;
    const recording = hello.kind === "recording";
    this.seek.hidden = !recording;
    for (const each of this.buttons) each.hidden = recording || (!hello.can_step && !each.id.endsWith("reset"));
    this.toSave.hidden = recording || !(hello.can_save ?? hello.knobs?.length);
    this.toKeep.hidden = recording || !hello.can_step;
    if (recording) {
      const end = Math.round(hello.stop_s * PS_PER_S);
      this.slider.max = end;
      this.slider.step = Math.max(1, Math.round(end / 10_000));
    }
  }

  connect(connected) {
    for (const each of [this.runButton, this.speed, this.slider, this.toSave, this.toKeep, ...this.buttons]) each.disabled = !connected;
  }

  draw(state) {
    for (const each of this.buttons) if (each.id !== "do-reset") each.disabled = !this.view.connected || Boolean(state.running);
    put(this.runButton, state.running ? "Pause" : "Run");
    mark(this.runButton, "aria-pressed", String(Boolean(state.running)));
    const speed = String(state.speed ?? "1");
    if (document.activeElement !== this.speed && this.shownSpeed !== speed) {
      if (![...this.speed.options].some((option) => option.value === speed)) this.speed.append(el("option", { value: speed }, `${speed}×`));
      this.speed.value = this.shownSpeed = speed;
    }
    if (!this.seek.hidden && state.t_ps !== undefined) {
      if (document.activeElement !== this.slider || state.running) this.slider.value = state.t_ps;
      put(this.instant, seconds(state.t_ps));
    }
  }

  run() {
    this.view.ask(this.view.state.running ? "pause" : "run");
  }

  #seek() {
    this.view.ask("to", { t_ps: Number(this.slider.value) });
  }

  async #save() {
    const answer = await this.view.ask("save");
    if (!answer) return;
    download(answer.name, answer.toml, "application/toml");
    this.view.say(`${answer.name} plays the same run: ins run ${answer.name}`, true);
  }

  async #snapshot() {
    const answer = await this.view.ask("snapshot");
    if (answer) download(answer.name, Uint8Array.from(atob(answer.base64), (c) => c.charCodeAt(0)), "application/octet-stream");
  }

  /** The menu that closes and opens panels. */
  panels(panels) {
    panels.forEach((panel) => {
      const box = el("input", { type: "checkbox", id: `open-${panel.name}`, onchange: () => (box.checked ? panel.slot.open(panel) : panel.slot.close(panel)) });
      this.menu.append(labelled(panel.title, box));
      new MutationObserver(() => (box.checked = !panel.tab.hidden)).observe(panel.tab, { attributeFilter: ["hidden"] });
      box.checked = true;
    });
    panels.slice(0, 9).forEach((panel, i) => this.keys.set(String(i + 1), () => this.view.show(panel.name).tab.focus()));
  }

  #key(event) {
    if (event.key === "Escape") {
      for (const menu of document.querySelectorAll("details.menu[open]")) menu.open = false;
      for (const slot of document.querySelectorAll(".slot.full")) slot.querySelector("[aria-pressed]").click();
    }
    const typing = event.target.closest("input:not([type=checkbox], [type=range]), select, textarea, dialog");
    if (typing || event.ctrlKey || event.metaKey || event.altKey || event.defaultPrevented || !this.single.checked) return;
    const act = this.keys.get(event.key);
    if (act && (this.view.connected || event.key === "?")) {
      event.preventDefault();
      act();
    }
  }

  #help() {
    this.single = el("input", { type: "checkbox", checked: true });
    const rows = [
      ["r", "run, pause"], ...COMMANDS.map(([, , label, key]) => [key, label.toLowerCase()]),
      ["1 ... 9", "to a panel, in the order of the menu"], ["Esc", "close a menu, end a panel's filling of the desk"],
      ["b", "in source and disassembly: breakpoint on or off; ↑ ↓ choose the line"],
      ["← →", "in tabs: another panel; on a separator (also ↑ ↓): move it"],
      ["← → + -", "in the analyser: pan, zoom; l: live"],
      ["a, c", "in the analyser: cursor A or C to the middle; [ and ]: move the last one to the edge before or behind"],
      ["+ - arrows", "in the schematic and the map: zoom, move; 0: all"],
    ];
    return el(
      "dialog", { "aria-labelledby": "help-title" }, el("h2", { id: "help-title" }, "Keys"),
      el("table", {}, ...rows.map(([keys, what]) => el("tr", {}, el("td", {}, el("kbd", {}, keys)), el("td", {}, what)))),
      el("p", {}, labelled("letters and digits act as keys", this.single)),
      el("form", { method: "dialog" }, el("button", {}, "Close"))
    );
  }
}
