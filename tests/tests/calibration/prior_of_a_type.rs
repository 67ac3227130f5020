//! A prior of the type is worth what it can be worth at best; the large version is `prior-study`.

use stillpoint_tests::prior_study::{POPULATIONS, study};

#[test]
fn a_prior_reaches_the_bayes_bound_and_is_never_worse_than_none() {
    for (seed, population) in POPULATIONS.iter().enumerate() {
        let m = study(population, 200, 300, 40 + seed as u64).unwrap();
        let [without, with, bound] = m.rms;
        // 200 devices: covariances of 9 and 12 parameters are known to a tenth; 500 come to 1.04 of the bound (`prior-study`).
        assert!(
            with < 1.12 * bound && with <= without,
            "{}: {m:?}",
            population.name
        );
        // Intervals do not count the error of the type's spread.
        assert!(
            (0.89..0.975).contains(&m.coverage),
            "{}: {m:?}",
            population.name
        );
        assert!(
            m.flagged > 0.88 && m.false_flags < 0.03,
            "{}: {m:?}",
            population.name
        );
    }
}
