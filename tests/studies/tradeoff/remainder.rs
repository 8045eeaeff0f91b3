//! Compositing with the remainder is compared by default, and rounds less where it can: long rays in binary32.

use super::output;
use serde_json::Value;
use std::collections::BTreeMap;

/// Segments of a ray, all alike, on which nothing but rounding is off; each of a depth whose e^(−x) is rounded by 0.46 units of
/// 2⁻²⁴ to the same side.
const COUNT: &str = "50000";

/// Relative errors in binary32 of all default methods that sample middles from front to back, by name.
fn errors() -> BTreeMap<String, f64> {
    let text = output(&[
        "--cases",
        "homogeneous",
        "--formats",
        "f32",
        "--levels",
        COUNT,
        "--cost",
        "evaluations",
        "--json",
        "-",
    ]);
    let document: Value = serde_json::from_str(&text).unwrap();
    let points = document["cases"][0]["units"][0]["points"].as_array();
    let mut found = BTreeMap::new();
    for point in points.expect("points") {
        let name = point["method"].as_str().expect("a name");
        if name.starts_with("front-to-back/middle/expm1") {
            let error = &point["outcome"]["error"];
            let error = error
                .as_str()
                .map_or_else(|| error.as_f64(), |x| x.parse().ok());
            // Exact is no error at all.
            found.insert(name.into(), error.unwrap_or(0.0));
        }
    }
    found
}

#[test]
fn what_remains_is_compared_by_default_and_rounds_less_than_products() {
    let errors = errors();
    let of = |name: &str| errors.get(&format!("front-to-back/middle/expm1{name}"));
    let products = of("").expect("products");
    let remainder = of("/remainder").expect("the remainder");
    let compensated = of("/remainder/neumaier").expect("compensated");
    assert!(8.0 * remainder <= *products, "{remainder} {products}");
    assert!(8.0 * compensated <= *products, "{compensated} {products}");
    // Units of 2⁻²⁴: a sum with what it loses is off by two.
    assert!(*compensated <= 4.0 * (-24_f64).exp2(), "{compensated}");
}
