// What the robot understood, asked or refused, and what became of each clause.

const heard = document.getElementById("heard");
const clauses = document.getElementById("clauses");
const verdict = document.getElementById("verdict");
const MARKS = { done: "✓", skipped: "–", pending: "", active: "" };

/** Forget the last command. */
export function clear() {
  heard.replaceChildren();
  clauses.replaceChildren();
  say("");
}

/** Show the clauses of a command that is carried out, and which words were corrected. */
export function showClauses(texts, corrections = []) {
  clear();
  heard.replaceChildren(...corrections.map((line) => made("p", line)));
  clauses.replaceChildren(...texts.map((text, index) => {
    const item = made("li", text);
    item.dataset.mark = index + 1;
    return item;
  }));
}

/** Tick the clauses as the judge sees them. */
export function tick(verdicts) {
  verdicts.forEach((name, index) => {
    const item = clauses.children[index];
    if (!item || item.title === name) return;
    item.title = name;
    item.className = name in MARKS ? name : "failed";
    item.dataset.mark = name in MARKS ? MARKS[name] || index + 1 : "✗";
    item.ariaCurrent = name === "active" ? "step" : null;
  });
}

/** Show a refusal, its faulty words underlined. `position` counts characters, not code units. */
export function showRefusal({ text, why, position, length }) {
  clear();
  const said = made("p", "", "said");
  const letters = Array.from(text);
  const [from, to] = position === null ? [0, 0] : [position, position + Math.max(1, length)];
  said.append("“", letters.slice(0, from).join(""));
  if (to > from) said.append(made("mark", letters.slice(from, to).join("")));
  said.append(letters.slice(to).join(""), "”");
  heard.replaceChildren(said, made("p", why, "problem"));
}

/** Show a question, with a button for each answer; `answer` is called with the one that is chosen. */
export function showQuestion({ question, choices, text }, answer) {
  clear();
  const row = made("div", "", "row");
  row.append(...choices.map((choice) => {
    const button = made("button", choice);
    button.type = "button";
    button.onclick = () => answer(choice);
    return button;
  }));
  heard.replaceChildren(made("p", `“${text}”`, "said"), made("p", question, "question"), row);
}

/** Say how a run ended. */
export function showEnd({ outcome, verdicts, impossible, collisions, seconds, metres }) {
  tick(verdicts);
  const touched = collisions === 1 ? "1 contact" : `${collisions || "no"} contacts`;
  const fault = verdicts.find((name) => !(name in MARKS));
  const what = { done: "Done", failed: `Not done: ${fault ?? "failed"}` }[outcome] ?? "Stopped by you";
  const why = impossible ? ` The robot found it impossible: ${impossible}.` : "";
  say(`${what}. ${seconds} s, ${metres} m, ${touched}.${why}`, outcome);
}

/** Say something about the run, which a screen reader reads out. */
export function say(words, kind = "") {
  verdict.textContent = words;
  verdict.className = kind;
}

function made(tag, text, className = "") {
  const element = document.createElement(tag);
  element.textContent = text;
  element.className = className;
  return element;
}
