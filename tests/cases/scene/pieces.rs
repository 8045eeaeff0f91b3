//! What is known of a scene's media: their forms, and where they are cut.

use super::{media, medium};
use rug::Rational;
use volver::scene::{Form, Kind, Scene, SceneProblem, read};

#[test]
fn what_is_constant_or_linear_is_known_to_be() {
    let form = |body: &str| medium(body).unwrap().media()[0].pieces[0].form.clone();
    let expression = |tau: &str, c: &str| {
        form(&format!(
            "kind = 'expression'\nextinction = '{tau}'\nemission = '{c}'"
        ))
    };
    assert!(matches!(expression("0", "5"), Form::Vacuum));
    assert!(matches!(
        expression("(lambda - lambda)*3", "1"),
        Form::Vacuum
    ));
    assert!(matches!(expression("2 + 1/3", "1"), Form::Constant(_)));
    assert!(matches!(expression("1 + lambda", "1"), Form::Linear { .. }));
    assert!(matches!(
        expression("1", "(1 + lambda)*2"),
        Form::Linear { .. }
    ));
    assert!(matches!(
        expression("1 + lambda^2", "1"),
        Form::Smooth { .. }
    ));
    let ends = form("kind = 'linear'\nextinction = {front = 1, back = 3}\nemission = 0.5");
    let Form::Linear { front, back } = ends else {
        panic!("{ends:?}");
    };
    assert_eq!(front[0].extinction, 1);
    assert_eq!(back[0].extinction, 3);
    // An exact decimal, not the nearest binary64.
    let shown = |extinction: &str| {
        format!(
            "{:?}",
            form(&format!("kind = 'constant'\nextinction = {extinction}"))
        )
    };
    assert_eq!(shown("0.1"), shown("'1/10'"));
    assert!(matches!(
        form("kind = 'linear'\nextinction = 2\nemission = 1"),
        Form::Constant(_)
    ));
}

#[test]
fn media_are_cut_where_they_are_not_analytic() {
    let scene = medium(
        "kind = 'expression'\nextinction = 'piecewise(lambda < 1/3, 1, 2)'\nemission = 'abs(lambda^2 - 2)'",
    )
    .unwrap();
    let pieces = &scene.media()[0].pieces;
    assert_eq!(pieces.len(), 3);
    assert_eq!(pieces[0].to, Rational::from((1, 3)));
    // √2, to hundreds of bits.
    let square: Rational = Rational::from(pieces[1].to.square_ref()) - 2;
    assert!(square.to_f64().abs() < 1e-100);
    assert_eq!(scene.media()[0].blur, 0.0);
}

#[test]
fn fields_are_put_into_the_transfer_functions() {
    let scene = medium(
        "kind = 'expression'\nfield = '2*lambda'\nextinction = 'max(s, 1)'\nemission = 's/4'",
    )
    .unwrap();
    let pieces = &scene.media()[0].pieces;
    assert_eq!(pieces.len(), 2);
    assert_eq!(pieces[0].to, Rational::from((1, 2)));
    let Form::Linear { back, .. } = &pieces[1].form else {
        panic!("{pieces:?}");
    };
    assert_eq!(
        (back[0].extinction.to_f64(), back[0].emission.to_f64()),
        (4.0, 1.0)
    );
}

#[test]
fn samples_are_linear_between_or_nearest() {
    let samples = |how: &str| {
        medium(&format!(
            "kind = 'sampled'\nsamples = [0, 1, 0.5]\ninterpolation = '{how}'\nextinction = 's'\nemission = '1'"
        ))
        .unwrap()
    };
    let places = |scene: &Scene| -> Vec<f64> {
        let pieces = scene.media()[0].pieces.iter();
        pieces.map(|piece| piece.to.to_f64()).collect()
    };
    assert_eq!(places(&samples("linear")), [1.0, 2.0]);
    assert_eq!(places(&samples("nearest")), [0.5, 1.5, 2.0]);
    let nearest = samples("nearest");
    let forms: Vec<_> = nearest.media()[0].pieces.iter().map(|p| &p.form).collect();
    assert!(matches!(
        forms[..],
        [Form::Vacuum, Form::Constant(_), Form::Constant(_)]
    ));
}

#[test]
fn a_table_cuts_cells_where_the_field_passes_its_entries() {
    let directory = tempfile::tempdir().unwrap();
    std::fs::write(
        directory.path().join("t.csv"),
        "s,extinction,emission\n0,0,1\n0.5,1,0\n1,4,2\n",
    )
    .unwrap();
    let scene = |lookup: &str| {
        let text = format!(
            "[[media]]\nfrom = 0\nto = 1\nkind = 'sampled'\nsamples = [1, 0]\ntable = 't.csv'\ntable-interpolation = '{lookup}'"
        );
        read(&text, directory.path()).unwrap()
    };
    let linear = scene("linear");
    let pieces = &linear.media()[0].pieces;
    assert_eq!(pieces.len(), 2);
    let Form::Linear { front, back } = &pieces[0].form else {
        panic!("{pieces:?}");
    };
    assert_eq!(
        (front[0].extinction.to_f64(), back[0].extinction.to_f64()),
        (4.0, 1.0)
    );
    // Halfway between entries: s = 3/4 and 1/4.
    let nearest = scene("nearest");
    let places: Vec<f64> = nearest.media()[0]
        .pieces
        .iter()
        .map(|p| p.to.to_f64())
        .collect();
    assert_eq!(places, [0.25, 0.75, 1.0]);
}

#[test]
fn channels_have_their_own_values_and_fingerprints_tell_scenes_apart() {
    let text = |c: &str| {
        format!(
            "channels = ['r', 'g']\nbackground = [0, 1]\n[[media]]\nfrom = 0\nto = 1\nkind = 'constant'\nextinction = [1, 2]\nemission = {c}"
        )
    };
    let scene = media(&text("[3, 4]")).unwrap();
    assert_eq!(scene.media()[0].kind, Kind::Constant);
    let Form::Constant(values) = &scene.media()[0].pieces[0].form else {
        panic!("not constant");
    };
    assert_eq!(
        (&values[1].extinction, &values[1].emission),
        (&2.into(), &4.into())
    );
    assert_ne!(
        scene.fingerprint(),
        media(&text("[3, 5]")).unwrap().fingerprint()
    );
    assert_eq!(
        scene.fingerprint(),
        media(&text("[3, 4]")).unwrap().fingerprint()
    );
    for names in ["[]", "['a', 'a']", "['s']", "['a b']"] {
        let text = format!("channels = {names}\n[[media]]\nfrom = 0\nto = 1\nkind = 'vacuum'");
        assert!(
            matches!(media(&text), Err(SceneProblem::ChannelNames { .. })),
            "{names}"
        );
    }
}
