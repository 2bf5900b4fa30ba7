//! Comparisons of impact models.

use pounding_study::comparison::{Comparison, QuantityKind};

use crate::chart::{Axis, Chart, Limit, LimitPlace, Look, Plot, Scale, Series};

/// Height of a row with the name of a model (pt).
const ROW: f64 = 13.0;
/// Part of a row over which the marks of its buildings are spread.
const SPREAD: f64 = 0.5;

/// Peaks with pounding over those without, a row a model in the order of the
/// tables: a dot for each building, with a bar from the least to the greatest record around their
/// median. No line joins models.
pub fn peak_ratios(c: &Comparison) -> Chart {
    let names = c.models.iter().map(|m| m.descriptor.name.to_owned());
    let names: Vec<String> = names.collect();
    let plot = |kind: QuantityKind, name: &str| {
        let quantities = c.quantities.iter().enumerate();
        let quantities: Vec<_> = quantities.filter(|(_, q)| q.kind == kind).collect();
        let count = quantities.len();
        let mut series = Vec::new();
        for (turn, (q, quantity)) in quantities.into_iter().enumerate() {
            let shift = SPREAD * ((turn as f64 + 0.5) / count as f64 - 0.5);
            let mut dots = Vec::new();
            for m in 0..c.models.len() {
                let ratios = (0..c.records.len()).map(|r| c.value(m, r, q) / c.isolated[r][q]);
                let mut ratios: Vec<f64> = ratios.filter(|x| x.is_finite()).collect();
                ratios.sort_by(f64::total_cmp);
                let (Some(least), Some(most)) = (ratios.first(), ratios.last()) else {
                    continue;
                };
                let row = m as f64 + shift;
                if most > least {
                    series.push(Series {
                        name: String::new(),
                        points: vec![(*least, row), (*most, row)],
                        look: Look {
                            dash: Some("".into()),
                            width: 0.9,
                            ..Look::line(turn)
                        },
                    });
                }
                let half = ratios.len() / 2;
                let median = 0.5 * (ratios[half] + ratios[(ratios.len() - 1) / 2]);
                dots.push((median, row));
            }
            let of_records = if c.records.len() > 1 {
                format!(", median and range of {} records", c.records.len())
            } else {
                String::new()
            };
            series.push(Series {
                name: format!("{}, with pounding{of_records}", quantity.of),
                points: dots,
                look: Look::points(turn),
            });
        }
        Plot {
            heading: format!("Maximum {name} over the storeys, over that without pounding"),
            // Each has a range of its own: accelerations grow tenfold, displacements hardly.
            horizontal: Axis::linear(&format!("{name} over that without pounding (-)")),
            vertical: Axis {
                label: String::new(),
                scale: Scale::Names(names.clone()),
                range: None,
            },
            series,
            limits: vec![Limit {
                name: "1.0: without pounding".to_owned(),
                at: LimitPlace::Horizontal(1.0),
                look: Look::limit("1 1.5"),
            }],
            height: 8.0 + ROW * names.len() as f64,
        }
    };
    Chart::of_page(vec![
        plot(QuantityKind::Displacement, "displacement"),
        plot(QuantityKind::StoreyShear, "storey shear"),
        plot(QuantityKind::AccelerationAbsolute, "absolute acceleration"),
    ])
}
