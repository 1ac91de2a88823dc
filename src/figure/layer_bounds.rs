//! The bounds of an author's layer, checked before it is read: what an SVG text grows to when its references are followed.
//!
//! A text of a few hundred bytes can name millions of shapes through `use`, markers, patterns and entities. [`check`] adds
//! up what every reference stands for without making it. Style sheets are not evaluated: a reference in one counts for
//! every element.

use std::collections::HashMap;

use usvg::roxmltree::{Document, Node, NodeId, ParsingOptions};

use crate::disk::{Fault, FileFault, Result};

/// The most elements, references followed: twenty for each of the most shapes of a layer.
const MAX_ELEMENTS: u64 = 100_000;
/// The most segments of paths, references followed: about what 8 MB of text hold.
const MAX_SEGMENTS: u64 = 500_000;
/// The most bytes of attributes, references followed.
const MAX_BYTES: u64 = 24 << 20;
/// The deepest nesting, references followed. Programs that draw nest some ten groups.
const MAX_DEPTH: u32 = 100;
/// The most bytes that entities may add to the text.
const MAX_ENTITY_BYTES: u64 = 1 << 20;

/// Refuses a text that grows beyond the bounds. What is no XML is left to its reader.
///
/// # Errors
/// With the bound that it exceeds, and what to do.
pub(super) fn check(text: &str) -> Result<()> {
    if entity_bytes(text) > MAX_ENTITY_BYTES {
        return Err(too_much("its entities stand for more than 1 MB of text"));
    }
    let options = ParsingOptions { allow_dtd: true, ..ParsingOptions::default() };
    let Ok(document) = Document::parse_with_options(text, options) else { return Ok(()) };
    let ids = document.descendants().filter_map(|n| Some((n.attribute("id")?, n.id()))).collect();
    let sheets: Vec<&str> = document
        .descendants()
        .filter(|n| n.has_tag_name("style") || n.tag_name().name() == "style")
        .filter_map(|n| n.text())
        .collect();
    let by_style = sheets.iter().flat_map(|sheet| referred(sheet)).map(str::to_owned).collect();
    let mut measure = Measure { document: &document, ids, by_style, known: HashMap::new(), open: Vec::new() };
    let size = measure.of(document.root_element(), 0)?;
    let over = match size {
        s if s.elements > MAX_ELEMENTS => format!("it stands for more than {MAX_ELEMENTS} elements"),
        s if s.segments > MAX_SEGMENTS => format!("its paths have more than {MAX_SEGMENTS} segments"),
        s if s.bytes > MAX_BYTES => format!("its attributes stand for more than {} MB", MAX_BYTES >> 20),
        _ => return Ok(()),
    };
    Err(too_much(&over))
}

pub(super) fn too_much(what: &str) -> Fault {
    Fault::of(FileFault::TooLarge, format!("the layer is too large: {what}"))
        .help("simplify the drawing: fewer shapes, dashes, copies and patterns")
}

/// What an element stands for.
#[derive(Debug, Clone, Copy, Default)]
struct Size {
    elements: u64,
    segments: u64,
    bytes: u64,
}

impl Size {
    fn add(&mut self, other: Self, times: u64) {
        let add = |a: &mut u64, b: u64| *a = a.saturating_add(b.saturating_mul(times));
        add(&mut self.elements, other.elements);
        add(&mut self.segments, other.segments);
        add(&mut self.bytes, other.bytes);
    }
}

struct Measure<'a, 'input> {
    document: &'a Document<'input>,
    ids: HashMap<&'a str, NodeId>,
    by_style: Vec<String>,
    known: HashMap<NodeId, Size>,
    open: Vec<NodeId>,
}

impl<'a, 'input> Measure<'a, 'input> {
    fn of(&mut self, node: Node<'a, 'input>, depth: u32) -> Result<Size> {
        if depth > MAX_DEPTH {
            return Err(too_much(&format!("it is nested more than {MAX_DEPTH} deep")));
        }
        // A circle of references is cut by the reader.
        if self.open.contains(&node.id()) {
            return Ok(Size::default());
        }
        if let Some(size) = self.known.get(&node.id()) {
            return Ok(*size);
        }
        self.open.push(node.id());
        let mut size = Size { elements: 1, ..Size::default() };
        let mut vertices = 1;
        for attribute in node.attributes() {
            size.bytes += attribute.value().len() as u64;
            if matches!(attribute.name(), "d" | "points") {
                size.segments += segments_in(attribute.value());
                vertices = size.segments.max(1);
            }
        }
        let mut named: Vec<(String, u64)> = self.by_style.iter().map(|id| (id.clone(), vertices)).collect();
        for attribute in node.attributes() {
            // A marker stands at every point of its path.
            let times =
                if attribute.name().starts_with("marker") || attribute.name() == "style" { vertices } else { 1 };
            named.extend(referred(attribute.value()).map(|id| (id.to_owned(), times)));
            if attribute.name() == "href"
                && let Some(id) = attribute.value().trim().strip_prefix('#')
            {
                named.push((id.to_owned(), 1));
            }
        }
        for (id, times) in named {
            let target = self.ids.get(id.as_str()).and_then(|id| self.document.get_node(*id));
            if let Some(target) = target {
                size.add(self.of(target, depth + 1)?, times);
            }
        }
        for child in node.children().filter(Node::is_element) {
            size.add(self.of(child, depth + 1)?, 1);
        }
        self.open.pop();
        self.known.insert(node.id(), size);
        Ok(size)
    }
}

/// The names in `url(#…)`.
fn referred(text: &str) -> impl Iterator<Item = &str> {
    text.split("url(").skip(1).filter_map(|rest| {
        let inside = rest.split(')').next()?.trim().trim_matches(['"', '\'']);
        inside.strip_prefix('#')
    })
}

/// An upper bound of the segments of path data or points: a command of each letter, and one for each set of its numbers.
fn segments_in(data: &str) -> u64 {
    let (mut segments, mut arity, mut numbers, mut in_number) = (0_u64, 2_u64, 0_u64, false);
    for c in data.chars() {
        match c {
            'e' | 'E' if in_number => {}
            '0'..='9' => {
                numbers += u64::from(!in_number);
                in_number = true;
            }
            // A second point begins a number of its own.
            '.' | '-' | '+' => {
                numbers += 1;
                in_number = true;
            }
            c => {
                in_number = false;
                if c.is_ascii_alphabetic() {
                    segments += 1 + numbers / arity;
                    numbers = 0;
                    arity = match c.to_ascii_lowercase() {
                        'h' | 'v' => 1,
                        'c' => 6,
                        's' | 'q' => 4,
                        // As up to four curves.
                        _ => 2,
                    };
                }
            }
        }
    }
    segments + numbers / arity
}

/// The bytes that entities of the document's own can add: every reference as the longest of them, with as many references
/// inside as the reader follows where any has one.
fn entity_bytes(text: &str) -> u64 {
    let declared = text.split("<!ENTITY").skip(1).map(|rest| rest.split('>').next().unwrap_or_default());
    let Some(longest) = declared.clone().map(str::len).max() else { return 0 };
    let nested = if declared.clone().any(|entity| entity.contains('&')) { 255 } else { 1 };
    let common = ["&amp;", "&lt;", "&gt;", "&quot;", "&apos;", "&#"].iter().map(|c| text.matches(c).count()).sum();
    let references = text.matches('&').count().saturating_sub(common);
    (references as u64).saturating_mul(longest as u64).saturating_mul(nested)
}
