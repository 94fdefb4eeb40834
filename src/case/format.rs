//! Numbers as they are said: with prefixes, as durations, as sizes.

use std::fmt::Write as _;
use std::time::Duration;

pub(super) fn mebibytes(bytes: f64) -> String {
    let mebi = bytes / f64::from(1 << 20);
    if mebi < 10_000.0 { format!("{mebi:.0} MiB") } else { format!("{:.0} GiB", mebi / 1024.0) }
}

/// An estimate of a duration, with two or three digits: `98s`, `12m`, `1h 23m`, `4days 4h`.
pub(super) fn duration(seconds: f64) -> String {
    let unit = match seconds {
        s if s < 100.0 => 1.0,
        s if s < 86400.0 => 60.0,
        _ => 3600.0,
    };
    match Duration::try_from_secs_f64((seconds / unit).round() * unit) {
        Ok(rounded) => humantime::format_duration(rounded).to_string(),
        Err(_) => format!("{seconds:.0e} s"),
    }
}

/// A value with a prefix: `65.7 µs`, `250 MPa`.
pub(crate) fn si(value: f64, unit: &str) -> String {
    const PREFIXES: [(f64, &str); 8] =
        [(1e9, "G"), (1e6, "M"), (1e3, "k"), (1.0, ""), (1e-3, "m"), (1e-6, "µ"), (1e-9, "n"), (1e-12, "p")];
    let (scale, prefix) = PREFIXES
        .into_iter()
        .find(|(scale, _)| value.abs() >= *scale * 0.99995)
        .unwrap_or(if value == 0.0 { (1.0, "") } else { (1e-12, "p") });
    let scaled = value / scale;
    let digits = if scaled.abs() < 10.0 {
        3
    } else if scaled.abs() < 100.0 {
        2
    } else {
        1
    };
    let number = format!("{scaled:.digits$}");
    let number = number.trim_end_matches('0').trim_end_matches('.');
    format!("{number} {prefix}{unit}")
}

/// A value without a prefix, with four digits after the point or, where that says too little or too much, a power of ten.
pub(super) fn plain(value: f64, unit: &str) -> String {
    let number = if (0.01..1e5).contains(&value.abs()) {
        let fixed = format!("{value:.4}");
        fixed.trim_end_matches('0').trim_end_matches('.').to_owned()
    } else {
        format!("{value:.3e}")
    };
    format!("{number} {unit}")
}

pub(super) fn hex(bytes: &[u8]) -> String {
    bytes.iter().fold(String::new(), |mut text, byte| {
        let _ = write!(text, "{byte:02x}");
        text
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn prefixes() {
        assert_eq!(si(65.7e-6, "s"), "65.7 µs");
        assert_eq!(si(250e6, "Pa"), "250 MPa");
        assert_eq!(si(1e-3, "m"), "1 mm");
        assert_eq!(si(195.3125e-6, "m"), "195.3 µm");
        assert_eq!(si(0.0, "m"), "0 m");
        assert_eq!(plain(999.9734, "kg/m3"), "999.9734 kg/m3");
        assert_eq!(plain(1.0, "kg/m3"), "1 kg/m3");
        assert_eq!(plain(4.7e-6, "kg/m3"), "4.700e-6 kg/m3");
        assert_eq!(duration(0.4), "0s");
        assert_eq!(duration(30.2), "30s");
        assert_eq!(duration(4981.0), "1h 23m");
        assert_eq!(duration(3600.0 * 5.0), "5h");
        assert_eq!(duration(3600.0 * 100.4), "4days 4h");
        assert_eq!(duration(1e300), "1e300 s");
    }
}
