//! Keys that need or exclude each other.

use super::{assert_refused, instead, slab};
use volver::case::{Description, Recipe};

#[test]
fn recipes() {
    let (e, x, d) = (
        "emission = '0'\n",
        "extinction = '0'\n",
        "emission_of_depth = '0'\n",
    );
    assert_refused(&[
        ("length = 1", 1, 1, "'depth', 'radiance' missing (allowed: "),
        (
            "depth = '0'\nradiance = '0'\nlength = 1",
            1,
            1,
            "no 'name' (allowed: ",
        ),
        (
            "depth = '0'\nradiance = '0'\nname = 'a'",
            1,
            1,
            "no 'length' (allowed: ",
        ),
        (
            &instead("depth = '0'"),
            3,
            1,
            "'radiance' missing beside 'depth' (allowed: ",
        ),
        (
            &instead("radiance = '0'"),
            3,
            1,
            "'depth' missing beside 'radiance' (allowed: ",
        ),
        (
            &instead(d),
            3,
            1,
            "'depth' missing beside 'emission_of_depth'",
        ),
        (
            &slab(e),
            3,
            1,
            "'extinction' missing beside 'depth', 'radiance', 'emission'",
        ),
        (
            &slab(x),
            3,
            1,
            "'emission' missing beside 'depth', 'radiance', 'extinction'",
        ),
        (
            &instead(x),
            3,
            1,
            "'emission' missing beside 'extinction' (allowed: ",
        ),
        (
            &instead(&format!("depth = '0'\n{x}{e}")),
            3,
            1,
            "'radiance' missing beside 'depth', 'extinction', 'emission' (allowed: ",
        ),
        (
            &slab(&format!("{e}{d}")),
            6,
            1,
            "'emission_of_depth' does not go with 'emission' (allowed: ",
        ),
        (
            &slab(&format!("{d}{x}")),
            6,
            1,
            "'extinction' does not go with 'emission_of_depth' (allowed: ",
        ),
        (
            &slab(&format!("{e}{x}inverse = 's'")),
            7,
            1,
            "'inverse' does not go with 'extinction' (allowed: ",
        ),
    ]);
    assert_refused(&[
        (
            &slab("inverse = 's'"),
            5,
            1,
            "'field' missing beside 'inverse' (allowed: ",
        ),
        (
            &slab("field = '1'"),
            5,
            1,
            "'inverse' missing beside 'field' (allowed: ",
        ),
        (
            &slab(&format!("{d}field = '1'")),
            6,
            1,
            "'inverse' missing beside 'field' (allowed: ",
        ),
    ]);
}

#[test]
fn optional_keys() {
    let recipe = |text: &str| Description::read(text).unwrap().recipe();
    let field = "field = 'lambda'\n";
    let claimed = slab(&format!("emission = '0'\nextinction = '0'\n{field}"));
    assert_eq!(recipe(&claimed), Recipe::Claimed);
    let medium = instead(&format!("emission = '0'\nextinction = '0'\n{field}"));
    assert_eq!(recipe(&medium), Recipe::Medium);
    let field = format!("{field}inverse = 's'\n");
    assert_eq!(recipe(&slab(&field)), Recipe::DepthAndRadiance);
    let of_depth = slab(&format!("emission_of_depth = '0'\n{field}"));
    assert_eq!(recipe(&of_depth), Recipe::EmissionOfDepth);
}

#[test]
fn channels() {
    let channel = |name: usize| format!("[channels.c{name}]\nradiance = '0'\n");
    let many: String = (1..=9).map(channel).collect();
    let depth = |lines: &str| instead(&format!("depth = '0'\n{lines}"));
    assert!(Description::read(&depth(&many[..many.len() - channel(9).len()])).is_ok());
    assert_refused(&[
        (&depth(&many), 4, 2, "9 channels (allowed: 1 to 8 tables"),
        (
            &depth("[channels]"),
            4,
            2,
            "0 channels (allowed: 1 to 8 tables",
        ),
        (
            &slab("[channels.red]"),
            4,
            1,
            "'radiance' outside the channels (allowed: in each [channels.NAME])",
        ),
        (&depth("[channels.Red]"), 4, 11, "'Red' is no name"),
        (
            &depth("[channels.red]"),
            4,
            11,
            "'channels.red.radiance' missing beside 'depth' (allowed: ",
        ),
        (
            &depth("[channels.red]\nemission_of_depth = '0'\n[channels.green]\nradiance = '0'\n"),
            6,
            11,
            "'channels.green.emission_of_depth' missing beside 'depth' (allowed: ",
        ),
        (
            &depth("[channels.red]\nemission_of_depth = '0'\n[channels.green]\nemission = '0'\n"),
            7,
            1,
            "'channels.green.emission' does not go with 'channels.red.emission_of_depth' (allowed: ",
        ),
        (
            &depth("extinction = '0'\n[channels.red]\nradiance = '0'\n"),
            5,
            11,
            "'channels.red.emission' missing beside 'depth', 'extinction', 'channels.red.radiance' (allowed: ",
        ),
    ]);
}
