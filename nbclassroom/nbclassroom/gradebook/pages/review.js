"use strict";
const answers = [...document.querySelectorAll("article")];
const [lines, count, status, save, copy] = ["lines", "count", "status", "save", "copy"].map(
  id => document.getElementById(id));
const [worths, graded] = ["worths", "graded"].map(id => document.getElementById(id));
let current = -1;
const isServed = location.protocol === "http:";

const formOf = answer => answer.querySelector("form");
const forms = [...answers.map(formOf), ...(worths ? [worths] : [])];
const fieldsOf = form => [form.elements.points, form.elements.comment];
const quoted = text => (/[",;\r\n]/.test(text) ? `"${text.replaceAll('"', '""')}"` : text);
const changedForms = () => forms.filter(form =>
   fieldsOf(form).some(field => field.value !== field.defaultValue));

function lineOf(form) {
  return [form.dataset.line, ...fieldsOf(form).map(field => quoted(field.value.trim()))].join(",");
}

// Which points and comment the server has: a line replaces these, and no others.
const seenOf = form => (form.seen ?? ["", ""]).map(quoted);

function showRubric(answer) {
  const rubric = answer.querySelector(".rubric");
  if (!rubric) return;
  const points = fieldsOf(formOf(answer))[0].value.trim();
  const [, numbers, mark] = points.match(/^lines((?: \d+)+) of (\w+)$/) ?? [];
  const ticked = mark === rubric.dataset.mark ? numbers.trim().split(" ").map(Number) : [];
  rubric.querySelectorAll("input").forEach((box, line) => { box.checked = ticked.includes(line); });
  const worth = ticked.reduce((sum, line) => sum + (line && Number(worthsNow()[line - 1])), 0);
  const shown = Math.min(Math.max(worth, 0), Number(rubric.dataset.max));
  const text = ticked.length ? `${shown} of ${rubric.dataset.max}` : mark ? "changed since it was graded" : points;
  rubric.querySelector("output").textContent = answer.querySelector(".points").textContent = text || "not graded";
  rubric.querySelectorAll(".worth-now").forEach((line, k) => { line.textContent = worthsNow()[k]; });
  return ticked.length > 0 || points && !mark;
}

const worthsNow = () => [...worths.querySelectorAll(".worth")].map(field => field.value);

function tick(answer, line) {
  const rubric = answer.querySelector(".rubric");
  const boxes = [...rubric.querySelectorAll("input")];
  const ticked = boxes.flatMap((box, other) => (box.checked && (line > 0) === (other > 0) ? [other] : []));
  fieldsOf(formOf(answer))[0].value = ticked.length ? `lines ${ticked.join(" ")} of ${rubric.dataset.mark}` : "";
}

function offerComments(select) {
  const comments = new Set(answers.map(answer => fieldsOf(formOf(answer))[1].value.trim()).filter(Boolean));
  select.replaceChildren(select.options[0], ...[...comments].map(comment => new Option(comment)));
}

function update() {
  const done = answers.filter(showRubric).length;
  if (graded) graded.textContent = done;
  const changed = changedForms();
  lines.value = changed.map(lineOf).join("\n");
  const number = `${changed.length || "No"} ${changed.length === 1 ? "line" : "lines"}`;
  const names = changed.map(form => form.dataset.name).join(", ");
  count.textContent = `${number} ${isServed ? "to save" : "for decisions.csv"}${names && `: ${names}`}`;
}

function show(number) {
  current = Math.max(0, Math.min(answers.length - 1, number));
  answers[current].focus({ preventScroll: true });
  answers[current].scrollIntoView();
  if (isServed && changedForms().length) saveLines();
}

function decideForAll(event) {
  event.preventDefault();
  for (const id of event.target.dataset.members.split(" ")) {
    const fields = fieldsOf(document.getElementById(id).querySelector("form"));
    fieldsOf(event.target).forEach((field, k) => { if (field.value) fields[k].value = field.value; });
  }
  update();
  if (isServed) saveLines();
}

function showNextExercise() {
  if (isServed && changedForms().length) saveLines();
  saving.then(() => document.querySelector("[rel=next]")?.click());
}

let saving = Promise.resolve();
const saveLines = () => { saving = saving.then(saveNow); };

async function saveNow() {
  const changed = changedForms();
  const values = changed.map(form => fieldsOf(form).map(field => field.value));
  const body = changed.map(form => [lineOf(form), ...seenOf(form)].join(",")).join("\n");
  const answer = await fetch("../decisions", { method: "POST", body }).catch(
    () => ({ ok: false, text: () => "Not saved: the command does not run any more. Copy the lines." }));
  if (answer.ok) changed.forEach((form, i) => {
    fieldsOf(form).forEach((field, k) => { field.defaultValue = values[i][k]; });
    form.seen = values[i].map(value => value.trim().normalize());
  });
  status.textContent = await answer.text();
  update();
}

async function copyLines() {
  lines.closest("details").open = true;
  lines.select();
  await navigator.clipboard.writeText(lines.value);
  status.textContent = "Copied.";
}

document.addEventListener("keydown", event => {
  const typing = event.target.matches("input:not([type=checkbox]), textarea, select");
  if (event.ctrlKey || event.metaKey || event.altKey) return;
  if (event.key === "Escape" && typing) answers[Math.max(0, current)].focus();
  const answer = answers[Math.max(0, current)];
  const boxes = answer.querySelectorAll(".rubric input");
  if (typing || !("npce".includes(event.key) || boxes[event.key])) return;
  event.preventDefault();
  if ("np".includes(event.key)) show(current + (event.key === "n" ? 1 : -1));
  else if (event.key === "e") showNextExercise();
  else if (!answer.contains(document.activeElement)) show(current);  // nobody is graded out of sight
  else if (event.key === "c") fieldsOf(formOf(answer))[1].focus();
  else boxes[event.key].click();
});
document.addEventListener("focusin", event => {
  const answer = event.target.closest("article");
  if (answer) current = answers.indexOf(answer);
  if (event.target.matches(".again")) offerComments(event.target);
});
document.addEventListener("input", event => {
  const [field, form] = [event.target, event.target.form];
  if (field.matches(".rubric input")) tick(field.closest("article"), Number(field.value));
  if (field.matches(".again") && field.value) fieldsOf(form)[1].value = field.value;
  if (field.matches(".worth") && field.reportValidity()) fieldsOf(form)[0].value = `points ${worthsNow().join(" ")}`;
  update();
});
// The page is of the last run: after a reload it has what was saved since then.
async function takeSaved() {
  const saved = await (await fetch("../decisions")).json();
  for (const form of forms) {
    form.seen = saved[form.dataset.line];
    (changedForms().includes(form) ? [] : form.seen ?? []).forEach((value, k) => {
      fieldsOf(form)[k].value = fieldsOf(form)[k].defaultValue = value;
    });
  }
  const changed = worths && (saved[worths.dataset.line] ?? [""])[0].split(" ").slice(1);
  worths?.querySelectorAll(".worth").forEach((field, k) => { field.value = changed[k] ?? field.value; });
  update();
}
if (isServed) takeSaved();
update();
let pause;
if (isServed) document.addEventListener("input", event => {
  clearTimeout(pause);
  if (event.target.closest("article, #worths")) pause = setTimeout(saveLines, 1000);
});
document.addEventListener("submit", event => {
  if (event.target.matches(".alike")) decideForAll(event);
  else event.preventDefault();
});
window.addEventListener("beforeunload", event => { if (lines.value) event.preventDefault(); });
copy.addEventListener("click", copyLines);
save.addEventListener("click", saveLines);
save.hidden = !isServed;
