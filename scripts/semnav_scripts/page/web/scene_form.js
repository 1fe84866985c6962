// The form that chooses floor plan, robot and agent.

import { numbers } from "./address.js";

const field = (id) => document.getElementById(id);
const form = field("scene-form");
const ABOUT = {
  scripted: "scripted: plans its paths",
  oracle: "oracle: knows the floor plan",
  drive: "drive: learned to drive",
  listener: "listener: learned to find the goal",
  listener_drives: "listener_drives: learned both",
  blind: "blind: does not hear the command",
  random: "random: any motion",
};

/** Fill the lists with what the server offers. */
export function offer({ plans, offices, robots, agents }) {
  const generated = offices.map((name) => [`office:${name}`, `generated: ${name}`]);
  fill(field("plan"), [...plans.map((name) => [name, name.replaceAll("_", " ")]), ...generated]);
  fill(field("robot"), robots.map((name) => [name, name]));
  fill(field("agent"), agents.map((name) => [name, ABOUT[name] ?? name]));
}

/** Let the visitor's own floor plan be chosen, too. */
export function offerOwn(name) {
  const own = field("plan").querySelector("option[value=own]") ?? field("plan").appendChild(new Option("", "own"));
  own.textContent = `yours: ${name}`;
}

/** Show a scene in the form. */
export function showScene(scene) {
  const office = scene.plan.match(/^(office:[a-z]+):(\d+)$/);
  field("plan").value = office ? office[1] : scene.plan;
  if (office) field("office-number").value = office[2];
  field("office").hidden = !office;
  for (const name of ["robot", "agent", "seed", "people"]) field(name).value = scene[name];
  field("start").value = scene.pose ? scene.pose.map((value) => Number(value.toFixed(2))).join(", ") : "";
  field("leaves").checked = scene.leaves;
}

/** The scene that the form asks for, without boxes. */
export function readScene() {
  const plan = field("plan").value;
  const start = field("start").value.trim();
  return {
    plan: plan.startsWith("office:") ? `${plan}:${whole("office-number")}` : plan,
    robot: field("robot").value,
    agent: field("agent").value,
    seed: whole("seed"),
    people: whole("people"),
    pose: start ? numbers(start) : null,
    leaves: field("leaves").checked,
  };
}

/** Call `use` with the id of whatever is changed in the form. */
export function onChange(use) {
  form.onsubmit = (event) => event.preventDefault();
  form.onchange = (event) => {
    if (event.target.type === "file") return;
    if (["plan", "office-number"].includes(event.target.id)) field("start").value = "";
    use(event.target.id);
  };
  field("another").onclick = () => {
    field("office-number").value = Math.floor(Math.random() * 1000);
    field("start").value = "";
    use("office-number");
  };
}

function whole(id) {
  return Math.round(Number(field(id).value) || 0);
}

function fill(select, pairs) {
  select.replaceChildren(...pairs.map(([value, text]) => new Option(text, value)));
}
