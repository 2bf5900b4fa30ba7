//! Pictures as PNG and PDF.

use std::sync::Arc;

use resvg::{tiny_skia, usvg};

use crate::error::ReportError;

/// Dots of an inch of a PNG file: what journals ask of line drawings in colour.
const DOTS_PER_INCH: f32 = 300.0;
/// Points of an inch.
const POINTS_PER_INCH: f32 = 72.0;

/// A form in which a picture is written.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum PictureFormat {
    /// Scalable Vector Graphics.
    Svg,
    /// Portable Network Graphics, 300 dots per inch.
    Png,
    /// Portable Document Format, with its font.
    Pdf,
}

impl PictureFormat {
    /// All of them.
    pub const ALL: [Self; 3] = [Self::Svg, Self::Png, Self::Pdf];

    /// Ending of its files.
    #[must_use]
    pub fn ending(self) -> &'static str {
        match self {
            Self::Svg => "svg",
            Self::Png => "png",
            Self::Pdf => "pdf",
        }
    }

    /// The form of files with this ending, in capitals or not.
    #[must_use]
    pub fn of_ending(ending: &str) -> Option<Self> {
        let ending = ending.to_ascii_lowercase();
        Self::ALL.into_iter().find(|f| f.ending() == ending)
    }

    /// A picture in this form.
    ///
    /// # Errors
    /// [`ReportError::Figure`].
    pub fn of(self, svg: &str) -> Result<Vec<u8>, ReportError> {
        match self {
            Self::Svg => Ok(svg.as_bytes().to_vec()),
            Self::Png => png(&tree(svg)?),
            Self::Pdf => pdf(&tree(svg)?),
        }
    }
}

fn refused(reason: impl ToString) -> ReportError {
    ReportError::Figure {
        reason: reason.to_string(),
    }
}

/// The picture with DejaVu Sans for its text, which is in the program: it looks alike on every
/// machine. Lengths are points.
fn tree(svg: &str) -> Result<usvg::Tree, ReportError> {
    let mut fonts = usvg::fontdb::Database::new();
    for font in [dejavu::sans::regular(), dejavu::sans::bold()] {
        fonts.load_font_data(font.to_vec());
    }
    fonts.set_sans_serif_family("DejaVu Sans");
    let options = usvg::Options {
        dpi: POINTS_PER_INCH,
        font_family: "DejaVu Sans".to_owned(),
        fontdb: Arc::new(fonts),
        ..usvg::Options::default()
    };
    usvg::Tree::from_str(svg, &options).map_err(refused)
}

fn png(tree: &usvg::Tree) -> Result<Vec<u8>, ReportError> {
    let scale = DOTS_PER_INCH / POINTS_PER_INCH;
    let size = tree.size();
    let pixels = |length: f32| (length * scale).ceil() as u32;
    let (width, height) = (pixels(size.width()), pixels(size.height()));
    let mut image = tiny_skia::Pixmap::new(width, height)
        .ok_or_else(|| refused(format!("{width} by {height} pixels are too many")))?;
    let transform = tiny_skia::Transform::from_scale(scale, scale);
    resvg::render(tree, transform, &mut image.as_mut());
    image.encode_png().map_err(refused)
}

fn pdf(tree: &usvg::Tree) -> Result<Vec<u8>, ReportError> {
    let page = svg2pdf::PageOptions {
        dpi: POINTS_PER_INCH,
    };
    svg2pdf::to_pdf(tree, svg2pdf::ConversionOptions::default(), page).map_err(refused)
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]

    use super::*;
    use crate::figure::{Curve, Panel, figure};

    fn picture() -> String {
        let curve = |name: &str, factor: f64| Curve {
            name: name.to_owned(),
            points: (0..50)
                .map(|i| (f64::from(i), factor * f64::from(i)))
                .collect(),
        };
        let panel = Panel {
            caption: "Displacement (mm)".to_owned(),
            horizontal: "time (s)".to_owned(),
            curves: vec![curve("one", 1.0), curve("two", 2.0)],
        };
        figure(&[panel]).svg()
    }

    /// 190 mm are 2244 pixels of 1/300 inch, and 538.6 pt.
    #[test]
    fn sizes() {
        let svg = picture();
        assert!(svg.contains("width=\"190mm\""));
        let png = PictureFormat::Png.of(&svg).unwrap();
        assert_eq!(&png[1..4], b"PNG");
        let width = u32::from_be_bytes([png[16], png[17], png[18], png[19]]);
        assert_eq!(width, 2245);
        let pdf = PictureFormat::Pdf.of(&svg).unwrap();
        assert!(pdf.starts_with(b"%PDF"));
        let text = String::from_utf8_lossy(&pdf);
        assert!(text.contains("/MediaBox [0 0 538.58"), "size of the page");
        assert!(text.contains("DejaVuSans"), "the font is in the file");
    }

    /// Marks of text and of lines are dark on a white ground.
    #[test]
    fn something_is_drawn() {
        let svg = picture();
        let tree = tree(&svg).unwrap();
        let size = tree.size().to_int_size();
        let mut image = tiny_skia::Pixmap::new(size.width(), size.height()).unwrap();
        resvg::render(&tree, tiny_skia::Transform::identity(), &mut image.as_mut());
        let dark = image.pixels().iter().filter(|p| p.red() < 128).count();
        let white = image.pixels().iter().filter(|p| p.red() == 255).count();
        assert!(dark > 300 && white > 20 * dark, "{dark} {white}");
        assert!(tree.has_text_nodes());
    }

    #[test]
    fn endings() {
        assert_eq!(PictureFormat::of_ending("PNG"), Some(PictureFormat::Png));
        assert_eq!(PictureFormat::of_ending("jpg"), None);
    }
}
