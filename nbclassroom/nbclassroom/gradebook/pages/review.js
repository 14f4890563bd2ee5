"use strict";
const answers = [...document.querySelectorAll("article")];
const [lines, count, status, save, copy] = ["lines", "count", "status", "save", "copy"].map(
  id => document.getElementById(id));
let current = -1;

const fieldsOf = form => [form.elements.points, form.elements.comment];
const quoted = text => (/[",;\r\n]/.test(text) ? `"${text.replaceAll('"', '""')}"` : text);
const changedForms = () => answers.map(answer => answer.querySelector("form")).filter(
  form => fieldsOf(form).some(field => field.value !== field.defaultValue));

function lineOf(form) {
  return [form.dataset.line, ...fieldsOf(form).map(field => quoted(field.value.trim()))].join(",");
}

function update() {
  const changed = changedForms();
  lines.value = changed.map(lineOf).join("\n");
  const number = changed.length || "No";
  count.textContent = `${number} ${changed.length === 1 ? "line" : "lines"} for decisions.csv`;
}

function show(number) {
  current = Math.max(0, Math.min(answers.length - 1, number));
  answers[current].focus({ preventScroll: true });
  answers[current].scrollIntoView();
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

async function saveLines() {
  const forms = changedForms();
  const values = forms.map(form => fieldsOf(form).map(field => field.value));
  const answer = await fetch("../decisions", { method: "POST", body: lines.value }).catch(
    () => ({ ok: false, text: () => "Not saved: the command does not run any more. Copy the lines." }));
  if (answer.ok) forms.forEach((form, i) => {
    fieldsOf(form).forEach((field, k) => { field.defaultValue = values[i][k]; });
    sessionStorage.setItem(form.dataset.line, JSON.stringify(values[i]));
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
  const typing = event.target.matches("input, textarea");
  if (event.ctrlKey || event.metaKey || event.altKey) return;
  if (event.key === "Escape" && typing) answers[Math.max(0, current)].focus();
  if (typing || !"npc".includes(event.key)) return;
  event.preventDefault();
  if (event.key === "c") fieldsOf(answers[Math.max(0, current)].querySelector("form"))[1].focus();
  else show(current + (event.key === "n" ? 1 : -1));
});
document.addEventListener("focusin", event => {
  const answer = event.target.closest("article");
  if (answer) current = answers.indexOf(answer);
});
document.addEventListener("input", update);
// The page is of the last run: after a reload it has what was saved since then.
const isServed = location.protocol === "http:";
for (const form of isServed ? answers.map(answer => answer.querySelector("form")) : []) {
  const saved = JSON.parse(sessionStorage.getItem(form.dataset.line) ?? "[]");
  saved.forEach((value, k) => { fieldsOf(form)[k].value = fieldsOf(form)[k].defaultValue = value; });
}
let pause;
if (isServed) document.addEventListener("input", event => {
  clearTimeout(pause);
  if (event.target.closest("article")) pause = setTimeout(saveLines, 1000);
});
document.addEventListener("submit", event => {
  if (event.target.matches(".alike")) decideForAll(event);
  else event.preventDefault();
});
window.addEventListener("beforeunload", event => { if (lines.value) event.preventDefault(); });
copy.addEventListener("click", copyLines);
save.addEventListener("click", saveLines);
save.hidden = !isServed;
