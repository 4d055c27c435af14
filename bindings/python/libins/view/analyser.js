// SPDX-License-Identifier: MIT
// Logic analyser and oscilloscope on one time axis: wires chosen, zoom, live or held, trigger on the display or on the board,
// two cursors.
import { engineering, Screen } from "./canvas.js";
import { button, choice, el, labelled, mark, put } from "./dom.js";
import { Track } from "./track.js";
import { paint } from "./waves.js";
import { PS_PER_S } from "./status.js";

const EDGES = 1 << 16;
const VOLTS = 1 << 14;
const LEAST_S = 1e-7;
const MOST_S = 100;
/** Where on the screen the trigger's edge is. */
const AT = 0.2;
const ASK_MS = 150;
const DIVISIONS = 10;
const SPANS = [1e-6, 2e-6, 5e-6, 1e-5, 2e-5, 5e-5, 1e-4, 2e-4, 5e-4, 1e-3, 2e-3, 5e-3, 0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1, 2, 5];

export class Analyser {
  name = "analyser";
  title = "Logic analyser and oscilloscope";

  constructor(view) {
    this.view = view;
    this.wires = [];
    this.channels = [];
    this.tracks = new Map();
    this.volts = new Map();
    this.span = 0.05 * PS_PER_S;
    this.end = 0;
    this.live = true;
    this.cursors = { A: null, C: null };
    this.trigger = { mode: "off", wire: null, edge: "rise" };
    this.screen = new Screen("Waveforms", (context, width, height) => paint(this, context, width, height), { tabindex: "0", role: "application" });
    this.#controls();
    this.element = el("div", {}, this.bar, this.screen.node, this.readout);
    const canvas = this.screen.canvas;
    canvas.addEventListener("wheel", (event) => {
      event.preventDefault();
      this.zoom(event.deltaY > 0 ? 1.25 : 0.8, this.#timeAt(event));
    }, { passive: false });
    canvas.addEventListener("pointerdown", (event) => this.#drag(event));
    canvas.addEventListener("keydown", (event) => this.#key(event));
  }

  #controls() {
    this.liveButton = button("Live", "Follow the newest (l)", () => this.follow(!this.live), { "aria-pressed": "true", id: "live" });
    const spans = SPANS.map((each) => [String(each), `${engineering(each, "s")}/div`]);
    this.scale = choice("Time per division", spans, (value) => this.#setSpan(Number(value) * DIVISIONS * PS_PER_S), { id: "scale" });
    this.scale.value = "0.005";
    this.picks = el("div");
    this.mode = choice("Trigger", [["off", "no trigger"], ["hold", "hold display"], ["stop", "stop board"]], (mode) => this.arm({ mode }), { id: "trigger" });
    this.wire = choice("Wire of the trigger", [], (wire) => this.arm({ wire }), { id: "trigger-wire" });
    this.edge = choice("Edge of the trigger", [["rise", "↑ rise"], ["fall", "↓ fall"], ["level", "↕ either"]], (edge) => this.arm({ edge }), { id: "trigger-edge" });
    this.bar = el(
      "div", { class: "row" },
      this.liveButton, button("◀", "Earlier (←)", () => this.pan(-0.25)), button("▶", "Later (→)", () => this.pan(0.25)),
      button("−", "Zoom out (-)", () => this.zoom(2)), button("+", "Zoom in (+)", () => this.zoom(0.5)), this.scale,
      el("details", { class: "menu left", id: "wires" }, el("summary", {}, "Wires"), this.picks), this.mode, this.wire, this.edge
    );
    this.text = el("span", { class: "mono grow", id: "cursors" });
    this.readout = el(
      "div", { class: "row" },
      ...["A", "C"].map((name) => button(name, `Cursor ${name} to the middle (${name.toLowerCase()})`, () => this.setCursor(name, this.middle), { id: `cursor-${name}` })),
      button("None", "Take the cursors away", () => this.#clearCursors()), this.text
    );
  }

  suits(hello) {
    return hello.wires.length > 0;
  }

  hello(hello) {
    const keep = new Set(this.wires);
    this.wires = hello.wires.filter((wire) => (keep.size ? keep.has(wire) : !/^P\d\.\d$/.test(wire)));
    this.all = hello.wires;
    this.tracks = new Map(hello.wires.map((wire) => [wire, new Track(EDGES)]));
    this.volts = new Map();
    this.channels = [];
    this.archive = null;
    this.since = null;
    this.live = true;
    this.picks.replaceChildren(...hello.wires.map((wire) => this.#pick(wire, () => this.toggle(wire), this.wires.includes(wire))));
    this.wire.replaceChildren(...hello.wires.map((wire) => el("option", { value: wire }, wire)));
    this.mode.options[2].disabled = hello.kind !== "8051";
    this.trigger = { mode: "off", wire: hello.wires[0] ?? null, edge: "rise" };
    this.mode.value = "off";
  }

  #pick(name, act, checked) {
    return labelled(name, el("input", { type: "checkbox", checked, "data-wire": name, onchange: act }));
  }

  /** Show a wire or not. */
  toggle(wire) {
    this.wires = this.all.filter((each) => (each === wire ? !this.wires.includes(wire) : this.wires.includes(each)));
    for (const box of this.picks.querySelectorAll("input")) if (box.dataset.wire === wire) box.checked = this.wires.includes(wire);
    this.#changed();
  }

  #channel(name) {
    this.volts.set(name, new Track(VOLTS));
    this.channels.push(name);
    const act = () => {
      this.channels = [...this.volts.keys()].filter((each) => (each === name ? !this.channels.includes(name) : this.channels.includes(each)));
      this.#changed();
    };
    this.picks.append(this.#pick(`AIN${name}`, act, true));
  }

  frame(frame, past) {
    for (const tracks of [this.tracks, this.volts]) if (past !== undefined) for (const track of tracks.values()) track.cut(past);
    if (past !== undefined) this.archive = null;
    const names = this.all ?? [];
    for (const [t, wire, level] of frame.edges ?? []) this.tracks.get(names[wire])?.add(t, level);
    for (const [t, channel, volts] of frame.analog ?? []) {
      if (!this.volts.has(String(channel))) this.#channel(String(channel));
      this.volts.get(String(channel)).add(t, volts);
    }
    if (this.since === null || frame.dropped || past < this.since) {
      this.since = frame.t_ps;
      for (const wire of names) if (frame.nets?.[wire] !== undefined) this.tracks.get(wire).add(frame.t_ps, Number(frame.nets[wire]));
    }
  }

  draw(state) {
    this.now = state.t_ps ?? 0;
    if (this.live) this.end = this.now;
    if (this.live && this.trigger.mode === "hold") this.#hold();
    this.screen.redraw();
    this.#read();
    mark(this.liveButton, "aria-pressed", String(this.live));
  }

  shown() {
    this.view.redraw();
  }

  stopped() {
    this.#ask();
  }

  /** The newest edge of the trigger that still has the screen's rest behind it. */
  #hold() {
    const track = this.tracks.get(this.trigger.wire);
    const { edge } = this.trigger;
    for (let i = (track?.after(this.now - (1 - AT) * this.span) ?? 0) - 1; i >= 0; i--) {
      if (edge === "level" || track.v[i] === Number(edge === "rise")) {
        this.end = track.t[i] + (1 - AT) * this.span;
        return;
      }
    }
  }

  /** Change the trigger: off, hold the display at it, or stop the board at it. */
  async arm(change) {
    const before = this.trigger.mode;
    this.trigger = { ...this.trigger, ...change };
    const { mode, wire, edge } = this.trigger;
    if (mode === "stop") await this.view.ask("trigger", { wire, edge });
    else if (before === "stop") await this.view.ask("trigger", { wire, edge: null });
    this.#changed();
  }

  get begin() {
    return this.end - this.span;
  }

  get middle() {
    return this.end - this.span / 2;
  }

  follow(live) {
    this.live = live;
    this.#changed();
  }

  pan(part) {
    this.live = false;
    this.end += part * this.span;
    this.#changed();
  }

  zoom(by, around = this.live ? this.end : this.middle) {
    const span = Math.min(Math.max(this.span * by, LEAST_S * PS_PER_S), MOST_S * PS_PER_S);
    this.end = around + ((this.end - around) * span) / this.span;
    this.#setSpan(span);
  }

  #setSpan(span) {
    this.span = span;
    const nearest = SPANS.reduce((best, each) => (Math.abs(Math.log((each * DIVISIONS * PS_PER_S) / span)) < Math.abs(Math.log((best * DIVISIONS * PS_PER_S) / span)) ? each : best));
    this.scale.value = String(nearest);
    this.#changed();
  }

  setCursor(name, t) {
    this.cursors[name] = t;
    this.last = name;
    this.#changed();
  }

  #clearCursors() {
    this.cursors = { A: null, C: null };
    this.#changed();
  }

  #changed() {
    this.view.redraw();
    if (!this.live) this.#ask();
  }

  /** What lies before the page's own memory comes from the engine. */
  #ask() {
    clearTimeout(this.asking);
    const [from, to] = [Math.max(0, this.begin), Math.min(this.end, this.now ?? 0)];
    const own = this.since !== null && from >= this.since && this.wires.every((wire) => (this.tracks.get(wire).t[0] ?? Infinity) <= from || this.tracks.get(wire).n < EDGES / 2);
    if (own || to <= from || (this.archive && this.archive.from <= from && to <= this.archive.to)) return;
    this.asking = setTimeout(async () => {
      const margin = this.span / 2;
      const window = { from_ps: Math.max(0, Math.floor(from - margin)), to_ps: Math.ceil(to + margin) };
      const answer = await this.view.ask("edges", { wires: this.all, ...window });
      if (!answer) return;
      const tracks = new Map(this.all.map((wire) => [wire, new Track(Math.max(2, answer.edges.length))]));
      for (const [t, wire, level] of answer.edges) tracks.get(this.all[wire]).add(t, level);
      this.archive = { from: window.from_ps, to: window.to_ps, tracks };
      this.view.redraw();
    }, ASK_MS);
  }

  /** Edges of a wire for the window that is shown. */
  edges(wire) {
    const held = this.archive && this.archive.from <= Math.max(0, this.begin) && Math.min(this.end, this.now) <= this.archive.to;
    return (held && !this.live ? this.archive.tracks : this.tracks).get(wire);
  }

  #read() {
    const { A, C } = this.cursors;
    const at = (t) => engineering(t / PS_PER_S, "s", 10);
    const parts = [];
    if (A !== null) parts.push(`A ${at(A)}`);
    if (C !== null) parts.push(`C ${at(C)}`);
    if (A !== null && C !== null) {
      const dt = Math.abs(C - A) / PS_PER_S;
      parts.push(`dt ${engineering(dt, "s", 6)}`);
      if (dt > 0) parts.push(`1/dt ${engineering(1 / dt, "Hz", 6)}`);
    }
    put(this.text, parts.join("   ") || "click: cursor A, shift-click: cursor C");
  }

  #timeAt(event) {
    const box = this.screen.canvas.getBoundingClientRect();
    const left = this.plotLeft ?? 0;
    return this.begin + (this.span * (event.clientX - box.left - left)) / (box.width - left);
  }

  #drag(event) {
    const canvas = this.screen.canvas;
    canvas.setPointerCapture(event.pointerId);
    const start = event.clientX;
    let last = start;
    let moved = false;
    canvas.onpointermove = (now) => {
      moved ||= Math.abs(now.clientX - start) > 3;
      if (moved) this.pan((last - now.clientX) / (canvas.clientWidth - (this.plotLeft ?? 0)));
      last = now.clientX;
    };
    canvas.onpointerup = (up) => {
      canvas.onpointermove = canvas.onpointerup = null;
      if (!moved) this.setCursor(up.shiftKey ? "C" : "A", this.#timeAt(up));
    };
  }

  /** Move the last cursor to the edge before (-1) or behind (1) it, of the wires that are shown. */
  snap(way) {
    const at = this.cursors[this.last];
    if (at === null || at === undefined) return;
    const all = this.wires.map((wire) => {
      const track = this.edges(wire);
      const i = way > 0 ? track.after(at) : track.after(at - 1) - 1;
      return i >= 0 && i < track.n ? track.t[i] : null;
    });
    const found = all.filter((t) => t !== null && t !== at);
    if (found.length) this.setCursor(this.last, way > 0 ? Math.min(...found) : Math.max(...found));
  }

  #key(event) {
    const act = {
      ArrowLeft: () => this.pan(-0.1), ArrowRight: () => this.pan(0.1), "+": () => this.zoom(0.5), "-": () => this.zoom(2),
      l: () => this.follow(!this.live), a: () => this.setCursor("A", this.middle), c: () => this.setCursor("C", this.middle),
      "[": () => this.snap(-1), "]": () => this.snap(1),
    }[event.key];
    if (!act || event.ctrlKey || event.metaKey || event.altKey) return;
    event.preventDefault();
    act();
  }
}
