// Pictures over time: fields above and below the wall, the slider, the choice of what is shown.

const MARGIN = {left: 44, right: 10, top: 10, bottom: 38};

class Viewer {
  constructor(told, place) {
    Object.assign(this, told);
    this.place = place;
    this.listeners = [];
    this.step = told.first;
    [this.timeFactor, this.timeLetter] = prefix(this.times[this.times.length - 1]);
    this.stage = element("div", {class: "stage"});
    this.overlay = element("svg:svg", {class: "overlay", role: "img"});
    for (const medium of this.media) {
      medium.fields = medium.fields.map(field => new Field(field));
      medium.canvas = element("canvas", {"aria-hidden": "true"});
      this.stage.append(medium.canvas);
      this.choose(medium, medium.fields[0]);
    }
    this.stage.append(this.overlay);
    this.readout = element("p", {class: "readout quiet"}, "\u00a0");
    const [upper, ...lower] = this.media.map(medium => this.controls(medium));
    place.append(upper, this.stage, ...lower, this.readout, this.clock(), this.moments_());
    this.watch();
    new ResizeObserver(() => this.layOut()).observe(place);
    this.layOut();
    this.go(this.step);
  }

  /** The choice among the fields of a medium, beside its colours. */
  controls(medium) {
    const choices = medium.fields.map((field, k) => {
      const input = element("input", {type: "radio", name: `field-${medium.name}`, value: field.name, checked: k === 0});
      input.addEventListener("change", () => { this.choose(medium, field); this.draw(); });
      return element("label", {}, input, element("span", {}, ...rich(field.label)));
    });
    medium.scale = element("div", {class: "scale"});
    this.choose(medium, medium.fields[0]);
    return element("div", {class: "controls"}, element("fieldset", {}, element("legend", {}, medium.name), ...choices), medium.scale);
  }

  choose(medium, field) {
    medium.field = field;
    medium.canvas.dataset.dark = field.dark;
    medium.scale?.replaceChildren(element("span", {class: "unit"}, ...rich(field.title)), field.bar());
  }

  /** Play, slider, time. */
  clock() {
    const last = this.times.length - 1;
    this.button = element("button", {type: "button", class: "play", "aria-label": "play"});
    this.slider = element("input", {type: "range", min: 0, max: last, step: 1, value: this.step, "aria-label": "time of the snapshot", disabled: last < 1});
    this.output = element("output", {class: "time"});
    this.button.addEventListener("click", () => this.playing ? this.pause() : this.play());
    this.slider.addEventListener("input", () => { this.pause(); this.go(Number(this.slider.value)); });
    return element("div", {class: "clock"}, this.button, this.slider, this.output);
  }

  moments_() {
    const buttons = this.moments.map(moment => {
      const button = element("button", {type: "button"}, `${moment.label}, ${this.time(moment.time)}`);
      button.addEventListener("click", () => { this.pause(); this.goTo(moment.time); });
      return button;
    });
    return element("div", {class: "moments", role: "group", "aria-label": "go to the snapshot nearest to"}, ...buttons);
  }

  time(value) {
    return `${number(value * this.timeFactor)} ${this.timeLetter}s`;
  }

  play() {
    if (this.step === this.times.length - 1) this.go(0);
    const pause = Math.min(600, Math.max(80, 5000 / this.times.length));
    this.playing = setInterval(() => this.step < this.times.length - 1 ? this.go(this.step + 1) : this.pause(), pause);
    this.button.setAttribute("aria-label", "pause");
    this.button.classList.add("on");
  }

  pause() {
    clearInterval(this.playing);
    this.playing = undefined;
    this.button.setAttribute("aria-label", "play");
    this.button.classList.remove("on");
  }

  /** Shows the snapshot nearest to a time. */
  goTo(time) {
    const away = this.times.map(other => Math.abs(other - time));
    this.go(away.indexOf(Math.min(...away)));
  }

  go(step) {
    this.step = Math.min(this.times.length - 1, Math.max(0, step));
    const shown = this.time(this.times[this.step]), which = `${this.step + 1} of ${this.times.length}`;
    this.slider.value = this.step;
    this.slider.setAttribute("aria-valuetext", `${shown}, snapshot ${which}`);
    this.output.replaceChildren(element("b", {}, `t = ${shown}`), ` ${which}`);
    this.draw();
    for (const listener of this.listeners) listener(this.times[this.step]);
  }

  /** Sizes of everything for the width there is. */
  layOut() {
    const [low, high, left, right] = this.extent, width = this.place.clientWidth;
    if (width < 150) return; // not laid out yet
    let across = width - MARGIN.left - MARGIN.right, up = across * (high - low) / (right - left);
    const tallest = Math.max(300, Math.min(680, 0.82 * window.innerHeight));
    this.isStretched = (high - low) > 6 * (right - left) || (right - left) > 12 * (high - low);
    if (this.isStretched) {
      across = Math.min(across, 420);
      up = Math.min(tallest, 420);
    } else if (up > tallest) {
      [across, up] = [tallest * (right - left) / (high - low), tallest];
    }
    this.size = [across + MARGIN.left + MARGIN.right, up + MARGIN.top + MARGIN.bottom];
    this.x = r => MARGIN.left + (r - left) / (right - left) * across;
    this.y = z => MARGIN.top + (high - z) / (high - low) * up;
    this.stage.style.width = `${this.size[0]}px`;
    this.stage.style.aspectRatio = `${this.size[0]} / ${this.size[1]}`;
    const sharp = Math.min(3, Math.max(1, window.devicePixelRatio || 1));
    for (const medium of this.media) {
      const [bottom, top, near, far] = medium.box, ends = this.mirrored ? [-far, far] : [near, far];
      const box = [this.x(ends[0]), this.y(top), this.x(ends[1]) - this.x(ends[0]), this.y(bottom) - this.y(top)];
      medium.canvas.width = Math.round(box[2] * sharp);
      medium.canvas.height = Math.round(box[3] * sharp);
      medium.toX = r => (this.x(r) - box[0]) * medium.canvas.width / box[2];
      medium.toY = z => (this.y(z) - box[1]) * medium.canvas.height / box[3];
      for (const [k, side] of ["left", "top", "width", "height"].entries()) {
        medium.canvas.style[side] = `${100 * box[k] / this.size[k % 2]}%`;
      }
    }
    this.drawFrame();
    this.draw();
  }

  /** Axes, names, the wall, the axis of symmetry. */
  drawFrame() {
    const [low, high, left, right] = this.extent, [width, height] = this.size, {factor, unit} = this.length;
    const [x, y] = [this.x, this.y], parts = [];
    const text = (where, words, more = {}) => parts.push(element("svg:text", {...where, ...more}, words));
    const line = (x1, y1, x2, y2, kind) => parts.push(element("svg:line", {x1, y1, x2, y2, class: kind}));
    this.overlay.setAttribute("viewBox", `0 0 ${width} ${height}`);
    parts.push(element("svg:rect", {x: x(left), y: y(high), width: x(right) - x(left), height: y(low) - y(high), class: "frame"}));
    // A tube is much longer than wide: then its width has a unit of its own.
    const wide = this.isStretched ? prefix(Math.max(Math.abs(left), Math.abs(right))) : [factor, unit.slice(0, -1)];
    const across = rounds(left * wide[0], right * wide[0], Math.max(5, (x(right) - x(left)) / 70)), up = rounds(low * factor, high * factor, (y(low) - y(high)) / 50);
    // Both halves are the same: |r|.
    labels(across).forEach((label, k) => text({x: x(across[k] / wide[0]), y: y(low) + 15, "text-anchor": "middle"}, this.mirrored ? label.replace("−", "") : label));
    labels(up).forEach((label, k) => text({x: x(left) - 6, y: y(up[k] / factor) + 4, "text-anchor": "end"}, label));
    for (const r of across) line(x(r / wide[0]), y(low), x(r / wide[0]), y(low) + 4, "tick");
    for (const z of up) line(x(left) - 4, y(z / factor), x(left), y(z / factor), "tick");
    text({x: (x(left) + x(right)) / 2, y: height - 5, "text-anchor": "middle"}, `r / ${wide[1]}m${this.isStretched ? ", stretched" : ""}`);
    text({x: 11, y: (y(low) + y(high)) / 2, "text-anchor": "middle", transform: `rotate(-90 11 ${(y(low) + y(high)) / 2})`}, `z / ${unit}`);
    if (this.mirrored) line(x(0), y(high), x(0), y(low), "symmetry");
    const step = Math.max(high - low, right - left) / 4000;
    for (const medium of this.media) {
      for (const kind of medium.lines) {
        // Lines are in steps from the axis and the top; where the picture is stretched, so are they.
        const scales = [x(step) - x(0), y(0) - y(step)];
        kind.path = element("svg:path", {class: `outline ${kind.kind}`, transform: `translate(${x(0)} ${y(high)}) scale(${scales[0]} ${scales[1]})`});
        parts.push(element("svg:g", {"clip-path": "url(#frame)"}, kind.path));
      }
      const above = medium === this.media[0];
      text({x: x(left) + 8, y: above ? y(high) + 19 : y(low) - 9}, medium.name, {class: "medium"});
    }
    if (this.wall !== null) line(x(left), y(this.wall), x(right), y(this.wall), "wall");
    parts.push(element("svg:clipPath", {id: "frame"}, element("svg:rect", {x: x(left), y: y(high), width: x(right) - x(left), height: y(low) - y(high)})));
    this.overlay.replaceChildren(...parts);
  }

  draw() {
    if (!this.size) return;
    const step = this.step;
    for (const medium of this.media) {
      const field = medium.field;
      field.draw(medium.canvas, step, medium.toX, medium.toY, this.mirrored, () => step === this.step && field === medium.field);
      if (this.playing && step + 1 < this.times.length) field.image(step + 1);
      for (const kind of medium.lines) kind.path?.setAttribute("d", kind.paths[step]);
    }
    const what = this.media.map(medium => `${medium.name}: ${medium.field.label}`).join("; ");
    const drawn = this.media.flatMap(medium => medium.lines.filter(kind => kind.paths[step]).map(kind => kind.label));
    this.overlay.setAttribute("aria-label", `${what}; at ${this.time(this.times[step])}${drawn.length ? `; lines: ${drawn.join(", ")}` : ""}`);
    this.rest = drawn.length ? `Lines: ${drawn.join("; ")}. Point to read values.` : "Point to read values.";
    if (!this.pointed) this.readout.textContent = this.rest;
  }

  /** Values under the pointer; a finger that wipes across goes from snapshot to snapshot. */
  watch() {
    const read = async event => {
      const box = this.stage.getBoundingClientRect(), [low, high, left, right] = this.extent;
      const px = (event.clientX - box.left) * this.size[0] / box.width, py = (event.clientY - box.top) * this.size[1] / box.height;
      const r = left + (px - this.x(left)) / (this.x(right) - this.x(left)) * (right - left);
      const z = high - (py - this.y(high)) / (this.y(low) - this.y(high)) * (high - low);
      const medium = this.media.find(one => z >= one.box[0] && z <= one.box[1] && (this.mirrored ? Math.abs(r) : r) <= one.box[3] && r <= right && r >= left);
      this.pointed = Boolean(medium);
      if (!medium) { this.readout.textContent = this.rest; return; }
      const field = medium.field, value = await field.at(this.step, z, this.mirrored ? Math.abs(r) : r), {factor, unit} = this.length;
      const place = `r = ${number((this.mirrored ? Math.abs(r) : r) * factor, 3)} ${unit}, z = ${number(z * factor, 3)} ${unit}`;
      if (this.pointed) this.readout.textContent = `${place}: ${field.label} ${Number.isNaN(value) ? "" : "≈ " + number(value, 3) + " " + field.unit}`;
    };
    this.stage.addEventListener("pointermove", read);
    this.stage.addEventListener("pointerleave", () => { this.pointed = false; this.readout.textContent = this.rest; });
    let from = null;
    this.stage.addEventListener("pointerdown", event => {
      from = event.pointerType === "mouse" ? null : event.clientX;
      read(event);
    });
    this.stage.addEventListener("pointermove", event => {
      if (from === null || Math.abs(event.clientX - from) < 36) return;
      this.pause();
      this.go(this.step + (event.clientX > from ? 1 : -1));
      from = event.clientX;
    });
    for (const end of ["pointerup", "pointercancel"]) this.stage.addEventListener(end, () => { from = null; });
  }
}
