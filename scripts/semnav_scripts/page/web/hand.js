// The hand of the visitor on the plan: by pointer, or by a cross that the arrow keys move.

const canvas = document.getElementById("canvas");
const STEP = 0.25; // metres that an arrow key moves the cross; with shift four times as far
const FINE = 0.05; // the same with alt
const LEAST_DRAG = 0.3; // metres from which a drag turns the robot
const ARROWS = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] };

/** Where the cross is, where the robot is being placed, and the line that is being drawn. */
export const hand = { cross: null, placing: null, line: null };

/** Let go of everything. */
export function letGo() { hand.cross = hand.placing = hand.line = null; }

/**
 * Watch the canvas.
 *
 * `mode()` is what a gesture is for: "click", "turn", "line" or "view". `act(points)` is called for a
 * click or Enter with one place, and for a drag or two Enters with two; `changed()` to draw.
 */
export function watch(camera, start, mode, act, zoom, changed) {
  let pressed = null;
  const at = (event) => camera.place(event.offsetX, event.offsetY);
  canvas.onpointerdown = (event) => {
    pressed = at(event);
    if (mode() !== "click") canvas.setPointerCapture(event.pointerId);
  };
  canvas.onpointermove = (event) => {
    if (!pressed) return;
    const there = at(event);
    if (mode() === "turn") hand.placing = [...pressed, headingTo(pressed, there) ?? start()[2]];
    else if (mode() === "line") hand.line = [pressed, there];
    else if (mode() === "view") camera.drag(pressed, there);
    else return;
    changed();
  };
  canvas.onpointerup = (event) => {
    if (!pressed) return;
    const points = [pressed, at(event)];
    pressed = null;
    letGo();
    if (mode() !== "view") act(points);
    changed();
  };
  canvas.onpointercancel = canvas.onpointerleave = (event) => {
    if (canvas.hasPointerCapture(event.pointerId)) return;
    pressed = hand.placing = null;
    changed();
  };
  canvas.onblur = () => {
    letGo();
    changed();
  };
  canvas.onkeydown = (event) => {
    if (event.key in ARROWS) {
      const step = event.altKey ? FINE : STEP * (event.shiftKey ? 4 : 1);
      const [dx, dy] = ARROWS[event.key].map((way) => way * step);
      const [x, y] = hand.cross ?? start();
      hand.cross = [x + dx, y + dy];
      if (hand.line) hand.line = [hand.line[0], hand.cross];
    } else if (event.key === "Enter" && hand.cross) enter(mode(), act);
    else if (event.key === "Escape" && hand.line) hand.line = null;
    else if (event.key === "+") zoom(1.3);
    else if (event.key === "-") zoom(1 / 1.3);
    else return;
    event.preventDefault();
    changed();
  };
}

/** Act at the cross; a line begins there, or ends. */
function enter(mode, act) {
  if (mode === "line" && !hand.line) hand.line = [hand.cross, hand.cross];
  else {
    const points = hand.line ?? [hand.cross];
    hand.line = null;
    act(points);
  }
}

/** The heading from one place to another; null if they are too near to tell, or there is none. */
export function headingTo([x1, y1], second) {
  if (!second) return null;
  const [x2, y2] = second;
  return Math.hypot(x2 - x1, y2 - y1) < LEAST_DRAG ? null : Math.atan2(y2 - y1, x2 - x1);
}
