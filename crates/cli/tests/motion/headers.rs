//! What a header says beside the samples: peaks with their signs, steps of processing.

use super::*;

/// A DYNA record, +1.5 to -99.25 cm/s2, with this peak in its header.
fn dyna(peak: &str) -> String {
    let keys = "EVENT_NAME: made up\nEVENT_ID: 1\nSTATION_CODE: XX01\nDATE_TIME_FIRST_SAMPLE_YYYYMMDD_HHMMSS: 20000101_000000.000\nSAMPLING_INTERVAL_S: 0.01\nNDATA: 5\nSTREAM: HNE\nUNITS: cm/s^2\n";
    format!(
        "{keys}PGA_CM/S^2: {peak}\nTIME_PGA_S: 0.02\nBASELINE_CORRECTION: BASELINE REMOVED\nHEADER_FORMAT: DYNA 1.2\nDATA_TYPE: ACCELERATION\nUSER5: \n0.5\n1.5\n-99.25\n0.25\n-0.5\n"
    )
}

fn header_of(folder: &Folder, peak: &str) -> (String, Value) {
    std::fs::write(folder.path("d.asc"), dyna(peak)).unwrap();
    let file = folder.name("d.asc");
    (text(&["info", &file]), json(&["info", &file]))
}

/// The samples reach -99.25 alone.
#[test]
fn signs_of_peaks_are_compared() {
    let folder = Folder::new();
    let (shown, told) = header_of(&folder, "-99.25");
    assert!(shown.contains(" -99.25 cm/s2 |"), "{shown}");
    assert!(!shown.contains("remark"), "{shown}");
    let series = &told["files"][0]["series"][0];
    assert_eq!(series["header_peak"]["opposite_sign"], false);
    close(number(&series["signed_peak"]), -0.9925, 1e-15);
    close(number(&series["peak"]["value"]), 0.9925, 1e-15);

    let (shown, told) = header_of(&folder, "99.25");
    for part in [
        "peak -99.25 cm/s2 in the samples, 99.25 cm/s2 in the header: the signs differ",
        "the header may print magnitudes",
    ] {
        assert!(shown.contains(part), "{part} is not in {shown}");
    }
    let series = &told["files"][0]["series"][0];
    assert_eq!(series["header_peak"]["opposite_sign"], true);

    // A magnitude that differs is reported with both signs.
    let (shown, _) = header_of(&folder, "98");
    assert!(
        shown.contains("peak is 98.000 cm/s2, that of the samples -99.250 cm/s2"),
        "{shown}"
    );
}

/// Samples -210.142 cm/s2, 36.929 cm/s, 19.344 cm; header 210.142, -36.92862, -19.344.
#[test]
fn the_inverted_record_of_caltech() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(
        "../../../shared/ground_motions/native/ElCentro1940_S90W_CaltechVol2__USACA47.035.txt",
    );
    if !path.exists() {
        return;
    }
    let shown = text(&["info", &path.display().to_string()]);
    for part in [
        "peak -210.142 cm/s2 in the samples, 210.142 cm/s2 in the header",
        "peak 36.929 cm/s in the samples, -36.9286 cm/s in the header",
        "peak 19.344 cm in the samples, -19.344 cm in the header",
        "all signs of the header are opposite to those of the samples",
    ] {
        assert!(shown.contains(part), "{part} is not in {shown}");
    }
}

#[test]
fn our_own_files_say_how_they_were_processed() {
    let folder = Folder::new();
    let (made, processed) = (folder.name("made.csv"), folder.name("processed.csv"));
    text(&[
        "synth",
        "sine",
        "--amplitude",
        "1 m/s^2",
        "--frequency",
        "1 Hz",
        "--duration",
        "2 s",
        "--output",
        &made,
    ]);
    text(&[
        "process",
        &made,
        "--taper",
        "start=0.2 s, end=0.2 s",
        "-o",
        &processed,
    ]);
    for file in [&made, &processed] {
        let shown = text(&["info", file]);
        assert!(shown.contains("before: Step: "), "{shown}");
        assert!(
            shown.contains("generated or processed by the steps"),
            "{shown}"
        );
        assert!(!shown.contains("does not say"), "{shown}");
        let told = json(&["info", file]);
        assert_eq!(told["files"][0]["series"][0]["processing"], "steps");
    }
    let shown = text(&["info", &el_centro()]);
    assert!(shown.contains("the file does not say how"), "{shown}");
}
