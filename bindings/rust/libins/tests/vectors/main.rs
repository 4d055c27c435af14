//! Every entry of the reference files (tests/data/vectors, or the directory in INS_VECTOR_DIR) whose formula the core has, through the
//! safe interface. Tolerances in double are those of the files; in float they are measured, times about 2.
//! SPDX-License-Identifier: MIT
mod api;
mod attitude;
mod filters;
mod json;
mod links;
mod navigation;
mod navigators;

use json::Json;
use libins::Real;

/// A tolerance for each number type.
pub const fn tol(double: f64, float: f64) -> f64 {
    if size_of::<Real>() == 8 {
        double
    } else {
        float
    }
}

pub fn load(name: &str) -> Json {
    let own = concat!(env!("CARGO_MANIFEST_DIR"), "/../../../tests/data/vectors");
    let path = std::path::Path::new(&std::env::var("INS_VECTOR_DIR").unwrap_or(own.into())).join(name);
    Json::parse(&std::fs::read_to_string(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display())))
}

/// To the library's number type.
pub fn real<const N: usize>(x: [f64; N]) -> [Real; N] {
    x.map(|v| v as Real)
}

/// To double.
#[allow(clippy::unnecessary_cast)]
pub fn wide<const N: usize>(x: &[Real; N]) -> [f64; N] {
    x.map(|v| v as f64)
}

/// The largest of many errors, and where it was.
#[derive(Debug, Default)]
pub struct Worst {
    error: f64,
    place: String,
    checked: usize,
}

impl Worst {
    pub fn take(&mut self, got: f64, want: f64, scale: f64, place: &str) {
        let error = (got - want).abs() / scale;
        self.checked += 1;
        if error.is_nan() || error > self.error {
            self.error = error;
            self.place = format!("{place}: got {got}, want {want}");
        }
    }

    pub fn take_all(&mut self, got: &[f64], want: &[f64], scale: f64, place: &str) {
        assert_eq!(got.len(), want.len(), "{place}");
        for (g, w) in got.iter().zip(want) {
            self.take(*g, *w, scale, place);
        }
    }

    /// The panic is the failure; `cargo test -- --nocapture` shows the figures.
    pub fn within(&self, tolerance: f64, what: &str) {
        assert!(self.checked > 0, "{what}: nothing was checked");
        println!("[ figure   ] {what}: {} values, largest error {:.2e} (tolerance {tolerance:.0e})", self.checked, self.error);
        assert!(self.error <= tolerance, "{what}: {:e} > {tolerance:e} at {}", self.error, self.place);
    }
}
