//! Riemann problems with their solutions, computed independently; their numbers are in the tables beside this file.

use super::super::Side;

/// A Riemann problem with its star state [p, u, rho left, rho right].
pub(crate) struct Case {
    pub name: &'static str,
    pub left: Side,
    pub right: Side,
    pub star: [f64; 4],
}

pub(crate) const fn side(rho: f64, u: f64, p: f64, gamma: f64, pi: f64) -> Side {
    Side { rho, u, p, gamma, pi, covolume: 0.0 }
}

/// Problems of all kinds.
pub(crate) fn reference() -> Vec<Case> {
    cases(include_str!("reference.csv"))
}

/// Problems at the limits of what has a solution, or a number.
pub(crate) fn extreme() -> Vec<Case> {
    cases(include_str!("extreme.csv"))
}

/// The waves of [`reference`]: (head, tail, shock), left and right.
pub(super) fn reference_waves() -> Vec<[(f64, f64, bool); 2]> {
    rows(include_str!("waves.csv"))
        .map(|(_, [a, b, c, d, e, f])| [(a, b, c == 1.0), (d, e, f == 1.0)])
        .collect()
}

/// A problem of [`reference`], and at a time `t` after the jump at `x0` a point with its state.
pub(super) struct Point {
    pub case: Case,
    pub t: f64,
    pub x0: f64,
    pub x: f64,
    pub rho: f64,
    pub u: f64,
    pub p: f64,
    pub of_left: bool,
}

pub(super) fn reference_points() -> Vec<Point> {
    let point = |(name, [t, x0, x, rho, u, p, left]): (&str, [f64; 7])| {
        let case = reference().into_iter().find(|case| case.name == name).expect("one of the reference");
        Point { case, t, x0, x, rho, u, p, of_left: left == 1.0 }
    };
    rows(include_str!("profiles.csv")).map(point).collect()
}

fn cases(table: &'static str) -> Vec<Case> {
    let case = |(name, numbers): (&'static str, [f64; 14])| {
        let side =
            |k: usize| side(numbers[k], numbers[k + 1], numbers[k + 2], numbers[k + 3], numbers[k + 4]);
        Case { name, left: side(0), right: side(5), star: std::array::from_fn(|k| numbers[10 + k]) }
    };
    rows(table).map(case).collect()
}

/// The rows of a table behind its comments and its head: a name and numbers.
fn rows<const N: usize>(table: &'static str) -> impl Iterator<Item = (&'static str, [f64; N])> {
    let rows = table.lines().filter(|line| !line.starts_with('#')).skip(1);
    rows.map(|row| {
        let (name, numbers) = row.split_once(',').expect("a name");
        let numbers: Vec<f64> = numbers.split(',').map(|number| number.parse().expect("a number")).collect();
        (name, numbers.try_into().expect("a number in each column"))
    })
}
