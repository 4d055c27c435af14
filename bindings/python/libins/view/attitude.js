// SPDX-License-Identifier: MIT
// Attitude in three dimensions: the board as it is, and as the navigator believes it to be. Frame n (north, east, down), q_nb as in
// docs/conventions.md; orthographic projection from the south-west above.
import { line, Screen, theme } from "./canvas.js";
import { el, put } from "./dom.js";

const DEG = 180 / Math.PI;
const AZIMUTH = -0.6;
const ELEVATION = 0.5;
/** Half length, width and thickness of the board drawn [1]. */
const BOARD = [1, 0.66, 0.06];
const NAMES = ["roll", "pitch", "yaw"];

/** v turned by the quaternion {w, x, y, z}. */
export function rotate([w, x, y, z], [a, b, c]) {
  const [tx, ty, tz] = [2 * (y * c - z * b), 2 * (z * a - x * c), 2 * (x * b - y * a)];
  return [a + w * tx + y * tz - z * ty, b + w * ty + z * tx - x * tz, c + w * tz + x * ty - y * tx];
}

/** Of a vector in n: right and up on the screen, and depth towards the eye. */
function project([north, east, down]) {
  const right = east * Math.cos(AZIMUTH) + north * Math.sin(AZIMUTH);
  const away = north * Math.cos(AZIMUTH) - east * Math.sin(AZIMUTH);
  return [right, -down * Math.cos(ELEVATION) + away * Math.sin(ELEVATION), -away * Math.cos(ELEVATION) - down * Math.sin(ELEVATION)];
}

const CORNERS = [-1, 1].flatMap((a) => [-1, 1].flatMap((b) => [-1, 1].map((c) => [a * BOARD[0], b * BOARD[1], c * BOARD[2]])));
/** Corners of each face, around it, and its outward normal in b. */
const FACES = [
  [[0, 2, 6, 4], [0, 0, -1]], [[1, 5, 7, 3], [0, 0, 1]], [[4, 6, 7, 5], [1, 0, 0]],
  [[0, 1, 3, 2], [-1, 0, 0]], [[2, 3, 7, 6], [0, 1, 0]], [[0, 4, 5, 1], [0, -1, 0]],
];

export class Attitude {
  name = "attitude";
  title = "Attitude";

  constructor(view) {
    this.view = view;
    this.screen = new Screen("Attitude of the board, truth and estimate", (...args) => this.#paint(...args));
    this.cells = {};
    const row = (name) =>
      el("tr", {}, el("th", {}, name), ...NAMES.map((axis) => (this.cells[`${name} ${axis}`] = el("td", { class: "number" }))));
    this.element = el(
      "div", {}, this.screen.node,
      el("table", {}, el("tr", {}, el("th", {}, "deg"), ...NAMES.map((axis) => el("th", { class: "number" }, axis))), row("truth"), row("estimate"), row("error"))
    );
  }

  draw(state) {
    this.state = state;
    this.screen.redraw();
    for (const [row, angles, scale] of [["truth", state.truth?.euler, DEG], ["estimate", state.estimate?.euler, DEG], ["error", state.error, DEG]]) {
      NAMES.forEach((axis, i) => put(this.cells[`${row} ${axis}`], angles ? (angles[i] * scale).toFixed(row === "error" ? 4 : 2) : "-"));
    }
  }

  shown() {
    this.view.redraw();
  }

  #paint(context, width, height) {
    const { truth, estimate } = this.state ?? {};
    const colours = theme();
    const size = Math.min(width / 2.7, height / 2.3);
    const at = (v) => {
      const [right, up] = project(v);
      return [width / 2 + size * right, height / 2 - size * up];
    };
    context.fillStyle = colours.muted;
    context.strokeStyle = colours.border;
    for (const [axis, name] of [[[1.25, 0, 0], "N"], [[0, 1.1, 0], "E"], [[0, 0, 0.9], "D"]]) {
      line(context, at([0, 0, 0]), at(axis));
      context.fillText(name, at(axis)[0] + 3, at(axis)[1] + 4);
    }
    if (truth?.q) this.#body(context, truth.q, at);
    if (estimate?.q) {
      context.strokeStyle = colours["trace-1"];
      context.setLineDash([5, 3]);
      context.lineWidth = 1.5;
      const corners = CORNERS.map((corner) => at(rotate(estimate.q, corner)));
      for (const [face] of FACES.slice(0, 2)) line(context, ...face.map((i) => corners[i]), corners[face[0]]);
      line(context, at([0, 0, 0]), at(rotate(estimate.q, [1.3, 0, 0])));
      context.setLineDash([]);
      context.lineWidth = 1;
    }
    context.fillStyle = colours.outline;
    context.fillText("■ truth", 6, 14);
    context.fillStyle = colours["trace-1"];
    context.fillText(estimate?.q ? "┄ estimate" : "no estimate", 6, 28);
  }

  #body(context, q, at) {
    const colours = theme();
    const corners = CORNERS.map((corner) => at(rotate(q, corner)));
    const seen = FACES.filter(([, normal]) => project(rotate(q, normal))[2] > 0);
    context.strokeStyle = colours.outline;
    for (const [face, normal] of seen) {
      context.fillStyle = normal[2] === -1 ? colours.body : colours.selected;
      context.beginPath();
      face.forEach((i) => context.lineTo(...corners[i]));
      context.closePath();
      context.fill();
      context.stroke();
      if (normal[2] === -1) this.#chip(context, q, at);
    }
    context.lineWidth = 2;
    line(context, at(rotate(q, [1, 0, 0])), at(rotate(q, [1.3, 0, 0])));
    context.lineWidth = 1;
    context.fillStyle = colours.outline;
    const nose = at(rotate(q, [1.42, 0, 0]));
    context.fillText("x", nose[0] - 3, nose[1] + 3);
  }

  /** The part on the upper side, towards the nose. */
  #chip(context, q, at) {
    const square = [[0.6, -0.2], [0.6, 0.2], [-0.3, 0.2], [-0.3, -0.2]].map(([a, b]) => at(rotate(q, [a, b, -BOARD[2]])));
    context.fillStyle = theme().outline;
    context.beginPath();
    square.forEach((point) => context.lineTo(...point));
    context.closePath();
    context.fill();
  }
}
