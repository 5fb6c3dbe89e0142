"use strict";
// The bar of methods: its height is kept, so that headings that are jumped to stand below it.
const tip = document.getElementById("tip");
const bar = document.getElementById("chips");
const chips = [...document.querySelectorAll(".chip")];
if (bar) {
  bar.hidden = false;
  const keepHeight = () => document.documentElement.style.setProperty("--bar", `${bar.offsetHeight + 6}px`);
  new ResizeObserver(keepHeight).observe(bar);
  keepHeight();
}
const contents = document.querySelector("nav details");
if (contents && matchMedia("(max-width: 60rem)").matches) contents.open = false;

// The tip: what is told of the thing that is pointed at, tapped or focused. Content is a text or an element.
function tell(content, x, y) {
  tip.replaceChildren(content);
  tip.hidden = false;
  const [wide, high] = [tip.offsetWidth, tip.offsetHeight];
  const left = x + 14 + wide > innerWidth ? x - 14 - wide : x + 14;
  const top = y + 14 + high > innerHeight ? y - 14 - high : y + 14;
  tip.style.left = `${Math.max(2, Math.min(left, innerWidth - wide - 2))}px`;
  tip.style.top = `${Math.max(2, top)}px`;
}
function hush() { tip.hidden = true; }
function left(event) { if (event?.pointerType !== "touch") hush(); } // what a finger tapped is told until the next tap
addEventListener("pointerdown", hush, { capture: true });
addEventListener("keydown", (event) => { if (event.key === "Escape") hush(); });
addEventListener("scroll", hush, { capture: true, passive: true });

// Methods: those that are chosen stay, and all others fade, in drawings and in charts.
const series = [...document.querySelectorAll(".series")];
const named = new Map(series.map((group) => [group, JSON.parse(decodeURIComponent(group.dataset.series))]));
const kept = new Set();
const onKept = []; // what charts do when the choice changes
const everyone = document.getElementById("everyone");
function show() {
  chips.forEach((chip) => chip.setAttribute("aria-pressed", String(kept.has(chip.dataset.method))));
  series.forEach((group) => group.classList.toggle("faded", kept.size > 0 && !kept.has(named.get(group)[0])));
  if (everyone) everyone.hidden = kept.size === 0;
  onKept.forEach((follow) => follow([...kept]));
}
function keep(method) {
  if (!kept.delete(method)) kept.add(method);
  show();
}
chips.forEach((chip) => chip.addEventListener("click", () => keep(chip.dataset.method)));
everyone?.addEventListener("click", () => { kept.clear(); show(); chips[0].focus(); });

// Drawings: the pointer on a mark names its variant; a click on it chooses its method.
for (const group of series) {
  const [method, ...variants] = named.get(group);
  const marks = [...group.querySelectorAll("use")];
  group.addEventListener("click", () => keep(method));
  const describe = (event) => {
    const own = variants.length === 1 ? variants[0] : variants[marks.indexOf(event.target)];
    tell(own ?? method, event.clientX, event.clientY);
  };
  group.addEventListener("pointermove", describe);
  group.addEventListener("pointerdown", describe);
  group.addEventListener("pointerleave", left);
}

// Tables: a click on a heading sorts by value, a second one the other way; a text filters rows.
function makeSortable(figure) {
  const body = figure.querySelector("tbody");
  const headings = [...figure.querySelectorAll("th[scope=col]")];
  const value = (row, i) => {
    const cell = row.cells[i];
    if (cell.dataset.v !== undefined) return Number(cell.dataset.v);
    const number = cell.className === "" ? Number(cell.textContent) : NaN;
    return cell.textContent && Number.isFinite(number) ? number : cell.textContent;
  };
  const compare = (a, b) => {
    const numbers = [typeof a === "number", typeof b === "number"];
    if (numbers[0] && numbers[1]) return a - b;
    if (numbers[0] !== numbers[1]) return numbers[0] ? -1 : 1; // numbers before words and dashes
    return a.localeCompare(b, undefined, { numeric: true });
  };
  headings.forEach((heading, i) => {
    const button = document.createElement("button");
    button.type = "button";
    button.className = "sort";
    button.append(...heading.childNodes);
    heading.append(button);
    button.addEventListener("click", () => {
      const down = heading.getAttribute("aria-sort") === "ascending";
      headings.forEach((other) => other.removeAttribute("aria-sort"));
      heading.setAttribute("aria-sort", down ? "descending" : "ascending");
      const rows = [...body.rows].map((row) => [value(row, i), row]);
      rows.sort((a, b) => (down ? -1 : 1) * compare(a[0], b[0]));
      body.append(...rows.map((pair) => pair[1]));
    });
  });
  if (!headings.length || body.rows.length < 4) return;
  const filter = document.createElement("input");
  const count = document.createElement("span");
  const told = figure.querySelector(".scroll").getAttribute("aria-label");
  Object.assign(filter, { className: "filter", type: "search", placeholder: "filter rows", ariaLabel: `filter the rows of: ${told}` });
  Object.assign(count, { className: "count", role: "status" });
  const both = document.createElement("span");
  both.className = "filtering";
  both.append(filter, " ", count);
  (figure.querySelector("caption > div") ?? figure.querySelector("table").createCaption()).append(both);
  filter.addEventListener("input", (event) => {
    const words = event.target.value.toLowerCase().split(/\s+/).filter(Boolean);
    let shown = 0;
    for (const row of body.rows) {
      const text = row.textContent.toLowerCase();
      row.hidden = !words.every((word) => text.includes(word));
      shown += row.hidden ? 0 : 1;
    }
    count.textContent = words.length ? `${shown} of ${body.rows.length} rows` : "";
  });
}
document.querySelectorAll("figure.table").forEach(makeSortable);

// A caption is as wide as its table's box, not as its table, which may be wider.
const boxes = new ResizeObserver((entries) => {
  for (const { target } of entries) target.style.setProperty("--wide", `${target.clientWidth}px`);
});
document.querySelectorAll(".scroll").forEach((box) => boxes.observe(box));

// Matrices: squares tell their notes; one square of a matrix is reached by Tab, the others by the arrow keys.
for (const matrix of document.querySelectorAll("figure.matrix")) {
  const rows = [...matrix.querySelectorAll("tbody tr")].map((row) => [...row.cells].slice(1)).filter((row) => row.length);
  const square = (cell) => cell?.querySelector(".square");
  const all = rows.flat().map(square).filter(Boolean);
  const arrows = { ArrowLeft: [0, -1], ArrowRight: [0, 1], ArrowUp: [-1, 0], ArrowDown: [1, 0] };
  const describe = (button) => {
    const box = button.getBoundingClientRect();
    tell(button.querySelector(".note").textContent, box.left + box.width / 2, box.bottom - 10);
  };
  all.forEach((button, i) => {
    button.tabIndex = i === 0 ? 0 : -1;
    button.addEventListener("pointerenter", () => describe(button));
    button.addEventListener("pointerdown", () => describe(button));
    button.addEventListener("click", () => describe(button));
    button.addEventListener("pointerleave", left);
    button.addEventListener("focus", () => describe(button));
    button.addEventListener("blur", hush);
    button.addEventListener("keydown", (event) => {
      const step = arrows[event.key];
      if (!step) return;
      event.preventDefault();
      let [r, c] = [rows.findIndex((row) => row.includes(button.parentElement)), button.parentElement.cellIndex - 1];
      do { r += step[0]; c += step[1]; } while (rows[r]?.[c] && !square(rows[r][c]));
      const next = square(rows[r]?.[c]);
      if (!next) return;
      all.forEach((other) => { other.tabIndex = other === next ? 0 : -1; });
      next.focus();
    });
  });
}

// Galleries: two pictures over each other, and a slider where the one ends and the other begins. It starts with the
// last pictures of two panels of two methods, whose titles begin with the method; one of one panel with its two pictures.
for (const gallery of document.querySelectorAll("figure.gallery:has(.sliding)")) {
  const panels = [...gallery.querySelectorAll(".panel")];
  const pictures = [];
  const lasts = [];
  for (const panel of panels) {
    const images = [...panel.querySelectorAll("img")];
    images.forEach((image, i) => {
      const kind = images.length < 2 ? "" : i === 0 ? "drawn" : "error";
      const title = panels.length > 1 || !kind ? panel.dataset.title : "";
      pictures.push([[title, kind].filter(Boolean).join(" – "), image]);
    });
    if (images.length) lasts.push(pictures.length - 1);
  }
  if (pictures.length < 2) continue;
  const alike = gallery.querySelector(".hero") && lasts.length > 2 ? lasts.slice(1) : lasts;
  const method = (i) => pictures[i][0].split(/[,[]/)[0];
  const other = alike.find((i) => method(i) !== method(alike[0])) ?? alike[1];
  const firsts = alike.length > 1 ? [alike[0], other] : [0, 1];
  gallery.querySelector(".sliding").hidden = false;
  [["left", "under", firsts[0]], ["right", "above", firsts[1]]].forEach(([side, layer, first]) => {
    const select = gallery.querySelector(`.${side}`);
    const target = gallery.querySelector(`.${layer}`);
    const choose = () => {
      target.src = pictures[select.value][1].src;
      target.alt = pictures[select.value][1].alt;
    };
    pictures.forEach(([title], i) => select.add(new Option(title, i, false, i === first)));
    select.addEventListener("change", choose);
    choose();
  });
  const [above, edge] = [gallery.querySelector(".above"), gallery.querySelector(".edge")];
  gallery.querySelector(".slider").addEventListener("input", (event) => {
    above.style.clipPath = `inset(0 0 0 ${event.target.value}%)`;
    edge.style.left = `${event.target.value}%`;
  });
}
