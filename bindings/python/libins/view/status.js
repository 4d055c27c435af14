// SPDX-License-Identifier: MIT
// The line at the bottom: time, place, speed, what stopped the board.
import { el, mark, put } from "./dom.js";

export const PS_PER_S = 1e12;

/** Simulated time with nanoseconds. */
export function seconds(t_ps) {
  return `${(t_ps / PS_PER_S).toFixed(9)} s`;
}

export class Status {
  constructor(node) {
    const field = (label, name) => {
      const value = el("b", { id: `status-${name}` });
      node.append(el("span", {}, `${label} `, value));
      return value;
    };
    this.time = field("t", "time");
    this.cycle = field("cycle", "cycle");
    this.pc = field("pc", "pc");
    this.place = field("at", "place");
    this.speed = field("speed", "speed");
    this.link = field("blocks", "link");
    this.why = el("b", { id: "status-state", role: "status" });
    node.append(el("span", { class: "last" }, this.why));
  }

  connect(connected) {
    this.connected = connected;
    if (!connected) this.#why("not connected", "bad");
  }

  #why(text, kind) {
    put(this.why, text);
    mark(this.why, "class", kind);
  }

  draw(state) {
    if (state.t_ps === undefined || !this.connected) return;
    put(this.time, seconds(state.t_ps));
    put(this.cycle, String(state.cycle ?? "-"));
    put(this.pc, typeof state.pc === "number" ? `${state.pc.toString(16).padStart(4, "0").toUpperCase()}h` : "-");
    put(this.place, state.place || "-");
    put(this.speed, state.running ? `${(state.achieved ?? 0).toFixed(2)}×` : "-");
    put(this.link, state.link ? `${state.link.accepted ?? 0}, lost ${state.link.lost ?? 0}` : "-");
    if (state.running) this.#why("running", "good");
    else if (state.stop) {
      const note = (state.stop.notes ?? []).join("; ").split("\n")[0];
      this.#why(`stopped: ${state.stop.kind}${note ? `, ${note}` : ""}`, "muted");
    } else this.#why("stopped", "muted");
  }
}
