// SPDX-License-Identifier: MIT
// The page of `ins view`: panels around one engine. Frames are taken as they come and drawn with the screen's own clock.
import { Analyser } from "./analyser.js";
import { Attitude } from "./attitude.js";
import { Breakpoints } from "./breakpoints.js";
import { Disassembly, Source } from "./code.js";
import { button, el } from "./dom.js";
import { Errors } from "./errors.js";
import { Faults } from "./faults.js";
import { Knobs } from "./knobs.js";
import { isShown, lay } from "./layout.js";
import { Link } from "./link.js";
import { Place } from "./map.js";
import { Memory, Registers, Watch } from "./memory.js";
import { Schematic } from "./schematic.js";
import { Status } from "./status.js";
import { Terminal } from "./terminal.js";
import { Toolbar } from "./toolbar.js";
import { Verdicts } from "./verdicts.js";

const message = document.getElementById("message");

/** What all panels share. Tests and bench/view read it as window.insView. */
const view = {
  connected: false,
  hello: null,
  /** The newest value of everything a frame says. */
  state: {},
  /** Frames drawn, and frames that came while another still waited to be drawn. */
  drawn: 0,
  merged: 0,
  panels: [],

  /** Ask the engine; null and a message where it refuses. */
  async ask(name, args) {
    try {
      return await this.link.ask(name, args);
    } catch (error) {
      this.say(error.message);
      return null;
    }
  },

  say(text, good = false) {
    message.hidden = false;
    message.classList.toggle("good", good);
    message.replaceChildren(el("span", {}, text), button("Close", "Close this message", () => (message.hidden = true)));
  },

  panel(name) {
    return this.panels.find((each) => each.name === name);
  },

  /** Bring a panel to the front. */
  show(name) {
    const panel = this.panel(name);
    panel.slot.open(panel);
    return panel;
  },

  redraw() {
    if (!waiting) {
      waiting = true;
      requestAnimationFrame(draw);
    }
  },
};
window.insView = view;

let waiting = false;
let fresh = false;

function draw() {
  waiting = false;
  if (fresh) view.drawn++;
  fresh = false;
  status.draw(view.state);
  toolbar.draw(view.state);
  for (const panel of view.panels) if (isShown(panel)) panel.draw?.(view.state);
}

function take(frame) {
  const past = frame.rewound ?? (frame.t_ps < view.state.t_ps ? frame.t_ps : undefined);
  const stopped = view.state.running && !frame.running;
  view.state = { ...view.state, ...frame };
  for (const panel of view.panels) panel.frame?.(frame, past);
  if (stopped || !frame.running) {
    const at = `${frame.t_ps} ${frame.pc}`;
    if (at !== view.at) {
      view.at = at;
      for (const panel of view.panels) panel.stopped?.(view.state);
    }
  }
  if (fresh) view.merged++;
  fresh = true;
  view.redraw();
}

function greet(hello) {
  view.hello = hello;
  view.state = {};
  view.at = null;
  message.hidden = true;
  document.title = `${hello.title} - ins view`;
  connect(true);
  toolbar.hello(hello);
  for (const panel of view.panels) {
    const none = panel.suits ? !panel.suits(hello) : false;
    if (none && !panel.tab.hidden) panel.slot.close(panel);
    if (!none) panel.hello?.(hello);
  }
}

function connect(connected) {
  if (view.connected && !connected) {
    view.say("The engine has ended: `ins view` no longer answers. Start it again and open the address that it prints.");
  }
  view.connected = connected;
  toolbar.connect(connected);
  status.connect(connected);
}

const status = new Status(document.getElementById("status"));
const toolbar = new Toolbar(view, document.getElementById("toolbar"));
view.panels = lay(document.getElementById("desk"), [
  [48, [[54, [new Schematic(view)]], [46, [new Analyser(view)]]]],
  [28, [
    [42, [new Source(view), new Disassembly(view), new Breakpoints(view)]],
    [32, [new Registers(view), new Memory(view), new Watch(view)]],
    [26, [new Terminal(view)]],
  ]],
  [24, [[35, [new Attitude(view), new Place(view)]], [27, [new Errors(view), new Verdicts(view)]], [38, [new Knobs(view), new Faults(view)]]]],
]);
toolbar.panels(view.panels);
view.link = new Link({ hello: greet, frame: take, state: connect, error: (text) => view.say(text) });
