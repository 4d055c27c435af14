// SPDX-License-Identifier: MIT
// The desk: columns of slots, panels as tabs in a slot, separators that the mouse and the arrow keys move. A panel can be closed
// and brought back, a slot can fill the desk.
import { button, el, mark } from "./dom.js";

const STEP = 0.04;
const LEAST = 0.12;

/** Between two parts of a row or column; moves size from one to the other. */
function separator(before, after, across) {
  const along = across ? "clientX" : "clientY";
  const length = across ? "offsetWidth" : "offsetHeight";
  const node = el("div", {
    class: "separator",
    role: "separator",
    tabindex: "0",
    "aria-label": across ? "Width of the columns beside it" : "Height of the panels beside it",
    "aria-orientation": across ? "vertical" : "horizontal",
    "aria-valuemin": "0",
    "aria-valuemax": "100",
  });
  const share = (part) => Number(part.dataset.share);
  const place = () => mark(node, "aria-valuenow", String(Math.round((100 * share(before)) / (share(before) + share(after)))));
  const move = (by) => {
    const both = share(before) + share(after);
    const first = Math.min(Math.max(share(before) + by * both, LEAST * both), (1 - LEAST) * both);
    resize(before, first);
    resize(after, both - first);
    place();
  };
  node.addEventListener("keydown", (event) => {
    const way = { ArrowLeft: -1, ArrowUp: -1, ArrowRight: 1, ArrowDown: 1 }[event.key];
    if (way) {
      move(way * STEP);
      event.preventDefault();
    }
  });
  node.addEventListener("pointerdown", (event) => {
    node.setPointerCapture(event.pointerId);
    let last = event[along];
    node.onpointermove = (moved) => {
      move((moved[along] - last) / (before[length] + after[length]));
      last = moved[along];
    };
    node.onpointerup = () => (node.onpointermove = null);
  });
  place();
  return node;
}

function resize(part, share) {
  part.dataset.share = share;
  part.style.flexGrow = share;
}

class Slot {
  constructor(panels, share) {
    this.panels = panels;
    this.tabs = el("div", { role: "tablist", class: "tabs", onkeydown: (event) => this.#key(event) });
    this.body = el("div", { class: "body" });
    this.full = button("□", "Fill the desk with this panel", () => this.fill(), { class: "quiet", "aria-pressed": "false" });
    const close = button("×", "Close this panel", () => this.close(this.chosen), { class: "quiet close" });
    this.node = el("section", { class: "slot" }, el("div", { class: "head" }, this.tabs, this.full, close), this.body);
    resize(this.node, share);
    for (const panel of panels) {
      panel.tab = el("button", { type: "button", role: "tab", id: `tab-${panel.name}`, onclick: () => this.choose(panel) }, panel.title);
      mark(panel.tab, "aria-controls", `panel-${panel.name}`);
      panel.page = el("div", { role: "tabpanel", id: `panel-${panel.name}`, class: "page", "aria-labelledby": panel.tab.id }, panel.element);
      panel.slot = this;
      this.tabs.append(panel.tab);
      this.body.append(panel.page);
    }
    this.choose(panels[0]);
  }

  choose(panel) {
    this.chosen = panel;
    for (const each of this.panels) {
      mark(each.tab, "aria-selected", String(each === panel));
      each.tab.tabIndex = each === panel ? 0 : -1;
      each.page.hidden = each !== panel;
    }
    panel.shown?.();
  }

  close(panel) {
    panel.tab.hidden = true;
    const open = this.panels.filter((each) => !each.tab.hidden);
    if (this.chosen === panel && open.length) this.choose(open[0]);
    if (!open.length) this.fill(false);
    this.changed();
  }

  open(panel) {
    panel.tab.hidden = false;
    this.choose(panel);
    this.changed();
  }

  fill(full = !this.node.classList.contains("full")) {
    this.node.classList.toggle("full", full);
    mark(this.full, "aria-pressed", String(full));
  }

  get isEmpty() {
    return this.panels.every((each) => each.tab.hidden);
  }

  #key(event) {
    const open = this.panels.filter((each) => !each.tab.hidden);
    const at = open.indexOf(this.chosen);
    const to = { ArrowRight: at + 1, ArrowLeft: at - 1, Home: 0, End: open.length - 1 }[event.key];
    if (to === undefined) return;
    this.choose(open[(to + open.length) % open.length]);
    this.chosen.tab.focus();
    event.preventDefault();
  }
}

/** columns: [[share, [[share, [panel, ...]], ...]], ...] into the desk. Returns all panels in order. */
export function lay(desk, columns) {
  const built = columns.map(([share, slots]) => {
    const node = el("div", { class: "column" });
    resize(node, share);
    return { node, slots: slots.map(([height, panels]) => new Slot(panels, height)), separators: [] };
  });
  const arrange = () => {
    desk.replaceChildren();
    let left = null;
    for (const { node, slots } of built) {
      node.replaceChildren();
      let above = null;
      for (const slot of slots.filter((each) => !each.isEmpty)) {
        if (above) node.append(separator(above, slot.node, false));
        node.append(slot.node);
        above = slot.node;
      }
      if (!above) continue;
      if (left) desk.append(separator(left, node, true));
      desk.append(node);
      left = node;
    }
  };
  for (const { slots } of built) for (const slot of slots) slot.changed = arrange;
  arrange();
  return built.flatMap(({ slots }) => slots.flatMap((slot) => slot.panels));
}

/** Whether the panel can be seen now. */
export function isShown(panel) {
  return panel.slot.chosen === panel && !panel.tab.hidden;
}
