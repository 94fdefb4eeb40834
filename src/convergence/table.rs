//! The table of a study: a row for each number, a column for each grid.

use std::fmt::Write as _;

use crate::convergence::analysis::{Analysis, Convergence};
use crate::convergence::numbers::KeyNumber;
use crate::convergence::plan::{End, Grid};
use crate::convergence::record::numbers;

/// Digits of a value: enough to see a difference of a hundredth of a per cent.
const DIGITS: usize = 4;

/// The table, and below it what its columns mean.
pub fn table(grids: &[Grid], ends: &[End]) -> String {
    let head = |grid: &Grid| {
        let cells = grid.case.cells_per_radius();
        cells.map_or_else(
            || format!("grid {}", grid.number),
            |cells| format!("R/h = {cells:.4}").trim_end_matches('0').trim_end_matches('.').to_owned(),
        )
    };
    let mut rows = vec![
        [
            vec!["number".to_owned(), "unit".to_owned()],
            grids.iter().map(head).collect(),
            ["order", "Richardson", "GCI"].map(str::to_owned).to_vec(),
        ]
        .concat(),
    ];
    let found = numbers(grids, ends);
    rows.extend(found.iter().map(|(number, analysis)| row(number, analysis)));
    let mut text = aligned(&rows);
    for (grid, end) in grids.iter().zip(ends) {
        if let End::Failed(error) = end {
            let _ = writeln!(text, "grid {} ({}) failed: {error}", grid.number, grid.levels());
        }
    }
    if found.iter().any(|(_, analysis)| analysis.convergence == Convergence::TwoGrids) {
        text.push_str(
            "Two grids say nothing of an order: GCI with order 2 assumed and a safety factor of 3.\n",
        );
    }
    if found.iter().any(|(_, analysis)| analysis.convergence == Convergence::Slow) {
        text.push_str(
            "slow: an order below 0.5 is no order yet, so nothing is extrapolated; coarser grids count too much: add a finer one.\n",
        );
    }
    text.push_str(
        "GCI: of the finest grid, safety factor 1.25, order within 0.5 to 2; in brackets the spread of the values where there is none.\n",
    );
    text
}

fn row(number: &KeyNumber, analysis: &Analysis) -> Vec<String> {
    let value =
        |value: Option<f64>| value.map_or_else(|| "-".to_owned(), |value| format!("{value:.DIGITS$e}"));
    let order = match analysis.order {
        Some(order) if analysis.convergence == Convergence::Slow => format!("slow {order:.2}"),
        Some(order) => format!("{order:.2}"),
        None => analysis.convergence.name().to_owned(),
    };
    let last = number.values.iter().rev().flatten().next().copied();
    let percent = |share: f64| {
        if share.abs() < 0.0995 {
            format!("{:.2} %", 100.0 * share)
        } else {
            format!("{:.0} %", 100.0 * share)
        }
    };
    let spread = || {
        let share = analysis.spread? / last.filter(|last| *last != 0.0)?.abs();
        Some(format!("({})", percent(share)))
    };
    let index = analysis.gci.map(percent).or_else(spread).unwrap_or_else(|| "-".to_owned());
    [
        vec![number.name.clone(), number.unit.to_owned()],
        number.values.iter().map(|found| value(*found)).collect(),
        vec![order, value(analysis.richardson), index],
    ]
    .concat()
}

/// Columns of equal width; the first two to the left, the others to the right.
fn aligned(rows: &[Vec<String>]) -> String {
    let columns = rows.first().map_or(0, Vec::len);
    let widths: Vec<usize> = (0..columns)
        .map(|column| rows.iter().map(|row| row[column].chars().count()).max().unwrap_or(0))
        .collect();
    let mut text = String::new();
    for row in rows {
        let mut line = String::new();
        for (column, (cell, width)) in row.iter().zip(&widths).enumerate() {
            // Writing to a string cannot fail.
            let _ =
                if column < 2 { write!(line, "{cell:<width$}  ") } else { write!(line, "{cell:>width$}  ") };
        }
        text.push_str(line.trim_end());
        text.push('\n');
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::convergence::analysis::analyse;

    #[test]
    fn a_row_says_order_value_and_index_or_what_there_is_instead() {
        let row = |values: &[Option<f64>]| {
            let number = KeyNumber { name: "peak".to_owned(), unit: "Pa", values: values.to_vec() };
            row(&number, &analyse(values)).join(" ")
        };
        assert_eq!(
            row(&[Some(4.0), Some(3.0), Some(2.5)]),
            "peak Pa 4.0000e0 3.0000e0 2.5000e0 1.00 2.0000e0 25 %"
        );
        assert_eq!(
            row(&[Some(4.0), Some(3.0), Some(2.2)]),
            "peak Pa 4.0000e0 3.0000e0 2.2000e0 slow 0.32 - 110 %"
        );
        assert_eq!(
            row(&[Some(4.0), Some(3.0), Some(3.5)]),
            "peak Pa 4.0000e0 3.0000e0 3.5000e0 oscillatory - (29 %)"
        );
        assert_eq!(row(&[Some(4.0), None, Some(4.1)]), "peak Pa 4.0000e0 - 4.1000e0 two-grids - 0.49 %");
        assert_eq!(row(&[None, Some(4.0)]), "peak Pa - 4.0000e0 unknown - -");
        assert_eq!(
            row(&[Some(1.0), Some(-1.0), Some(0.0)]),
            "peak Pa 1.0000e0 -1.0000e0 0.0000e0 oscillatory - -"
        );
    }

    #[test]
    fn columns_line_up() {
        let rows = [["a", "b", "long"], ["longer", "b", "c"]].map(|row| row.map(str::to_owned).to_vec());
        assert_eq!(aligned(&rows), "a       b  long\nlonger  b     c\n");
    }
}
