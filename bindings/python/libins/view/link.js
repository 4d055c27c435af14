// SPDX-License-Identifier: MIT
// The one WebSocket to the engine: commands with their answers, and what is pushed. docs/view_protocol.md.

const AGAIN_MS = 1000;

export class Link {
  #socket = null;
  #waiting = new Map();
  #number = 0;

  /** listeners: hello(object), frame(object), state(connected), error(text) that no question asked for. */
  constructor(listeners) {
    this.listeners = listeners;
    this.#open();
  }

  /** Ask the engine; the answer, or an Error with the engine's text. */
  ask(name, args = {}) {
    if (this.#socket?.readyState !== WebSocket.OPEN) return Promise.reject(new Error("not connected to the engine"));
    const id = ++this.#number;
    return new Promise((resolve, reject) => {
      this.#waiting.set(id, { resolve, reject });
      this.#socket.send(JSON.stringify({ id, do: name, ...args }));
    });
  }

  #open() {
    const address = new URL("ws", document.baseURI);
    address.protocol = address.protocol.replace("http", "ws");
    const socket = new WebSocket(address);
    this.#socket = socket;
    socket.onmessage = (event) => this.#take(JSON.parse(event.data));
    socket.onclose = () => this.#closed();
  }

  #take(message) {
    if (message.hello) this.listeners.hello(message.hello);
    else if (message.frame) this.listeners.frame(message.frame);
    else if (this.#waiting.has(message.id)) {
      const { resolve, reject } = this.#waiting.get(message.id);
      this.#waiting.delete(message.id);
      if (message.error) reject(new Error(message.error));
      else resolve(message);
    } else if (message.error) this.listeners.error(message.error);
  }

  #closed() {
    for (const { reject } of this.#waiting.values()) reject(new Error("the engine has ended"));
    this.#waiting.clear();
    this.listeners.state(false);
    setTimeout(() => this.#open(), AGAIN_MS);
  }
}
