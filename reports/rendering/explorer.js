// The explorer: a panel for each scene of the chosen rows, by the chosen axes.
(() => {
  const place = document.getElementById("explorer");
  if (!place) return;
  const held = JSON.parse(document.getElementById("explorer-rows").textContent);
  const base = JSON.parse(document.getElementById("explorer-chart").textContent);
  const methods = JSON.parse(document.getElementById("methods").textContent);
  const count = held.ms.length;
  const columns = Object.entries(held).map(([name, column]) => [name, Array.isArray(column)
    ? (i) => column[i] : (i) => column.values[column.rows[i]]]);
  const rows = Array.from({ length: count }, (_, i) =>
    Object.fromEntries([...columns.map(([name, at]) => [name, at(i)]), ["row", i]]));
  const selects = Object.fromEntries([...place.querySelectorAll("select")].map((one) => [one.name, one]));
  const said = place.querySelector(".said");
  const charts = place.querySelector(".charts");
  const ALL = ""; // the value of "all surfaces" and "all views"
  const steps = ["device", "precision", "setting", "surface", "view"]; // each choice is among the rows of those before it
  let zoom = 1;

  // Numbers as people read them.
  const number = (value) => {
    if (value === null || value === undefined || !Number.isFinite(value)) return "–";
    const digits = value === 0 ? 0 : Math.max(0, 2 - Math.floor(Math.log10(Math.abs(value)) + 1e-9));
    return value.toLocaleString("en-US", { minimumFractionDigits: Math.min(digits, 12), maximumFractionDigits: Math.min(digits, 12) });
  };
  const whole = (value) => (value === null ? "–" : value.toLocaleString("en-US"));
  const error = (value) => (value === null || value === undefined ? "–" : value === 0 ? "0" : value.toExponential(1).replace("e+", "e").replaceAll("-", "−"));

  // What the axes show.
  const speeds = {
    ms: { of: (row) => row.ms, low: (row) => row.low, high: (row) => row.high, less: true },
    rate: { of: (row) => row.rate, low: (row) => row.rate * row.ms / row.high, high: (row) => row.rate * row.ms / row.low },
    frames: { of: (row) => 1e3 / row.ms, low: (row) => 1e3 / row.high, high: (row) => 1e3 / row.low },
    evaluations: { of: (row) => row.evaluations, low: (row) => row.evaluations, high: (row) => row.evaluations, less: true },
  };
  const units = {
    scene: (row, which) => row[which],
    radius: (row, which) => (row[which] === null || !row.radius ? null : row[which] / row.radius),
    pixels: (row, which) => row[`pixels_${which}`],
  };
  const titleOf = (name) => selects[name].selectedOptions[0].textContent;

  // The choice of rows.
  function most(list, name) {
    const counts = new Map();
    for (const row of list) counts.set(row[name], (counts.get(row[name]) ?? 0) + 1);
    return [...counts].reduce((best, one) => (one[1] > best[1] ? one : best))[0];
  }
  function chosenRows() {
    let list = rows;
    for (const name of steps) {
      const select = selects[name];
      const values = [...new Set(list.map((row) => row[name]))];
      const listed = name === "surface" || name === "view" ? [ALL, ...values] : values;
      const before = select.dataset.chosen;
      const scenes = new Set(list.map((row) => row.scene)).size;
      let now = listed.includes(before) ? before : values.length === 1 ? values[0] : listed[0];
      if (before === undefined && listed[0] !== ALL) now = most(list, name);
      if (before === undefined && name === "view" && scenes > 24) now = most(list, name);
      if (values.length === 1) [now] = values;
      select.replaceChildren(...(values.length === 1 ? values : listed).map((value) =>
        new Option(value === ALL ? `all ${values.length}` : value, value, false, value === now)));
      select.closest("label").hidden = values.length === 1;
      if (now !== ALL) list = list.filter((row) => row[name] === now);
    }
    return list;
  }

  // An end of an interval; where there is none the mark has no bar.
  const end = (value, middle) => (Number.isFinite(value) && value > 0 ? value : middle);

  // One panel's data. `zero` is where an error of 0 stands.
  function dataOf(list, speed, zero) {
    const points = list.map((row) => {
      const { color, shape } = methods[row.method] ?? { color: "#555", shape: "circle" };
      const right = row.wrong === 0;
      return { x: row.x || zero, y: row.y, low: end(speed.low(row), row.y), high: end(speed.high(row), row.y), method: row.method,
        color, shape, fill: right ? color : "white", row: String(row.row) };
    });
    const beats = (a, b) => (speed.less ? a < b : a > b);
    const front = [];
    const right = list.filter((row) => row.wrong === 0);
    right.sort((a, b) => a.x - b.x || (speed.less ? a.y - b.y : b.y - a.y));
    for (const row of right) if (!front.length || beats(row.y, front.at(-1).y)) front.push(row);
    return { points, front: front.map((row) => ({ x: row.x || zero, y: row.y, label: row.label })) };
  }
  function around(values, margin) {
    const [low, high] = [Math.min(...values), Math.max(...values)];
    const more = Math.max((high / low) ** margin, 1.25);
    return [low / more, high * more];
  }
  function zoomed([low, high]) {
    const [middle, half] = [Math.sqrt(low * high), Math.sqrt(high / low) ** zoom];
    return [middle / half, middle * half];
  }

  function describe(index) {
    const row = rows[index];
    const interval = row.low === null ? "too few samples for an interval" : `${number(row.low)} to ${number(row.high)}`;
    const told = [["time", `${number(row.ms)} ms (${interval})`],
      ["rate", `${number(row.rate)} Mrays/s, ${number(1e3 / row.ms)} frames/s`],
      ["evaluations", `${number(row.evaluations)} a ray`],
      ["largest error", `${error(row.max)} scene units, ${error(units.pixels(row, "max"))} pixels`],
      ["99.9th percentile", `${error(row.p999)}, 99th ${error(row.p99)}`],
      ["over the radius", error(units.radius(row, "max"))],
      ["wrong rays", `${whole(row.wrong)} of ${whole(row.rays)}${row.kinds ? ` (${row.kinds})` : ""}`]];
    if (row.grazing) told.push(["grazing, wrong", row.grazing]);
    if (row.drowned) told.push(["drowned, wrong", row.drowned]);
    told.push(["device", `${row.device}, ${row.precision}${row.bound ? `; ${row.bound}` : ""}`]);
    return listed(told, `${row.label}: ${row.scene}`, row.variant);
  }

  // Drawing.
  let shown = [];
  function redraw() {
    const speed = speeds[selects.speed.value];
    shown = chosenRows().map((row) =>
      ({ ...row, x: units[selects.unit.value](row, selects.error.value), y: speed.of(row) }));
    const all = shown.length;
    shown = shown.filter((row) => row.x !== null && row.x >= 0 && Number.isFinite(row.y) && row.y > 0);
    const positive = shown.map((row) => row.x).filter((x) => x > 0);
    const zeros = shown.length > positive.length;
    const lowest = positive.length ? 10 ** Math.floor(Math.log10(Math.min(...positive))) : 1e-8;
    const zero = lowest / 10 ** (positive.length ? 1.5 : 0);
    const across = zeros ? [zero, ...positive] : positive;
    said.textContent = [
      shown.length ? "" : "No row has both figures.",
      shown.length && shown.length < all ? `${all - shown.length} of ${all} rows lack one of the figures.` : "",
      zeros ? "At 0: every error is within the oracle's certified interval of the root." : "",
    ].filter(Boolean).join(" ");
    for (const element of charts.querySelectorAll(".chart")) {
      drawnViews.get(element)?.finalize();
      drawnViews.delete(element);
    }
    const scenes = Map.groupBy ? [...Map.groupBy(shown, (row) => row.scene)] : grouped(shown);
    charts.replaceChildren(...scenes.map(([scene, list]) => panel(scene, list, speed, zeros ? zero : -1, around(across, 0.06))));
    fillTable();
  }
  function grouped(list) {
    const found = new Map();
    for (const row of list) found.set(row.scene, [...(found.get(row.scene) ?? []), row]);
    return [...found];
  }
  function panel(scene, list, speed, zero, across) {
    const figure = document.createElement("figure");
    figure.className = "panel-chart";
    const heading = document.createElement("h3");
    heading.textContent = scene;
    const element = document.createElement("div");
    element.className = "chart";
    element.setAttribute("role", "img");
    element.setAttribute("aria-label", `Speed against error on ${scene}; the table below has the numbers.`);
    figure.append(heading, element);
    const spec = structuredClone(base);
    const up = around(list.flatMap((row) => [row.y]), 0.12);
    const { points, front } = dataOf(list, speed, zero);
    placeLabels(front, across, up);
    if (front.length) {
      front.unshift({ x: front[0].x, y: speed.less ? up[1] * 1e3 : up[0] / 1e3, label: "" });
      front.push({ x: across[1] * 1e3, y: front.at(-1).y, label: "" });
    }
    if (matchMedia("(pointer: coarse)").matches) spec.layer.forEach((layer) => { delete layer.params; }); // fingers scroll
    spec.datasets = { points, front };
    spec.params.find((one) => one.name === "zero").value = zero;
    const error = `${titleOf("error")} error |t − t*|, ${titleOf("unit")}`;
    spec.encoding.x.axis.title = error;
    spec.encoding.y.axis.title = titleOf("speed");
    spec.encoding.x.scale.domain = zoomed(across);
    spec.encoding.y.scale.domain = zoomed(up);
    figure.drawNow = () => draw(element, spec, describe);
    nearby.observe(figure);
    return figure;
  }

  // Label what lies on the front, the fastest first; a label that would cover another one is left out.
  function placeLabels(front, across, up) {
    const [wide, high] = [300, 180]; // about a panel's size in pixels
    const at = ([low, most], value) => Math.log(value / low) / Math.log(most / low);
    const taken = [];
    for (const point of front.toReversed()) {
      const left = at(across, point.x) < 0.5;
      const [x, y] = [wide * at(across, point.x), high * (1 - at(up, point.y)) - 9];
      const box = left ? [x, x + 6 * point.label.length] : [x - 6 * point.label.length, x];
      const free = taken.every(([from, to, level]) => Math.abs(level - y) > 13 || box[0] > to || box[1] < from);
      Object.assign(point, left ? { align: "left", dx: 5 } : { align: "right", dx: -5 });
      if (free) taken.push([...box, y]);
      else point.label = "";
    }
  }

  // The same rows as a table.
  const numbers = place.querySelector(".numbers");
  function fillTable() {
    if (!numbers.open) return;
    const heads = [["method"], ["variant"], ["scene"], ["ms", 1], ["Mrays/s", 1], ["evaluations a ray", 1], ["largest error", 1],
      ["99.9 %", 1], ["99 %", 1], ["wrong rays", 1]];
    const figure = document.createElement("figure");
    figure.className = "table";
    figure.innerHTML = '<div class="scroll" tabindex="0" role="region" aria-label="the points\' numbers"><table><thead><tr></tr></thead><tbody></tbody></table></div>';
    for (const [title, right] of heads) {
      const head = document.createElement("th");
      head.scope = "col";
      head.className = right ? "" : "t";
      head.textContent = title;
      figure.querySelector("thead tr").append(head);
    }
    for (const row of shown) {
      const line = figure.querySelector("tbody").insertRow();
      const cells = [row.label, row.variant, row.scene, [row.ms, number], [row.rate, number], [row.evaluations, number],
        [row.max, error], [row.p999, error], [row.p99, error], [row.wrong, whole]];
      cells.forEach((cell, i) => {
        const made = document.createElement(i ? "td" : "th");
        if (!i) made.scope = "row";
        made.textContent = Array.isArray(cell) ? cell[1](cell[0]) : cell;
        if (!Array.isArray(cell)) made.className = "t";
        else if (cell[0] !== null) made.dataset.v = cell[0];
        line.append(made);
      });
    }
    numbers.querySelector("figure")?.remove();
    numbers.append(figure);
    makeSortable(figure);
  }
  numbers.addEventListener("toggle", fillTable);

  for (const [name, select] of Object.entries(selects)) {
    select.addEventListener("change", () => {
      if (steps.includes(name)) select.dataset.chosen = select.value;
      zoom = 1;
      redraw();
    });
  }
  for (const button of place.querySelectorAll("[data-zoom]")) {
    button.addEventListener("click", () => {
      zoom = Number(button.dataset.zoom) ? zoom * Number(button.dataset.zoom) : 1;
      redraw();
    });
  }
  place.hidden = false;
  redraw();
})();
