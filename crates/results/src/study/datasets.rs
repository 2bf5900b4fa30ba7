//! Datasets and attributes of a result, with their units and names.

use std::ops::Range;

use hdf5::types::{FixedAscii, TypeDescriptor, VarLenUnicode};
use hdf5::{Dataset, File, Group, H5Type, Result};
use serde_json::json;

use super::{Axis, Description, Place, ranges};
use crate::attributes::{self, text, unicode};
use crate::dimension_scales::attach;

/// Rows of a block, and of a chunk of the file: hundreds of kilobytes before compression.
pub(super) const BLOCK: usize = 1024;
/// Characters of a run's identity.
pub(super) type Id = FixedAscii<32>;

/// Root attribute of a result with some quantities alone: their names.
pub(super) const CHOSEN_QUANTITIES: &str = "quantities";
/// Root attribute of the type of quantities, and its value where they have 32 bits.
pub(super) const NUMBERS: &str = "numbers";
/// See [`NUMBERS`].
pub(super) const FLOAT32: &str = "float32";

/// Root attribute of a result of several shards, but not all: their numbers.
pub(super) const MERGED_SHARDS: &str = "merged_shards";

/// What datasets are attached to.
pub(super) struct Axes<'d> {
    pub run: &'d Dataset,
    pub storey: Option<&'d Dataset>,
    pub level: Option<&'d Dataset>,
    pub link_level: Option<&'d Dataset>,
    pub building: Option<&'d Dataset>,
    /// Names of the coordinates of the runs.
    pub coordinates: &'d str,
}

/// A dataset for each variable, with the names of its choices.
pub(super) fn coordinates(
    file: &File,
    description: &Description,
    run: &Dataset,
    rows: usize,
) -> Result<Vec<(Dataset, Option<Vec<String>>)>> {
    let mut coordinates = Vec::new();
    for c in &description.coordinates {
        let data = match c.choices {
            Some(_) => dataset::<VarLenUnicode>(file, &c.name, rows, None)?,
            None => dataset::<f64>(file, &c.name, rows, None)?,
        };
        describe(&data, &c.unit, &c.long_name)?;
        attach(&data, run, 0)?;
        coordinates.push((data, c.choices.clone()));
    }
    Ok(coordinates)
}

/// How runs ended, and their identities.
pub(super) fn states(file: &File, axes: &Axes<'_>, rows: usize) -> Result<(Dataset, Dataset)> {
    let status = dataset::<i8>(file, "status", rows, None)?;
    describe(
        &status,
        "",
        "0 the run is complete, 1 it failed, 2 a building collapsed: see the group failures",
    )?;
    text(&status, "flag_meanings", "complete failed collapsed")?;
    let values = status.new_attr::<i8>().shape(3).create("flag_values")?;
    values.write_raw(&[0_i8, 1, 2])?;
    let id = dataset::<Id>(file, "run_id", rows, None)?;
    describe(
        &id,
        "",
        "identity of the run: hash of case, record and program version",
    )?;
    for data in [&status, &id] {
        attach(data, axes.run, 0)?;
        text(data, "coordinates", axes.coordinates)?;
    }
    Ok((status, id))
}

/// Coordinates of storeys, of levels and of levels of links beside their labels.
const OF_STOREYS: &str = "storey_building storey_number storey_elevation";
const OF_LEVELS: &str = "level_gap level_left_storey level_right_storey level_left_elevation level_right_elevation level_width";
const OF_LINK_LEVELS: &str = "link_level_link link_level_left_storey link_level_right_storey link_level_left_elevation link_level_right_elevation";

/// A dataset for each quantity, with its columns.
pub(super) fn quantities(
    file: &File,
    description: &Description,
    axes: &Axes<'_>,
    rows: usize,
) -> Result<Vec<(Dataset, Range<usize>)>> {
    let layout = &description.layout;
    let mut quantities = Vec::new();
    for q in &layout.quantities {
        let (width, scale, places) = match q.axis {
            Axis::Run => (None, None, ""),
            Axis::Storey => (Some(layout.width(q.axis)), axes.storey, OF_STOREYS),
            Axis::Level => (Some(layout.width(q.axis)), axes.level, OF_LEVELS),
            Axis::Building => (Some(layout.width(q.axis)), axes.building, ""),
            Axis::LinkLevel => (Some(layout.width(q.axis)), axes.link_level, OF_LINK_LEVELS),
        };
        if width == Some(0) {
            continue;
        }
        let data = match description.float32 {
            true => dataset::<f32>(file, q.name, rows, width)?,
            false => dataset::<f64>(file, q.name, rows, width)?,
        };
        describe(&data, q.unit, q.long_name)?;
        let names = [axes.coordinates, places].join(" ");
        text(&data, "coordinates", names.trim())?;
        attach(&data, axes.run, 0)?;
        if let Some(scale) = scale {
            attach(&data, scale, 1)?;
        }
        quantities.push((data, layout.range(q.name)));
    }
    Ok(quantities)
}

pub(super) fn root(file: &File, d: &Description) -> Result<()> {
    let variables: Vec<_> = d
        .coordinates
        .iter()
        .map(|c| json!({"name": c.name, "long_name": c.long_name, "unit": c.unit, "choices": c.choices}))
        .collect();
    attributes::head(file, &d.title, &d.version, &d.build)?;
    for (name, value) in [
        ("study", &d.study),
        ("study_sha256", &d.study_sha256),
        ("case", &d.case),
        ("record_sha256", &d.records),
        ("warnings", &d.warnings.join("\n")),
        ("variables", &json!(variables).to_string()),
    ] {
        text(file, name, value)?;
    }
    if let Some(names) = &d.quantities {
        text(file, CHOSEN_QUANTITIES, &names.join(" "))?;
    }
    if d.float32 {
        text(file, NUMBERS, FLOAT32)?;
    }
    // One that holds several shards names them; readers that know only one refuse the zero.
    let shard = match d.part.shards() {
        [one] => *one,
        several => {
            text(file, MERGED_SHARDS, &ranges(several))?;
            0
        }
    };
    for (name, value) in [
        ("runs", d.runs),
        ("chunk", d.chunk),
        ("shard", shard),
        ("shards", d.part.count()),
    ] {
        file.new_attr::<u64>()
            .create(name)?
            .write_scalar(&(value as u64))?;
    }
    Ok(())
}

/// What the labels of storeys, levels and levels of links are made of.
pub(super) fn places(
    file: &File,
    d: &Description,
    [storey, level, link_level]: [Option<&Dataset>; 3],
) -> Result<()> {
    let (storeys, levels) = (&d.layout.storeys, &d.layout.levels);
    if let Some(scale) = storey {
        if let Some(data) = labels(
            file,
            "storey_building",
            storeys.iter().map(|p| p.of.as_str()),
        )? {
            attach(&data, scale, 0)?;
        }
        let values: Vec<i32> = storeys.iter().map(|p| p.storeys[0] as i32).collect();
        let long_name = "storey of its building, from 1 at the bottom";
        numbers(file, ("storey_number", "", long_name), &values, scale)?;
        let values = storeys.iter().map(|p| or_nan(p.elevations[0]));
        let long_name = "floor elevation above the ground; NaN where a variable changes it";
        let about = ("storey_elevation", "m", long_name);
        numbers(file, about, &values.collect::<Vec<_>>(), scale)?;
    }
    if let Some(scale) = level {
        if let Some(data) = labels(file, "level_gap", levels.iter().map(|p| p.of.as_str()))? {
            attach(&data, scale, 0)?;
        }
        sides(
            file,
            ("level", "storey from 1, 0 for a wall"),
            levels,
            scale,
        )?;
        let values: Vec<f64> = levels.iter().map(|p| or_nan(p.width)).collect();
        let long_name =
            "width of the gap at rest; NaN where a variable changes that of a level of the gap";
        numbers(file, ("level_width", "m", long_name), &values, scale)?;
    }
    let levels = &d.layout.link_levels;
    if let Some(scale) = link_level {
        let links = levels.iter().map(|p| p.of.as_str());
        if let Some(data) = labels(file, "link_level_link", links)? {
            attach(&data, scale, 0)?;
        }
        let storey = "storey from 1, 0 for a wall or a foundation";
        sides(file, ("link_level", storey), levels, scale)?;
    }
    Ok(())
}

/// Storeys and elevations on both sides of levels: of which axis, and what their storeys are.
fn sides(
    file: &File,
    (axis, storey): (&str, &str),
    levels: &[Place],
    scale: &Dataset,
) -> Result<()> {
    for (i, side) in ["left", "right"].into_iter().enumerate() {
        let values: Vec<i32> = levels.iter().map(|p| p.storeys[i] as i32).collect();
        let name = format!("{axis}_{side}_storey");
        numbers(file, (name.as_str(), "", storey), &values, scale)?;
        let values = levels.iter().map(|p| or_nan(p.elevations[i]));
        let name = format!("{axis}_{side}_elevation");
        let long_name =
            "floor elevation above the ground; NaN for a wall, and where a variable changes it";
        let about = (name.as_str(), "m", long_name);
        numbers(file, about, &values.collect::<Vec<_>>(), scale)?;
    }
    Ok(())
}

/// A coordinate of storeys or levels: name, unit, long name and values.
fn numbers<T: H5Type>(
    file: &File,
    (name, unit, long_name): (&str, &str, &str),
    values: &[T],
    scale: &Dataset,
) -> Result<()> {
    let data = dataset::<T>(file, name, values.len(), None)?;
    data.write_raw(values)?;
    describe(&data, unit, long_name)?;
    attach(&data, scale, 0)
}

fn or_nan(x: Option<f64>) -> f64 {
    x.unwrap_or(f64::NAN)
}

/// A dataset of texts; none if there are no texts.
pub(super) fn labels<'t>(
    file: &File,
    name: &str,
    texts: impl Iterator<Item = &'t str>,
) -> Result<Option<Dataset>> {
    let values = texts.map(unicode).collect::<Result<Vec<_>>>()?;
    if values.is_empty() {
        return Ok(None);
    }
    let builder = file.new_dataset::<VarLenUnicode>().obj_track_times(false);
    let data = builder.shape(values.len()).create(name)?;
    data.write_raw(&values)?;
    Ok(Some(data))
}

/// Numbers of runs that failed or collapsed, and their diagnoses.
pub(super) fn failures(file: &File) -> Result<(Dataset, Dataset)> {
    let group = file.create_group("failures")?;
    let run = group
        .new_dataset::<i64>()
        .obj_track_times(false)
        .chunk(256)
        .fletcher32()
        .shape(0..)
        .create("run")?;
    describe(&run, "", "number of the run")?;
    let builder = group.new_dataset::<VarLenUnicode>().obj_track_times(false);
    let diagnosis = builder.chunk(256).shape(0..).create("diagnosis")?;
    describe(
        &diagnosis,
        "",
        "why the run failed, or when and where a building collapsed",
    )?;
    Ok((run, diagnosis))
}

/// A compressed dataset of rows, or of rows and columns.
pub(super) fn dataset<T: H5Type>(
    group: &Group,
    name: &str,
    rows: usize,
    columns: Option<usize>,
) -> Result<Dataset> {
    if rows == 0 {
        // A shard without runs: nothing to divide into chunks.
        let builder = group.new_dataset::<T>().obj_track_times(false);
        return match columns {
            Some(columns) => builder.shape((0, columns)).create(name),
            None => builder.shape(0).create(name),
        };
    }
    let chunk = BLOCK.min(rows);
    // Blocks are whole chunks, written once: a cache would only keep what is finished.
    let builder = group
        .new_dataset::<T>()
        .chunk_cache(1, 0, 1.0)
        .obj_track_times(false)
        .shuffle()
        .deflate(1);
    // HDF5 filters no texts of variable length, and refuses to where it must.
    let builder = match T::type_descriptor() {
        TypeDescriptor::VarLenUnicode => builder,
        _ => builder.fletcher32(),
    };
    match columns {
        Some(columns) => builder
            .chunk((chunk, columns))
            .shape((rows, columns))
            .create(name),
        None => builder.chunk(chunk).shape(rows).create(name),
    }
}

/// Long name of a dataset, and its unit if it has one.
pub(super) fn describe(data: &Dataset, unit: &str, long_name: &str) -> Result<()> {
    match unit {
        "" => text(data, "long_name", long_name),
        _ => attributes::describe(data, unit, long_name),
    }
}
