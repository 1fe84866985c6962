// Draws a moment of a run over its floor plan.

const EVERY_BEAM = 9; // of the beams one in so many is drawn; more would blur
const LABEL_FONT = "11px system-ui, sans-serif";
let paint; // the canvas' 2D context
let view; // the camera
let colour; // of a name in style.css
let written = []; // boxes of the names that are written: none is written over another

/** Draw everything. `scene` and `moment` are messages of the server; `extra` is what the page adds. */
export function draw(context, camera, scene, moment, extra) {
  begin(context, camera);
  drawFloor(scene.plan);
  if (moment) drawScan(moment);
  drawSolids(scene.plan);
  drawRoomNames(scene.plan.rooms);
  if (moment) drawMoment(moment, scene, extra.trail);
  else drawBody(scene.body, scene.start);
  if (extra.placing) drawBody(scene.body, extra.placing);
  if (extra.cross) drawCross(extra.cross);
  drawScale();
}

/** Draw a moment of a drive that was kept: beside it the true way, and where something was touched. */
export function drawKept(context, camera, scene, moment, { trail, route, goals, touched, aim }) {
  begin(context, camera);
  drawFloor(scene.plan);
  drawSolids(scene.plan);
  paint.setLineDash([7, 6]);
  line(route, "good", 2);
  paint.setLineDash([]);
  drawMoment(moment, scene, trail);
  const doors = new Set(scene.plan.doors.map(({ name }) => name)); // in their words is told what failed
  for (const door of scene.plan.doors) drawDoorName(door);
  drawRoomNames(scene.plan.rooms.filter(({ name }) => !doors.has(name)));
  goals.forEach((at, index) => drawMark(index + 1, at, "good"));
  if (aim) drawMark("★", aim, "goal");
  for (const at of touched) drawMark("×", at, "hit");
  drawScale();
}

/** Draw a floor plan that is drawn on: all its names, its faults, and the line that is begun. */
export function drawBoard(context, camera, plan, faults, { line: begun, cross }) {
  begin(context, camera);
  drawFloor(plan);
  drawSolids(plan);
  for (const door of plan.doors) line(door.ends, door.open ? "door" : "hit", 4);
  for (const room of plan.rooms) write(room.name, ...room.at, "ink");
  for (const door of plan.doors) drawDoorName(door);
  for (const corridor of plan.corridors) write(corridor.name, ...corridor.at, "name");
  faults.forEach(({ at }, index) => { if (at) drawMark(index + 1, at, "bad"); });
  if (begun) drawBegun(begun);
  if (cross) drawCross(cross);
  drawScale();
}

function begin(context, camera) {
  paint = context;
  view = camera;
  const style = getComputedStyle(document.documentElement);
  colour = (name) => style.getPropertyValue(`--${name}`).trim();
  paint.setTransform(devicePixelRatio, 0, 0, devicePixelRatio, 0, 0);
  paint.clearRect(0, 0, ...camera.size);
  paint.lineCap = paint.lineJoin = "round";
  written = [];
}

function drawFloor(plan) {
  fill(plan.boundary, "floor");
  for (const room of plan.rooms) fill(room.points, "room");
  for (const corridor of plan.corridors) fill(corridor.points, "corridor");
}

/** The names of the rooms that are wide enough for them. */
function drawRoomNames(rooms) {
  for (const { name, points, at } of rooms) {
    const xs = points.map(([x]) => x);
    paint.font = LABEL_FONT;
    const wide = (Math.max(...xs) - Math.min(...xs)) * view.scale;
    if (paint.measureText(spaced(name)).width < wide - 8) write(name, ...at, "name", "room");
  }
}

/** The name of a door behind it, as seen from its corridor. */
function drawDoorName({ name, ends: [[x1, y1], [x2, y2]] }) {
  const length = Math.hypot(x2 - x1, y2 - y1) || 1;
  const [right, down] = [(y2 - y1) / length, (x2 - x1) / length]; // in pixels, from the corridor
  paint.font = LABEL_FONT;
  const half = paint.measureText(spaced(name)).width / 2;
  const away = 10 + half * Math.abs(right);
  writeAt(spaced(name), view.x((x1 + x2) / 2) + away * right, view.y((y1 + y2) / 2) + away * down, "door");
}

/** Write a name at a place in metres, unless it would lie on another one. */
function write(name, x, y, colourName, halo) {
  writeAt(spaced(name), view.x(x), view.y(y), colourName, halo);
}

/** The same at a place in pixels; a name that lies on another moves by a line, or is left out. */
function writeAt(words, x, y, colourName, halo) {
  paint.font = LABEL_FONT;
  const half = paint.measureText(words).width / 2 + 2;
  for (const shift of [0, 13, -13]) {
    const box = [x - half, y + shift - 7, x + half, y + shift + 7];
    if (written.some((other) => overlap(box, other))) continue;
    written.push(box);
    return label(words, x, y + shift, colourName, halo);
  }
}

function overlap(a, b) { return a[0] < b[2] && b[0] < a[2] && a[1] < b[3] && b[1] < a[3]; }
function spaced(name) { return name.replaceAll("_", " "); }

/** A number or another sign in a ring. */
function drawMark(sign, [x, y], name) {
  paint.beginPath();
  paint.arc(view.x(x), view.y(y), 9, 0, 7);
  paint.fillStyle = colour("halo");
  paint.fill();
  stroke(name, 2);
  text(String(sign), view.x(x), view.y(y), name, "bold 11px system-ui, sans-serif");
}

function drawBegun([from, to]) {
  line([from, to], "halo", 6);
  line([from, to], "goal", 3);
  const length = Math.hypot(to[0] - from[0], to[1] - from[1]);
  label(`${length.toFixed(2)} m`, view.x((from[0] + to[0]) / 2), view.y((from[1] + to[1]) / 2) - 12, "goal");
}

function drawSolids(plan) {
  const widths = { wall: 2.2, glass: 2.2, leaf: 2, furniture: 1.2, person: 1.5 };
  for (const { material, points } of plan.surfaces) {
    const name = material === "wall" ? "solid" : material;
    if (material === "furniture" && points.length > 3) fill(points, "furniture");
    line(points, name, widths[material]);
  }
  for (const door of plan.doors) if (!door.open) line(door.ends, "leaf", 2.5);
}

function drawScan({ lidar, hits, walls }) {
  const [x, y] = [view.x(lidar[0] / 100), view.y(lidar[1] / 100)];
  paint.beginPath();
  paint.moveTo(x, y);
  each(hits, 2, (hx, hy) => paint.lineTo(view.x(hx), view.y(hy)));
  paint.closePath();
  paint.fillStyle = colour("fan");
  paint.fill();
  paint.beginPath();
  each(hits, 2, (hx, hy, _x, _y, index) => {
    if (index % EVERY_BEAM) return;
    paint.moveTo(x, y);
    paint.lineTo(view.x(hx), view.y(hy));
  });
  stroke("beam", 0.8);
  segments(walls, "beam", 7);
}

function drawMoment(moment, { body }, trail) {
  if (moment.goal?.door) segments(moment.goal.door, "doorway", 14);
  segments(moment.leaves, "leaf", 3);
  line(trail, "trail", 2);
  segments(moment.remembered, "remembered", 1.6);
  paint.fillStyle = colour("hit");
  each(moment.hits, 2, (x, y) => paint.fillRect(view.x(x) - 1, view.y(y) - 1, 2, 2));
  for (const door of moment.doors) drawDoor(door);
  each(moment.people, 3, (x, y, radius) => disc(x, y, radius * view.scale, "person"));
  drawBody(body, moment.pose, moment.contact);
  if (moment.goal) drawGoal(moment.goal, moment.pose);
  for (const door of moment.doors) if (door.number) drawNumber(door);
}

/** A remembered door: the surer the robot is of it, the stronger. */
function drawDoor({ ends, confidence }) {
  paint.globalAlpha = 0.35 + 0.65 * (confidence ?? 1);
  segments(ends, "door", 4);
  paint.globalAlpha = 1;
}

function drawNumber({ ends, number, confidence }) {
  const [x1, y1, x2, y2] = ends.map((value) => value / 100);
  const length = Math.hypot(x2 - x1, y2 - y1) || 1;
  const [away, up] = [(y1 - y2) / length, (x1 - x2) / length]; // to the robot's side, in pixels
  const x = view.x((x1 + x2) / 2) + 16 * away;
  const y = view.y((y1 + y2) / 2) + 16 * up;
  paint.beginPath();
  paint.arc(x, y, 9, 0, 7);
  paint.fillStyle = colour("door");
  paint.fill();
  stroke("halo", 1.5);
  text(String(number), x, y, "halo", "bold 11px system-ui, sans-serif");
  if (confidence !== null) label(`${Math.round(100 * confidence)} %`, x + 23 * away, y + 17 * up, "door");
}

function drawGoal({ kind, pose }, robot) {
  const [x, y, heading] = pose;
  paint.setLineDash([2, 5]);
  line([robot, pose], "goal", 1);
  paint.setLineDash([]);
  const [px, py] = [view.x(x), view.y(y)];
  const [dx, dy] = [Math.cos(heading), -Math.sin(heading)];
  paint.beginPath();
  paint.moveTo(px + 9 * dx, py + 9 * dy);
  paint.lineTo(px + 22 * dx, py + 22 * dy);
  stroke("goal", 2.5);
  paint.beginPath();
  paint.arc(px, py, 8, 0, 7);
  paint.fillStyle = colour("halo");
  paint.fill();
  stroke("goal", 2.5);
  text({ seek: "?", stop: "■" }[kind] ?? "●", px, py + 0.5, "goal", "bold 11px system-ui, sans-serif");
}

function drawBody(body, [x, y, heading], contact = false) {
  paint.save();
  paint.translate(view.x(x), view.y(y));
  paint.rotate(-heading);
  paint.scale(view.scale, -view.scale);
  const [half, side] = [body.length / 2, body.width / 2];
  slab(-half, -side, body.length, body.width, colour(contact ? "hit" : "halo"), 0.12);
  slab(-half, -side, body.length, body.width, colour(body.legs ? "spot" : "body"), 0);
  if (!body.legs) slab(-half * 0.7, -side * 0.62, body.length * 0.6, body.width * 0.62, colour("seat"), 0);
  paint.beginPath();
  paint.moveTo(half * 0.8, 0);
  paint.lineTo(half * 0.15, side * 0.55);
  paint.lineTo(half * 0.3, 0);
  paint.lineTo(half * 0.15, -side * 0.55);
  paint.fillStyle = colour("solid");
  paint.fill();
  paint.restore();
}

function slab(x, y, width, height, fillStyle, grow) {
  paint.beginPath();
  paint.roundRect(x - grow / 2, y - grow / 2, width + grow, height + grow, 0.12);
  paint.fillStyle = fillStyle;
  paint.fill();
}

function drawCross([x, y]) {
  const [px, py] = [view.x(x), view.y(y)];
  paint.beginPath();
  for (const [dx, dy] of [[1, 0], [-1, 0], [0, 1], [0, -1]]) {
    paint.moveTo(px + 4 * dx, py + 4 * dy);
    paint.lineTo(px + 13 * dx, py + 13 * dy);
  }
  stroke("halo", 5);
  stroke("goal", 2.5);
}

function drawScale() {
  const [left, bottom, length] = [16, view.size[1] - 16, 2 * view.scale];
  paint.beginPath();
  paint.moveTo(left, bottom);
  paint.lineTo(left + length, bottom);
  stroke("muted", 2);
  label("2 m", left + length / 2, bottom - 9, "muted");
}

function fill(points, name) {
  path(points);
  paint.fillStyle = colour(name);
  paint.fill();
}

function line(points, name, width) {
  path(points);
  stroke(name, width);
}

function path(points) {
  paint.beginPath();
  for (const [x, y] of points) paint.lineTo(view.x(x), view.y(y));
}

function segments(ends, name, width) {
  paint.beginPath();
  each(ends, 4, (x1, y1, x2, y2) => {
    paint.moveTo(view.x(x1), view.y(y1));
    paint.lineTo(view.x(x2), view.y(y2));
  });
  stroke(name, width);
}

function disc(x, y, radius, name) {
  paint.beginPath();
  paint.arc(view.x(x), view.y(y), radius, 0, 7);
  paint.fillStyle = colour(name);
  paint.fill();
}

/** Text on a halo, so that it can be read on anything. */
function label(words, x, y, name, halo = "halo") {
  paint.font = LABEL_FONT;
  paint.textAlign = "center";
  paint.textBaseline = "middle";
  paint.strokeStyle = colour(halo);
  paint.lineWidth = 3;
  paint.strokeText(words, x, y);
  paint.fillStyle = colour(name);
  paint.fillText(words, x, y);
}

function text(words, x, y, name, font) {
  paint.font = font;
  paint.textAlign = "center";
  paint.textBaseline = "middle";
  paint.fillStyle = colour(name);
  paint.fillText(words, x, y);
}

function stroke(name, width) {
  paint.strokeStyle = colour(name);
  paint.lineWidth = width;
  paint.stroke();
}

/** Call `use` with each row of a flat list of centimetres, in metres. */
function each(numbers, width, use) {
  for (let k = 0; k < numbers.length; k += width) {
    use(numbers[k] / 100, numbers[k + 1] / 100, numbers[k + 2] / 100, numbers[k + 3] / 100, k / width);
  }
}
