// Images of a field, one for each snapshot: decoded when they are shown, read where one points.

const KEPT = 24; // decoded images of a field, at most

class Field {
  constructor(told) {
    Object.assign(this, told);
    this.decoded = new Map();
    this.palette = told.colours.match(/.{6}/g);
    this.steps = new Map(this.palette.map((colour, step) => [colour, step]));
  }

  /** The image of a snapshot, decoded. */
  image(step) {
    let found = this.decoded.get(step);
    if (!found) {
      const image = new Image();
      image.src = "data:image/png;base64," + this.images[step].data;
      found = image.decode().then(() => image);
    } else {
      this.decoded.delete(step);
    }
    this.decoded.set(step, found);
    if (this.decoded.size > KEPT) this.decoded.delete(this.decoded.keys().next().value);
    return found;
  }

  /** Draws a snapshot and, if it is mirrored, its mirror image; `x`, `y` bring m to pixels of the canvas. */
  async draw(canvas, step, x, y, mirrored, isWanted) {
    const image = await this.image(step);
    if (!isWanted()) return;
    const [low, high, near, far] = this.images[step].box;
    const pen = canvas.getContext("2d");
    const [left, right, top, bottom] = [x(near), x(far), y(high), y(low)].map(Math.round);
    pen.setTransform(1, 0, 0, 1, 0, 0);
    pen.clearRect(0, 0, canvas.width, canvas.height);
    // Pixels of an image are cells or several of them: as they are where they are enlarged.
    pen.imageSmoothingEnabled = right - left < image.naturalWidth;
    pen.drawImage(image, left, top, right - left, bottom - top);
    if (mirrored) {
      pen.setTransform(-1, 0, 0, 1, 2 * Math.round(x(0)), 0);
      pen.drawImage(image, left, top, right - left, bottom - top);
    }
    canvas.dataset.shown = `${this.name} ${step}`;
  }

  /** The value at a place in m: that of the step of the palette whose colour the image has there; NaN where it cannot be read. */
  async at(step, z, r) {
    const image = await this.image(step), [low, high, near, far] = this.images[step].box;
    const column = Math.floor((r - near) / (far - near) * image.naturalWidth), row = Math.floor((high - z) / (high - low) * image.naturalHeight);
    if (column < 0 || row < 0 || column >= image.naturalWidth || row >= image.naturalHeight) return NaN;
    const pixel = element("canvas", {width: 1, height: 1}).getContext("2d", {willReadFrequently: true});
    pixel.drawImage(image, -column, -row);
    const colour = [...pixel.getImageData(0, 0, 1, 1).data.slice(0, 3)].map(part => part.toString(16).padStart(2, "0")).join("");
    return this.steps.has(colour) ? this.values[this.steps.get(colour)] : NaN;
  }

  /** The colours as a bar with ticks. */
  bar() {
    const shown = Array.from({length: 33}, (_, k) => `#${this.palette[Math.round(k * (this.palette.length - 1) / 32)]}`);
    const colours = element("div", {class: "colours", "data-dark": this.dark});
    colours.style.background = `linear-gradient(to right, ${shown.join(", ")})`;
    const ticks = element("div", {class: "ticks"});
    for (const [place, text] of this.marks) {
      const tick = element("span", {}, text);
      tick.style.left = `${100 * place}%`;
      ticks.append(tick);
    }
    return element("div", {class: "bar", role: "img", "aria-label": `colours of ${this.title}: ${this.marks.map(mark => mark[1]).join(", ")}`},
      colours, ticks);
  }

  get title() {
    return this.unit ? `${this.label} / ${this.unit}` : this.label;
  }
}
