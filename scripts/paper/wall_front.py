"""The front of the water hammer on the wall, and the Rayleigh wave that it makes.

A load that runs along a solid's surface as fast as its Rayleigh waves is in resonance with them (Cole & Huth 1958).
"""

import numpy as np
from matplotlib.figure import Figure
from pycav.plot.style import BLUE, GREY, ORANGE, styled

from .study import MEGA, MICRO, MILLI


class Front:
    """Where the pressure on the wall falls most steeply, from shortly after its peak on the axis, by the history.

    `place` is where the pressure is half way between the largest value within 0.15 R behind the steepest fall and the
    least within 0.06 R ahead of it, `width` the distance of the places at nine tenths and one tenth, `speed` the slope
    of a parabola through the places within 0.45 µs (times scale with R / 10 mm). `peak` is the history of the largest
    von Mises stress.
    """

    def __init__(self, study):
        data = study.result.histories
        time, r, pressure = (data[f"interface/{name}"].to_numpy() for name in ("time", "r", "pressure"))
        self.start = float(data["time"][data["wall/pressure_axis"].to_numpy().argmax()]) + 0.3 / MICRO * study.slowness
        self.peak = [data[f"solid/{name}"].to_numpy() for name in ("time", "von_mises_max", "von_mises_max_position")]
        rows = []
        cell, margin = r[1] - r[0], int(round(0.15 * study.radius / (r[1] - r[0])))
        for now, p in zip(time, pressure):
            if now < self.start:
                continue
            steepest = int(np.argmin(np.diff(p)))
            if r[steepest] > 0.7 * r[-1]:
                break
            first = max(0, steepest - margin)
            crest = first + int(np.argmax(p[first : steepest + 1]))
            foot = p[steepest + 1 : steepest + 1 + max(1, int(0.4 * margin))].min()
            fall = p[crest : steepest + 1 + margin]

            def reached(share):
                level = foot + share * (p[crest] - foot)
                k = int(np.flatnonzero((fall[:-1] >= level) & (fall[1:] < level))[0])
                return r[crest + k] + (fall[k] - level) / (fall[k] - fall[k + 1]) * cell

            rows.append((now, reached(0.5), reached(0.1) - reached(0.9), p[crest] - foot))
        self.time, self.place, self.width, self.jump = np.array(rows).T
        near = 0.45 / MICRO * study.slowness
        self.speed = np.array([np.polyfit(self.time[s] - t, self.place[s], 2)[1]
                               for t in self.time for s in [np.abs(self.time - t) < near]])

    def passes(self, speed):
        """When and where the front, which slows down, passes a speed; None if it does not."""
        below = np.flatnonzero((self.speed[:-1] > speed) & (self.speed[1:] <= speed))
        if len(below) == 0:
            return None
        share = (self.speed[below[0]] - speed) / (self.speed[below[0]] - self.speed[below[0] + 1])
        return [x[below[0]] + share * (x[below[0] + 1] - x[below[0]]) for x in (self.time, self.place)]

    def peak_speed(self, start, end):
        """How fast the place of the largest von Mises stress runs outwards between two times."""
        time, _, place = self.peak
        s = (time > start) & (time < end)
        return np.polyfit(time[s] - start, place[s, 1], 1)[0]


@styled
def wall_front(study):
    """Places and speeds of the front and of the largest von Mises stress."""
    front, rayleigh = Front(study), study.rayleigh_wave_speed()
    time, stress, place = front.peak
    shown = (time > front.start) & (time < front.time[-1])
    at = time[shown] * MICRO
    figure = Figure(figsize=(5.6, 5.6))
    top, middle, bottom = figure.subplots(3, 1, sharex=True, gridspec_kw=dict(height_ratios=(1.4, 1, 1), hspace=0.08))
    top.plot(front.time * MICRO, front.place * MILLI, color=BLUE, linewidth=1, label="front on the wall")
    top.plot(at, place[shown, 1] * MILLI, color=ORANGE, linewidth=1, label="largest von Mises stress in the solid")
    passed = front.passes(rayleigh)
    if passed:
        since = np.array([passed[0], front.time[-1]])
        top.plot(since * MICRO, (passed[1] + rayleigh * (since - passed[0])) * MILLI, color=GREY, linewidth=0.8,
                 dashes=(5, 3), label=f"Rayleigh wave, {rayleigh:.0f} m/s")
        for axes in (top, middle, bottom):
            axes.axvline(passed[0] * MICRO, color=GREY, linewidth=0.6, dashes=(2, 2))
    top.set(ylabel="$r$ / mm", ylim=(0, None))
    top.legend(frameon=False, fontsize=8, loc="upper left")
    middle.plot(front.time * MICRO, front.speed, color=BLUE, linewidth=1)
    middle.axhline(rayleigh, color=GREY, linewidth=0.8, dashes=(5, 3))
    middle.set(ylabel="speed of the\nfront / (m/s)", ylim=(0.4 * rayleigh, 2 * rayleigh))
    bottom.plot(at, stress[shown] * MEGA, color=ORANGE, linewidth=1)
    bottom.set(xlabel="$t$ / µs", ylabel=r"largest $\sigma_\mathrm{vM}$ / MPa", ylim=(0, None), xlim=(at[0], at[-1]))
    figure.subplots_adjust(0.15, 0.085, 0.98, 0.985)
    figure.align_ylabels()
    return figure
