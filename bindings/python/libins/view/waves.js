// SPDX-License-Identifier: MIT
// The analyser's picture: a row for each wire, the inputs' volts below, time axis and cursors.
import { engineering, line, round125, theme, ticks, TRACES } from "./canvas.js";
import { PS_PER_S } from "./status.js";

const LABELS = 78;
const AXIS = 16;
const ROW_MAX = 30;
const ANALOG_LEAST = 64;
const FULL_V = 5;

/** How each trace is drawn beside its colour. */
const DASHES = [[], [6, 3], [2, 2], [8, 3, 2, 3], [4, 4], [1, 3]];

export function paint(analyser, context, width, height) {
  const colours = theme();
  const { begin, span, wires, channels } = analyser;
  analyser.plotLeft = LABELS;
  const bottom = height - AXIS;
  const x = (t) => LABELS + ((t - begin) / span) * (width - LABELS);
  const analog = channels.length ? Math.max(ANALOG_LEAST, bottom - wires.length * ROW_MAX) : 0;
  const row = wires.length ? Math.min(ROW_MAX, (bottom - analog) / wires.length) : 0;
  axis(context, analyser, width, height, x);
  const now = Math.min(width, x(analyser.now ?? 0));
  wires.forEach((wire, i) => {
    const top = i * row + 0.22 * row;
    context.fillStyle = colours.text;
    context.fillText(wire, 4, top + 0.6 * row);
    context.strokeStyle = colours["trace-0"];
    digital(context, analyser.edges(wire), { begin, end: analyser.end, now, x, high: top, low: top + 0.66 * row });
  });
  if (analog) volts(context, analyser, { top: wires.length * row + 4, bottom, x, width });
  cursors(context, analyser, bottom, x);
}

function axis(context, analyser, width, height, x) {
  const { begin, end, span } = analyser;
  const colours = theme();
  const step = round125(span / 8);
  context.strokeStyle = colours.scale;
  context.fillStyle = colours.muted;
  context.textAlign = "center";
  const base = Math.floor(begin / step) * step;
  for (const t of ticks(begin - base, end - base, step)) {
    const at = Math.round(x(base + t)) + 0.5;
    line(context, [at, 0], [at, height - AXIS + 3]);
    if (at > LABELS + 14 && at < width - 24) context.fillText(t === 0 ? "0" : engineering(t / PS_PER_S, "s"), at, height - 4);
  }
  context.textAlign = "left";
  context.fillText(engineering(Math.max(0, base) / PS_PER_S, "s", 9), 4, height - 4);
  context.strokeStyle = colours.border;
  line(context, [LABELS + 0.5, 0], [LABELS + 0.5, height - AXIS]);
}

/** Levels from edges. Where several edges share a pixel, one bar stands for them. */
function digital(context, track, { begin, end, now, x, high, low }) {
  if (!track?.n) return;
  const y = (level) => Math.round(level ? high : low) + 0.5;
  context.beginPath();
  let i = track.after(begin);
  let level = i ? track.v[i - 1] : null;
  let at = i ? LABELS : null;
  if (i) context.moveTo(LABELS, y(level));
  const perPixel = (end - begin) / (x(end) - LABELS);
  while (i < track.n && track.t[i] <= end) {
    const px = x(track.t[i]);
    if (at === null) context.moveTo(px, y(track.v[i]));
    else context.lineTo(px, y(level));
    const beyond = track.after(track.t[i] + perPixel, i);
    if (beyond - i > 1) {
      context.lineTo(px, y(1));
      context.lineTo(px, y(0));
    }
    level = track.v[beyond - 1];
    context.lineTo(px, y(level));
    at = px;
    i = beyond;
  }
  context.lineTo(now, y(level));
  context.stroke();
}

function volts(context, analyser, { top, bottom, x, width }) {
  const colours = theme();
  const y = (v) => bottom - 3 - (v / FULL_V) * (bottom - top - 14);
  context.strokeStyle = colours.scale;
  context.fillStyle = colours.muted;
  context.textAlign = "right";
  for (const v of bottom - top > 110 ? [0, 1, 2, 3, 4, 5] : [0, 2.5, 5]) {
    line(context, [LABELS, Math.round(y(v)) + 0.5], [width, Math.round(y(v)) + 0.5]);
    context.fillText(`${v} V`, LABELS - 4, y(v) + 4);
  }
  context.textAlign = "left";
  context.save();
  context.beginPath();
  context.rect(LABELS, top, width - LABELS, bottom - top);
  context.clip();
  analyser.channels.forEach((name, i) => {
    context.strokeStyle = context.fillStyle = colours[`trace-${i % TRACES}`];
    context.setLineDash(DASHES[i % DASHES.length]);
    curve(context, analyser.volts.get(name), analyser.begin, analyser.end, x, y);
  });
  context.restore();
  context.setLineDash([]);
  analyser.channels.forEach((name, i) => {
    context.fillStyle = colours[`trace-${i % TRACES}`];
    context.fillText(`AIN${name}`, LABELS + 6 + 52 * i, top + 10);
  });
}

/** Values joined by lines; of those that share a pixel the first, least, most and last. */
export function curve(context, track, begin, end, x, y) {
  const last = Math.min(track.n, track.after(end) + 1);
  let i = Math.max(0, track.after(begin) - 1);
  if (last - i < 1) return;
  context.beginPath();
  context.moveTo(x(track.t[i]), y(track.v[i]));
  while (i < last) {
    const px = x(track.t[i]);
    let [low, high] = [track.v[i], track.v[i]];
    context.lineTo(px, y(track.v[i]));
    const first = i;
    while (i < last && x(track.t[i]) < px + 1) {
      low = Math.min(low, track.v[i]);
      high = Math.max(high, track.v[i]);
      i++;
    }
    if (i - first > 1) {
      context.lineTo(px, y(low));
      context.lineTo(px, y(high));
      context.lineTo(px, y(track.v[i - 1]));
    }
  }
  context.stroke();
}

function cursors(context, analyser, bottom, x) {
  const colours = theme();
  for (const [name, t] of Object.entries(analyser.cursors)) {
    if (t === null || t < analyser.begin || t > analyser.end) continue;
    context.strokeStyle = context.fillStyle = name === "A" ? colours.accent : colours.bad;
    context.setLineDash(name === "A" ? [] : [5, 3]);
    line(context, [x(t), 0], [x(t), bottom]);
    context.fillText(name, x(t) + (t > analyser.end - analyser.span / 50 ? -10 : 3), 10);
  }
  context.setLineDash([]);
}
