// A chart: curves of one unit over time or radius. All charts over time have one span and one pointer.

/** What is shown of the axis that charts share: from, to, and where one points. */
class Span {
  constructor(low, high) {
    Object.assign(this, {all: [low, high], low, high, pointed: null, moment: null, charts: []});
  }

  /** Shows from low to high, within all there is. */
  set(low, high) {
    const [first, last] = this.all, width = Math.min(last - first, Math.max(high - low, 1e-4 * (last - first)));
    this.low = Math.min(Math.max(first, low), last - width);
    this.high = this.low + width;
    this.redraw();
  }

  get isWhole() {
    return this.high - this.low >= (1 - 1e-9) * (this.all[1] - this.all[0]);
  }

  point(place) {
    this.pointed = place;
    for (const chart of this.charts) chart.drawPointer();
  }

  redraw() {
    cancelAnimationFrame(this.frame);
    this.frame = requestAnimationFrame(() => { for (const chart of this.charts) chart.draw(); });
  }
}

const FRAME = {left: 52, right: 12, top: 8, bottom: 34, height: 210};

class Chart {
  constructor(told, clocks, spans) {
    Object.assign(this, told);
    this.curves = told.curves.map(curve => new Curve(curve, clocks[curve.clock], this));
    const clock = this.curves[0].clock;
    this.clock = clock;
    this.span = spans[clock.symbol] ??= new Span(Infinity, -Infinity);
    for (const curve of this.curves) {
      this.span.all = [Math.min(this.span.all[0], curve.places[0]), Math.max(this.span.all[1], curve.places[curve.places.length - 1])];
    }
    [this.span.low, this.span.high] = this.span.all;
    this.span.charts.push(this);
    this.when = element("span", {class: "when"});
    this.reset = element("button", {type: "button", class: "reset", hidden: true}, "show all");
    this.reset.addEventListener("click", () => this.span.set(...this.span.all));
    this.svg = element("svg:svg", {tabindex: 0, role: "application", "aria-roledescription": "chart",
      "aria-label": `${this.title} in ${this.unit}. Arrows move along the curve, plus and minus zoom, Escape shows all.`});
    this.figure = element("figure", {class: "chart"},
      element("figcaption", {}, element("h3", {}, this.title), this.when, this.reset),
      element("div", {class: "legend"}, ...this.curves.map((curve, k) => this.key(curve, k))), this.svg);
    new ResizeObserver(() => this.draw()).observe(this.figure);
  }

  /** A curve's entry in the legend: it turns the curve on and off and shows its value. */
  key(curve, k) {
    curve.kind = `curve c${k % 6}`;
    curve.value = element("b", {class: "value"});
    const button = element("button", {type: "button", "aria-pressed": "true"}, element("i", {class: `swatch c${k % 6}`}), `${curve.label} `, curve.value);
    button.addEventListener("click", () => {
      curve.isOn = !curve.isOn;
      button.setAttribute("aria-pressed", String(curve.isOn));
      this.draw();
    });
    return button;
  }

  get shown() {
    return this.curves.filter(curve => curve.isOn);
  }

  /** From and to of the values that are shown: with 0 where they are not all far from it. */
  heights() {
    const ends = this.shown.map(curve => curve.ends(this.span.low, this.span.high));
    let low = Math.min(...ends.map(end => end[0])), high = Math.max(...ends.map(end => end[1]));
    if (!(high >= low)) return [0, 1];
    for (const [level] of this.levels) if (level > high && level < 1.6 * high) high = level;
    if (low > 0 && low < 0.8 * high) low = 0;
    if (high < 0 && high > 0.8 * low) high = 0;
    const room = 0.07 * (high - low || Math.abs(high) || 1);
    return [low === 0 ? 0 : low - room, high === 0 ? 0 : high + room];
  }

  draw() {
    const width = this.figure.clientWidth - 2;
    if (width < 150) return; // not laid out yet
    const {left, right, top, bottom, height} = FRAME, span = this.span, [low, high] = this.heights();
    this.width = width;
    this.x = place => left + (place - span.low) / (span.high - span.low) * (width - left - right);
    this.y = value => top + (high - value) / (high - low) * (height - top - bottom);
    this.svg.setAttribute("viewBox", `0 0 ${width} ${height}`);
    const parts = [], clip = `clip-${this.number}`, floor = height - bottom;
    const text = (attributes, words) => parts.push(element("svg:text", attributes, words));
    const line = (x1, y1, x2, y2, kind) => parts.push(element("svg:line", {x1, y1, x2, y2, class: kind}));
    parts.push(element("svg:clipPath", {id: clip}, element("svg:rect", {x: left, y: top - 2, width: width - left - right, height: floor - top + 4})));
    const up = rounds(low * this.factor, high * this.factor, 4), across = rounds(span.low * this.clock.factor, span.high * this.clock.factor, (width - left) / 80);
    labels(up).forEach((label, k) => {
      const y = this.y(up[k] / this.factor);
      line(left, y, width - right, y, up[k] === 0 ? "zero" : "grid");
      text({x: left - 6, y: y + 4, "text-anchor": "end"}, label);
    });
    labels(across).forEach((label, k) => {
      const x = this.x(across[k] / this.clock.factor);
      line(x, floor, x, floor + 4, "tick");
      text({x, y: floor + 16, "text-anchor": "middle"}, label);
    });
    line(left, floor, width - right, floor, "tick");
    text({x: (left + width - right) / 2, y: height - 3, "text-anchor": "middle"}, `${this.clock.symbol} / ${this.clock.shown}`);
    text({x: 11, y: (top + floor) / 2, "text-anchor": "middle", transform: `rotate(-90 11 ${(top + floor) / 2})`}, this.unit);
    for (const [level, label] of this.levels) {
      const y = this.y(level);
      if (y < top || y > floor) continue;
      line(left, y, width - right, y, "level");
      text({x: width - right - 4, y: y - 4, "text-anchor": "end", class: "level"}, `${label} ${number(level * this.factor)} ${this.unit}`);
    }
    const lines = element("svg:g", {"clip-path": `url(#${clip})`});
    for (const curve of this.shown) lines.append(element("svg:path", {class: curve.kind, d: curve.path(span.low, span.high, this.x, this.y)}));
    this.marks = element("svg:g", {class: "marks"});
    parts.push(lines, this.marks);
    this.svg.replaceChildren(...parts);
    this.reset.hidden = span.isWhole;
    this.drawPointer();
  }

  /** The line of the snapshot, that of the pointer, and the recorded values there. */
  drawPointer() {
    if (!this.x) return;
    const {left, right, top, bottom, height} = FRAME, span = this.span, parts = [], place = span.pointed ?? span.moment;
    const upright = (where, kind) => {
      const x = this.x(where);
      if (x >= left - 1 && x <= this.width - right + 1) parts.push(element("svg:line", {x1: x, y1: top, x2: x, y2: height - bottom, class: kind}));
    };
    if (span.moment !== null) upright(span.moment, "moment");
    // Where one points, the largest value in that column of pixels, so that what is drawn can be read.
    const reach = span.pointed === null ? 0 : 0.5 * (span.high - span.low) / (this.width - left - right);
    let told = null;
    for (const curve of this.curves) {
      const row = place === null || !curve.isOn ? -1 : curve.row(place, reach);
      const isRead = row >= 0;
      curve.value.textContent = isRead ? `${number(curve.values[row] * this.factor)} ${this.unit}` : "";
      curve.value.dataset.value = isRead ? String(curve.values[row]) : "";
      curve.value.dataset.place = isRead ? String(curve.places[row]) : "";
      if (!isRead) continue;
      told ??= curve.places[row];
      if (span.pointed === null || curve.places[row] < span.low || curve.places[row] > span.high) continue;
      parts.push(element("svg:circle", {cx: this.x(curve.places[row]), cy: this.y(curve.values[row]), r: 3.5, class: curve.kind.replace("curve", "dot")}));
    }
    if (span.pointed !== null) upright(told ?? span.pointed, "pointer");
    this.when.textContent = told === null ? "" : `${this.clock.symbol} = ${number(told * this.clock.factor)} ${this.clock.shown}`;
    if (this.selected) {
      const ends = this.selected.map(this.x).sort((a, b) => a - b);
      parts.push(element("svg:rect", {x: ends[0], y: top, width: ends[1] - ends[0], height: height - bottom - top, class: "selected"}));
    }
    this.marks.replaceChildren(...parts);
  }

  /** The place under a pointer. */
  placeAt(clientX) {
    const box = this.svg.getBoundingClientRect(), {left, right} = FRAME, span = this.span;
    const share = ((clientX - box.left) * this.width / box.width - left) / (this.width - left - right);
    return span.low + Math.min(1, Math.max(0, share)) * (span.high - span.low);
  }
}
