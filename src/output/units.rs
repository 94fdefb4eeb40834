//! Units of planar runs.

/// The unit that a quantity of the whole, or per radian, has in a planar run: per metre of depth. Any other unit stays.
#[must_use]
pub fn per_depth(unit: &str) -> &str {
    match unit {
        "m3" | "m3/rad" => "m2",
        "kg" | "kg/rad" => "kg/m",
        "N" => "N/m",
        "N s" | "N s/rad" => "N s/m",
        "J" | "J/rad" => "J/m",
        other => other,
    }
}

#[cfg(test)]
mod tests {
    use super::per_depth;

    #[test]
    fn wholes_become_per_metre_of_depth_and_densities_stay() {
        for (whole, planar) in [
            ("m3", "m2"),
            ("m3/rad", "m2"),
            ("kg", "kg/m"),
            ("N", "N/m"),
            ("N s/rad", "N s/m"),
            ("J/rad", "J/m"),
            ("J/m3", "J/m3"),
            ("kg/m3", "kg/m3"),
            ("Pa s", "Pa s"),
            ("m", "m"),
            ("1", "1"),
        ] {
            assert_eq!(per_depth(whole), planar);
        }
    }
}
