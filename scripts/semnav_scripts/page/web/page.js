// The page: sends what the visitor wants, shows what the server says.

import { readAddress, writeAddress } from "./address.js";
import { board, boardGesture, drawOnBoard, openBoard, sayOnBoard, showBoard, watchBoard } from "./board.js";
import { Camera } from "./camera.js";
import { draw, drawBoard } from "./drawing.js";
import { message as fileMessage, onDrop, save } from "./files.js";
import { hand, headingTo, letGo, watch } from "./hand.js";
import { connect } from "./link.js";
import * as replay from "./replay_bar.js";
import { offer, offerOwn, onChange, readScene, showScene } from "./scene_form.js";
import { listenBy } from "./speech.js";
import * as talk from "./talk.js";

const FIRST = { pose: [-2.5, -0.6, 0.25] }; // of a visitor whose address names no scene
const PUT = { // what is said of what comes into a run
  box: "A box is put down.",
  person: "A person walks about now.",
  robot: "The robot is carried there.",
};
const REACH = 1.0; // metres from a door within which a click means it

const byId = (id) => document.getElementById(id);
const canvas = byId("canvas");
const camera = new Camera();
let scene = null; // the last message "scene"
let moment = null; // the message "frame" that is shown
let trail = []; // poses of the run, of which the moment that is shown has seen `reach`
let reach = 0;
let run = "none"; // or "driving", "paused", "over"
let pending = 0; // scenes that were asked for and are not there yet
let afterScene = null; // a command to give as soon as the scene is there
let shut = new Set(); // doors shut by hand
let settled = 0; // clauses that a screen reader was told of
let due = false;
let largestFile = 0; // bytes

const { send, sendFile } = connect({
  choices(message) {
    offer(message);
    byId("command").maxLength = message.longest_text;
    byId("part-name").maxLength = message.longest_name;
    byId("plan-file").accept = message.files.join();
    largestFile = message.largest_file;
    byId("connection").textContent = "";
    const asked = readAddress(location.search);
    byId("command").value = asked.command;
    byId("language").value = asked.language;
    const isOwn = asked.scene.plan === "own";
    afterScene = isOwn ? null : asked.command || null;
    askScene(location.search && !isOwn ? asked.scene : FIRST);
    if (isOwn) talk.say("The link does not hold your floor plan: drop its file here.", "failed");
  },
  scene(message) {
    const moved = board.open || scene?.plan.name !== message.plan.name;
    if (board.open) openBoard(false);
    letGo();
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
  understood({ clauses, corrections }) {
    talk.showClauses(clauses, corrections);
    run = "none";
    begin("driving");
    remember();
  },
  refused(message) { talk.showRefusal(message); },
  asked(message) { talk.showQuestion(message, (text) => send("answer", { text })); },
  frame(message) {
    if (run === "none") return showStart(message);
    trail.push(message.pose);
    replay.add(message, trail.length);
    narrate(message);
  },
  put({ what }) { talk.say(PUT[what]); },
  ended(message) {
    begin("over");
    talk.showEnd(message);
  },
  board(message) {
    const isNew = !board.open;
    const bounds = String(board.plan?.bounds);
    if (isNew) replay.halt();
    if (isNew && run === "driving") send("playback", { action: "stop" });
    showBoard(message);
    offerOwn(board.plan.name);
    if (isNew) openBoard(true);
    if (isNew || String(board.plan.bounds) !== bounds) camera.show(board.plan.bounds, true);
    if (isNew) camera.centre = middle(board.plan.bounds);
    redraw();
  },
  async file(blob) {
    const said = await save(blob);
    byId(board.open ? "board-kept" : "kept").textContent = said;
    byId("film").disabled = run === "none";
  },
  error({ text }) {
    byId("kept").textContent = "";
    byId("film").disabled = run === "none";
    const asked = pending > 0;
    if (asked) [pending, afterScene] = [0, null];
    if (board.open) return sayOnBoard(text, "failed");
    talk.say(text, "failed");
    if (scene) settle();
    else if (asked) askScene(FIRST); // the address asked for something that there is not
  },
  closed() {
    byId("connection").textContent = "not connected: reload the page when the server is there";
    byId("connection").className = "bad";
  },
});

/** Enter a state of the run: which buttons can be used follows from it. */
function begin(state) {
  const fresh = state === "none" || (state === "driving" && run !== "paused");
  if (fresh) [moment, trail, reach, settled, shut] = [null, [], 0, 0, new Set()];
  if (fresh) replay.clear();
  replay.halt();
  run = state;
  const drives = run === "driving" || run === "paused";
  for (const id of ["pause", "step", "stop"]) byId(id).disabled = !drives;
  byId("pause").textContent = run === "paused" ? "Go on" : "Pause";
  for (const id of ["film", "episode"]) byId(id).disabled = run === "none";
  replay.show(run !== "driving");
  if (fresh) byId("clock").textContent = "";
  if (fresh) showDoors();
}

/** Show what the robot sees before it is told anything. */
function showStart(message) {
  moment = { ...message, goal: null, doors: message.doors.map((door) => ({ ...door, number: null })) };
  redraw();
}

/** Show a moment of the run. `seen` is the number of poses driven by then. */
function present(shown, seen) {
  [moment, reach] = [shown, seen];
  talk.tick(moment.verdicts);
  byId("reason").textContent = moment.reasons.length ? `The robot: ${moment.reasons.join("; ")}` : "";
  byId("clock").textContent = `${moment.seconds.toFixed(2)} s`;
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

/** Do what a gesture on the plan means. */
function act(points) {
  if (board.open) drawOnBoard(points, send);
  else if (scene) actInScene(points);
}

function actInScene([[x, y], second]) {
  const heading = headingTo([x, y], second);
  const place = [Number(x.toFixed(2)), Number(y.toFixed(2))];
  const turned = heading === null ? null : Number(heading.toFixed(3));
  const drives = run === "driving" || run === "paused";
  if (tool() === "door") swing(nearestDoor(x, y));
  else if (drives) send("put", { what: tool(), place, heading: turned });
  else if (tool() === "person") talk.say("A person can be added while the robot drives.");
  else if (tool() === "box") change({ boxes: [...scene.scene.boxes, place] });
  else change({ pose: [...place, turned ?? Number(scene.start[2].toFixed(3))] });
}

/** What a click in the scene does: "door", "box", "person" or "robot". */
function tool() {
  return document.querySelector("input[name=tool]:checked").value;
}

/** What a gesture on the plan is for. */
function gesture() {
  if (board.open) return boardGesture();
  return tool() === "robot" ? "turn" : "click";
}

/** Send a file of the visitor's to the drawing board. */
function putOnBoard(file) {
  if (!file) return;
  const tell = board.open ? sayOnBoard : talk.say;
  if (file.size > largestFile) return tell(`${file.name} has ${file.size} bytes; at most ${largestFile} are taken.`, "failed");
  tell(`reading ${file.name} …`);
  sendFile(fileMessage(file));
}

/** Leave the drawing board for the scene. */
function leaveBoard() {
  openBoard(false);
  letGo();
  talk.say("");
  camera.show(scene.plan.bounds);
  showScene(scene.scene);
  redraw();
}

function middle([west, south, east, north]) { return [(west + east) / 2, (south + north) / 2]; }

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

/** Draw soon, once for all that has changed by then; look there at once, for a click may come before. */
function redraw() {
  if (!scene) return;
  camera.lookAt(hand.cross ?? (board.open ? camera.centre : moment?.pose ?? scene.start));
  if (due) return;
  due = true;
  requestAnimationFrame(() => {
    due = false;
    const context = canvas.getContext("2d");
    if (board.open) drawBoard(context, camera, board.plan, board.faults, hand);
    else draw(context, camera, scene, moment, { trail: trail.slice(0, reach), ...hand });
  });
}

byId("command-form").onsubmit = (event) => {
  event.preventDefault();
  const text = byId("command").value.trim() || byId("command").placeholder;
  if (scene) command(text);
};
byId("suggestion").onclick = () => command(scene.suggestion);
byId("pause").onclick = () => {
  replay.toEnd();
  send("playback", { action: run === "driving" ? "pause" : "go on" });
  begin(run === "driving" ? "paused" : "driving");
};
byId("step").onclick = () => {
  replay.toEnd();
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
  send("keep", { what: "film" });
};
byId("episode").onclick = () => send("keep", { what: "episode" });
byId("plan-copy").onclick = () => send("keep", { what: "plan" });
byId("plan-file").onchange = () => {
  putOnBoard(byId("plan-file").files[0]);
  byId("plan-file").value = "";
};
onDrop(putOnBoard);
byId("open-board").onclick = () => send("draw", { tool: "open" });
byId("drive-here").onclick = () => {
  byId("plan").value = "own";
  byId("start").value = "";
  change({ plan: "own", boxes: [], pose: null });
};
byId("close-board").onclick = leaveBoard;
watchBoard(send);
replay.watch(present, () => Number(byId("speed").value));
listenBy(byId("speak"), () => byId("language").value, (text, isFinal) => {
  byId("command").value = text;
  if (isFinal && scene && text) command(text);
}, (why) => talk.say(why, "failed"));
byId("link").onclick = async () => {
  const address = remember();
  try {
    await navigator.clipboard.writeText(address);
    byId("kept").textContent = scene.scene.plan === "own" ? "The link is copied; your floor plan is not in it." : "The link is copied.";
  } catch {
    byId("kept").textContent = address;
  }
};
byId("nearer").onclick = () => zoom(1.3);
byId("farther").onclick = () => zoom(1 / 1.3);
byId("whole").onclick = () => zoom(0);
onChange((id) => change(["plan", "office-number"].includes(id) ? { boxes: [], pose: null } : {}));
watch(camera, () => (board.open ? [...camera.centre, 0] : moment?.pose ?? scene?.start ?? [0, 0, 0]), gesture, act, zoom, redraw);
matchMedia("(prefers-color-scheme: dark)").onchange = redraw;
new ResizeObserver(() => {
  const before = camera.wholeScale * camera.zoom;
  camera.size = [canvas.clientWidth, canvas.clientHeight];
  canvas.width = camera.size[0] * devicePixelRatio;
  canvas.height = camera.size[1] * devicePixelRatio;
  if (scene && before > 0) camera.zoom = Math.max(1, camera.zoom);
  redraw();
}).observe(canvas);
