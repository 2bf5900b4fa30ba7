//! Values that no building has, which would be lost in maxima without a word.
use nalgebra::DMatrix;
use pounding_shear_building::{
    Damping, Foundation, GeneralBuilding, ShearBuilding, ShearBuildingError, SpringDashpot,
};

fn two_storeys() -> ShearBuilding {
    let damping = Damping::StiffnessProportional { ratio: 0.05 };
    let (mass, stiffness, height) = (vec![25e3; 2], vec![3.46e6; 2], vec![3.0; 2]);
    ShearBuilding::under_gravity("b".to_owned(), mass, stiffness, height, damping, 0.0).unwrap()
}

fn general() -> GeneralBuilding {
    let stiffness = DMatrix::from_row_slice(2, 2, &[6.92e6, -3.46e6, -3.46e6, 3.46e6]);
    GeneralBuilding {
        name: "b".to_owned(),
        mass: vec![25e3; 2],
        height: vec![3.0; 2],
        further: Vec::new(),
        stiffness,
        geometric: None,
        damping: Damping::StiffnessProportional { ratio: 0.05 },
        drifts: Some(vec![vec![1.0, 0.0], vec![-1.0, 1.0]]),
        sections: vec![vec![1.0, 0.0], vec![-1.0, 1.0], vec![1.0, 1.0]],
        responses: Vec::new(),
    }
}

/// A weight that is no number made a peak of zero.
#[test]
fn weights_are_numbers() {
    assert!(ShearBuilding::with_coordinates(general()).is_ok());
    for value in [f64::NAN, f64::INFINITY] {
        let mut of_sections = general();
        of_sections.sections[1][0] = value;
        let mut of_drifts = general();
        of_drifts.drifts.as_mut().unwrap()[0][1] = value;
        for wrong in [of_sections, of_drifts] {
            let error = ShearBuilding::with_coordinates(wrong).unwrap_err();
            assert!(
                matches!(error, ShearBuildingError::Weight { .. }),
                "{error}"
            );
        }
    }
}

/// Without a weight nothing would be overturned.
#[test]
fn gravity_and_length_of_a_foundation_are_above_zero() {
    let foundation = || {
        let spring = |stiffness, dashpot| SpringDashpot { stiffness, dashpot };
        let (sway, rocking) = (spring(1.9e9, 4.7e7), spring(7.5e10, 1.1e9));
        Foundation::new(150e3, 5.4e6, Some(sway), Some(rocking)).unwrap()
    };
    assert!(
        two_storeys()
            .on_foundation(foundation(), Some(10.0), 9.81)
            .is_ok()
    );
    for (length, gravity, quantity) in [
        (Some(10.0), f64::NAN, "gravity"),
        (Some(10.0), -1.0, "gravity"),
        (Some(0.0), 9.81, "length"),
        (Some(f64::NAN), 9.81, "length"),
    ] {
        let error = two_storeys().on_foundation(foundation(), length, gravity);
        let told = error.unwrap_err().to_string();
        assert!(
            told.contains(quantity) && told.contains("greater than zero"),
            "{told}"
        );
    }
}

/// A matrix that gives energy to motions, or that is not symmetric, is refused by whichever road it came.
#[test]
fn damping_matrices_take_energy() {
    let with = |entries: [f64; 4]| {
        let matrix = DMatrix::from_row_slice(2, 2, &entries);
        ShearBuilding::with_coordinates(GeneralBuilding {
            damping: Damping::Matrix { matrix },
            ..general()
        })
    };
    assert!(with([2e4, -1e4, -1e4, 1e4]).is_ok());
    assert!(with([0.0; 4]).is_ok());
    let told = with([-1e5, 0.0, 0.0, -1e5]).unwrap_err().to_string();
    assert!(told.contains("eigenvalue"), "{told}");
    let told = with([2e4, -1e4, 0.0, 1e4]).unwrap_err().to_string();
    assert!(told.contains("not symmetric"), "{told}");
}
