// The address of the page: it holds the scene and the command, so that a link brings both back.

const NUMBERS = ["seed", "people"];
const TEXTS = ["plan", "robot", "agent"];

/** What an address asks for: {scene, command, language}. Fields that it does not name are missing. */
export function readAddress(search) {
  const query = new URLSearchParams(search);
  const scene = {};
  for (const name of TEXTS) if (query.has(name)) scene[name] = query.get(name);
  for (const name of NUMBERS) if (query.has(name)) scene[name] = Number(query.get(name));
  if (query.has("pose")) scene.pose = numbers(query.get("pose"));
  if (query.has("boxes")) scene.boxes = query.get("boxes").split(";").filter(Boolean).map(numbers);
  if (query.has("leaves")) scene.leaves = query.get("leaves") !== "no";
  return { scene, command: query.get("say") ?? "", language: query.get("language") ?? "" };
}

/** The query that brings a scene and a command back. */
export function writeAddress(scene, command, language) {
  const query = new URLSearchParams();
  for (const name of TEXTS) query.set(name, scene[name]);
  for (const name of NUMBERS) if (scene[name]) query.set(name, scene[name]);
  if (scene.pose) query.set("pose", scene.pose.join(","));
  if (scene.boxes.length) query.set("boxes", scene.boxes.map((box) => box.join(",")).join(";"));
  if (!scene.leaves) query.set("leaves", "no");
  if (command) query.set("say", command);
  if (language) query.set("language", language);
  return `?${query}`;
}

/** The numbers of a text such as "1.5, -2"; what is none becomes null, which the server refuses. */
export function numbers(text) {
  return text.split(",").map((part) => {
    const value = part.trim() === "" ? NaN : Number(part);
    return Number.isFinite(value) ? value : null;
  });
}
