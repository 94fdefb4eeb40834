"""Pictures of sections through bubble and wall."""

from pycav import plot


def collapse(run):
    """Just after the shock's arrival, when the reflected wave meets the bubble."""
    return plot.overview(run, time=8.5e-6, reach=2.5e-3, depth=1.9e-3)


def grid(run):
    """The blocks of the adaptive grid over the waves."""
    return plot.schlieren(run, time=8.3e-6, window=(-1.6e-3, 3.0e-3, 1.9e-3), blocks=True)


def jet(run):
    """The jet close up, before it meets the other side."""
    return plot.close_up(run, time=7.9e-6, window=(0.35e-3, 1.05e-3, 0.35e-3))


def waves(run):
    """Longitudinal, shear and head waves of a weak pulse."""
    return plot.schlieren(run, time=3e-6, window=(-8e-3, 6e-3, 6.5e-3))


def pit(run):
    """The pit and the plastic zone at the end."""
    return plot.pit(run, reach=2.6e-3)


def wall(run):
    """The pressure on the wall over radius and time."""
    return plot.space_time(run, "wall", reach=2.5e-3, since=7.5e-6, power=0.5)


def cut(run):
    """A bubble that the wall cuts, after its jet has met the wall."""
    return plot.overview(run, time=7.92e-6, reach=1e-3, depth=0.8e-3)


def two(run):
    """The shock of the larger bubble on the wall, and on what is left of the smaller one."""
    return plot.overview(run, time=9.07e-6, reach=3e-3, depth=1.8e-3)
