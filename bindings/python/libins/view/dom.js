// SPDX-License-Identifier: MIT
// Elements made by hand, text changed only where it differs, files handed to the user.

const SVG = "http://www.w3.org/2000/svg";

function filled(node, attributes, children) {
  for (const [name, value] of Object.entries(attributes)) {
    if (name.startsWith("on")) node.addEventListener(name.slice(2), value);
    else if (value === true) node.setAttribute(name, "");
    else if (value !== false && value !== null && value !== undefined) node.setAttribute(name, value);
  }
  node.append(...children);
  return node;
}

/** An HTML element; attributes named on... are listeners, true and false set and leave out. */
export function el(tag, attributes = {}, ...children) {
  return filled(document.createElement(tag), attributes, children);
}

/** An SVG element. */
export function svg(tag, attributes = {}, ...children) {
  return filled(document.createElementNS(SVG, tag), attributes, children);
}

const shown = new WeakMap();

/** Text of a node that this function alone fills. */
export function put(node, text) {
  if (shown.get(node) !== text) {
    shown.set(node, text);
    node.textContent = text;
  }
}

const marked = new WeakMap();

/** One attribute of a node that this function alone sets. */
export function mark(node, name, value) {
  let values = marked.get(node);
  if (!values) marked.set(node, (values = {}));
  if (values[name] !== value) {
    values[name] = value;
    node.setAttribute(name, value);
  }
}

export function button(text, label, act, attributes = {}) {
  return el("button", { type: "button", title: label, "aria-label": label, onclick: act, ...attributes }, text);
}

/** A select of [value, text] pairs or of plain values. */
export function choice(label, options, act, attributes = {}) {
  const entries = options.map((option) => (Array.isArray(option) ? option : [option, option]));
  return el(
    "select",
    { "aria-label": label, title: label, onchange: (event) => act(event.target.value), ...attributes },
    ...entries.map(([value, text]) => el("option", { value }, String(text)))
  );
}

export function labelled(text, input) {
  return el("label", {}, el("span", {}, text), input);
}

/** Hands a file to the user. */
export function download(name, content, type) {
  const address = URL.createObjectURL(new Blob([content], { type }));
  el("a", { href: address, download: name }).click();
  setTimeout(() => URL.revokeObjectURL(address), 10_000);
}
