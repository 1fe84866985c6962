// The page: sends what the visitor wants, shows what the server says.

import { readAddress, writeAddress } from "./address.js";
import { Camera } from "./camera.js";
import { draw } from "./drawing.js";
import { hand, tool, watch } from "./hand.js";
import { connect } from "./link.js";
import { offer, onChange, readScene, showScene } from "./scene_form.js";
import * as talk from "./talk.js";

const FIRST = { pose: [-2.5, -0.6, 0.25] }; // of a visitor whose address names no scene
const REACH = 1.0; // metres from a door within which a click means it

const byId = (id) => document.getElementById(id);
const canvas = byId("canvas");
const camera = new Camera();
let scene = null; // the last message "scene"
let moment = null; // the last message "frame" of a run
let trail = [];
let run = "none"; // or "driving", "paused", "over"
let pending = 0; // scenes that were asked for and are not there yet
let afterScene = null; // a command to give as soon as the scene is there
let shut = new Set(); // doors shut by hand
let settled = 0; // clauses that a screen reader was told of
let due = false;

const send = connect({
  choices(message) {
    offer(message);
    byId("command").maxLength = message.longest_text;
    byId("connection").textContent = "";
    const asked = readAddress(location.search);
    byId("command").value = asked.command;
    byId("language").value = asked.language;
    afterScene = asked.command || null;
    askScene(location.search ? asked.scene : FIRST);
  },
  scene(message) {
    const moved = scene?.plan.name !== message.plan.name;
    scene = message;
    begin("none");
    talk.clear();
    listDoors();
    byId("reason").textContent = "";
    byId("clear-boxes").disabled = !scene.scene.boxes.length;
    byId("suggestion").textContent = `Try: ${message.suggestion}`;
    if (moved) camera.show(message.plan.bounds);
    redraw();
    pending -= 1;
    if (!pending) settle();
  },
  understood({ clauses }) {
    talk.showClauses(clauses);
    run = "none";
    begin("driving");
    remember();
  },
  refused(message) { talk.showRefusal(message); },
  asked(message) { talk.showQuestion(message, (text) => send("answer", { text })); },
  frame(message) {
    moment = message;
    if (run === "none") return showStart(message);
    trail.push(message.pose);
    talk.tick(message.verdicts);
    narrate(message);
    byId("reason").textContent = message.reasons.length ? `The robot: ${message.reasons.join("; ")}` : "";
    byId("clock").textContent = `${message.seconds.toFixed(2)} s`;
    redraw();
  },
  ended(message) {
    begin("over");
    talk.showEnd(message);
  },
  film(blob) {
    const link = Object.assign(document.createElement("a"), { href: URL.createObjectURL(blob), download: "semnav.gif" });
    link.click();
    setTimeout(() => URL.revokeObjectURL(link.href), 60000);
    byId("film").disabled = false;
    byId("kept").textContent = `GIF: ${Math.round(blob.size / 1024)} KB`;
  },
  error({ text }) {
    byId("kept").textContent = "";
    byId("film").disabled = run === "none";
    talk.say(text, "failed");
    if (pending) [pending, afterScene] = [0, null];
    if (scene) settle();
  },
  closed() {
    byId("connection").textContent = "not connected: reload the page when the server is there";
    byId("connection").className = "bad";
  },
});

/** Enter a state of the run: which buttons can be used follows from it. */
function begin(state) {
  const fresh = state === "none" || (state === "driving" && run !== "paused");
  if (fresh) [moment, trail, settled, shut] = [null, [], 0, new Set()];
  run = state;
  const drives = run === "driving" || run === "paused";
  for (const id of ["pause", "step", "stop"]) byId(id).disabled = !drives;
  byId("pause").textContent = run === "paused" ? "Go on" : "Pause";
  byId("film").disabled = run === "none";
  if (fresh) byId("clock").textContent = "";
  if (fresh) showDoors();
}

/** Show what the robot sees before it is told anything. */
function showStart(message) {
  moment = { ...message, goal: null, doors: message.doors.map((door) => ({ ...door, number: null })) };
  redraw();
}

function command(text) {
  byId("command").value = text;
  talk.say("");
  send("command", { text, language: byId("language").value || null });
  send("speed", { factor: Number(byId("speed").value) });
}

/** Ask for a scene with some changes; a command that was being carried out begins again in it. */
function change(changes) {
  if (run === "driving") afterScene = byId("command").value;
  askScene({ ...readScene(), boxes: scene.scene.boxes, ...changes });
}

function askScene(asked) {
  pending += 1;
  byId("suggestion").hidden = true;
  send("scene", asked);
}

/** The last scene that was asked for is there: show it, and give the command that waits for it. */
function settle() {
  showScene(scene.scene);
  byId("suggestion").hidden = false;
  if (afterScene) command(afterScene);
  afterScene = null;
}

/** Keep scene and command in the address. */
function remember() {
  const query = writeAddress(scene.scene, byId("command").value.trim(), byId("language").value);
  history.replaceState(null, "", query);
  return new URL(query, location.href).href;
}

/** Tell a screen reader about a clause that is done; the picture tells everybody else. */
function narrate({ verdicts }) {
  const done = verdicts.filter((name) => name === "done" || name === "skipped").length;
  if (done > settled && run === "driving") talk.say(`${done} of ${verdicts.length} done`);
  settled = done;
}

function act([x, y], heading) {
  if (!scene) return;
  const place = [Number(x.toFixed(2)), Number(y.toFixed(2))];
  if (tool() === "box") change({ boxes: [...scene.scene.boxes, place] });
  else if (tool() === "robot") change({ pose: [...place, Number((heading ?? scene.start[2]).toFixed(3))] });
  else swing(nearestDoor(x, y));
}

function nearestDoor(x, y) {
  const far = ({ ends: [[x1, y1], [x2, y2]] }) => Math.hypot((x1 + x2) / 2 - x, (y1 + y2) / 2 - y);
  const doors = scene.plan.doors.filter((door) => door.swings && far(door) < REACH);
  return doors.sort((a, b) => far(a) - far(b))[0]?.name;
}

/** Shut a door, or open it again. */
function swing(name) {
  if (!name) return talk.say("There is no door here that can be shut.");
  if (run !== "driving" && run !== "paused") return talk.say("Doors can be shut while the robot drives.");
  if (!shut.delete(name)) shut.add(name);
  send("door", { door: name, shut: shut.has(name) });
  showDoors();
}

function listDoors() {
  const doors = scene.plan.doors.filter((door) => door.swings);
  byId("doors").replaceChildren(...doors.map(({ name }) => {
    const item = document.createElement("li");
    const button = Object.assign(document.createElement("button"), { type: "button" });
    button.dataset.door = name;
    button.onclick = () => swing(name);
    item.append(button);
    return item;
  }));
  byId("door-details").hidden = !doors.length;
  showDoors();
}

function showDoors() {
  for (const button of byId("doors").querySelectorAll("button")) {
    const { door } = button.dataset;
    button.textContent = `${door.replaceAll("_", " ")}: ${shut.has(door) ? "shut, open it" : "open, shut it"}`;
    button.disabled = run !== "driving" && run !== "paused";
  }
}

function zoom(factor) {
  camera.zoom = Math.min(Math.max(camera.zoom * factor, 1), 12);
  redraw();
}

/** Draw soon, once for all that has changed by then. */
function redraw() {
  if (due || !scene) return;
  due = true;
  requestAnimationFrame(() => {
    due = false;
    camera.lookAt(hand.cross ?? moment?.pose ?? scene.start);
    draw(canvas.getContext("2d"), camera, scene, moment, { trail, ...hand });
  });
}

byId("command-form").onsubmit = (event) => {
  event.preventDefault();
  const text = byId("command").value.trim() || byId("command").placeholder;
  if (scene) command(text);
};
byId("suggestion").onclick = () => command(scene.suggestion);
byId("pause").onclick = () => {
  send("playback", { action: run === "driving" ? "pause" : "go on" });
  begin(run === "driving" ? "paused" : "driving");
};
byId("step").onclick = () => {
  send("playback", { action: "step" });
  begin("paused");
};
byId("stop").onclick = () => send("playback", { action: "stop" });
byId("reset").onclick = () => {
  run = "none";
  change({});
};
byId("speed").onchange = () => send("speed", { factor: Number(byId("speed").value) });
byId("clear-boxes").onclick = () => change({ boxes: [] });
byId("film").onclick = () => {
  byId("film").disabled = true;
  byId("kept").textContent = "drawing the film …";
  send("film");
};
byId("link").onclick = async () => {
  const address = remember();
  try {
    await navigator.clipboard.writeText(address);
    byId("kept").textContent = "The link is copied.";
  } catch {
    byId("kept").textContent = address;
  }
};
byId("nearer").onclick = () => zoom(1.3);
byId("farther").onclick = () => zoom(1 / 1.3);
byId("whole").onclick = () => zoom(0);
onChange((id) => change(["plan", "office-number"].includes(id) ? { boxes: [], pose: null } : {}));
watch(camera, () => moment?.pose ?? scene?.start ?? [0, 0, 0], act, zoom, redraw);
matchMedia("(prefers-color-scheme: dark)").onchange = redraw;
new ResizeObserver(() => {
  const before = camera.wholeScale * camera.zoom;
  camera.size = [canvas.clientWidth, canvas.clientHeight];
  canvas.width = camera.size[0] * devicePixelRatio;
  canvas.height = camera.size[1] * devicePixelRatio;
  if (scene && before > 0) camera.zoom = Math.max(1, camera.zoom);
  redraw();
}).observe(canvas);
