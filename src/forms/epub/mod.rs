//! A lesson as an EPUB 3 book: a chapter a clip, read aloud by media overlays syllable by syllable, with the talking face
//! as animated SVG over a picture of it for readers that show no SVG (thesis 7.4).
//!
//! No clock stands in a book: its name comes from what is in it, so the day it was changed, which the format wants, can
//! be the same in all.

mod chapter;
mod cover;

use std::fmt::Write;

use sha2::{Digest, Sha256};

use super::escaped;
use super::sound::Encoded;
use super::zip::Archive;
use crate::disk::Result;
use crate::figure::Figure;
use crate::forms::said::{self, Phrase};

pub(crate) use cover::poster;

/// The day that every book was changed: that of its archive's entries.
const CHANGED: &str = "1980-01-01T00:00:00Z";

const CONTAINER: &str = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n\
<container version=\"1.0\" xmlns=\"urn:oasis:names:tc:opendocument:xmlns:container\">\n\
<rootfiles><rootfile full-path=\"book/package.opf\" media-type=\"application/oebps-package+xml\"/></rootfiles>\n\
</container>\n";

const STYLE: &str = "body{margin:5%;line-height:1.6}\nh1{font-size:1.4em;font-weight:600}\nfigure{margin:0 0 1.2em}\n\
figure object,figure img{width:100%;height:auto;display:block}\naudio{width:100%;margin-top:.5em}\n\
.said{font-size:1.4em;line-height:2.1}\nrt{font-size:.5em;padding:0 .2em}\n\
.-epub-media-overlay-active,.heard{background:#fbe3d6;color:#a63c22;border-radius:.2em}\n\
@media (prefers-color-scheme:dark){.-epub-media-overlay-active,.heard{background:#4a2c22;color:#ffb59c}}\n";

/// What the book needs of a clip.
pub(crate) struct Chapter {
    /// Its heading.
    pub title: String,
    /// What is said, for those who cannot see or hear it.
    pub description: String,
    /// Seconds.
    pub duration: f64,
    /// The face, animated.
    pub svg: String,
    /// A picture of it, PNG.
    pub poster: Vec<u8>,
    /// Its sound, in a form that readers must know.
    pub sound: Option<Encoded>,
    /// Its script.
    pub phrases: Vec<Phrase>,
    /// Whether readings are in Zhuyin and not in Pinyin.
    pub zhuyin: bool,
    /// Frames a second of the face.
    pub fps: f64,
    /// Pixels of the picture.
    pub size: [u32; 2],
}

impl Chapter {
    fn has_overlay(&self) -> bool {
        self.sound.is_some() && !self.phrases.is_empty()
    }
}

/// A file of the book.
struct Entry {
    name: String,
    mime: &'static str,
    id: String,
    properties: &'static str,
    overlay: Option<String>,
    bytes: Vec<u8>,
}

/// The book.
///
/// # Errors
/// When its cover cannot be painted.
pub(crate) fn book(title: &str, figure: &Figure, chapters: &[Chapter]) -> Result<Vec<u8>> {
    let language = said::language(chapters.iter().flat_map(|c| &c.phrases), title);
    let mut entries = vec![
        entry("nav.xhtml", "application/xhtml+xml", "nav", "nav", nav(title, language, chapters).into_bytes()),
        entry("style.css", "text/css", "style", "", STYLE.as_bytes().to_vec()),
        entry("face.js", "text/javascript", "script", "", include_bytes!("face.js").to_vec()),
        entry("cover.png", "image/png", "cover", "cover-image", cover::cover(figure, title)?),
    ];
    for (i, chapter) in chapters.iter().enumerate() {
        let n = i + 1;
        let mut text = entry(
            &format!("clip-{n}.xhtml"),
            "application/xhtml+xml",
            &format!("clip-{n}"),
            "scripted",
            chapter::text(chapter, n, language).into_bytes(),
        );
        text.overlay = chapter.has_overlay().then(|| format!("overlay-{n}"));
        entries.push(text);
        let svg = chapter.svg.clone().into_bytes();
        entries.push(entry(&format!("clip-{n}.svg"), "image/svg+xml", &format!("face-{n}"), "", svg));
        entries.push(entry(&format!("clip-{n}.png"), "image/png", &format!("poster-{n}"), "", chapter.poster.clone()));
        if let Some(sound) = &chapter.sound {
            let name = format!("clip-{n}.{}", sound.extension);
            entries.push(entry(&name, sound.mime, &format!("sound-{n}"), "", sound.bytes.clone()));
        }
        if chapter.has_overlay() {
            let smil = chapter::overlay(chapter, n).into_bytes();
            entries.push(entry(&format!("clip-{n}.smil"), "application/smil+xml", &format!("overlay-{n}"), "", smil));
        }
    }
    let package = package(title, language, chapters, &entries);
    let mut archive = Archive::default();
    // What the file is stands first, and as it is, so that it can be told without opening the archive.
    archive.add("mimetype", b"application/epub+zip", false);
    archive.add("META-INF/container.xml", CONTAINER.as_bytes(), true);
    archive.add("book/package.opf", package.as_bytes(), true);
    for e in &entries {
        let packed = !matches!(e.mime, "image/png" | "audio/mpeg" | "audio/mp4");
        archive.add(&format!("book/{}", e.name), &e.bytes, packed);
    }
    Ok(archive.done())
}

fn entry(name: &str, mime: &'static str, id: &str, properties: &'static str, bytes: Vec<u8>) -> Entry {
    Entry { name: name.to_owned(), mime, id: id.to_owned(), properties, overlay: None, bytes }
}

fn nav(title: &str, language: &str, chapters: &[Chapter]) -> String {
    let list: String = chapters
        .iter()
        .enumerate()
        .map(|(i, c)| format!("<li><a href=\"clip-{}.xhtml\">{}</a></li>\n", i + 1, escaped(&c.title)))
        .collect();
    format!(
        "{}<nav epub:type=\"toc\" id=\"toc\"><h1>{1}</h1>\n<ol>\n{list}</ol></nav>\n</body>\n</html>\n",
        chapter::head(title, language, false),
        escaped(title)
    )
}

fn package(title: &str, language: &str, chapters: &[Chapter], entries: &[Entry]) -> String {
    let mut sum = Sha256::new();
    sum.update(title.as_bytes());
    for e in entries {
        sum.update(e.name.as_bytes());
        sum.update((e.bytes.len() as u64).to_le_bytes());
        sum.update(&e.bytes);
    }
    let mut text = format!(
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<package xmlns=\"http://www.idpf.org/2007/opf\" version=\"3.0\" \
         unique-identifier=\"name\" xml:lang=\"{language}\">\n\
         <metadata xmlns:dc=\"http://purl.org/dc/elements/1.1/\">\n<dc:identifier id=\"name\">urn:uuid:{}</dc:identifier>\n\
         <dc:title>{}</dc:title>\n<dc:language>{language}</dc:language>\n\
         <meta property=\"dcterms:modified\">{CHANGED}</meta>\n<meta name=\"cover\" content=\"cover\"/>\n",
        uuid(&sum.finalize()),
        escaped(title)
    );
    let spoken = || chapters.iter().enumerate().filter(|(_, c)| c.has_overlay());
    if spoken().next().is_some() {
        let total: f64 = spoken().map(|(_, c)| c.duration).sum();
        let _ = writeln!(text, "<meta property=\"media:duration\">{total:.3}s</meta>");
        for (i, chapter) in spoken() {
            let _ = writeln!(
                text,
                "<meta property=\"media:duration\" refines=\"#overlay-{}\">{:.3}s</meta>",
                i + 1,
                chapter.duration
            );
        }
        text.push_str("<meta property=\"media:active-class\">-epub-media-overlay-active</meta>\n");
    }
    text.push_str("</metadata>\n<manifest>\n");
    for e in entries {
        let _ = write!(text, "<item id=\"{}\" href=\"{}\" media-type=\"{}\"", e.id, e.name, e.mime);
        if !e.properties.is_empty() {
            let _ = write!(text, " properties=\"{}\"", e.properties);
        }
        if let Some(overlay) = &e.overlay {
            let _ = write!(text, " media-overlay=\"{overlay}\"");
        }
        text.push_str("/>\n");
    }
    text.push_str("</manifest>\n<spine>\n");
    for n in 1..=chapters.len() {
        let _ = writeln!(text, "<itemref idref=\"clip-{n}\"/>");
    }
    text.push_str("</spine>\n</package>\n");
    text
}

/// A name of the form that is made from contents (RFC 9562, version 8).
fn uuid(sum: &[u8]) -> String {
    let mut bytes = [0_u8; 16];
    bytes.iter_mut().zip(sum).for_each(|(b, s)| *b = *s);
    bytes[6] = bytes[6] & 0x0F | 0x80;
    bytes[8] = bytes[8] & 0x3F | 0x80;
    let hex: String = bytes.iter().map(|b| format!("{b:02x}")).collect();
    format!("{}-{}-{}-{}-{}", &hex[..8], &hex[8..12], &hex[12..16], &hex[16..20], &hex[20..])
}
