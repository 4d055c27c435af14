// SPDX-License-Identifier: MIT
// Values over time in a bounded buffer: edges of a wire, volts of an input, an error. Time in ps as a double: exact up to 2.5 h,
// within 4 ps up to 8 h.

export class Track {
  /** thins: when full, every second value goes; otherwise the older half. */
  constructor(capacity, thins = false) {
    this.t = new Float64Array(capacity);
    this.v = new Float64Array(capacity);
    this.n = 0;
    this.thins = thins;
    this.every = 1;
    this.skipped = 0;
  }

  add(t, v) {
    if (this.thins && ++this.skipped < this.every) return;
    this.skipped = 0;
    if (this.n === this.t.length) this.#shorten();
    this.t[this.n] = t;
    this.v[this.n++] = v;
  }

  #shorten() {
    const half = this.n >> 1;
    if (this.thins) {
      for (let i = 0; i < half; i++) {
        this.t[i] = this.t[2 * i];
        this.v[i] = this.v[2 * i];
      }
      this.every *= 2;
    } else {
      this.t.copyWithin(0, this.n - half, this.n);
      this.v.copyWithin(0, this.n - half, this.n);
    }
    this.n = half;
  }

  /** Index of the first value behind t. */
  after(t, from = 0) {
    let low = from;
    let high = this.n;
    while (low < high) {
      const middle = (low + high) >> 1;
      if (this.t[middle] <= t) low = middle + 1;
      else high = middle;
    }
    return low;
  }

  /** The value at t, held from the last before it; null before the first. */
  at(t) {
    const i = this.after(t);
    return i ? this.v[i - 1] : null;
  }

  /** What is behind t has not happened. */
  cut(t) {
    this.n = this.after(t);
  }

  clear() {
    this.n = 0;
    this.every = 1;
  }
}
