// One curve: its rows, its line without lost peaks, the row at a place.

class Curve {
  constructor(told, clock, chart) {
    Object.assign(this, told);
    this.clock = clock;
    this.chart = chart;
    this.values = decoded(told.data);
    this.places = clock.values;
    this.isOn = true;
  }

  /** The first row that is not before a place. */
  from(place) {
    let low = 0, high = this.places.length;
    while (low < high) {
      const middle = (low + high) >> 1;
      if (this.places[middle] < place) low = middle + 1; else high = middle;
    }
    return low;
  }

  /** Smallest and largest value between two places. */
  ends(low, high) {
    let [least, most] = [Infinity, -Infinity];
    for (let row = this.from(low); row < this.places.length && this.places[row] <= high; row++) {
      const value = this.values[row];
      if (value < least) least = value;
      if (value > most) most = value;
    }
    return [least, most];
  }

  /** An SVG path from low to high. Of each column of pixels it has first, smallest, largest and last row, so that no peak is lost. */
  path(low, high, x, y) {
    const parts = [];
    let up = true, column = NaN, kept = [];
    const point = row => {
      parts.push(`${up ? "M" : "L"}${x(this.places[row]).toFixed(2)} ${y(this.values[row]).toFixed(2)}`);
      up = false;
    };
    const flush = () => {
      [...new Set(kept)].sort((a, b) => a - b).forEach(point);
      kept = [];
    };
    const last = Math.min(this.places.length - 1, this.from(high));
    for (let row = Math.max(0, this.from(low) - 1); row <= last; row++) {
      if (Number.isNaN(this.values[row])) { flush(); up = true; column = NaN; continue; }
      const here = Math.floor(x(this.places[row]));
      if (here !== column) {
        flush();
        column = here;
        kept = [row, row, row, row]; // first, smallest, largest, last
      } else {
        if (this.values[row] < this.values[kept[1]]) kept[1] = row;
        if (this.values[row] > this.values[kept[2]]) kept[2] = row;
        kept[3] = row;
      }
    }
    flush();
    return parts.join("");
  }

  /** The row for a place: the largest value within `reach` of it, else the nearest row that has one; -1 without any. */
  row(place, reach) {
    let best = -1;
    for (let row = this.from(place - reach); row < this.places.length && this.places[row] <= place + reach; row++) {
      if (!Number.isNaN(this.values[row]) && (best < 0 || this.values[row] > this.values[best])) best = row;
    }
    if (best >= 0) return best;
    const after = this.from(place);
    for (let away = 0; away <= this.places.length; away++) {
      const near = [after - 1 - away, after + away].filter(row => row >= 0 && row < this.places.length && !Number.isNaN(this.values[row]));
      if (near.length) return near.sort((a, b) => Math.abs(this.places[a] - place) - Math.abs(this.places[b] - place))[0];
    }
    return -1;
  }
}
