// The hand of the visitor on the plan: by pointer, or by a cross that the arrow keys move.

const canvas = document.getElementById("canvas");
const STEP = 0.25; // metres that an arrow key moves the cross; with shift four times as far
const LEAST_DRAG = 0.3; // metres from which a drag turns the robot
const ARROWS = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] };

export const hand = { cross: null, placing: null };

/** Watch the canvas. `act(place, heading)` is called for a click or Enter; `changed()` to draw. */
export function watch(camera, start, act, zoom, changed) {
  let pressed = null;
  const at = (event) => camera.place(event.offsetX, event.offsetY);
  canvas.onpointerdown = (event) => { pressed = at(event); };
  canvas.onpointermove = (event) => {
    if (!pressed || tool() !== "robot") return;
    hand.placing = [...pressed, headingTo(pressed, at(event)) ?? start()[2]];
    changed();
  };
  canvas.onpointerup = (event) => {
    if (!pressed) return;
    act(pressed, headingTo(pressed, at(event)));
    pressed = hand.placing = null;
    changed();
  };
  canvas.onpointercancel = canvas.onpointerleave = () => {
    pressed = hand.placing = null;
    changed();
  };
  canvas.onblur = () => {
    hand.cross = null;
    changed();
  };
  canvas.onkeydown = (event) => {
    if (event.key in ARROWS) {
      const [dx, dy] = ARROWS[event.key].map((way) => way * STEP * (event.shiftKey ? 4 : 1));
      const [x, y] = hand.cross ?? start();
      hand.cross = [x + dx, y + dy];
    } else if (event.key === "Enter" && hand.cross) act(hand.cross, null);
    else if (event.key === "+") zoom(1.3);
    else if (event.key === "-") zoom(1 / 1.3);
    else return;
    event.preventDefault();
    changed();
  };
}

/** What a click does: "door", "box" or "robot". */
export function tool() {
  return document.querySelector("input[name=tool]:checked").value;
}

/** The heading from one place to another; null if they are too near to tell. */
function headingTo([x1, y1], [x2, y2]) {
  return Math.hypot(x2 - x1, y2 - y1) < LEAST_DRAG ? null : Math.atan2(y2 - y1, x2 - x1);
}
