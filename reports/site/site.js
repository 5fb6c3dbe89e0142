// Filters the leaderboard: shows the chosen bound, hides what is not chosen, and counts the standings anew.
"use strict";
const told = JSON.parse(document.getElementById("cells").textContent);
const form = document.getElementById("filters");
const board = document.getElementById("board");
const lines = board ? [...document.querySelectorAll("#standings tbody tr")] : [];
const methods = board ? JSON.parse(document.getElementById("of").dataset.methods) : [];
const NONE = "–";

function number(value) { // as reports/wording.py: three significant digits and no exponent
  const digits = Math.max(0, 2 - Math.floor(Math.log10(Math.abs(Number(value.toExponential(2))))));
  return value.toLocaleString("en-US", { minimumFractionDigits: digits, maximumFractionDigits: digits });
}

function median(values) {
  const sorted = values.sort((a, b) => a - b), half = sorted.length >> 1;
  return !sorted.length ? null : sorted.length % 2 ? sorted[half] : (sorted[half - 1] + sorted[half]) / 2;
}

function counted(cells, method, at) { // as reports/site/standings.py counts
  const own = cells.map(cell => cell.m[method]).filter(Boolean), sum = (of) => own.reduce((n, e) => n + of(e), 0);
  const speedups = own.map(e => e.v[at]).filter(v => v);
  return {
    raced: own.length, won: sum(e => e.w[at] === 2), tied: sum(e => e.w[at] === 1), usable: sum(e => e.v[at] !== null),
    speedup: median(speedups), compared: speedups.length, wrong: sum(e => e.x), rays: sum(e => e.n),
  };
}

function write(line, found, cells) {
  const tied = found.tied ? ` + ${found.tied} tied` : "", share = line.querySelector(".share");
  const texts = [
    null, `${found.usable} of ${found.raced}`,
    found.compared ? `${number(found.speedup)}× in ${found.compared}` : NONE,
    found.wrong ? `${found.wrong.toLocaleString("en-US")} of ${found.rays.toLocaleString("en-US")}` : "0",
  ];
  share.textContent = `${found.won}${tied}`;
  share.style.setProperty("--share", cells ? found.won / cells : 0);
  line.querySelectorAll("td").forEach((cell, i) => { if (texts[i] !== null) cell.textContent = texts[i]; });
}

function choose() {
  const chosen = Object.fromEntries(new FormData(form)), at = told.levels.indexOf(chosen.error);
  const fits = (of) => ["device", "precision", "machine"].every(name => !chosen[name] || of[name] === chosen[name]);
  const cells = told.cells.filter(cell => fits(cell) && (!chosen.kind || cell.kind === chosen.kind));
  board.dataset.error = chosen.error;
  const found = methods.map((method, i) => ({ line: lines[i], method, ...counted(cells, method, at) }));
  found.forEach(one => {
    write(one.line, one, cells.length);
    one.line.hidden = !one.raced || (chosen.method && one.method !== chosen.method);
  });
  const order = (a, b) => b.won - a.won || b.tied - a.tied || b.usable - a.usable || (a.method < b.method ? -1 : 1);
  lines[0].parentNode.append(...found.sort(order).map(one => one.line));
  const columns = JSON.parse(document.getElementById("winners").dataset.columns).map(fits);
  for (const table of [document.getElementById("classes"), ...document.querySelectorAll("#winners table")])
    for (const row of table.rows) [...row.cells].slice(1).forEach((cell, i) => { cell.hidden = !columns[i]; });
  for (const section of document.querySelectorAll("#winners [data-kind]"))
    section.hidden = Boolean(chosen.kind) && section.dataset.kind !== chosen.kind;
  for (const row of document.querySelectorAll("#classes tbody tr"))
    row.hidden = Boolean(chosen.kind) && row.cells[0].textContent !== chosen.kind;
  for (const level of document.querySelectorAll("#winners .at")) {
    const won = level.querySelector(".won");
    level.classList.toggle("pale", Boolean(chosen.method) && !(won && won.dataset.won.split(" ").includes(chosen.method)));
  }
  document.getElementById("said").textContent =
    cells.length === told.cells.length ? "" : `${cells.length} of ${told.cells.length} cells are chosen.`;
}

if (board) {
  form.hidden = false;
  form.addEventListener("change", choose);
  choose();
}
