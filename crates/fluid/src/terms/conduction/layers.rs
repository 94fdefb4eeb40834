//! How well heat passes through cells: as if what they hold of gas and of liquid lay in layers.

/// 1/λ of both phases, m K/W.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Resistivity {
    pub gas: f64,
    pub liquid: f64,
}

/// A conductivity that is none, W/(m K).
const NONE: f64 = 1e-200;

impl Resistivity {
    /// Of the conductivities of gas and liquid, W/(m K); 0 lets nothing through.
    pub fn of(gas: f64, liquid: f64) -> Self {
        Self { gas: 1.0 / gas.max(NONE), liquid: 1.0 / liquid.max(NONE) }
    }

    /// The thermal resistance from where a cell has its mean temperature to one of its faces, over the cell's width, m K/W.
    ///
    /// The gas lies in a layer of thickness φh towards where there is more of it, the liquid in one of (1 − φ)h towards the other side. A flux q through
    /// both makes two straight profiles that meet on the interface at T_I; the mean by heat capacities (shares s_g, s_l) is
    /// T = T_I + q [s_g φh/2λ_g − s_l (1 − φ)h/2λ_l]. From there to the face of the gas it is
    ///
    /// R_g/h = φ/λ_g (1 − s_g/2) + s_l (1 − φ)/2λ_l,
    ///
    /// and to that of the liquid likewise. Both together are the resistance of the layers, so that a steady flux through
    /// any number of such cells is exact. In one phase each is h/2λ.
    ///
    /// - `phi`: of the cell, within [0, 1]; `share`: s_g; `is_towards_gas`: whether the face is on the gas's side.
    /// - tested by: layers add up; media in contact.
    #[inline(always)]
    pub fn to_face(self, phi: f64, share: f64, is_towards_gas: bool) -> f64 {
        let (gas, liquid) = (phi * self.gas, (1.0 - phi) * self.liquid);
        let (half_gas, half_liquid) = (0.5 * share * gas, 0.5 * (1.0 - share) * liquid);
        if is_towards_gas { gas - half_gas + half_liquid } else { liquid - half_liquid + half_gas }
    }

    /// Of both layers of a cell over its width.
    #[inline(always)]
    pub fn of_cell(self, phi: f64) -> f64 {
        phi * self.gas + (1.0 - phi) * self.liquid
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn both_ways_out_of_a_cell_are_all_of_its_layers() {
        let r = Resistivity::of(0.026, 0.6);
        for (phi, share) in [(0.0, 0.0), (0.3, 1e-3), (0.9, 0.5), (1.0, 1.0)] {
            let ways = r.to_face(phi, share, true) + r.to_face(phi, share, false);
            approx::assert_relative_eq!(ways, r.of_cell(phi), max_relative = 1e-14);
        }
        assert_eq!(r.to_face(0.0, 0.0, true), 0.5 * r.liquid);
        assert_eq!(r.to_face(1.0, 1.0, false), 0.5 * r.gas);
        // Where the liquid holds the heat, the temperature is that of the liquid's middle.
        approx::assert_relative_eq!(r.to_face(0.4, 0.0, true), 0.4 * r.gas + 0.3 * r.liquid);
    }
}
