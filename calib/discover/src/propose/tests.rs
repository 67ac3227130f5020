use effects::effect_file::parse_effects;
use recording::Recording;
use sensor::Axis;
use simulate::{Hidden, Periodic, Spec};

use super::*;
use crate::remainder::unexplained::rest_of;
use crate::request::Request;
use crate::{Extension, Verdict, discover, validate};

/// A force of third order in a rate, most of which a linear one explains as well.
const CUBE: &str = r#"
[[definitions]]
name = "gyro_cube"
sensor = "gyroscope"
z = "k * fx^3"
parameters = [{ name = "k", unit = "rad/s/(m/s^2)^3", typical = 2.5e-7 }]
"#;

/// Specific force along two axes leaks into the rate about the third.
const SWIRL: &str = r#"
[[definitions]]
name = "gyro_swirl"
sensor = "gyroscope"
x = "k * fy * fz"
parameters = [{ name = "k", unit = "rad/s/(m/s^2)^2", typical = 5e-6 }]
"#;

/// The same on every axis, small.
const SWIRLS: &str = r#"
[[definitions]]
name = "gyro_swirls"
sensor = "gyroscope"
x = "k * fy * fz"
y = "k * fx * fz"
z = "k * fx * fy"
parameters = [{ name = "k", unit = "rad/s/(m/s^2)^2", typical = 3e-6 }]
"#;

/// A product of third order.
const BEND: &str = r#"
[[definitions]]
name = "accel_bend"
sensor = "accelerometer"
z = "k * fx * fy^2"
parameters = [{ name = "k", unit = "1/(m/s^2)^2", typical = 2e-5 }]
"#;

/// The rate of an axis that remembers the way in which the force along another last changed.
const MEMORY: &str = r#"
[[definitions]]
name = "gyro_memory"
sensor = "gyroscope"
x = "k * changez"
parameters = [{ name = "k", unit = "rad/s", typical = 1e-4 }]
"#;

/// A force that either sign of that along another axis makes.
const EITHER_WAY: &str = r#"
[[definitions]]
name = "accel_either_way"
sensor = "accelerometer"
z = "k * abs(fy)"
parameters = [{ name = "k", unit = "", typical = 1e-3 }]
"#;

fn defined(definition: &str) -> EffectRef {
    parse_effects(definition, "hidden.toml").unwrap().remove(0)
}

/// A session in which the definition's effect has its typical size.
fn session_with(seed: u64, definition: &str) -> (Recording, Request) {
    let effect = defined(definition);
    let mut spec = Spec::hand_held(seed);
    spec.definitions = vec![effect.definition().unwrap().clone()];
    let parameters = spec.effects.entry(effect.name().into()).or_default();
    parameters.insert("k".into(), effect.typical());
    let request = Request::new(spec.gravity);
    (spec.run().unwrap().recording, request)
}

/// The proposal is the hidden product and nothing else, its coefficient is right, and the gap closes.
fn is_found(seed: u64, definition: &str, equation: &str) -> Proposal {
    let (recording, request) = session_with(seed, definition);
    let findings = discover(&[recording], &request).unwrap().findings;
    // A proposal is no name.
    assert_eq!(findings.verdict, Verdict::Unexplained);
    assert!(findings.effects.is_empty());
    let found = findings.proposed.unwrap();
    assert_eq!(found.equation, equation);
    let (term, truth) = (&found.terms[0], defined(definition).typical());
    let std = term.std.unwrap();
    // Four standard errors: 1 in 16 000; and the product is seen to a tenth.
    assert!((term.value - truth).abs() < 4.0 * std, "{term:?}");
    assert!(std < 0.15 * truth, "{term:?}");
    assert!(found.stability >= super::chosen::STABLE.get());
    assert!(found.adjusted_p_value < 1e-6);
    assert!(found.held_out_gap_before > 1.2, "{found:?}");
    assert!(found.held_out_gap_after < 1.1, "{found:?}");
    found
}

#[test]
fn a_product_of_two_forces_in_a_rate_is_proposed_and_named_once_it_is_in_the_catalogue() {
    let found = is_found(1, SWIRL, "W_x += x_fy_fz * fy * fz");
    assert_eq!(found.name, "gyro_proposed");
    assert_eq!(found.terms[0].unit, "rad/s/(m/s^2)^2");
    let (recording, mut request) = session_with(1, SWIRL);
    request.catalogue.push(defined(SWIRL));
    let findings = discover(&[recording], &request).unwrap().findings;
    assert_eq!(findings.verdict, Verdict::Named);
    assert_eq!(findings.effects[0].name, "gyro_swirl");
    assert!(findings.proposed.is_none());
}

#[test]
fn a_product_that_a_walk_of_the_bias_is_taken_for_is_proposed() {
    for seed in [2, 4, 5, 6] {
        let (recording, request) = session_with(seed, SWIRLS);
        let recordings = [recording];
        let session = Session::new(&recordings, &request).unwrap();
        let base = State::fit(&session, Extension::default()).unwrap();
        assert!(rest_of(&base, request.alpha_of_rest()).is_none(), "{seed}");
        let findings = discover(&recordings, &request).unwrap().findings;
        assert!(findings.effects.is_empty());
        assert_eq!(
            findings.proposed.unwrap().equation,
            "W_x += x_fy_fz * fy * fz, W_y += y_fx_fz * fx * fz, W_z += z_fx_fy * fx * fy"
        );
    }
}

#[test]
fn a_formula_is_tried_on_the_validation_recording() {
    let (recording, request) = session_with(1, SWIRL);
    let found = discover(&[recording], &request).unwrap();
    let with_it = |seed: u64| {
        let validated = validate(&session_with(seed, SWIRL).0, &request, &found);
        validated.unwrap().gaps
    };
    // Of a device that has it, and of one that does not.
    let has = &with_it(1)[0];
    assert!(
        has.gap_with_formula.unwrap() < has.gap_after - 0.05,
        "{has:?}"
    );
    let without = Spec::hand_held(1).run().unwrap().recording;
    let lacks = &validate(&without, &request, &found).unwrap().gaps[0];
    assert!(
        lacks.gap_with_formula.unwrap() > lacks.gap_after + 0.05,
        "{lacks:?}"
    );
}

#[test]
fn a_product_of_third_order_in_a_specific_force_is_proposed() {
    is_found(1, BEND, "A_z += z_fx_fy2 * fx * fy^2");
}

#[test]
fn what_a_rate_remembers_is_proposed() {
    let found = is_found(2, MEMORY, "W_x += x_changez * changez");
    assert_eq!(found.terms[0].unit, "rad/s");
}

#[test]
fn the_size_of_a_force_is_proposed() {
    is_found(2, EITHER_WAY, "A_z += z_absfy * abs(fy)");
}

#[test]
fn a_force_of_third_order_is_no_g_sensitivity() {
    is_found(1, CUBE, "W_z += z_fx3 * fx^3");
    let (recording, request) = session_with(1, CUBE);
    let findings = discover(&[recording], &request).unwrap().findings;
    let instead_of = findings.unexplained.unwrap().instead_of;
    assert_eq!(instead_of, ["gyro_g_sensitivity"]);
}

/// What would be proposed were the whole disagreement of a channel unexplained.
fn asked_of(spec: &Spec, channel: Channel) -> Option<Formula> {
    let recordings = [spec.run().unwrap().recording];
    let request = Request::new(spec.gravity);
    let session = Session::new(&recordings, &request).unwrap();
    let state = State::fit(&session, Extension::default()).unwrap();
    let rest = Unexplained {
        statistic: 40.0,
        dof: 3.0,
        channel,
        size: 1.0,
        rms: None,
        p_value: 1.0,
        finding: ::findings::Finding::of(::findings::Kind::MORE_SCATTER),
        recording: None,
        period: None,
        fitted_by: None,
        instead_of: Vec::new(),
        columns: None,
        wandering: None,
    };
    propose(&session, &state, &rest).map(|p| p.formula)
}

#[test]
fn nothing_is_proposed_for_a_device_that_lacks_nothing_even_when_asked() {
    for (seed, channel) in (21..24).zip(Channel::ALL) {
        assert_eq!(asked_of(&Spec::hand_held(seed), channel), None);
    }
}

#[test]
fn nothing_is_proposed_for_what_no_product_describes() {
    let swing = Hidden::Periodic(Periodic {
        sensor: Sensor::Gyroscope,
        axis: Axis::X,
        amplitude: 2e-4,
        period: 45.0,
        phase: 0.3,
    });
    let spec = Spec::hand_held(1).with_hidden(swing);
    let recording = spec.run().unwrap().recording;
    let findings = discover(&[recording], &Request::new(spec.gravity))
        .unwrap()
        .findings;
    assert_eq!(findings.verdict, Verdict::Unexplained);
    assert!(findings.proposed.is_none(), "{:?}", findings.proposed);
}

/// A form that goes with the axis, half as large on the last one.
const UNEVEN: &str = r#"
[[definitions]]
name = "gyro_uneven"
sensor = "gyroscope"
x = "k * fx * wx"
y = "k * fy * wy"
z = "0.5 * k * fz * wz"
parameters = [{ name = "k", unit = "1/(m/s^2)", typical = 8e-5 }]
"#;

#[test]
fn what_a_form_does_on_two_axes_is_kept_on_the_third_where_it_is_small() {
    for seed in [2, 6] {
        let (recording, request) = session_with(seed, UNEVEN);
        let findings = discover(&[recording], &request).unwrap().findings;
        let found = findings.proposed.unwrap();
        let form = "W_x += x_fx_wx * fx * wx, W_y += y_fy_wy * fy * wy, W_z += z_fz_wz * fz * wz";
        assert_eq!(found.equation, form);
        // Alone it would be too little.
        let small = &found.terms[2];
        assert!(small.value < 3.5 * small.std.unwrap(), "{small:?}");
    }
}
