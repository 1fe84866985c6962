// The drawing board: what is drawn on a floor plan, and what is wrong with it.

const byId = (id) => document.getElementById(id);
const LINES = ["door", "corridor", "wall", "scale"]; // tools that draw a line; the others take a click
const NEEDS = { room: "part-name", scale: "known-length" }; // fields without which a tool means nothing

export const board = { open: false, plan: null, faults: [] };

/** What a gesture on the plan is for, while it is drawn on: "line", "view" or "click". */
export function boardGesture() {
  if (LINES.includes(tool())) return "line";
  return tool() === "view" ? "view" : "click";
}

/** Show the board, or the scene again. */
export function openBoard(open) {
  board.open = open;
  document.body.classList.toggle("drawing", open);
  byId("draw").hidden = !open;
  for (const id of ["talk", "choices", "run"]) byId(id).hidden = open;
  showFields();
  if (open) byId("draw-title").focus();
}

/** Show a message "board". */
export function showBoard({ plan, notes, undo, redo, faults }) {
  board.plan = plan;
  board.faults = faults ?? [];
  byId("undo").disabled = !undo;
  byId("redo").disabled = !redo;
  byId("board-notes").replaceChildren(...notes.map((note) => item(note)));
  byId("faults").replaceChildren(...board.faults.map(({ text }) => item(text)));
  byId("part-name").value = "";
  if (faults === null) sayOnBoard(summary(plan));
  else sayOnBoard(faults.length ? `${faults.length} to mend:` : "Nothing is wrong with it.", faults.length ? "failed" : "done");
}

export function sayOnBoard(words, kind = "") {
  byId("board-said").textContent = words;
  byId("board-said").className = kind;
}

/** Draw what a gesture with the present tool means, unless a field that it needs is empty. */
export function drawOnBoard(points, send) {
  const field = NEEDS[tool()] && byId(NEEDS[tool()]);
  if (field && !field.value.trim()) {
    sayOnBoard(`Type the ${tool() === "room" ? "name of the room" : "length in metres"} first.`, "failed");
    return field.focus();
  }
  send("draw", {
    tool: tool(),
    points: points.slice(0, boardGesture() === "line" ? 2 : 1).map((place) => place.map((value) => Number(value.toFixed(3)))),
    name: byId("part-name").value.trim(),
    length: tool() === "scale" ? Number(byId("known-length").value) : null,
  });
}

/** Let the buttons of the board work. */
export function watchBoard(send) {
  for (const id of ["undo", "redo"]) byId(id).onclick = () => send("draw", { tool: id });
  byId("check").onclick = () => {
    sayOnBoard("looking for faults …");
    send("draw", { tool: "check" });
  };
  byId("board-copy").onclick = () => send("keep", { what: "board" });
  byId("draw-form").onsubmit = (event) => event.preventDefault();
  byId("draw-form").onchange = showFields;
}

function tool() {
  return document.querySelector("input[name=board-tool]:checked").value;
}

function summary({ doors, rooms, corridors }) {
  return `${doors.length} doors, ${rooms.length} rooms, ${corridors.length} corridors and intersections.`;
}

/** Show the fields that the present tool takes. */
function showFields() {
  byId("name-field").hidden = !["door", "room", "corridor"].includes(tool());
  byId("length-field").hidden = tool() !== "scale";
}

function item(text) {
  return Object.assign(document.createElement("li"), { textContent: text });
}
