"use strict";
// Tables: a click on a heading sorts by value, a second one the other way; a text filters rows.
for (const figure of document.querySelectorAll("figure.table")) {
  const body = figure.querySelector("tbody");
  const count = figure.querySelector(".count");
  const headings = [...figure.querySelectorAll("th[scope=col]")];
  const value = (row, i) => {
    const cell = row.cells[i];
    return cell.dataset.v === undefined ? cell.textContent : Number(cell.dataset.v);
  };
  const compare = (a, b) => {
    const numbers = [typeof a === "number", typeof b === "number"];
    if (numbers[0] && numbers[1]) return a - b;
    if (numbers[0] !== numbers[1]) return numbers[0] ? -1 : 1; // numbers before words and dashes
    return a.localeCompare(b, undefined, { numeric: true });
  };
  headings.forEach((heading, i) => {
    heading.querySelector(".sort").addEventListener("click", () => {
      const down = heading.getAttribute("aria-sort") === "ascending";
      headings.forEach((other) => other.removeAttribute("aria-sort"));
      heading.setAttribute("aria-sort", down ? "descending" : "ascending");
      const rows = [...body.rows].map((row) => [value(row, i), row]);
      rows.sort((a, b) => (down ? -1 : 1) * compare(a[0], b[0]));
      body.append(...rows.map((pair) => pair[1]));
    });
  });
  figure.querySelector(".filter")?.addEventListener("input", (event) => {
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

// Drawings: the pointer on a mark names its variant; a click on a method, or on its mark, fades the others.
const tip = document.getElementById("tip");
const chips = [...document.querySelectorAll(".chip")];
const series = [...document.querySelectorAll(".series")];
const named = new Map(series.map((group) => [group, JSON.parse(decodeURIComponent(group.dataset.series))]));
let kept = null;
function keep(method) {
  kept = kept === method ? null : method;
  chips.forEach((chip) => chip.setAttribute("aria-pressed", String(chip.dataset.method === kept)));
  series.forEach((group) => group.classList.toggle("faded", kept !== null && named.get(group)[0] !== kept));
}
chips.forEach((chip) => chip.addEventListener("click", () => keep(chip.dataset.method)));
for (const group of series) {
  const [method, ...variants] = named.get(group);
  const marks = [...group.querySelectorAll("use")];
  group.addEventListener("click", () => keep(method));
  group.addEventListener("pointermove", (event) => {
    const own = variants.length === 1 ? variants[0] : variants[marks.indexOf(event.target)];
    tip.textContent = own ?? method;
    tip.hidden = false;
    tip.style.left = `${event.clientX + 12}px`;
    tip.style.top = `${event.clientY + 12}px`;
  });
  group.addEventListener("pointerleave", () => { tip.hidden = true; });
}

// Galleries: two pictures over each other, and a slider where the one ends and the other begins.
for (const gallery of document.querySelectorAll("figure.gallery")) {
  const pictures = [];
  for (const panel of gallery.querySelectorAll(".panel")) {
    panel.querySelectorAll("img").forEach((image, i) => {
      pictures.push([`${panel.dataset.title} – ${i === 0 ? "drawn" : "error"}`, image]);
    });
  }
  const sides = [["left", "under", 0], ["right", "above", Math.min(1, pictures.length - 1)]];
  for (const [side, layer, first] of sides) {
    const select = gallery.querySelector(`.${side}`);
    const target = gallery.querySelector(`.${layer}`);
    const choose = () => {
      target.src = pictures[select.value][1].src;
      target.alt = pictures[select.value][1].alt;
    };
    pictures.forEach(([title], i) => select.add(new Option(title, i, false, i === first)));
    select.addEventListener("change", choose);
    choose();
  }
  const [above, edge] = [gallery.querySelector(".above"), gallery.querySelector(".edge")];
  gallery.querySelector(".slider").addEventListener("input", (event) => {
    above.style.clipPath = `inset(0 0 0 ${event.target.value}%)`;
    edge.style.left = `${event.target.value}%`;
  });
}
