// Charts: Vega-Lite draws them once the reader comes near.
function power(exponent) {
  return `10${String(exponent).replace(/./g, (sign) => "⁻⁰¹²³⁴⁵⁶⁷⁸⁹"["-0123456789".indexOf(sign)])}`;
}
// The label of a tick: a plain number where `zero` is 0, else an error, which is 0 at `zero`.
function tick(value, zero) {
  if (zero === 0) return value >= 1e-4 && value < 1e6 ? Number(value.toPrecision(3)).toLocaleString("en-US", { maximumFractionDigits: 6 }) : value.toExponential(0);
  if (zero > 0 && Math.abs(Math.log(value / zero)) < 1e-6) return "0";
  const exponent = Math.floor(Math.log10(value) + 1e-9);
  const digits = Number((value / 10 ** exponent).toPrecision(3));
  return digits === 1 ? power(exponent) : `${digits}×${power(exponent)}`;
}
// The values of a logarithmic axis from low to high that have ticks, 7 at most where it has more than two decades.
function ticks([low, high], zero) {
  const [first, last] = [Math.log10(low), Math.log10(high)];
  const found = [];
  const within = last - first < 0.7 ? [1, 1.2, 1.5, 2, 2.5, 3, 4, 5, 6, 8] : last - first < 2 ? [1, 2, 5] : [1];
  const step = Math.ceil((last - first) / 6);
  for (let power = Math.floor(first); power <= last; power += 1) {
    if (within.length === 1 && power % step) continue;
    for (const digit of within) {
      const value = Number(`${digit}e${power}`);
      if (value >= low && value <= high && (zero <= 0 || value > 2 * zero)) found.push(value);
    }
  }
  return zero >= low && zero <= high && zero > 0 ? [zero, ...found] : found;
}

const drawnViews = new Map(); // element → its Vega view
const options = { actions: false, renderer: "svg", expressionFunctions: { tick, ticks } };
async function draw(element, spec, describe) {
  const tooltip = (handler, event, item, value) => {
    if (value !== null && value !== undefined && value !== "") tell(describe(value), event.clientX, event.clientY);
    else left(event);
  };
  drawnViews.get(element)?.finalize();
  const { view } = await vegaEmbed(element, spec, { ...options, tooltip });
  drawnViews.set(element, view);
  view.addEventListener("pointerdown", (event, item) => { // a finger taps, and does not hover
    if (item?.tooltip) tell(describe(item.tooltip), event.clientX, event.clientY);
  });
  choose(view, [...kept]);
  return view;
}
function choose(view, methods) {
  if ("kept" in view.getState().signals) view.signal("kept", methods).runAsync();
}
onKept.push((methods) => drawnViews.forEach((view) => choose(view, methods)));

// Turn what a chart tells of a mark, an object of names and values, into a list.
function listed(pairs, title, code) {
  const told = document.createElement("div");
  const add = (tag, text, to) => {
    const made = document.createElement(tag);
    made.textContent = text;
    to.append(made);
    return made;
  };
  if (title) add("b", title, told);
  if (code) add("code", code, told);
  const list = add("dl", "", told);
  for (const [name, value] of pairs) {
    add("dt", name, list);
    add("dd", value, list);
  }
  return told;
}

const nearby = new IntersectionObserver((entries) => {
  for (const { target, isIntersecting } of entries) {
    if (!isIntersecting) continue;
    nearby.unobserve(target);
    target.drawNow();
  }
}, { rootMargin: "400px" });
