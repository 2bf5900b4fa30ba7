//! Pictures as PNG and PDF.

use std::collections::BTreeSet;
use std::sync::Arc;

use fontdb::Database;
use resvg::{tiny_skia, usvg};
use ttf_parser::Face;

use crate::chart::FACES;
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
    pub fn of(self, svg: &str) -> Result<Converted, ReportError> {
        let letters = Letters::of(svg, Database::load_system_fonts);
        let bytes = match self {
            Self::Svg => {
                // Whoever shows it has fonts of their own.
                return Ok(Converted {
                    bytes: svg.as_bytes().to_vec(),
                    without_glyph: BTreeSet::new(),
                });
            }
            Self::Png => png(&letters.tree(svg)?)?,
            Self::Pdf => pdf(&letters.tree(svg)?)?,
        };
        Ok(Converted {
            bytes,
            without_glyph: letters.without_glyph,
        })
    }
}

/// A picture in another form.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Converted {
    /// Its file.
    pub bytes: Vec<u8>,
    /// Characters of it of which neither the program nor the machine has a glyph: boxes stand in
    /// their places.
    pub without_glyph: BTreeSet<char>,
}

fn refused(reason: impl ToString) -> ReportError {
    ReportError::Figure {
        reason: reason.to_string(),
    }
}

/// The fonts for the text of a picture: DejaVu Sans, which is in the program, so that pictures look
/// alike on every machine; for characters that it lacks, those of the machine too.
struct Letters {
    fonts: Database,
    /// Characters that are in none of them.
    without_glyph: BTreeSet<char>,
}

impl Letters {
    /// Fonts for a picture; `system` adds those of the machine.
    fn of(svg: &str, system: impl FnOnce(&mut Database)) -> Self {
        let mut fonts = Database::new();
        for font in [dejavu::sans::regular(), dejavu::sans::bold()] {
            fonts.load_font_data(font.to_vec());
        }
        // All that the program itself writes is in the font.
        let wanted = svg.chars().filter(|c| !c.is_ascii());
        let mut without_glyph: BTreeSet<char> = wanted.collect();
        remove_known(&fonts, &mut without_glyph);
        if !without_glyph.is_empty() {
            system(&mut fonts);
            remove_known(&fonts, &mut without_glyph);
        }
        Self {
            fonts,
            without_glyph,
        }
    }

    /// The picture with text in these fonts. Lengths are points.
    fn tree(&self, svg: &str) -> Result<usvg::Tree, ReportError> {
        let options = usvg::Options {
            dpi: POINTS_PER_INCH,
            font_family: "DejaVu Sans".to_owned(),
            fontdb: Arc::new(self.fonts.clone()),
            ..usvg::Options::default()
        };
        // Faces of the machine stand in for missing characters alone.
        let svg = svg.replacen(FACES, "DejaVu Sans", 1);
        usvg::Tree::from_str(&svg, &options).map_err(refused)
    }
}

/// Removes characters that some font has a glyph of.
fn remove_known(fonts: &Database, characters: &mut BTreeSet<char>) {
    for face in fonts.faces() {
        if characters.is_empty() {
            return;
        }
        fonts.with_face_data(face.id, |data, index| {
            if let Ok(face) = Face::parse(data, index) {
                characters.retain(|c| face.glyph_index(*c).is_none());
            }
        });
    }
}

/// Dots of a PNG per metre: how large it is on a page.
const DOTS_PER_METRE: u32 = (DOTS_PER_INCH / 0.0254 + 0.5) as u32;

fn png(tree: &usvg::Tree) -> Result<Vec<u8>, ReportError> {
    let scale = DOTS_PER_INCH / POINTS_PER_INCH;
    let size = tree.size();
    let pixels = |length: f32| (length * scale).ceil() as u32;
    let (width, height) = (pixels(size.width()), pixels(size.height()));
    let mut image = tiny_skia::Pixmap::new(width, height)
        .ok_or_else(|| refused(format!("{width} by {height} pixels are too many")))?;
    let transform = tiny_skia::Transform::from_scale(scale, scale);
    resvg::render(tree, transform, &mut image.as_mut());
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, width, height);
    encoder.set_color(png::ColorType::Rgba);
    encoder.set_depth(png::BitDepth::Eight);
    encoder.set_pixel_dims(Some(png::PixelDimensions {
        xppu: DOTS_PER_METRE,
        yppu: DOTS_PER_METRE,
        unit: png::Unit::Meter,
    }));
    let mut writer = encoder.write_header().map_err(refused)?;
    let colour = |pixel: &tiny_skia::PremultipliedColorU8| {
        let colour = pixel.demultiply();
        [colour.red(), colour.green(), colour.blue(), colour.alpha()]
    };
    let pixels: Vec<u8> = image.pixels().iter().flat_map(colour).collect();
    writer.write_image_data(&pixels).map_err(refused)?;
    writer.finish().map_err(refused)?;
    Ok(bytes)
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
        let png = PictureFormat::Png.of(&svg).unwrap().bytes;
        assert_eq!(&png[1..4], b"PNG");
        // 300 dots per inch, behind the header of 33 bytes.
        assert_eq!(&png[37..41], b"pHYs");
        assert_eq!(png[41..50], [0, 0, 0x2e, 0x23, 0, 0, 0x2e, 0x23, 1]);
        let width = u32::from_be_bytes([png[16], png[17], png[18], png[19]]);
        assert_eq!(width, 2245);
        let pdf = PictureFormat::Pdf.of(&svg).unwrap().bytes;
        assert!(pdf.starts_with(b"%PDF"));
        let text = String::from_utf8_lossy(&pdf);
        assert!(text.contains("/MediaBox [0 0 538.58"), "size of the page");
        assert!(text.contains("DejaVuSans"), "the font is in the file");
    }

    /// Dark pixels of a picture.
    fn ink(tree: &usvg::Tree) -> usize {
        let size = tree.size().to_int_size();
        let mut image = tiny_skia::Pixmap::new(size.width(), size.height()).unwrap();
        resvg::render(tree, tiny_skia::Transform::identity(), &mut image.as_mut());
        image.pixels().iter().filter(|p| p.red() < 128).count()
    }

    /// Marks of text and of lines are dark on a white ground.
    #[test]
    fn something_is_drawn() {
        let svg = picture();
        let tree = Letters::of(&svg, |_| {}).tree(&svg).unwrap();
        let size = tree.size().to_int_size();
        let mut image = tiny_skia::Pixmap::new(size.width(), size.height()).unwrap();
        resvg::render(&tree, tiny_skia::Transform::identity(), &mut image.as_mut());
        let dark = image.pixels().iter().filter(|p| p.red() < 128).count();
        let white = image.pixels().iter().filter(|p| p.red() == 255).count();
        assert!(dark > 300 && white > 20 * dark, "{dark} {white}");
        assert!(tree.has_text_nodes());
    }

    /// A character that DejaVu Sans lacks comes from another font, here its monospaced sister; one
    /// that none has is named, and nothing is asked of the machine where all is known.
    #[test]
    fn characters_of_other_fonts() {
        let named = |name: &str| picture().replace(">one<", &format!(">{name}<"));
        let western = Letters::of(&named("Größe α 2×10⁻⁵ ж"), |_| panic!("asked"));
        assert!(western.without_glyph.is_empty());
        // A machine has ideas of its own about what a face without serifs is.
        let more = |fonts: &mut Database| {
            fonts.load_font_data(dejavu::sans_mono::regular().to_vec());
            fonts.set_sans_serif_family("a font that is not there");
        };
        let arc = named("\u{2312}");
        let (alone, helped) = (Letters::of(&arc, |_| {}), Letters::of(&arc, more));
        assert_eq!(alone.without_glyph, BTreeSet::from(['\u{2312}']));
        assert!(helped.without_glyph.is_empty());
        let drawn = |letters: &Letters| png(&letters.tree(&arc).unwrap()).unwrap();
        assert_ne!(drawn(&alone), drawn(&helped), "the glyph is drawn");
        let texts = |letters: &Letters| ink(&letters.tree(&arc).unwrap());
        let (alone, helped) = (texts(&alone), texts(&helped));
        assert!(
            10 * alone.abs_diff(helped) < alone,
            "all other text is drawn: {alone} {helped}"
        );
        let bridge = Letters::of(&named("橋 \u{2312}"), more);
        assert_eq!(bridge.without_glyph, BTreeSet::from(['橋']));
        assert!(
            PictureFormat::Svg
                .of(&named("橋"))
                .unwrap()
                .without_glyph
                .is_empty()
        );
    }

    #[test]
    fn endings() {
        assert_eq!(PictureFormat::of_ending("PNG"), Some(PictureFormat::Png));
        assert_eq!(PictureFormat::of_ending("jpg"), None);
    }
}
