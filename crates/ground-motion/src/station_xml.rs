//! StationXML (Federation of Digital Seismograph Networks, versions 1.0 to 1.2): the sensitivity
//! of a channel, with the unit of the ground motion that it counts.

use std::cell::OnceCell;
use std::path::{Path, PathBuf};

use roxmltree::{Document, Node, ParsingOptions};
use sha2::{Digest, Sha256};

use crate::direction::Orientation;
use crate::error::GroundMotionError;
use crate::quantity::{Quantity, SeriesUnit};
use crate::start_times::days_after_1900;

/// Elements of StationXML nest some ten deep; the parser calls itself for each.
const MOST_DEPTH: usize = 200;

/// Largest file that is read (bytes), and elements and texts that it may have: a network's
/// stations with all their stages take some ten million bytes.
const MOST_BYTES: u64 = 64 << 20;
const MOST_NODES: u32 = 4_000_000;
/// Bytes in which the root element must stand, and files of a folder that are looked into.
const HEAD: usize = 4096;
const MOST_FILES: usize = 256;
/// Reasons why files have no sensitivity that one message names.
const MOST_REASONS: usize = 3;
/// Part by which the stages' gains may differ from the whole sensitivity.
const GAIN_TOLERANCE: f64 = 0.05;

/// A channel as its record names it.
pub(crate) struct ChannelName {
    pub network: String,
    pub station: String,
    pub location: String,
    pub channel: String,
    /// Time of the first sample (us after the year 1900).
    pub start: i64,
    /// Time of the last sample (us after the year 1900).
    pub end: i64,
    /// The same for messages.
    pub start_text: String,
    /// Samples per second.
    pub rate: f64,
}

impl ChannelName {
    fn label(&self) -> String {
        format!(
            "{}.{}.{}.{}",
            self.network, self.station, self.location, self.channel
        )
    }
}

/// What a file says of a channel.
#[derive(Debug, Clone)]
pub(crate) struct Sensitivity {
    /// Counts per `unit`.
    pub value: f64,
    pub unit: SeriesUnit,
    /// Frequency (Hz) for which it holds.
    pub frequency: Option<f64>,
    /// Where its positive values point.
    pub orientation: Option<Orientation>,
    /// Name of the file, and SHA-256 of its bytes.
    pub file: String,
    pub sha256: String,
    pub warnings: Vec<String>,
}

/// Where to look for the sensitivities of a record.
pub(crate) enum Responses {
    /// The file that the user names.
    Given(StationFile),
    /// What lies beside the record.
    Beside(Beside),
}

/// The files that lie beside a record.
pub(crate) struct Beside {
    /// Those with the code of a station in their name, which go before the others.
    named: Read,
    /// The others, which are read where those have no sensitivity.
    others: Vec<PathBuf>,
    read: OnceCell<Read>,
    /// Files that are too many to be looked into.
    left: usize,
}

/// Files that were read, and why others could not be.
#[derive(Default)]
struct Read {
    files: Vec<StationFile>,
    wrong: Vec<String>,
}

impl Read {
    fn of(paths: &[PathBuf]) -> Self {
        let mut read = Self::default();
        for path in paths {
            match StationFile::read(path) {
                Ok(file) => read.files.push(file),
                Err(error) => read.wrong.push(error.to_string()),
            }
        }
        read
    }
}

/// A StationXML file that was read.
pub(crate) struct StationFile {
    file: String,
    sha256: String,
    text: String,
}

/// The files of a folder that may be StationXML: what ends in `.xml` and has its root element; behind
/// the first 256 that end so, which are looked into, all that do.
///
/// A record whose header does not state its sensitivity is held against these; whoever writes
/// files must not write over them.
#[must_use]
pub fn responses_beside(record: &Path) -> Vec<PathBuf> {
    let paths = xml_beside(record).into_iter().enumerate();
    paths
        .filter(|(i, path)| *i >= MOST_FILES || is_station_xml(path))
        .map(|(_, path)| path)
        .collect()
}

/// What ends in `.xml` in the folder of a record, in the order of the names.
fn xml_beside(record: &Path) -> Vec<PathBuf> {
    let folder = match record.parent() {
        Some(folder) if !folder.as_os_str().is_empty() => folder,
        _ => Path::new("."),
    };
    let Ok(entries) = std::fs::read_dir(folder) else {
        return Vec::new();
    };
    let mut names: Vec<PathBuf> = entries
        .filter_map(|entry| Some(PathBuf::from(entry.ok()?.file_name())))
        .filter(|name| {
            name.extension()
                .is_some_and(|e| e.eq_ignore_ascii_case("xml"))
        })
        .collect();
    names.sort();
    let paths = names.into_iter().map(|name| record.with_file_name(name));
    paths.collect()
}

fn is_station_xml(path: &Path) -> bool {
    use std::io::Read;
    let regular = std::fs::metadata(path).is_ok_and(|found| found.is_file());
    let Some(file) = regular.then(|| std::fs::File::open(path).ok()).flatten() else {
        return false;
    };
    let mut head = Vec::with_capacity(HEAD);
    let read = file.take(HEAD as u64).read_to_end(&mut head);
    read.is_ok() && holds_root(&head)
}

fn holds_root(bytes: &[u8]) -> bool {
    let root = b"FDSNStationXML";
    let head = &bytes[..bytes.len().min(HEAD)];
    head.windows(root.len()).any(|w| w == root)
}

impl Responses {
    /// The file that the user names, else those beside the record: first the ones of which the
    /// names hold a station.
    ///
    /// # Errors
    /// A named file that cannot be read or is no StationXML.
    pub(crate) fn find(
        given: Option<&Path>,
        record: Option<&Path>,
        stations: &[String],
    ) -> Result<Self, GroundMotionError> {
        if let Some(path) = given {
            return StationFile::read(path).map(Self::Given);
        }
        let of_station = |path: &PathBuf| {
            let name = path.file_name().unwrap_or_default().to_string_lossy();
            let name = name.to_ascii_lowercase();
            stations
                .iter()
                .any(|s| name.contains(&s.to_ascii_lowercase()))
        };
        let all = record.map_or(Vec::new(), xml_beside);
        let (mut named, mut others): (Vec<_>, Vec<_>) = all.into_iter().partition(of_station);
        let left = (named.len() + others.len()).saturating_sub(MOST_FILES);
        named.truncate(MOST_FILES);
        others.truncate(MOST_FILES - named.len());
        named.retain(|path| is_station_xml(path));
        others.retain(|path| is_station_xml(path));
        Ok(Self::Beside(Beside {
            named: Read::of(&named),
            others,
            read: OnceCell::new(),
            left,
        }))
    }

    /// The sensitivity of a channel. `Err` of the inner result says why there is none.
    ///
    /// # Errors
    /// Files that contradict one another.
    pub(crate) fn of(
        &self,
        record: &str,
        name: &ChannelName,
    ) -> Result<Result<Sensitivity, GroundMotionError>, GroundMotionError> {
        let beside = match self {
            Self::Given(file) => return Ok(file.sensitivity(name)),
            Self::Beside(beside) => beside,
        };
        let mut reasons = Vec::new();
        if let Some(found) = beside.named.sensitivity(record, name, &mut reasons)? {
            return Ok(Ok(found));
        }
        let others = beside.read.get_or_init(|| Read::of(&beside.others));
        if let Some(found) = others.sensitivity(record, name, &mut reasons)? {
            return Ok(Ok(found));
        }
        let more = reasons.len().saturating_sub(MOST_REASONS);
        reasons.truncate(MOST_REASONS);
        if more > 0 {
            reasons.push(format!("{more} more files beside it do not have it either"));
        }
        if reasons.is_empty() {
            reasons.push("no StationXML lies beside it".to_owned());
        }
        if beside.left > 0 {
            reasons.push(format!(
                "{} more files that end in .xml were not opened",
                beside.left
            ));
        }
        Ok(Err(GroundMotionError::MissingSensitivity {
            file: record.to_owned(),
            searched: format!(": {}", reasons.join("; ")),
        }))
    }
}

impl Read {
    /// The sensitivity of a channel, with the reasons of the files that have none.
    ///
    /// # Errors
    /// Files that contradict one another.
    fn sensitivity(
        &self,
        record: &str,
        name: &ChannelName,
        reasons: &mut Vec<String>,
    ) -> Result<Option<Sensitivity>, GroundMotionError> {
        let mut found: Option<Sensitivity> = None;
        reasons.extend(self.wrong.iter().cloned());
        for file in &self.files {
            match (file.sensitivity(name), &found) {
                (Err(error), _) => reasons.push(error.to_string()),
                (Ok(other), Some(first))
                    if other.value != first.value || other.unit != first.unit =>
                {
                    return Err(GroundMotionError::Unsupported {
                        file: record.to_owned(),
                        what: format!(
                            "the sensitivity of {} is {} per {} in {}, but {} per {} in {}",
                            name.label(),
                            first.value,
                            first.unit.symbol,
                            first.file,
                            other.value,
                            other.unit.symbol,
                            other.file
                        ),
                        remedy: "name the one that is right: `response` in [ground_motion] of a case, `--response FILE` with `pounding motion`",
                    });
                }
                (Ok(first), None) => found = Some(first),
                (Ok(_), Some(_)) => {}
            }
        }
        Ok(found)
    }
}

impl StationFile {
    fn read(path: &Path) -> Result<Self, GroundMotionError> {
        let file = path.display().to_string();
        crate::regular_file::regular(path, &file)?;
        let refused = |what: String| GroundMotionError::Unsupported {
            file: file.clone(),
            what,
            remedy: "give the station's StationXML, as a data centre's station service sends it at level=channel or level=response",
        };
        let length = std::fs::metadata(path).map_or(0, |m| m.len());
        if length > MOST_BYTES {
            return Err(refused(format!(
                "{length} bytes are more than any station's metadata"
            )));
        }
        let bytes = std::fs::read(path).map_err(|source| GroundMotionError::Io {
            file: file.clone(),
            source,
        })?;
        if !holds_root(&bytes) {
            return Err(refused(
                "this is no StationXML: the element FDSNStationXML is missing".to_owned(),
            ));
        }
        let sha256 = Sha256::digest(&bytes)
            .iter()
            .map(|b| format!("{b:02x}"))
            .collect();
        // Names alone may hold other letters than those of ASCII.
        let text = String::from_utf8(bytes)
            .unwrap_or_else(|e| e.into_bytes().iter().map(|b| char::from(*b)).collect());
        let text = match text.strip_prefix('\u{feff}') {
            Some(rest) => rest.to_owned(),
            None => text,
        };
        Ok(Self { file, sha256, text })
    }

    fn refused(&self, line: usize, message: String, remedy: &str) -> GroundMotionError {
        GroundMotionError::Parse {
            file: self.file.clone(),
            line,
            column: 1,
            message,
            remedy: remedy.to_owned(),
        }
    }

    /// The sensitivity of a channel at the time of its first sample.
    fn sensitivity(&self, name: &ChannelName) -> Result<Sensitivity, GroundMotionError> {
        if let Some(line) = too_deep(&self.text) {
            let message =
                format!("elements nest more than {MOST_DEPTH} deep: this is no StationXML");
            return Err(self.refused(line, message, "get the file again"));
        }
        let options = ParsingOptions {
            allow_dtd: false,
            nodes_limit: MOST_NODES,
        };
        let document = Document::parse_with_options(&self.text, options).map_err(|e| {
            let line = e.pos().row as usize;
            self.refused(line, format!("this is no XML: {e}"), "get the file again")
        })?;
        let epochs = self.epochs(&document, name);
        let line = |node: &Node<'_, '_>| document.text_pos_at(node.range().start).row as usize;
        let now: Vec<Node<'_, '_>> = epochs
            .iter()
            .copied()
            .filter(|n| covers(n, name.start))
            .collect();
        let Some(channel) = now.first() else {
            let what = if epochs.is_empty() {
                format!("there is no channel {}", name.label())
            } else {
                format!(
                    "no epoch of channel {} covers {}",
                    name.label(),
                    name.start_text
                )
            };
            return Err(self.refused(
                epochs.first().map_or(1, line),
                what,
                "give the StationXML of the record's station and time, or `sensitivity`",
            ));
        };
        // Inventories that were merged have the same epoch twice.
        if let Some(other) = now.iter().find(|other| !is_same(channel, other)) {
            return Err(self.refused(
                line(other),
                format!(
                    "a second epoch of channel {} covers {}",
                    name.label(),
                    name.start_text
                ),
                "take the epoch out that is wrong, or give `sensitivity`",
            ));
        }
        let at = line(channel);
        let remedy = "give `sensitivity` in counts per m/s2";
        let whole = descendant(channel, "InstrumentSensitivity").ok_or_else(|| {
            let message = format!("channel {} has no InstrumentSensitivity", name.label());
            self.refused(
                at,
                message,
                "ask for the station at level=response, or give `sensitivity` in counts per m/s2",
            )
        })?;
        let at = line(&whole);
        let value = number(&whole, "Value");
        let value = value
            .filter(|v| v.is_finite() && *v != 0.0)
            .ok_or_else(|| {
                let message = format!(
                    "the sensitivity of {} is no number above zero",
                    name.label()
                );
                self.refused(at, message, remedy)
            })?;
        let input = unit_name(&whole, "InputUnits").unwrap_or_default();
        let stated = unit_name(&whole, "OutputUnits").unwrap_or_default();
        // Some networks write "None" there; what the last stage gives is what the chain gives.
        let of_stages = match stated.is_empty() || stated.eq_ignore_ascii_case("none") {
            true => output_of_stages(channel),
            false => None,
        };
        let output = of_stages.as_ref().unwrap_or(&stated);
        let unit = SeriesUnit::parse(&input).ok_or_else(|| {
            let message = format!(
                "channel {} records \"{input}\", which is no acceleration, velocity or displacement",
                name.label()
            );
            self.refused(at, message, "use a channel that records the motion of the ground, or give `sensitivity`")
        })?;
        // `count/V` is the digitizer's alone.
        if !["count", "counts"].contains(&output.to_ascii_lowercase().as_str()) {
            let message = format!(
                "the sensitivity of {} gives \"{output}\", not counts",
                name.label()
            );
            return Err(self.refused(at, message, remedy));
        }
        let frequency = number(&whole, "Frequency").filter(|f| f.is_finite() && *f >= 0.0);
        let mut warnings = self.doubts(channel, name, value, frequency);
        if let Some(output) = &of_stages {
            warnings.push(format!(
                "{}: line {at}: the sensitivity of {} names no unit of its output: {output} of the last stage are taken",
                self.file,
                name.label()
            ));
        }
        if unit.quantity != Quantity::Acceleration && is_of_accelerograph(&name.channel) {
            warnings.push(format!(
                "{}: line {at}: channel {} is that of an accelerograph by its code, but its sensitivity is one to {} (\"{input}\"){}: is that right?",
                self.file,
                name.label(),
                unit.quantity.name(),
                frequency.map_or(String::new(), |f| format!(", which for an accelerograph holds at {f} Hz alone"))
            ));
        }
        // The epoch of the first sample counts.
        let changes = epochs
            .iter()
            .filter(|epoch| **epoch != *channel && overlaps(epoch, name));
        for epoch in changes {
            let later = descendant(epoch, "InstrumentSensitivity");
            let other = later
                .and_then(|node| Some((number(&node, "Value")?, unit_name(&node, "InputUnits")?)));
            let Some((other, other_input)) = other.filter(|other| *other != (value, input.clone()))
            else {
                continue;
            };
            warnings.push(format!(
                "{}: line {}: another epoch of {} begins within the record, with a sensitivity of {other} per {other_input}, not {value} per {input}, which is used for all samples",
                self.file,
                line(epoch),
                name.label()
            ));
        }
        if !epochs.iter().any(|epoch| covers(epoch, name.end)) {
            warnings.push(format!(
                "{}: line {}: the epoch of {} ends at {}, and none covers the last sample: its sensitivity is used for all samples",
                self.file,
                line(channel),
                name.label(),
                channel.attribute("endDate").unwrap_or_default()
            ));
        }
        for epoch in &now {
            for attribute in ["startDate", "endDate"] {
                let date = epoch.attribute(attribute);
                if let Some(date) = date.filter(|date| microseconds(date).is_none()) {
                    warnings.push(format!(
                        "{}: line {}: {attribute} \"{date}\" of {} is no date, and bounds nothing",
                        self.file,
                        line(epoch),
                        name.label()
                    ));
                }
            }
        }
        let angles = (number(channel, "Azimuth"), number(channel, "Dip"));
        let orientation = angles.0.zip(angles.1);
        if let Some((azimuth, dip)) = orientation
            && Orientation::of(azimuth, dip).is_none()
        {
            warnings.push(format!(
                "{}: azimuth {azimuth} and dip {dip} degrees of {} are no direction, and are not used",
                self.file,
                name.label()
            ));
        }
        Ok(Sensitivity {
            value,
            unit,
            frequency,
            orientation: orientation.and_then(|(azimuth, dip)| Orientation::of(azimuth, dip)),
            file: self.file.clone(),
            sha256: self.sha256.clone(),
            warnings,
        })
    }

    /// What else the file says that does not agree with the record or with itself.
    fn doubts(
        &self,
        channel: &Node<'_, '_>,
        name: &ChannelName,
        value: f64,
        frequency: Option<f64>,
    ) -> Vec<String> {
        let mut doubts = Vec::new();
        let gains = stage_gains(channel);
        let product: f64 = gains.iter().map(|(gain, _)| gain).product();
        let ratio = product / value;
        let message = format!(
            "{}: the sensitivity of {} is {value}{}, the gains of its stages make {product}{}",
            self.file,
            name.label(),
            frequency.map_or(String::new(), |f| format!(" at {f} Hz")),
            at_frequencies(&gains)
        );
        if !gains.is_empty() && !(ratio.abs() - 1.0).abs().le(&GAIN_TOLERANCE) {
            doubts.push(message);
        } else if !gains.is_empty() && ratio < 0.0 {
            doubts.push(format!(
                "{message}: their signs are opposite, and that of the sensitivity is used"
            ));
        }
        // Opposite signs are named above.
        if value < 0.0 && (gains.is_empty() || ratio > 0.0) {
            doubts.push(format!(
                "{}: the sensitivity of {} is negative, {value}: the samples have the opposite sign of the counts",
                self.file,
                name.label()
            ));
        }
        let rate = number(channel, "SampleRate").filter(|rate| *rate > 0.0);
        if let Some(rate) = rate.filter(|rate| (rate / name.rate - 1.0).abs() > 0.01) {
            doubts.push(format!(
                "{}: channel {} has {rate} samples/s, the record {}",
                self.file,
                name.label(),
                name.rate
            ));
        }
        if let Some(frequency) = frequency.filter(|f| *f > 0.5 * name.rate) {
            doubts.push(format!(
                "{}: the sensitivity holds at {frequency} Hz, beyond half the {} samples/s of the record",
                self.file, name.rate
            ));
        }
        doubts
    }

    /// The elements of a channel, one for each of its epochs.
    fn epochs<'d>(&self, document: &'d Document<'_>, name: &ChannelName) -> Vec<Node<'d, 'd>> {
        let is = |node: &Node<'_, '_>, attribute: &str, code: &str| {
            node.attribute(attribute).unwrap_or_default().trim() == code
        };
        let location = |node: &Node<'_, '_>| {
            let code = node.attribute("locationCode").unwrap_or_default().trim();
            let plain = |code: &str| code.trim_matches('-').to_owned();
            plain(code) == plain(&name.location)
        };
        let element =
            |node: &Node<'_, '_>, tag: &str| node.is_element() && node.tag_name().name() == tag;
        // A record may leave out its network.
        let networks = document.root_element().children().filter(|n| {
            element(n, "Network") && (name.network.is_empty() || is(n, "code", &name.network))
        });
        let stations = networks
            .flat_map(|n| n.children())
            .filter(|n| element(n, "Station") && is(n, "code", &name.station));
        stations
            .flat_map(|n| n.children())
            .filter(|n| element(n, "Channel") && is(n, "code", &name.channel) && location(n))
            .collect()
    }
}

/// Gains of the stages with the frequencies (Hz) at which they hold; none where one is no number.
fn stage_gains(channel: &Node<'_, '_>) -> Vec<(f64, f64)> {
    let Some(response) = child(channel, "Response") else {
        return Vec::new();
    };
    let stages = response
        .children()
        .filter(|n| n.tag_name().name() == "Stage");
    let gains = stages.filter_map(|stage| child(&stage, "StageGain"));
    let pairs: Option<Vec<(f64, f64)>> = gains
        .map(|gain| {
            Some((
                number(&gain, "Value")?,
                number(&gain, "Frequency").unwrap_or(0.0),
            ))
        })
        .collect();
    pairs.unwrap_or_default()
}

/// Frequencies of gains that do not all hold at one; a digital stage's may hold at zero.
fn at_frequencies(gains: &[(f64, f64)]) -> String {
    let mut held: Vec<f64> = gains.iter().map(|p| p.1).filter(|f| *f > 0.0).collect();
    held.sort_by(f64::total_cmp);
    held.dedup();
    if held.len() < 2 {
        return String::new();
    }
    let shown: Vec<String> = held.iter().map(f64::to_string).collect();
    format!(" at {} Hz", shown.join(" and "))
}

fn child<'a, 'd>(node: &Node<'a, 'd>, tag: &str) -> Option<Node<'a, 'd>> {
    node.children()
        .find(|n| n.is_element() && n.tag_name().name() == tag)
}

/// `Response/TAG`.
fn descendant<'a, 'd>(channel: &Node<'a, 'd>, tag: &str) -> Option<Node<'a, 'd>> {
    child(&child(channel, "Response")?, tag)
}

fn number(node: &Node<'_, '_>, tag: &str) -> Option<f64> {
    child(node, tag)?.text()?.trim().parse().ok()
}

/// The unit in an element of a sensitivity.
fn unit_name(sensitivity: &Node<'_, '_>, element: &str) -> Option<String> {
    let units = child(sensitivity, element)?;
    child(&units, "Name")?.text().map(|t| t.trim().to_owned())
}

/// The unit of what the last stage of a channel gives.
fn output_of_stages(channel: &Node<'_, '_>) -> Option<String> {
    let response = child(channel, "Response")?;
    let is_stage = |n: &Node<'_, '_>| n.tag_name().name() == "Stage";
    let last = response.children().rfind(is_stage)?;
    let mut parts = last.children().rev();
    parts.find_map(|part| unit_name(&part, "OutputUnits"))
}

/// Whether a channel is one of an accelerograph by the second letter of its code (SEED manual, appendix A).
fn is_of_accelerograph(channel: &str) -> bool {
    channel.as_bytes().get(1).is_some_and(|b| *b == b'N')
}

/// Whether two epochs say the same of samples: sensitivity and direction.
fn is_same(first: &Node<'_, '_>, second: &Node<'_, '_>) -> bool {
    let says = |channel: &Node<'_, '_>| {
        let whole = descendant(channel, "InstrumentSensitivity");
        let units = ["InputUnits", "OutputUnits"]
            .map(|element| unit_name(whole.as_ref()?, element).map(|u| u.to_ascii_lowercase()));
        let value = whole.and_then(|whole| number(&whole, "Value"));
        let angles = ["Azimuth", "Dip"].map(|angle| number(channel, angle));
        (value, units, angles)
    };
    says(first) == says(second)
}

/// Whether the epoch of a channel covers a time: its end is the first moment that it does not.
fn covers(channel: &Node<'_, '_>, time: i64) -> bool {
    is_within(channel, time, time)
}

/// Whether the epoch of a channel covers a sample of a record.
fn overlaps(channel: &Node<'_, '_>, record: &ChannelName) -> bool {
    is_within(channel, record.start, record.end)
}

/// Whether the epoch of a channel covers some of the time from a first moment to a last.
fn is_within(channel: &Node<'_, '_>, first: i64, last: i64) -> bool {
    let bound = |attribute| channel.attribute(attribute).and_then(microseconds);
    bound("startDate").is_none_or(|start| start <= last)
        && bound("endDate").is_none_or(|end| first < end)
}

/// `2019-07-06T03:19:53.0000Z` in microseconds after the year 1900.
fn microseconds(text: &str) -> Option<i64> {
    let (date, time) = text
        .trim()
        .split_once('T')
        .unwrap_or((text.trim(), "00:00:00"));
    let mut parts = date.split('-');
    let mut next = || parts.next()?.parse::<i64>().ok();
    let (year, month, day) = (next()?, next()?, next()?);
    if !((1..=9999).contains(&year) && (1..=12).contains(&month) && (1..=31).contains(&day)) {
        return None;
    }
    let (clock, offset) = match time.find(['Z', '+', '-']) {
        Some(at) => (&time[..at], time[at..].trim_start_matches('Z')),
        None => (time, ""),
    };
    let mut parts = clock.split(':');
    let hour: i64 = parts.next()?.parse().ok()?;
    let minute: i64 = parts.next().unwrap_or("0").parse().ok()?;
    let second: f64 = parts.next().unwrap_or("0").parse().ok()?;
    if !((0..=24).contains(&hour) && (0..60).contains(&minute) && (0.0..61.0).contains(&second)) {
        return None;
    }
    let ahead = match offset.split_once(':') {
        Some((hours, minutes)) => {
            let sign = if hours.starts_with('-') { -1 } else { 1 };
            hours.parse::<i64>().ok()? * 60 + sign * minutes.parse::<i64>().ok()?
        }
        None => 0,
    };
    let minutes = days_after_1900((year, month, day))? * 1440 + hour * 60 + minute - ahead;
    Some(minutes * 60_000_000 + (second * 1.0e6).round() as i64)
}

/// The line at which elements nest deeper than is allowed; `None` if none do. What is not well
/// formed is left to the parser.
fn too_deep(text: &str) -> Option<usize> {
    let (mut depth, mut at) = (0_usize, 0_usize);
    while let Some(found) = text[at..].find('<') {
        let start = at + found;
        let rest = &text[start..];
        let end = |mark: &str| {
            rest.find(mark)
                .map_or(text.len(), |e| start + e + mark.len())
        };
        at = if rest.starts_with("<!--") {
            end("-->")
        } else if rest.starts_with("<![CDATA[") {
            end("]]>")
        } else {
            let end = end(">");
            let opens = rest[1..].starts_with(|c: char| c.is_alphabetic() || c == '_' || c == ':');
            if rest.starts_with("</") {
                depth = depth.saturating_sub(1);
            } else if opens && !text[start..end].ends_with("/>") {
                depth += 1;
            }
            if depth > MOST_DEPTH {
                return Some(1 + text[..start].matches('\n').count());
            }
            end
        };
    }
    None
}

#[cfg(test)]
mod tests {
    use super::*;

    /// By the Unix epoch, 25567 days after 1 January 1900, and the leap day of 2000.
    #[test]
    fn times_of_epochs() {
        let day = 86_400_000_000;
        assert_eq!(microseconds("1900-01-01"), Some(0));
        assert_eq!(microseconds("1970-01-01T00:00:00"), Some(25_567 * day));
        let leap = microseconds("2000-03-01T00:00:00.5Z").unwrap_or_default();
        assert_eq!(leap, (25_567 + 11_017) * day + 500_000);
        assert_eq!(microseconds("2000-03-01T09:00:00.500+09:00"), Some(leap));
        assert_eq!(microseconds("2000-02-29T19:00:00.5-05:00"), Some(leap));
        for text in ["", "2000", "2000-13-01", "2000-01-01T99:00:00", "x-y-z"] {
            assert_eq!(microseconds(text), None, "{text}");
        }
    }
}
