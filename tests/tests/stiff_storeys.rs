//! A storey that is stiffer by many orders than the one below it, as what stands for a rigid part of a building, with
//! damping in proportion to stiffness: its mode is damped far beyond critical.
use std::sync::Arc;

use pounding_shear_building::{Damping, ShearBuilding};
use pounding_time_history::{GroundAcceleration, MethodChoice, RunOptions, System, run};

/// Two storeys of 120 and 160 t, the upper one stiffer by this ratio, 5 % in the first mode, under a sine in samples of this
/// length (s).
fn system(ratio: f64, time_step: f64) -> System {
    let damping = Damping::StiffnessProportional { ratio: 0.05 };
    damped(ratio, time_step, damping)
}

fn damped(ratio: f64, time_step: f64, damping: Damping) -> System {
    let mass = vec![1.2e5, 1.6e5];
    let stiffness = 2.8e5 * 169.0;
    let stiffnesses = vec![stiffness, stiffness * ratio];
    let building = ShearBuilding::new("b".into(), mass, stiffnesses, vec![3.0; 2], damping);
    let samples = (0..100).map(|i| 3.0 * (0.3 * f64::from(i)).sin());
    let ground = GroundAcceleration {
        samples: samples.collect::<Vec<_>>().into(),
        time_step,
    };
    System::new(vec![Arc::new(building.unwrap())], ground)
}

/// Peaks of shear (N) and absolute acceleration (m/s2) of the upper storey by the closed form of the modes with 50 digits,
/// the place of each by the golden section.
const PEAKS: [(f64, [f64; 2], [f64; 2]); 5] = [
    (1e4, SHORT, [1_802_791.666_797_68, 11.333_699_892_298_3]),
    (1e6, SHORT, [1_802_812.955_388_92, 11.333_832_195_216_2]),
    (1e5, SHORT, [1_802_811.020_514_12, 11.333_820_170_431_5]),
    (1e7, SHORT, [1_802_813.148_871_43, 11.333_833_397_664_4]),
    (1e6, [0.5, 2.0], [443_671.077_827_431, 2.781_002_814_540_54]),
];
/// Samples and duration (s).
const SHORT: [f64; 2] = [0.02, 1.0];

#[test]
fn modes_damped_far_beyond_critical_keep_their_digits() {
    for (ratio, [time_step, duration], [shear, acceleration]) in PEAKS {
        let options = RunOptions {
            method: MethodChoice::EventDriven {
                relative_tolerance: 1e-8,
            },
            duration: Some(duration),
            energy_tolerance: Some(1e-13),
        };
        let outcome = run(&system(ratio, time_step), &options, &mut [], &mut |_| {}).unwrap();
        let storey = &outcome.buildings[0].storeys[1];
        let error = |x: f64, expected: f64| (x / expected - 1.0).abs();
        let errors = [
            error(storey.storey_shear.value, shear),
            error(storey.acceleration_absolute.value, acceleration),
        ];
        // The difference between floors that such a storey joins is known to so many digits.
        let allowed = 1e-15 * ratio + 1e-11;
        assert!(errors.iter().all(|e| *e < allowed), "{ratio:e}: {errors:?}");
    }
}

/// The same damping by a dashpot a storey, which are not taken apart by modes: the exponential of a sample is squared some
/// twenty times, and accelerations have their peaks while the upper storey comes to rest, in a millionth of a sample.
#[test]
fn dashpots_of_stiff_storeys_keep_their_digits() {
    for (ratio, [time_step, duration], expected) in PEAKS {
        let first = system(ratio, time_step).buildings()[0]
            .modes()
            .circular_frequency[0];
        let per_stiffness = 2.0 * 0.05 / first;
        let stiffness = 2.8e5 * 169.0;
        let coefficients = vec![per_stiffness * stiffness, per_stiffness * stiffness * ratio];
        let system = damped(ratio, time_step, Damping::Dashpots { coefficients });
        let options = RunOptions {
            method: MethodChoice::EventDriven {
                relative_tolerance: 1e-8,
            },
            duration: Some(duration),
            energy_tolerance: Some(1e-6),
        };
        let outcome = run(&system, &options, &mut [], &mut |_| {}).unwrap();
        let storey = &outcome.buildings[0].storeys[1];
        let found = [
            storey.storey_shear.value,
            storey.acceleration_absolute.value,
        ];
        let errors = [0, 1].map(|k| (found[k] / expected[k] - 1.0).abs());
        let allowed = 1e-14 * ratio + 1e-10;
        assert!(errors.iter().all(|e| *e < allowed), "{ratio:e}: {errors:?}");
    }
}

/// A light floor whose dashpot brings it to rest 4,600 times within a sample: the acceleration has its peak 4 us after a sample,
/// where the slope of the ground's acceleration turns. Peaks (m/s2) and times (s) by the exponential of the matrix with 40 digits,
/// the place of each by the golden section.
#[test]
fn peaks_just_after_a_sample_are_those_of_the_motion() {
    let expected = [
        [5.983_893_319_322_33, 0.100_003_754_996_2],
        [3.170_148_302_740_73, 0.178_076_968_676_274],
        [2.515_883_642_670_777, 0.18],
    ];
    let coefficients = vec![1.6e8, 334_763.0, 1_080_796.0];
    let building = ShearBuilding::new(
        "b".into(),
        vec![690.0, 19_620.0, 28_089.0],
        vec![114_048_997.0, 159_214_980.0, 143_824_980.0],
        vec![3.5; 3],
        Damping::Dashpots { coefficients },
    );
    let ground = GroundAcceleration {
        samples: vec![0.0, 3.0, -2.0, 5.0, -4.0, 6.0, -1.0, 3.0, -5.0, 0.0].into(),
        time_step: 0.02,
    };
    let system = System::new(vec![Arc::new(building.unwrap())], ground);
    let options = RunOptions {
        method: MethodChoice::EventDriven {
            relative_tolerance: 1e-8,
        },
        duration: Some(0.18),
        energy_tolerance: None,
    };
    let outcome = run(&system, &options, &mut [], &mut |_| {}).unwrap();
    for (storey, [value, time]) in outcome.buildings[0].storeys.iter().zip(expected) {
        let peak = &storey.acceleration_absolute;
        let errors = [(peak.value / value - 1.0).abs(), (peak.time - time).abs()];
        assert!(errors[0] < 1e-12 && errors[1] < 1e-11, "{errors:?}");
    }
}
