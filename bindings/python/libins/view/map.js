// SPDX-License-Identifier: MIT
// Where the board is: a local grid of east and north with a scale, the way of truth and of the estimate. No tiles.
import { engineering, line, round125, Screen, theme, ticks } from "./canvas.js";
import { button, el, put } from "./dom.js";

const KEPT = 1 << 12;
const DEG = 180 / Math.PI;
const LEAST_M = 1e-3;

/** A way: points of [east, north] with their instants; thinned when full. */
class Way {
  points = [];
  every = 1;
  skipped = 0;

  add(t, [east, north]) {
    if (++this.skipped < this.every) return;
    this.skipped = 0;
    this.points.push([t, east, north]);
    if (this.points.length > KEPT) {
      this.points = this.points.filter((_, i) => i % 2 === 0);
      this.every *= 2;
    }
  }

  cut(t) {
    this.points = this.points.filter((point) => point[0] <= t);
  }
}

export class Place {
  name = "map";
  title = "Map";

  constructor(view) {
    this.view = view;
    this.screen = new Screen("Way of the board, north up", (...args) => this.#paint(...args), { tabindex: "0" });
    this.text = el("div", { class: "mono row" });
    this.element = el(
      "div", {},
      el("div", { class: "row" }, button("−", "Zoom out", () => this.#zoom(0.5)), button("+", "Zoom in", () => this.#zoom(2)), button("All", "Show the whole way", () => this.#all()),
        el("span", { class: "muted" }, "█ truth  ┄ estimate")),
      this.screen.node, this.text
    );
    this.screen.canvas.addEventListener("keydown", (event) => this.#key(event));
    this.screen.canvas.addEventListener("wheel", (event) => {
      event.preventDefault();
      this.#zoom(event.deltaY > 0 ? 0.8 : 1.25);
    }, { passive: false });
    this.#all();
  }

  hello() {
    this.ways = { truth: new Way(), estimate: new Way() };
  }

  frame(frame, past) {
    const { position } = frame;
    if (past !== undefined) for (const way of Object.values(this.ways)) way.cut(past);
    if (position?.en) this.ways.truth.add(frame.t_ps, position.en);
    if (position?.estimate?.en) this.ways.estimate.add(frame.t_ps, position.estimate.en);
  }

  draw(state) {
    this.position = state.position;
    const llh = state.position?.llh;
    put(this.text, llh ? `${(llh[0] * DEG).toFixed(7)}°  ${(llh[1] * DEG).toFixed(7)}°  ${llh[2].toFixed(2)} m` : "");
    this.screen.redraw();
  }

  shown() {
    this.view.redraw();
  }

  #all() {
    this.scale = null;
    this.shift = [0, 0];
    this.view.redraw?.();
  }

  #zoom(by) {
    this.scale = (this.scale ?? this.fitted) * by;
    this.view.redraw();
  }

  #key(event) {
    const move = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] }[event.key];
    if (move) {
      this.scale ??= this.fitted;
      this.shift = this.shift.map((each, i) => each + (40 / this.scale) * move[i]);
      this.view.redraw();
    } else if (event.key === "+") this.#zoom(2);
    else if (event.key === "-") this.#zoom(0.5);
    else if (event.key === "0") this.#all();
    else return;
    event.preventDefault();
  }

  #paint(context, width, height) {
    const colours = theme();
    const all = Object.values(this.ways ?? {}).flatMap((way) => way.points);
    if (!all.length) {
      context.fillStyle = colours.muted;
      context.fillText("no position: this run has none", 8, 20);
      context.fillText("(one with [track] or [gps] has)", 8, 36);
      return;
    }
    let [west, east, south, north] = [Infinity, -Infinity, Infinity, -Infinity];
    for (const [, e, n] of all) {
      west = Math.min(west, e);
      east = Math.max(east, e);
      south = Math.min(south, n);
      north = Math.max(north, n);
    }
    this.fitted = Math.min((width - 40) / Math.max(east - west, LEAST_M), (height - 50) / Math.max(north - south, LEAST_M));
    const scale = this.scale ?? this.fitted;
    const [middleE, middleN] = [(west + east) / 2 + this.shift[0], (south + north) / 2 + this.shift[1]];
    const x = (e) => width / 2 + (e - middleE) * scale;
    const y = (n) => height / 2 - (n - middleN) * scale;
    const step = round125(70 / scale);
    context.strokeStyle = colours.scale;
    for (const e of ticks(middleE - width / 2 / scale, middleE + width / 2 / scale, step)) line(context, [x(e), 0], [x(e), height]);
    for (const n of ticks(middleN - height / 2 / scale, middleN + height / 2 / scale, step)) line(context, [0, y(n)], [width, y(n)]);
    this.#way(context, this.ways.truth, x, y, colours.outline, [], 4);
    this.#way(context, this.ways.estimate, x, y, colours["trace-2"], [5, 3], 1.5);
    context.strokeStyle = context.fillStyle = colours.text;
    line(context, [10, height - 8], [10 + step * scale, height - 8]);
    context.fillText(engineering(step, "m"), 14, height - 12);
    line(context, [width - 14, 26], [width - 14, 8], [width - 18, 14]);
    context.fillText("N", width - 17, 38);
  }

  #way(context, way, x, y, colour, dash, thick) {
    if (!way.points.length) return;
    context.strokeStyle = context.fillStyle = colour;
    context.setLineDash(dash);
    context.lineWidth = thick;
    context.globalAlpha = thick > 2 ? 0.45 : 1;
    context.beginPath();
    for (const [, e, n] of way.points) context.lineTo(x(e), y(n));
    context.stroke();
    context.globalAlpha = 1;
    context.setLineDash([]);
    context.lineWidth = 1;
    const [, e, n] = way.points.at(-1);
    context.fillRect(x(e) - 3, y(n) - 3, 6, 6);
  }
}
