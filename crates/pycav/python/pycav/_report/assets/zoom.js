// What pointers, the wheel and keys do to a chart.

const SCROLLS = 300; // ms; a wheel that has just moved the page goes on moving it
let scrolled = -Infinity;
window.addEventListener("scroll", () => { scrolled = performance.now(); }, {passive: true});

/** Shows `factor` times as much about a place. */
function zoom(span, place, factor) {
  span.set(place - (place - span.low) * factor, place + (span.high - place) * factor);
}

function watch(chart, goTo) {
  const span = chart.span, svg = chart.svg, fingers = new Map();
  let from = null, apart = null;
  svg.addEventListener("pointerdown", event => {
    fingers.set(event.pointerId, event.clientX);
    apart = fingers.size === 2 ? [...fingers.values()] : null;
    if (event.pointerType === "mouse" && event.button === 0) {
      from = event.clientX;
      svg.setPointerCapture(event.pointerId);
    }
    span.point(chart.placeAt(event.clientX));
  });
  svg.addEventListener("pointermove", event => {
    if (fingers.has(event.pointerId)) fingers.set(event.pointerId, event.clientX);
    if (apart && fingers.size === 2) {
      const now = [...fingers.values()], factor = Math.abs(apart[0] - apart[1]) / Math.max(8, Math.abs(now[0] - now[1]));
      zoom(span, chart.placeAt((now[0] + now[1]) / 2), factor);
      apart = now;
      return;
    }
    if (from !== null && Math.abs(event.clientX - from) > 4) chart.selected = [chart.placeAt(from), chart.placeAt(event.clientX)];
    span.point(chart.placeAt(event.clientX));
  });
  svg.addEventListener("pointerup", event => {
    const ends = chart.selected;
    chart.selected = null;
    fingers.delete(event.pointerId);
    apart = null;
    if (from === null) return;
    from = null;
    if (ends) span.set(Math.min(...ends), Math.max(...ends));
    else goTo(chart.placeAt(event.clientX));
  });
  svg.addEventListener("pointercancel", event => {
    fingers.delete(event.pointerId);
    [from, apart, chart.selected] = [null, null, null];
  });
  svg.addEventListener("pointerleave", () => { if (from === null) span.point(null); });
  svg.addEventListener("dblclick", () => span.set(...span.all));
  svg.addEventListener("wheel", event => {
    // Out of what is whole nothing can be zoomed: there the wheel moves the page.
    if (performance.now() - scrolled < SCROLLS || (event.deltaY > 0 && span.isWhole)) return;
    event.preventDefault();
    zoom(span, chart.placeAt(event.clientX), Math.exp(Math.sign(event.deltaY) * Math.min(0.5, Math.abs(event.deltaY) * (event.ctrlKey ? 0.01 : 0.002))));
  }, {passive: false});
  svg.addEventListener("keydown", event => pressed(event, chart, goTo));
  svg.addEventListener("blur", () => span.point(null));
}

/** Keys: along the rows of the first curve, in and out, all. */
function pressed(event, chart, goTo) {
  const span = chart.span, curve = chart.shown[0];
  if (!curve || event.altKey || event.ctrlKey || event.metaKey) return;
  const here = span.pointed ?? span.moment ?? span.low, row = curve.row(here, 0);
  const first = curve.from(span.low), last = Math.min(curve.places.length, curve.from(span.high * (1 + 1e-12) + 1e-300) + 1) - 1;
  const far = Math.max(2, Math.round((last - first) / 20));
  const steps = {ArrowLeft: row - 1, ArrowRight: row + 1, PageDown: row - far, PageUp: row + far, Home: first, End: last};
  if (event.key in steps) {
    const to = Math.min(last, Math.max(first, steps[event.key]));
    span.point(curve.places[to]);
    tell(`${chart.when.textContent}: ${chart.shown.map(one => `${one.label} ${one.value.textContent}`).join(", ")}`);
  } else if (event.key === "+" || event.key === "=") zoom(span, here, 0.5);
  else if (event.key === "-") zoom(span, here, 2);
  else if (event.key === "Escape") { span.set(...span.all); span.point(null); }
  else if (event.key === "Enter") goTo(here);
  else return;
  event.preventDefault();
}
