//! Table 1 as printed.

use super::Exponent;

/// A row of the printed table.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Printed {
    /// β.
    pub exponent: Exponent,
    /// MS_SKP in hundredths.
    pub standard: i32,
    /// MS_EKP in hundredths.
    pub extended: i32,
    /// Δ in hundredths of a per cent.
    pub efficiency: i32,
}

const fn row(exponent: Exponent, standard: i32, extended: i32, efficiency: i32) -> Printed {
    Printed { exponent, standard, extended, efficiency }
}

/// HV-Tab1: `MS_SKP rises from 65.38 to 75.45, MS_EKP from 66.22 to 88.72, Δ from 1.28 % to 17.59 % as β falls from 2 to 0`
pub const PRINTED: [Printed; 10] = [
    row(Exponent::Natural(2), 6538, 6622, 128),
    row(Exponent::Natural(1), 7052, 7903, 1206),
    row(Exponent::Real(0.8), 7282, 8381, 1508),
    row(Exponent::Real(0.5), 7458, 8720, 1693),
    row(Exponent::Real(0.1), 7537, 8859, 1755),
    row(Exponent::Real(0.05), 7541, 8866, 1757),
    row(Exponent::Real(0.01), 7544, 8871, 1759),
    row(Exponent::Real(0.005), 7544, 8872, 1759),
    row(Exponent::Real(0.001), 7545, 8872, 1759),
    row(Exponent::Natural(0), 7545, 8872, 1759),
];
