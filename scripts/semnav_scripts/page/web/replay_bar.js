// The bar by which a run that was driven is looked at again: a slider, steps, and play.

import { Replay } from "./replay.js";

const byId = (id) => document.getElementById(id);
const slider = byId("moment");
const replay = new Replay();
let present = () => {}; // shows a moment
let timer = 0; // of the moment that comes next

/** Let the bar work. `use(moment, reach)` shows a moment; `speed()` is of simulated seconds a second. */
export function watch(use, speed) {
  present = use;
  byId("back").onclick = () => step(-1);
  byId("forth").onclick = () => step(1);
  slider.oninput = () => {
    halt();
    go(Number(slider.value));
  };
  byId("play").onclick = () => {
    if (timer) return halt();
    if (replay.index === replay.last) go(0);
    play(speed);
  };
}

/** Forget the run. */
export function clear() { replay.clear(); }

/** Keep the latest moment, and show it. */
export function add(moment, reach) {
  replay.add(moment, reach);
  if (!byId("replay").hidden) showPlace();
  present(moment, reach);
}

/** Show the bar, if there is something to look at again. */
export function show(allowed) {
  byId("replay").hidden = !allowed || replay.last < 1;
  showPlace();
}

/** Stop playing. */
export function halt() {
  clearTimeout(timer);
  timer = 0;
  byId("play").textContent = "Replay";
}

/** Show the latest moment again. */
export function toEnd() {
  halt();
  if (replay.there) go(replay.last);
}

function step(by) {
  halt();
  go(replay.index + by);
}

function go(index) {
  replay.go(index);
  showPlace();
  present(replay.there.moment, replay.there.reach);
}

function play(speed) {
  const wait = replay.untilNext;
  if (wait === null) return halt();
  byId("play").textContent = "Halt";
  timer = setTimeout(() => {
    go(replay.index + 1);
    play(speed);
  }, (1000 * wait) / speed());
}

function showPlace() {
  slider.max = replay.last;
  slider.value = replay.index;
  slider.ariaValueText = replay.there ? `${replay.there.moment.seconds.toFixed(1)} s` : "";
  byId("back").disabled = replay.index === 0;
  byId("forth").disabled = replay.index === replay.last;
}
