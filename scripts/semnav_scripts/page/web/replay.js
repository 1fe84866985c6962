// The moments of a run that was just driven, to look at again.

const MOST = 1200; // moments that are kept: 80 s of a run in full, of a longer one every other, and so on

export class Replay {
  constructor() { this.clear(); }

  clear() {
    this.kept = [];
    this.every = 1;
    this.came = 0;
    this.index = 0;
  }

  /** Keep a moment. `reach` is the number of poses driven by then. */
  add(moment, reach) {
    if (this.came % this.every && this.kept.length > 1) this.kept.pop(); // it was the latest, no more
    this.kept.push({ moment, reach });
    this.came += 1;
    if (this.kept.length >= MOST) {
      this.kept = this.kept.filter((_, index) => index % 2 === 0);
      this.every *= 2;
    }
    this.index = this.last;
  }

  get last() { return Math.max(0, this.kept.length - 1); }
  get there() { return this.kept[this.index]; }

  /** Go to a moment by its number, from 0. */
  go(index) { this.index = Math.min(Math.max(index, 0), this.last); }

  /** Simulated seconds until the next moment; null at the end. */
  get untilNext() {
    const next = this.kept[this.index + 1];
    return next ? next.moment.seconds - this.there.moment.seconds : null;
  }
}
