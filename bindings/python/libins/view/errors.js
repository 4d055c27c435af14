// SPDX-License-Identifier: MIT
// Errors of the navigator's attitude over time: estimate minus truth, as the score of `ins run` counts them.
import { engineering, line, round125, Screen, theme, ticks } from "./canvas.js";
import { choice, el } from "./dom.js";
import { PS_PER_S } from "./status.js";
import { Track } from "./track.js";
import { curve } from "./waves.js";

const KEPT = 1 << 13;
const LABELS = 68;
const AXIS = 15;
const AXES = ["roll", "pitch", "yaw"];
const DASHES = [[], [6, 3], [2, 2]];

export class Errors {
  name = "errors";
  title = "Errors";

  constructor(view) {
    this.view = view;
    this.tracks = AXES.map(() => new Track(KEPT, true));
    this.span = Infinity;
    this.screen = new Screen("Attitude errors over time", (...args) => this.#paint(...args));
    const spans = [["Infinity", "all"], ["60", "60 s"], ["10", "10 s"], ["2", "2 s"]];
    this.element = el("div", {}, el("div", { class: "row" }, choice("Time shown", spans, (value) => this.#show(Number(value)), { id: "errors-span" }), el("span", { class: "muted" }, "estimate − truth")), this.screen.node);
  }

  suits(hello) {
    return hello.has_error !== false;
  }

  hello() {
    for (const track of this.tracks) track.clear();
  }

  #show(span) {
    this.span = span;
    this.view.redraw();
  }

  frame(frame, past) {
    if (past !== undefined) for (const track of this.tracks) track.cut(past);
    if (frame.error && this.tracks[0].t[this.tracks[0].n - 1] !== frame.t_ps) this.tracks.forEach((track, i) => track.add(frame.t_ps, frame.error[i]));
  }

  draw(state) {
    this.now = state.t_ps ?? 0;
    this.screen.redraw();
  }

  shown() {
    this.view.redraw();
  }

  #paint(context, width, height) {
    const colours = theme();
    const first = this.tracks[0];
    if (!first.n) {
      context.fillStyle = colours.muted;
      context.fillText("no error yet: nobody navigates, or nothing is known to compare with", 8, 20);
      return;
    }
    const end = this.now;
    const begin = Math.max(first.t[0], end - this.span * PS_PER_S);
    const last = Math.max(end, begin + PS_PER_S / 1000);
    let most = 1e-9;
    for (const track of this.tracks) for (let i = Math.max(0, track.after(begin) - 1); i < track.n; i++) most = Math.max(most, Math.abs(track.v[i]));
    const top = round125(most);
    const bottom = height - AXIS;
    const x = (t) => LABELS + ((t - begin) / (last - begin)) * (width - LABELS - 4);
    const y = (v) => bottom / 2 - (v / top) * (bottom / 2 - 12);
    context.textAlign = "right";
    for (const v of [-top, -top / 2, 0, top / 2, top]) {
      context.strokeStyle = v === 0 ? colours.border : colours.scale;
      line(context, [LABELS, Math.round(y(v)) + 0.5], [width, Math.round(y(v)) + 0.5]);
      context.fillStyle = colours.muted;
      context.fillText(v === 0 ? "0" : engineering(v, "rad", 3), LABELS - 4, y(v) + 4);
    }
    context.textAlign = "center";
    context.strokeStyle = colours.scale;
    for (const t of ticks(begin / PS_PER_S, last / PS_PER_S, round125((last - begin) / PS_PER_S / 4))) {
      const at = x(t * PS_PER_S);
      line(context, [at, 0], [at, bottom]);
      if (at > LABELS + 10 && at < width - 16) context.fillText(engineering(t, "s", 6), at, height - 3);
    }
    context.textAlign = "left";
    this.tracks.forEach((track, i) => {
      context.strokeStyle = context.fillStyle = colours[`trace-${i}`];
      context.setLineDash(DASHES[i]);
      curve(context, track, begin, last, x, y);
      line(context, [LABELS + 6 + 62 * i, 6], [LABELS + 20 + 62 * i, 6]);
      context.fillText(AXES[i], LABELS + 24 + 62 * i, 10);
    });
    context.setLineDash([]);
  }
}
