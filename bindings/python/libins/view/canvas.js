// SPDX-License-Identifier: MIT
// A canvas that keeps its element's size in device pixels, the theme's colours for it, and scales of axes.
import { el } from "./dom.js";

const NAMES = [
  "panel", "text", "muted", "border", "accent", "scale", "high", "low", "bad", "good", "wire", "body", "outline", "selected",
  "trace-0", "trace-1", "trace-2", "trace-3", "trace-4", "trace-5",
];
export const TRACES = 6;
export const FONT = '11px ui-monospace, "DejaVu Sans Mono", monospace';

let colours = null;
const dark = matchMedia("(prefers-color-scheme: dark)");
dark.addEventListener("change", () => (colours = null));

/** The theme's colours by name. */
export function theme() {
  if (!colours) {
    const style = getComputedStyle(document.documentElement);
    colours = Object.fromEntries(NAMES.map((name) => [name, style.getPropertyValue(`--${name}`).trim()]));
  }
  return colours;
}

/** A canvas in a box; paint(context, width, height) draws it, in CSS pixels. redraw() does so now. */
export class Screen {
  constructor(label, paint, attributes = {}) {
    this.canvas = el("canvas", { role: "img", "aria-label": label, ...attributes });
    this.node = el("div", { class: "screen" }, this.canvas);
    this.paint = paint;
    this.width = this.height = 0;
    new ResizeObserver(([entry]) => {
      this.width = Math.floor(entry.contentRect.width);
      this.height = Math.floor(entry.contentRect.height);
      this.canvas.width = this.width * devicePixelRatio;
      this.canvas.height = this.height * devicePixelRatio;
      this.redraw();
    }).observe(this.node);
    dark.addEventListener("change", () => this.redraw());
  }

  redraw() {
    if (!this.width || !this.height) return;
    const context = this.canvas.getContext("2d");
    context.setTransform(devicePixelRatio, 0, 0, devicePixelRatio, 0, 0);
    context.fillStyle = theme().panel;
    context.fillRect(0, 0, this.width, this.height);
    context.font = FONT;
    context.textBaseline = "alphabetic";
    context.textAlign = "left";
    context.setLineDash([]);
    context.lineWidth = 1;
    this.paint(context, this.width, this.height);
  }
}

/** 1, 2 or 5 times a power of ten, not below x. */
export function round125(x) {
  const power = 10 ** Math.floor(Math.log10(x));
  return [1, 2, 5, 10].map((each) => each * power).find((each) => each >= x * 0.999999);
}

/** Multiples of a step within a span. */
export function ticks(low, high, step) {
  const found = [];
  for (let k = Math.ceil(low / step); k * step <= high; k++) found.push(k * step);
  return found;
}

const PREFIXES = [[1e-12, "p"], [1e-9, "n"], [1e-6, "µ"], [1e-3, "m"], [1, ""], [1e3, "k"], [1e6, "M"], [1e9, "G"]];

/** "12.5 µs". */
export function engineering(value, unit, digits = 4) {
  if (value === 0 || !Number.isFinite(value)) return `${value} ${unit}`;
  const [factor, prefix] = PREFIXES.findLast(([each]) => Math.abs(value) >= each * 0.9999999) ?? PREFIXES[0];
  return `${Number((value / factor).toPrecision(digits))} ${prefix}${unit}`;
}

export function line(context, ...points) {
  context.beginPath();
  context.moveTo(...points[0]);
  for (const point of points.slice(1)) context.lineTo(...point);
  context.stroke();
}
