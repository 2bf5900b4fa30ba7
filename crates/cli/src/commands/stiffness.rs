//! `pounding stiffness`: where a contact stiffness comes from.

use pounding_case::Dimension;
use pounding_gap_element::contact_stiffness::{
    Approach, ContactStiffness, Intermediate, Slab, Sphere, duration, hertz, multiple, penetration,
    slab,
};
use serde::Serialize;

use crate::arguments::{
    ApproachArguments, DurationArguments, HertzArguments, MultipleArguments, PenetrationArguments,
    SlabArguments, StiffnessArguments, StiffnessMethod, optional, value,
};
use crate::failure::Failure;
use crate::output::{pretty, print};

const AREA: Dimension = Dimension {
    mass: 0.0,
    length: 2.0,
    time: 0.0,
};
const DENSITY: Dimension = Dimension {
    mass: 1.0,
    length: -3.0,
    time: 0.0,
};

/// One stiffness with source and warnings.
pub fn stiffness(arguments: &StiffnessArguments) -> Result<(), Failure> {
    let (name, result) = match &arguments.method {
        StiffnessMethod::Hertz(a) => ("hertz", by_hertz(a)?),
        StiffnessMethod::Slab(a) => ("slab", by_slab(a)?),
        StiffnessMethod::Duration(a) => ("duration", by_duration(a)?),
        StiffnessMethod::Penetration(a) => ("penetration", by_penetration(a)?),
        StiffnessMethod::Multiple(a) => ("multiple", by_multiple(a)?),
    };
    if arguments.json {
        return print(&pretty(&Stiffness::of(name, &result))?);
    }
    print(&as_text(&result))
}

fn by_hertz(a: &HertzArguments) -> Result<ContactStiffness, Failure> {
    let left = Sphere {
        radius: radius(&a.radius_left, "radius-left")?,
        elastic_modulus: value(
            &a.elastic_modulus_left,
            "elastic-modulus-left",
            Dimension::PRESSURE,
        )?,
        poisson_ratio: value(
            &a.poisson_ratio_left,
            "poisson-ratio-left",
            Dimension::NUMBER,
        )?,
        density: optional(a.density_left.as_deref(), "density-left", DENSITY)?,
    };
    let right = Sphere {
        radius: radius(&a.radius_right, "radius-right")?,
        elastic_modulus: optional(
            a.elastic_modulus_right.as_deref(),
            "elastic-modulus-right",
            Dimension::PRESSURE,
        )?
        .unwrap_or(left.elastic_modulus),
        poisson_ratio: optional(
            a.poisson_ratio_right.as_deref(),
            "poisson-ratio-right",
            Dimension::NUMBER,
        )?
        .unwrap_or(left.poisson_ratio),
        density: optional(a.density_right.as_deref(), "density-right", DENSITY)?
            .or(left.density.filter(|_| a.elastic_modulus_right.is_none())),
    };
    let meeting = match (&a.velocity, &a.mass_left, &a.mass_right) {
        (Some(v), Some(l), Some(r)) => Some(meeting(v, l, r)?),
        _ => None,
    };
    Ok(hertz(&left, &right, meeting)?)
}

fn by_slab(a: &SlabArguments) -> Result<ContactStiffness, Failure> {
    let length = |text: Option<&str>, name| optional(text, name, Dimension::LENGTH);
    let width = length(a.width_left.as_deref(), "width-left")?;
    let thickness = length(a.thickness_left.as_deref(), "thickness-left")?;
    let area = optional(a.area_left.as_deref(), "area-left", AREA)?;
    let left = Slab {
        elastic_modulus: value(
            &a.elastic_modulus_left,
            "elastic-modulus-left",
            Dimension::PRESSURE,
        )?,
        area: cross_section(area, width, thickness, "left")?,
        length: value(&a.length_left, "length-left", Dimension::LENGTH)?,
    };
    let width_right = length(a.width_right.as_deref(), "width-right")?;
    let thickness_right = length(a.thickness_right.as_deref(), "thickness-right")?;
    let area_right = match optional(a.area_right.as_deref(), "area-right", AREA)? {
        Some(area) => area,
        None if width_right.is_none() && thickness_right.is_none() => left.area,
        None => cross_section(
            None,
            width_right.or(width),
            thickness_right.or(thickness),
            "right",
        )?,
    };
    let right = Slab {
        elastic_modulus: optional(
            a.elastic_modulus_right.as_deref(),
            "elastic-modulus-right",
            Dimension::PRESSURE,
        )?
        .unwrap_or(left.elastic_modulus),
        area: area_right,
        length: length(a.length_right.as_deref(), "length-right")?.unwrap_or(left.length),
    };
    let storey = optional(
        a.storey_stiffness.as_deref(),
        "storey-stiffness",
        Dimension::STIFFNESS,
    )?;
    Ok(slab(&left, &right, storey)?)
}

/// Area from itself, or from width and thickness, which must each be positive:
/// the product of two negative lengths is no area.
fn cross_section(
    area: Option<f64>,
    width: Option<f64>,
    thickness: Option<f64>,
    side: &str,
) -> Result<f64, Failure> {
    match (area, width, thickness) {
        (Some(area), ..) => Ok(area),
        (None, Some(width), Some(thickness)) if width > 0.0 && thickness > 0.0 => {
            Ok(width * thickness)
        }
        (None, Some(width), Some(thickness)) => Err(Failure::input(
            format!(
                "the {side} slab is {width} m wide and {thickness} m thick, but both must be greater than zero"
            ),
            None,
        )),
        _ => Err(Failure::input(
            format!("the {side} slab has no area"),
            Some(format!(
                "give --area-{side}, or both --width-{side} and --thickness-{side}"
            )),
        )),
    }
}

fn by_duration(a: &DurationArguments) -> Result<ContactStiffness, Failure> {
    let wanted = value(&a.duration, "duration", Dimension::TIME)?;
    let (exponent, approach, restitution) = power_law(&a.approach)?;
    Ok(duration(wanted, exponent, approach, restitution)?)
}

fn by_penetration(a: &PenetrationArguments) -> Result<ContactStiffness, Failure> {
    let wanted = value(&a.penetration, "penetration", Dimension::LENGTH)?;
    let gap = optional(a.gap_width.as_deref(), "gap-width", Dimension::LENGTH)?;
    let (exponent, approach, restitution) = power_law(&a.approach)?;
    Ok(penetration(wanted, exponent, approach, restitution, gap)?)
}

fn by_multiple(a: &MultipleArguments) -> Result<ContactStiffness, Failure> {
    let storey = value(
        &a.storey_stiffness,
        "storey-stiffness",
        Dimension::STIFFNESS,
    )?;
    let factor = value(&a.factor, "factor", Dimension::NUMBER)?;
    Ok(multiple(factor, storey)?)
}

/// Exponent, approach and restitution of the law that is meant.
fn power_law(a: &ApproachArguments) -> Result<(f64, Approach, Option<f64>), Failure> {
    Ok((
        value(&a.exponent, "exponent", Dimension::NUMBER)?,
        meeting(&a.velocity, &a.mass_left, &a.mass_right)?,
        optional(a.restitution.as_deref(), "restitution", Dimension::NUMBER)?,
    ))
}

fn meeting(velocity: &str, mass_left: &str, mass_right: &str) -> Result<Approach, Failure> {
    let right = match mass_right {
        "wall" => None,
        text => Some(value(text, "mass-right", Dimension::MASS)?),
    };
    Ok(Approach::new(
        value(velocity, "velocity", Dimension::VELOCITY)?,
        value(mass_left, "mass-left", Dimension::MASS)?,
        right,
    )?)
}

fn radius(text: &str, name: &str) -> Result<f64, Failure> {
    match text {
        "flat" => Ok(f64::INFINITY),
        text => value(text, name, Dimension::LENGTH),
    }
}

fn as_text(result: &ContactStiffness) -> String {
    let mut text = format!(
        "stiffness               {:.6e} {}\n",
        result.value,
        result.unit()
    );
    for i in &result.intermediate {
        text.push_str(&format!("{:22}  {:.6e} {}\n", i.name, i.value, i.unit));
    }
    text.push_str(&format!(
        "\nin the gap of a case    {}\nsource                  {}\nstatus                  {}\n",
        result.case_line().replace('\n', &format!("\n{:24}", "")),
        result.source,
        result.status
    ));
    if !result.warnings.is_empty() {
        text.push_str("\nwarnings\n");
    }
    for warning in &result.warnings {
        text.push_str(&format!("  - {warning}\n"));
    }
    text
}

/// What `--json` prints.
#[derive(Serialize)]
struct Stiffness<'s> {
    method: &'static str,
    stiffness: f64,
    exponent: f64,
    unit: String,
    case_line: String,
    source: &'static str,
    status: String,
    intermediate: &'s [Intermediate],
    warnings: &'s [String],
}

impl<'s> Stiffness<'s> {
    fn of(method: &'static str, result: &'s ContactStiffness) -> Self {
        Self {
            method,
            stiffness: result.value,
            exponent: result.exponent,
            unit: result.unit(),
            case_line: result.case_line(),
            source: result.source,
            status: result.status.to_string(),
            intermediate: &result.intermediate,
            warnings: &result.warnings,
        }
    }
}
